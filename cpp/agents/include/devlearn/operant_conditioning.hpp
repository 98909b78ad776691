#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/fields.hpp"
#include "devlearn/detail/value_table.hpp"

namespace devlearn {

/// By what a motion is reinforced or extinguished.
enum class ReinforcedBy : std::uint8_t {
  kSmf,     ///< the sign of SMF, as orientation grows or shrinks by Eq. 9
  kReward,  ///< the sign of the reward less the mean of those that came in the situation before
};

/// The settings of OperantConditioning.
struct OperantConditioningConfig {
  double reward_step = 0.1;
  double penalty_step = 0.01;
  ReinforcedBy reinforced_by = ReinforcedBy::kSmf;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = OperantConditioningConfig;
    return described(
        "OperantConditioningConfig",
        field("reward_step", &C::reward_step, "a", open(0.0, 1.0),
              "step towards a motion that is reinforced"),
        field("penalty_step", &C::penalty_step, "b", Interval{0.0, 1.0, true, false, ""},
              "step away from a motion that is extinguished: as much as a in the scheme "
              "L_R-P, 0 in L_R-I, between them in L_R-eP"),
        field("reinforced_by", &C::reinforced_by, "", names("smf", "reward"),
              "what reinforces: SMF above 0, or a reward above the mean of those that "
              "came in the situation before; less extinguishes, and equal does neither"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const OperantConditioningConfig& a,
                       const OperantConditioningConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const OperantConditioningConfig& a,
                       const OperantConditioningConfig& b) noexcept {
  return !(a == b);
}

/// What OperantConditioning has come to in a situation. Of N motions:
struct ConditioningExplanation {
  SituationId situation = -1;               ///< which
  std::vector<bool> allowed;                ///< N: whether each may be chosen
  std::vector<double> probability;          ///< N: of each to be chosen; they sum to 1
  std::vector<std::uint64_t> tried;         ///< N: how often each was
  std::vector<std::uint64_t> reinforced;    ///< N: and was reinforced
  std::vector<std::uint64_t> extinguished;  ///< N: and was extinguished
  double entropy = 0.0;                     ///< of all N probabilities [bits]
  double mean_reward = 0.0;                 ///< of the rewards that came; 0 before the first
  int last_motion = -1;                     ///< the one last tried; -1 for none
  int last_reinforcement = 0;  ///< what came of it: 1 reinforced, -1 extinguished, 0 neither
};

/// A table for people, a line a motion.
std::string to_text(const ConditioningExplanation& explanation);

/// Operant conditioning as a one-to-one mapping: in every situation a probability for each of its N
/// motions, at first 1 / N, all of which change with every step. It is the learning automaton of
/// linear reward and penalty (Bush & Mosteller 1955; Narendra & Thathachar 1974): where motion i is
///
///     reinforced,    p_i <- p_i + a (1 - p_i),    p_j <- (1 - a) p_j;
///     extinguished,  p_i <- (1 - b) p_i,          p_j <- b / (N - 1) + (1 - b) p_j,
///
/// j being every other one. b = a is the scheme L_R-P, which never settles; b = 0 is L_R-I, which
/// settles on one motion, the better one almost surely for small a; a small b is L_R-eP.
///
/// Of motions that are allowed, each has its probability over their sum, and what is learned is
/// learned within that sum (Thathachar & Harita 1987); where the sum is 0, each is as likely.
/// choose throws InvalidValue while a choice waits, or for another motion_count than before;
/// observe and cancel where none waits; all for numbers that are not finite.
class OperantConditioning final : public Agent {
 public:
  using Config = OperantConditioningConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "operant_conditioning";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit OperantConditioning(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit OperantConditioning(const AgentState& state, const std::string& source = "state");

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// The probability of a motion where all are allowed; nothing for a situation never met. Throws
  /// InvalidValue for a negative situation or a motion outside M.
  std::optional<double> probability(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }
  /// Entropy of a situation's probabilities, -sum p log2 p, in [0, log2 N] bits; nothing for a
  /// situation never met. Throws InvalidValue for a negative situation.
  std::optional<double> entropy(SituationId situation) const;
  /// The mean of that over all situations met; nothing before the first.
  std::optional<double> mean_entropy() const;
  /// What it has come to in a situation, of motions that are allowed now; nothing for a situation
  /// never met. Throws InvalidValue for a negative situation, and for a mask that fits no motions.
  std::optional<ConditioningExplanation> explain(SituationId situation,
                                                 AllowedMotions allowed = {}) const;

 private:
  // How often a motion was tried, and what came of it.
  struct Counts {
    std::uint64_t tried = 0, reinforced = 0, extinguished = 0;
  };
  // What was last tried in a situation, and the mean of what came.
  struct Last {
    int motion = -1, reinforcement = 0;
    double mean_reward = 0.0;
  };
  // Of some motions: their probability together, and how many they are.
  struct Share {
    double sum;
    int count;
  };

  void fit();
  template <typename Allowed>
  Share share_of(detail::Row row, const Allowed& allowed) const;
  int judge(detail::Row row, double smf, double reward);
  void learn(detail::Row row, int motion, int reinforcement);
  double entropy_of(detail::Row row) const noexcept;

  Config config_;
  detail::ValueTable table_;    // Q is the probability
  std::vector<Counts> counts_;  // of each pair
  std::vector<Last> last_;      // of each row
};

}  // namespace devlearn
