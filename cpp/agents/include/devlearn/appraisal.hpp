#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/transition_counts.hpp"
#include "devlearn/detail/value_table.hpp"

namespace devlearn {

/// The settings of Appraisal.
struct AppraisalConfig {
  double novelty = 0.0;
  double motivation = 0.0;
  double control = -0.3;
  double valence = 0.0;
  double external = 0.7;
  double alpha = 0.3;
  double gamma = 0.9;
  double epsilon = 1.0;
  double epsilon_decay = 1.0001;
  double novelty_decay = 1.001;
  int planning_steps = 10;
  double theta = 1e-4;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = AppraisalConfig;
    constexpr Interval weight = closed(-1.0, 1.0);
    return described(
        "AppraisalConfig",
        field("novelty", &C::novelty, "phi_n", weight, "weight of novelty in what is learned from"),
        field("motivation", &C::motivation, "phi_m", weight,
              "weight of motivation, which is goal relevance"),
        field("control", &C::control, "phi_c", weight, "weight of control"),
        field("valence", &C::valence, "phi_v", weight, "weight of valence"),
        field("external", &C::external, "phi_e", weight, "weight of the reward from outside"),
        field("alpha", &C::alpha, "alpha", above(0.0, 1.0), "step size"),
        field("gamma", &C::gamma, "gamma", closed(0.0, 1.0), "discount rate"),
        field("epsilon", &C::epsilon, "epsilon", closed(0.0, 1.0),
              "probability of a random motion instead of a greedy one, at first"),
        field("epsilon_decay", &C::epsilon_decay, "", closed(1.0, 2.0),
              "what epsilon is divided by after each step"),
        field("novelty_decay", &C::novelty_decay, "lambda", closed(1.0, 2.0),
              "what novelty is divided by at each visit"),
        field("planning_steps", &C::planning_steps, "n", whole(0, 1000000),
              "updates after each step, at most; as many again of the values of external reward"),
        field("theta", &C::theta, "theta", closed(0.0, 1e9),
              "what would change a value by no more than this is not queued"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const AppraisalConfig& a, const AppraisalConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const AppraisalConfig& a, const AppraisalConfig& b) noexcept {
  return !(a == b);
}

/// How a situation is appraised at present, for each of its N motions. The reward of a motion is
/// the sum of its four appraisals and of the mean reward from outside, weighted by the settings.
struct AppraisalExplanation {
  SituationId situation = -1;  ///< which
  AppraisalConfig config;      ///< the weights, and all other settings
  double epsilon = 0.0;        ///< probability of a random motion, at present
  SituationId goal = -1;       ///< the situation of the highest external value; -1: none as yet
  /// Motions from here to the goal, by all transitions seen; -1: no way is known
  std::int64_t goal_distance = -1;
  std::vector<bool> allowed;           ///< N: at the last choice here
  std::vector<std::uint32_t> visits;   ///< N: how often each was tried
  std::vector<double> novelty;         ///< N: in [0, 1]
  double motivation = 0.0;             ///< in [0, 1], the same for all motions
  std::vector<double> control;         ///< N: in [0, 1]
  std::vector<double> valence;         ///< N: in [0, 1]
  std::vector<double> external;        ///< N: mean reward from outside; 0 for one never tried
  std::vector<double> reward;          ///< N: what they come to
  std::vector<double> value;           ///< N: Q, by which motions are chosen
  std::vector<double> external_value;  ///< N: Q of external rewards alone
};

/// A table for people, a line a motion.
std::string to_text(const AppraisalExplanation& explanation);

/// Learning by appraising, as in Sequeira, Melo & Paiva (2011; 2014) and their published program:
/// rewards come from within. Each step is appraised by the history of (s, a),
///
///     novelty     (lambda^-n(s) + lambda^-n(s, a)) / 2, n: visits before this one
///     motivation  1 / (1 + d), d: motions from s to the goal, the situation of the highest V_e
///     control     1 - mean |change| of Q_e(s, a), over its updates
///     valence     (Q_e(s, a) / V_e(s) + (V_e(s) - min V_e) / (max V_e - min V_e)) / 2
///
/// and Q is learned of their sum with the external reward, weighted; Q_e, of external rewards
/// alone. Weights by default are those that the program calls universal. Both by prioritized
/// sweeping, from what each motion led to, drawn by how often it did, and from mean rewards. Chosen
/// by Q, epsilon-greedy, with an epsilon that falls from step to step.
///
/// All appraisals are held within [0, 1]. Where V_e(s) is below 0, V_e(s) / Q_e(s, a) is taken;
/// where it is 0, or all V_e are equal, valence is 0; where no way to a goal is known, motivation.
///
/// An arrival is worth 0. Maxima are over the motions allowed at the last choice in a situation.
/// choose throws InvalidValue while a choice waits, or for another motion_count than before;
/// observe and cancel where none waits; all for numbers that are not finite.
class Appraisal final : public Agent {
 public:
  using Config = AppraisalConfig;  ///< its settings
  /// In a state, and in files.
  static constexpr const char* kKind = "appraisal";

  /// seed: of the stream "agent". Throws InvalidValue.
  explicit Appraisal(const Config& config = {}, std::uint64_t seed = 0);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit Appraisal(const AgentState& state, const std::string& source = "state");

  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override { table_.cancel(); }
  std::optional<AgentState> state() const override;

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// The probability of a random motion, at present.
  double epsilon() const noexcept { return epsilon_; }
  /// Q of a situation and motion; nothing for a situation never met. Throws InvalidValue for a
  /// negative situation or a motion outside M.
  std::optional<double> value(SituationId situation, int motion) const {
    return table_.value(situation, motion);
  }
  /// How a situation is appraised; nothing for one never met. Throws InvalidValue for a negative
  /// one.
  std::optional<AppraisalExplanation> explain(SituationId situation) const;

 private:
  using Row = detail::Row;
  /// Of what rewards values are: of those from outside, or of all.
  enum Of : std::size_t { kExternal, kAppraised };
  struct Appraisals {
    double novelty, motivation, control, valence;
  };

  static detail::ValueTable::Rules rules(const Config& config) {
    return {FirstValue::kConstant, 0.0, Shaping::kNone, config.gamma};
  }

  double q(Of of, std::size_t pair) const noexcept;
  double best(Of of, Row row) const noexcept;
  void set(Of of, std::size_t pair, double value);
  void learn(Of of, std::size_t pair, double reward, Row next);
  double priority(Of of, std::size_t pair, double reward, Row next) const noexcept;

  double novelty(Row row, int motion) const noexcept;
  Appraisals appraise(Row row, int motion) const noexcept;
  double weighted(const Appraisals& appraisals, double external) const noexcept;

  void fit();
  void rank(Row row);
  void aim();
  void shorten(Row row);

  Config config_;
  detail::ValueTable table_;
  detail::TransitionCounts model_;
  double epsilon_;
  std::array<std::vector<double>, 2> reward_;  // mean of each pair, of external ones and of all
  std::vector<double> external_;               // Q_e
  std::vector<double> change_;                 // mean |change| of Q_e
  std::vector<std::uint64_t> updates_;         // of Q_e
  std::vector<bool> updated_;                  // of each pair, in the present sweep
  // What follows from these.
  std::vector<double> worth_;                // V_e of each row
  std::set<std::pair<double, Row>> ranked_;  // less V_e, and the row
  Row goal_ = detail::kNoRow;
  std::vector<std::int64_t> distance_;  // of each row from the goal, or -1
};

}  // namespace devlearn
