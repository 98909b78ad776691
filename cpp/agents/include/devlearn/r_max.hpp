#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/value_table.hpp"
#include "devlearn/value_settings.hpp"

namespace devlearn {

/// The settings of RMax.
struct RMaxConfig {
  int m = 3;
  double gamma = 1.0;
  FirstValue first_value = FirstValue::kEstimate;
  double initial_value = 0.0;
  double theta = 1e-6;
  double least_value = -1000.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = RMaxConfig;
    return described(
        "RMaxConfig",
        field("m", &C::m, "m", whole(1, 1000), "times a motion is tried until it is known"),
        field("gamma", &C::gamma, "gamma", closed(0.0, 1.0), "discount rate"),
        field("first_value", &C::first_value, "", names("constant", "estimate"),
              "value of a motion that is not known: initial_value, or less the estimate of the "
              "cost to go"),
        field("initial_value", &C::initial_value, "", closed(-1e9, 1e9),
              "value of a motion that is not known, where first_value is constant"),
        field("theta", &C::theta, "theta", closed(1e-9, 1e9),
              "changes of a value by no more than this are not planned on with"),
        field("least_value", &C::least_value, "", closed(-1e6, 0.0),
              "value of that from which nothing leads on"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const RMaxConfig& a, const RMaxConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const RMaxConfig& a, const RMaxConfig& b) noexcept { return !(a == b); }

/// R-max (Brafman & Tennenholtz 2002): a motion is known in a situation once it was tried m times
/// there. The known ones make up the model, as often as each outcome came; one that is not known is
/// worth its first value, which should be no less than what can be had. The best plan under that is
/// followed, each of equal motions as likely, and made anew, by value iteration where values
/// change, as a motion becomes known: so it explores, or is near to optimal.
///
/// An arrival is worth 0. Only allowed motions count. choose throws InvalidValue while a choice
/// waits, or for another motion_count than before; observe and cancel where none waits; all for
/// numbers that are not finite.
class RMax final : public Agent {
 public:
  using Config = RMaxConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "r_max";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit RMax(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit RMax(const AgentState& state, const std::string& source = "state");

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// The value of a motion in a situation under the plan; nothing for a situation never met. Throws
  /// InvalidValue for a negative situation or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }
  /// How often a motion was tried in a situation, at most m: then it is known. Throws InvalidValue
  /// as value does.
  int visits(SituationId situation, int motion) const;

 private:
  static detail::ValueTable::Rules rules(const Config& config) {
    return {config.first_value, config.initial_value, Shaping::kNone, config.gamma};
  }

  bool known(std::size_t pair) const noexcept {
    return visits_[pair] == static_cast<std::uint32_t>(config_.m);
  }
  double worth(detail::Row row) const noexcept;
  void fit();
  void add_leading(std::size_t pair);
  void plan_from(detail::Row row);
  bool plan(detail::Row row);

  Config config_;
  detail::ValueTable table_;
  std::vector<std::uint32_t> visits_;           // of each pair, at most m
  std::vector<double> reward_;                  // their sum
  std::vector<detail::Row> next_;               // of each of m visits
  std::vector<double> worth_;                   // of each row, as planned with
  std::vector<std::set<detail::Row>> leading_;  // rows from which a known motion leads to each
};

}  // namespace devlearn
