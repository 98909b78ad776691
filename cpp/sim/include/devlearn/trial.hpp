#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "devlearn/adaptive.hpp"
#include "devlearn/agent.hpp"
#include "devlearn/environment.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/record.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/tally.hpp"
#include "devlearn/trial_config.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

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
  /// Puts the robot at the start of another world, which has the same arena; robot, grid, agent
  /// and time stay. The present round ends, where the agent is in one. Throws InvalidValue.
  void change_world(const World& world);

  /// A world that the trial was in before.
  struct EarlierWorld {
    World world;         ///< as it was
    std::int64_t steps;  ///< made by the trial when it was changed
  };

  /// Puts the robot where it was in a round, 0 before the first, of which the agent was told or
  /// not: what goes on from a snapshot. Throws InvalidValue.
  void resume(const Environment::Place& place, std::int32_t round, bool round_open,
              std::vector<EarlierWorld> earlier_worlds = {});

  /// Where the robot is [m, m, degrees].
  const Pose& pose() const noexcept { return environment_.pose(); }
  /// The world's time: steps made so far, over all rounds, x sample_time [s].
  double time() const noexcept { return environment_.time(); }
  /// What change_world changed, the first world first.
  const std::vector<EarlierWorld>& earlier_worlds() const noexcept { return earlier_worlds_; }
  /// The robot in its world, without who chooses.
  const Environment& environment() const noexcept { return environment_; }
  /// The present round, from 1; 0 before the first.
  std::int32_t round() const noexcept { return round_; }
  /// Whether the agent is in a round: told that it began, and not yet that it ended.
  bool round_open() const noexcept { return round_open_; }
  /// Whether a call is under way, as its agent may see.
  bool under_way() const noexcept { return under_way_; }
  /// Whether the robot is at the target: d_g <= goal_radius.
  bool arrived() const noexcept { return environment_.arrived(); }
  ///@{
  /// What it was made of.
  const World& world() const noexcept { return environment_.world(); }
  const Robot& robot() const noexcept { return environment_.robot(); }
  /// The grid of config, whether or not its situations are used.
  const SituationGrid& grid() const noexcept { return environment_.grid(); }
  const TrialConfig& config() const noexcept { return environment_.config(); }
  std::uint64_t seed() const noexcept { return seed_; }
  const std::shared_ptr<Agent>& agent() const noexcept { return agent_; }
  const TrialParts& parts() const noexcept { return environment_.parts(); }
  ///@}
  /// The paper's learner, where that is the agent; null otherwise.
  std::shared_ptr<Learner> learner() const noexcept;
  /// The adaptive learner, where that is the agent; null otherwise.
  std::shared_ptr<AdaptiveLearner> adaptive_learner() const noexcept;

 private:
  void require_motions(int motions) const;
  Step tick();
  Choice chosen();
  Environment::Transition after(int motion);
  void put(const Pose& pose);
  void open_round();
  void close_round(bool arrived);
  void open(Record& record, const RunOptions& options) const;
  void go_on(Record& record, std::int64_t steps, bool until_arrival, const RunOptions& options);
  bool run_on(Record& record, std::int64_t steps, bool until_arrival, const RunOptions& options);

  Environment environment_;
  std::uint64_t seed_;
  std::shared_ptr<Agent> agent_;
  std::vector<EarlierWorld> earlier_worlds_;
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
