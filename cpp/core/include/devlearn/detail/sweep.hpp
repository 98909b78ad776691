#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "devlearn/detail/fields.hpp"

namespace devlearn::detail {

/// Passes over all situations, the one met last first, for what is known of the goal spreads from
/// there; until one changes little. It can stop anywhere and go on later.
struct Sweep {
  int next = -1;
  int passes = 0;
  bool found = false;
  double change = 0.0;

  /// See AdaptiveConfig::fields.
  static constexpr auto fields() {
    using C = Sweep;
    return described(
        "sweep",
        field("next", &C::next, "", whole(-1, 2'147'483'646), "situation; -1: not under way"),
        field("passes", &C::passes, "", whole(0, 1'000), "left, this one included"),
        field("found", &C::found, "", Truth{}, "whether this pass, or the last, found something"),
        field("change", &C::change, "", closed(0.0, std::numeric_limits<double>::infinity()),
              "the largest in this pass"));
  }

  bool under_way() const noexcept { return next >= 0; }

  /// Over so many situations.
  void begin(std::size_t count, int most_passes) noexcept {
    *this = {static_cast<int>(count) - 1, most_passes, false, 0.0};
  }

  /// visit(situation, *this), which gives the change, for so many more of them.
  template <typename Visit>
  void go_on(std::size_t count, std::size_t visits, double small, const Visit& visit) {
    for (; visits > 0 && under_way(); --visits) {
      change = std::max(change, visit(static_cast<std::uint32_t>(next), *this));
      if (--next >= 0) continue;
      if (--passes > 0 && change >= small) begin(count, passes);
    }
  }
};

}  // namespace devlearn::detail
