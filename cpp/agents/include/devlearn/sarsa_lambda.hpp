#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/value_table.hpp"
#include "devlearn/value_settings.hpp"

namespace devlearn {

/// What a visit makes of an eligibility trace.
enum class Traces : std::uint8_t {
  kAccumulating,  ///< one more
  kReplacing,     ///< 1
};

/// The settings of SarsaLambda.
struct SarsaLambdaConfig {
  double alpha = 0.5;
  double gamma = 1.0;
  double epsilon = 0.1;
  FirstValue first_value = FirstValue::kConstant;
  double initial_value = 0.0;
  Shaping shaping = Shaping::kNone;
  double trace_decay = 0.9;
  Traces traces = Traces::kAccumulating;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = SarsaLambdaConfig;
    return described_with_values<C>(
        "SarsaLambdaConfig",
        field("trace_decay", &C::trace_decay, "lambda", closed(0.0, 1.0),
              "trace-decay parameter: how far back an outcome is learned from; "
              "0 is SARSA"),
        field("traces", &C::traces, "", names("accumulating", "replacing"),
              "what a visit makes of an eligibility trace: one more, or 1"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const SarsaLambdaConfig& a, const SarsaLambdaConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const SarsaLambdaConfig& a, const SarsaLambdaConfig& b) noexcept {
  return !(a == b);
}

/// SARSA(lambda), tabular and epsilon-greedy (Sutton & Barto 12.7; with lambda 0, 6.4):
///
///     delta = R + gamma Q(S', A') - Q(S, A)
///     Q <- Q + alpha delta z,    z <- gamma lambda z
///
/// with a trace z for each situation and motion of the round, which a visit makes one more, or 1.
/// An arrival is worth 0. A motion is learned about once A' has run; where the round ends or is
/// broken off before that, or the next choice is elsewhere, it is not. A trace below 1e-10 is
/// dropped. choose throws InvalidValue while a choice waits, or for another motion_count than
/// before; observe and cancel where none waits; all for numbers that are not finite.
class SarsaLambda final : public Agent {
 public:
  using Config = SarsaLambdaConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "sarsa_lambda";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit SarsaLambda(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit SarsaLambda(const AgentState& state, const std::string& source = "state");

  void begin_round() override { forget_round(); }
  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  void end_round(bool) override { forget_round(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// Q of a situation and motion; nothing for a situation never met. Throws InvalidValue for a
  /// negative situation or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }

 private:
  void learn(std::size_t pair, double target);
  void forget_round();

  Config config_;
  detail::ValueTable table_;
  std::optional<detail::Transition> last_;  // whose next motion has not run yet
  std::vector<std::uint64_t> traced_;       // pairs, in the order of their first visits
  std::vector<double> traces_;              // z of each
};

}  // namespace devlearn
