#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/last_outcomes.hpp"
#include "devlearn/detail/value_table.hpp"
#include "devlearn/value_settings.hpp"

namespace devlearn {

/// The settings of DynaQ.
struct DynaQConfig {
  double alpha = 0.5;
  double gamma = 1.0;
  double epsilon = 0.1;
  FirstValue first_value = FirstValue::kConstant;
  double initial_value = 0.0;
  Shaping shaping = Shaping::kNone;
  int planning_steps = 10;
  double kappa = 0.0;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = DynaQConfig;
    return described_with_values<C>(
        "DynaQConfig",
        field("planning_steps", &C::planning_steps, "n", whole(0, 1000000),
              "steps of planning after each real one"),
        field("kappa", &C::kappa, "kappa", closed(0.0, 1e6),
              "bonus of Dyna-Q+: planning adds kappa sqrt(tau) to the reward of a motion not tried "
              "for tau steps; 0 is Dyna-Q"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const DynaQConfig& a, const DynaQConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const DynaQConfig& a, const DynaQConfig& b) noexcept { return !(a == b); }

/// Tabular Dyna-Q (Sutton & Barto 8.2), epsilon-greedy: after each real step of Q-learning,
/// planning_steps more from a model, which is what came of each motion when it was last tried; of a
/// situation in which a motion was tried, and of such a motion, each as likely.
///
/// With kappa > 0 it is Dyna-Q+ (8.3): a motion not tried for tau steps is planned with the reward
/// R + kappa sqrt(tau). Motions never tried are planned, too, where they are allowed: as if they
/// led back, with a reward of 0, tau counted from the first step. Then gamma should be below 1.
///
/// An arrival is worth 0. Maxima are over the motions allowed at the last choice in a situation.
/// choose throws InvalidValue while a choice waits, or for another motion_count than before;
/// observe and cancel where none waits; all for numbers that are not finite.
class DynaQ final : public Agent {
 public:
  using Config = DynaQConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "dyna_q";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit DynaQ(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit DynaQ(const AgentState& state, const std::string& source = "state");

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
  void plan();
  bool may_be_planned(detail::Row row, int motion) const noexcept;

  Config config_;
  detail::ValueTable table_;
  detail::LastOutcomes model_;
  std::uint64_t steps_ = 0;
  std::vector<std::uint64_t> last_tried_;  // the step, for each pair; 0 for never
  std::vector<detail::Row> tried_rows_;    // in which a motion was tried, in the order of that
};

}  // namespace devlearn
