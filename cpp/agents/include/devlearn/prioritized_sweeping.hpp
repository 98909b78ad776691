#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/last_outcomes.hpp"
#include "devlearn/detail/value_table.hpp"
#include "devlearn/value_settings.hpp"

namespace devlearn {

/// The settings of PrioritizedSweeping.
struct PrioritizedSweepingConfig {
  double alpha = 1.0;
  double gamma = 1.0;
  double epsilon = 0.1;
  FirstValue first_value = FirstValue::kConstant;
  double initial_value = 0.0;
  Shaping shaping = Shaping::kNone;
  int planning_steps = 10;
  double theta = 1e-4;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = PrioritizedSweepingConfig;
    return described_with_values<C>(
        "PrioritizedSweepingConfig",
        field("planning_steps", &C::planning_steps, "n", whole(0, 1000000),
              "updates after each step, at most"),
        field("theta", &C::theta, "theta", closed(0.0, 1e9),
              "what would change a value by no more than this is not queued"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const PrioritizedSweepingConfig& a,
                       const PrioritizedSweepingConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const PrioritizedSweepingConfig& a,
                       const PrioritizedSweepingConfig& b) noexcept {
  return !(a == b);
}

/// Prioritized sweeping for a deterministic world (Moore & Atkeson 1993, as in Sutton & Barto 8.4),
/// epsilon-greedy. The model is what came of each motion when it was last tried. After each step at
/// most planning_steps updates of Q-learning from the model, those first that change most; what led
/// to a situation whose value changed is queued by how much it would change, if by more than theta.
/// What is left in the queue stays there. With alpha below 1 an update leaves an error that is not
/// queued again until something around it changes.
///
/// An arrival is worth 0. Maxima are over the motions allowed at the last choice in a situation.
/// choose throws InvalidValue while a choice waits, or for another motion_count than before;
/// observe and cancel where none waits; all for numbers that are not finite.
class PrioritizedSweeping final : public Agent {
 public:
  using Config = PrioritizedSweepingConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "prioritized_sweeping";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit PrioritizedSweeping(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit PrioritizedSweeping(const AgentState& state, const std::string& source = "state");

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// How many updates there have been.
  std::uint64_t updates() const noexcept { return updates_; }
  /// Q of a situation and motion; nothing for a situation never met. Throws InvalidValue for a
  /// negative situation or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }

 private:
  double target(std::size_t pair) const noexcept;
  void queue(std::size_t pair);
  void fit();

  Config config_;
  detail::ValueTable table_;
  detail::LastOutcomes model_;
  std::vector<std::set<std::size_t>> leading_;      // pairs that lead to each row
  std::vector<double> priority_;                    // of each pair; 0 for one that is not queued
  std::set<std::pair<double, std::size_t>> queue_;  // less the priority, and the pair
  std::uint64_t updates_ = 0;
};

}  // namespace devlearn
