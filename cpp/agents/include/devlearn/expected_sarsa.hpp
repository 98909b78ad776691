#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "devlearn/agent.hpp"
#include "devlearn/detail/value_table.hpp"
#include "devlearn/value_settings.hpp"

namespace devlearn {

/// The settings of ExpectedSarsa.
struct ExpectedSarsaConfig {
  double alpha = 0.5;
  double gamma = 1.0;
  double epsilon = 0.1;
  FirstValue first_value = FirstValue::kConstant;
  double initial_value = 0.0;
  Shaping shaping = Shaping::kNone;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    return detail::described_with_values<ExpectedSarsaConfig>("ExpectedSarsaConfig");
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const ExpectedSarsaConfig& a, const ExpectedSarsaConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const ExpectedSarsaConfig& a, const ExpectedSarsaConfig& b) noexcept {
  return !(a == b);
}

/// Expected SARSA (Sutton & Barto 6.6) under its epsilon-greedy policy pi:
///
///     Q(S, A) <- Q(S, A) + alpha (R + gamma sum_a pi(a | S') Q(S', a) - Q(S, A))
///
/// An arrival is worth 0. The sum is over the motions allowed at the last choice in a situation.
/// choose throws InvalidValue while a choice waits, or for another motion_count than before;
/// observe and cancel where none waits; all for numbers that are not finite.
class ExpectedSarsa final : public Agent {
 public:
  using Config = ExpectedSarsaConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "expected_sarsa";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit ExpectedSarsa(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit ExpectedSarsa(const AgentState& state, const std::string& source = "state");

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// Q of a situation and motion; nothing for a situation never met. Throws InvalidValue for a
  /// negative situation or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }

 private:
  Config config_;
  detail::ValueTable table_;
};

}  // namespace devlearn
