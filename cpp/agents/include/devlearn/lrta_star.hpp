#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "devlearn/agent.hpp"
#include "devlearn/detail/last_outcomes.hpp"
#include "devlearn/detail/value_table.hpp"
#include "devlearn/value_settings.hpp"

namespace devlearn {

/// The settings of LrtaStar.
struct LrtaStarConfig {
  FirstValue first_value = FirstValue::kEstimate;
  double initial_value = 0.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = LrtaStarConfig;
    return described("LrtaStarConfig",
                     field("first_value", &C::first_value, "", names("constant", "estimate"),
                           "-h of a situation when it is first met: initial_value, or less the "
                           "estimate of the cost to go"),
                     field("initial_value", &C::initial_value, "", closed(-1e9, 1e9),
                           "-h of a situation when it is first met, where first_value is "
                           "constant"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const LrtaStarConfig& a, const LrtaStarConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const LrtaStarConfig& a, const LrtaStarConfig& b) noexcept {
  return !(a == b);
}

/// Learning real-time A* (Korf 1990): in situation s, of what each motion led to when it was last
/// tried,
///
///     f(s, a) = cost + h(s'),    h(s) <- min_a f(s, a),
///
/// and the motion of the least f, each of those as likely. h is first the estimate of the cost to
/// go, and so is f of a motion that was never tried; an arrival's h is 0. In a deterministic world
/// with an estimate that is never too high, each round arrives, and rounds become optimal.
///
/// Only allowed motions count. choose throws InvalidValue while a choice waits, or for another
/// motion_count than before; observe and cancel where none waits, and observe for a cost that is
/// not above 0; all for numbers that are not finite.
class LrtaStar final : public Agent {
 public:
  using Config = LrtaStarConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "lrta_star";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit LrtaStar(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit LrtaStar(const AgentState& state, const std::string& source = "state");

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// -f of a situation and motion, as last computed; nothing for a situation never met. Throws
  /// InvalidValue for a negative situation or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }

 private:
  static detail::ValueTable::Rules rules(const Config& config) {
    return {config.first_value, config.initial_value, Shaping::kNone, 1.0};
  }

  Config config_;
  detail::ValueTable table_;  // Q = -f, so that its maximum is -h
  detail::LastOutcomes model_;
};

}  // namespace devlearn
