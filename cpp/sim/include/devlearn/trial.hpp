#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "devlearn/adaptive.hpp"
#include "devlearn/agent.hpp"
#include "devlearn/detail/fields.hpp"
#include "devlearn/evaluation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/record.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/tally.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

/// Where d_o of Eq. 6 comes from.
enum class ClearanceSource : std::uint8_t {
  kGeometric,  ///< exact distance from the robot's centre to the nearest surface
  kSonar,      ///< least echo plus the robot's radius, what a real robot has
};

/// Everything a trial needs besides the world and the seed; the defaults are the paper's.
struct TrialConfig {
  std::variant<LearnerConfig, AdaptiveConfig> learner;
  StateEvaluation evaluation;
  RobotDef robot;
  ClearanceSource clearance_source = ClearanceSource::kGeometric;
  bool walls_count = false;
  double goal_radius = 0.1;
  double touch_cost = 5.0;
  double cell_size = 0.25;
  int heading_bins = 12;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = TrialConfig;
    return described(
        "TrialConfig",
        field("learner", &C::learner, "", one_of("learner", "adaptive"),
              "the paper's steps 3-5, or the adaptive learner; its motions are the robot's"),
        field("evaluation", &C::evaluation, "", Nested{}, "step 2, Eq. 6"),
        field("robot", &C::robot, "", Nested{}, "Eq. 1-2"),
        field("clearance_source", &C::clearance_source, "", names("geometric", "sonar"),
              "where d_o of Eq. 6 comes from: the exact distance, or the least echo plus the "
              "robot's radius"),
        field("walls_count", &C::walls_count, "", Truth{},
              "whether walls count in d_o; the clearance source sonar needs it"),
        field("goal_radius", &C::goal_radius, "", above(0.0, 100.0, "m"),
              "arrived when d_g is no more than this"),
        later(field("touch_cost", &C::touch_cost, "", closed(0.0, 1e6),
                    "what a step costs beside 1 where the body touched something; the paper's "
                    "learner does not look at costs")),
        field("cell_size", &C::cell_size, "", closed(0.001, 1000.0, "m"),
              "side of a cell of the situation grid"),
        field("heading_bins", &C::heading_bins, "", whole(1, 3600),
              "headings of the situation grid"));
  }

  /// The default; see LearnerConfig::paper.
  static TrialConfig paper() { return {}; }
  /// See LearnerConfig::step5.
  static TrialConfig step5();
  /// The paper's, with an AdaptiveConfig.
  static TrialConfig adaptive();

  /// N_M of the learner.
  int motion_count() const;

  /// Throws InvalidValue.
  void validate() const;
};

bool operator==(const TrialConfig& a, const TrialConfig& b);
inline bool operator!=(const TrialConfig& a, const TrialConfig& b) { return !(a == b); }

/// What is sensed at a pose. The sonars' echoes there are told by a Robot of the same world and
/// def.
struct Senses {
  Pose pose;                   ///< [m, m, degrees]
  double goal_distance = 0.0;  ///< d_g [m]
  double clearance = 0.0;      ///< d_o [m]
};

/// A function of what is sensed, under a name by which a snapshot knows it: the same value for the
/// same senses. What it throws comes out of the trial's call.
template <typename Value>
struct NamedFunction {
  std::string name;                              ///< UTF-8; empty where there is no function
  std::function<Value(const Senses&)> function;  ///< null: the trial's own
};

/// What stands in place of Eq. 6 and of the grid's situations; by default nothing. Redefining both
/// is what the paper concludes with.
struct TrialParts {
  NamedFunction<double> evaluation;  ///< SEF, within +-1e300
  /// Or SEF of each of the grid's situations, as long as there are such; empty: none.
  std::vector<double> sef_table;
  NamedFunction<SituationId> situations;  ///< ids, at least 0
};

/// How a run is watched.
struct RunOptions {
  bool echoes = false;  ///< whether the sonars' echoes are recorded
  /// Called before a round's first step and every few steps; returning true ends the run there.
  std::function<bool()> interrupt;
  /// Whether nothing but Record::rounds is recorded, so that memory does not grow with steps; not
  /// together with echoes.
  bool rounds_only = false;
  /// Where the steps are counted, beside the record; null: nowhere.
  Tally* tally = nullptr;
};

/// The closed loop: world -> sense -> situation -> choice -> motion -> evaluation -> development
/// -> record.
///
/// A new trial stands at the world's start. Its rounds are numbered from 1; the first begins with
/// whatever is called first. One call at a time: an agent that moves its own trial is refused. What
/// an agent is told of rounds is in Agent.
class Trial {
 public:
  /// With a learner of its own from config.learner and `seed`. Throws InvalidValue.
  Trial(const World& world, const TrialConfig& config = {}, std::uint64_t seed = 0);
  /// The same, with an evaluation or situations of one's own. Throws InvalidValue.
  Trial(const World& world, const TrialConfig& config, std::uint64_t seed, TrialParts parts);
  /// With another agent. Throws InvalidValue.
  Trial(const World& world, const TrialConfig& config, std::uint64_t seed,
        std::shared_ptr<Agent> agent, TrialParts parts = {});

  /// One step: once around the loop. Where an agent throws, the trial is left as it was; likewise
  /// where a function of one's own does, and the agent's choice is cancelled.
  Step step();

  ///@{
  /// The phases append to a record: what is finished is kept there even where an agent throws.
  /// Throws InvalidValue for a record that has steps or echoes where it now would not, or the
  /// reverse.

  /// `steps` steps from where the robot is, in the present round.
  void run(Record& record, std::int64_t steps, const RunOptions& options = {});
  /// A new round of `steps` steps from the start pose; reaching the target ends nothing.
  void free_learning(Record& record, std::int64_t steps, const RunOptions& options = {});
  /// `rounds` new rounds from the start pose, each until the target is reached, or failed
  /// (arrived = false) after `step_limit` steps. A round that begins at the target has no step.
  void path_learning(Record& record, std::int64_t rounds, std::int64_t step_limit = 10000,
                     const RunOptions& options = {});
  /// Goes on with the present round until the target is reached, for at most `steps` steps: what
  /// finishes a round of path learning that was interrupted.
  void finish_round(Record& record, std::int64_t steps, const RunOptions& options = {});
  ///@}

  /// Puts the robot at the start pose for a new round.
  void begin_round();
  /// Puts the robot anywhere it fits for a new round. Throws InvalidValue.
  void place(const Pose& pose);
  /// Puts the robot where it was in a round, 0 before the first, of which the agent was told or
  /// not: what goes on from a snapshot. Throws InvalidValue.
  void resume(const Pose& pose, std::int32_t round, bool round_open);

  /// Where the robot is [m, m, degrees].
  const Pose& pose() const noexcept { return here_.pose; }
  /// The present round, from 1; 0 before the first.
  std::int32_t round() const noexcept { return round_; }
  /// Whether the agent is in a round: told that it began, and not yet that it ended.
  bool round_open() const noexcept { return round_open_; }
  /// Whether a call is under way, as its agent may see.
  bool under_way() const noexcept { return under_way_; }
  /// Whether the robot is at the target: d_g <= goal_radius.
  bool arrived() const noexcept { return arrived_at(here_); }
  ///@{
  /// What it was made of.
  const World& world() const noexcept { return robot_.world(); }
  const Robot& robot() const noexcept { return robot_; }
  /// The grid of config, whether or not its situations are used.
  const SituationGrid& grid() const noexcept { return grid_; }
  const TrialConfig& config() const noexcept { return config_; }
  std::uint64_t seed() const noexcept { return seed_; }
  const std::shared_ptr<Agent>& agent() const noexcept { return agent_; }
  const TrialParts& parts() const noexcept { return parts_; }
  ///@}
  /// The paper's learner, where that is the agent; null otherwise.
  std::shared_ptr<Learner> learner() const noexcept;
  /// The adaptive learner, where that is the agent; null otherwise.
  std::shared_ptr<AdaptiveLearner> adaptive_learner() const noexcept;

 private:
  void require_motions(int motions) const;
  void require_parts() const;
  Step tick();
  Observation sense(const Pose& pose) const;
  Observation sense_after(const Pose& pose) const;
  SituationId own_situation(const Observation& there) const;
  double own_sef(const Observation& there) const;
  double clearance(const Pose& pose) const;
  bool arrived_at(const Observation& place) const noexcept {
    return place.goal_distance <= config_.goal_radius;
  }
  AllowedMotions allowed() const;
  Choice chosen();
  Outcome outcome_of(const Observation& after, double smf, bool collided) const;
  void put(const Pose& pose);
  void open_round();
  void close_round(bool arrived);
  void open(Record& record, const RunOptions& options) const;
  void go_on(Record& record, std::int64_t steps, bool until_arrival, const RunOptions& options);
  bool run_on(Record& record, std::int64_t steps, bool until_arrival, const RunOptions& options);

  TrialConfig config_;
  std::uint64_t seed_;
  Robot robot_;
  SituationGrid grid_;
  std::shared_ptr<Agent> agent_;
  TrialParts parts_;
  Observation here_;
  std::unique_ptr<bool[]> allowed_;  // a bool a motion
  std::int32_t round_ = 0;
  bool round_open_ = false;
  bool under_way_ = false;
};

/// A new record of what `phases(record)` appends to it.
///
///     const Record record = recorded([&](Record& r) { trial.free_learning(r, 10000); });
template <typename Phases>
Record recorded(const Phases& phases) {
  Record record;
  phases(record);
  return record;
}

}  // namespace devlearn
