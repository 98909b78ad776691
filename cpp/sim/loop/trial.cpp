#include "devlearn/trial.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "devlearn/adaptive_agent.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/learner_agent.hpp"

namespace devlearn {
namespace {

constexpr std::int64_t kStepsBetweenInterrupts = 8;

// For how many steps room is made in a record beforehand, at most.
constexpr std::int64_t kStepsAtOnce = 65536;

constexpr std::int64_t kMostSteps = std::int64_t{1} << 40;
constexpr std::int64_t kLastRound = std::int64_t{1} << 30;

// One call at a time: an agent that calls its trial back would pull the step from under itself.
class OneCall {
 public:
  explicit OneCall(bool& under_way) : under_way_(under_way) {
    if (under_way_) {
      throw InvalidValue("Trial", "a call while another is under way", "one call at a time");
    }
    under_way_ = true;
  }
  ~OneCall() { under_way_ = false; }
  OneCall(const OneCall&) = delete;
  OneCall& operator=(const OneCall&) = delete;

 private:
  bool& under_way_;
};

// What the record is told.
Step row(std::int32_t round, SituationId situation, SituationId true_situation,
         const Choice& choice, const Environment::Transition& made,
         const Development& development) {
  const Observation& after = made.next.here;
  const Outcome& outcome = made.outcome;
  Step step;
  step.round = round;
  step.situation = situation;
  step.true_situation = true_situation;
  step.motion = choice.motion;
  step.kind = choice.kind;
  step.sef = after.sef;
  step.smf = made.smf;
  step.smf_used = outcome.smf;
  step.collided = outcome.collided;
  step.arrived = outcome.arrived;
  step.goal_distance = after.goal_distance;
  step.clearance = after.clearance;
  step.cost = outcome.cost;
  step.value = development.value;
  step.event = development.event;
  step.reduced = development.reduced;
  step.explored_count = development.explored_count;
  step.effective_count = development.effective_count;
  step.pose = made.next.place.pose;
  return step;
}

std::shared_ptr<Agent> agent_with(const LearnerConfig& config, std::uint64_t seed) {
  return std::make_shared<LearnerAgent>(std::make_shared<Learner>(config, seed));
}
std::shared_ptr<Agent> agent_with(const AdaptiveConfig& config, std::uint64_t seed) {
  return std::make_shared<AdaptiveAgent>(std::make_shared<AdaptiveLearner>(config, seed));
}
std::shared_ptr<Agent> own_agent(const TrialConfig& config, std::uint64_t seed) {
  return std::visit([seed](const auto& def) { return agent_with(def, seed); }, config.learner);
}

}  // namespace

// --- the trial ---------------------------------------------------------------------------------

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed)
    : Trial(world, config, seed, TrialParts{}) {}

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed, TrialParts parts)
    : Trial(world, config, seed, own_agent(config, seed), std::move(parts)) {}

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed,
             std::shared_ptr<Agent> agent, TrialParts parts)
    : environment_(world, config, seed, std::move(parts)), seed_(seed), agent_(std::move(agent)) {
  if (!agent_) throw InvalidValue("Trial.agent", "null", "an agent");
  if (const auto paper = learner()) require_motions(paper->config().motion_count);
  if (const auto adaptive = adaptive_learner()) require_motions(adaptive->config().motion_count);
}

// An agent of devlearn's own says how many motions it has.
void Trial::require_motions(int motions) const {
  if (motions == config().motion_count()) return;
  throw InvalidValue(
      "Trial.agent.config.motion_count", std::to_string(motions),
      std::to_string(config().motion_count()) + ", the number of robot.steering_angles");
}

Step Trial::step() {
  const OneCall call(under_way_);
  return tick();
}

// The loop: a line a stage, equations as in the paper.
Step Trial::tick() {
  open_round();
  // world -> sense -> situation: as it was when the robot came here
  const SituationId situation = environment_.state().here.situation;
  const SituationId true_situation = environment_.state().true_situation;
  // -> choice (Eq. 5 and 7), of what the robot can make
  const Choice choice = chosen();
  // -> motion (Eq. 1) -> sense -> situation -> evaluation (Eq. 6 and 8)
  const Environment::Transition made = after(choice.motion);
  // -> development (Eq. 9-17)
  const Development development = agent_->observe(made.outcome);
  // -> record
  round_ = std::max(round_, 1);
  const Step step = row(round_, situation, true_situation, choice, made, development);
  environment_.enter(made.next);
  return step;
}

// Where it cannot be told what came of a motion, it was not made.
Environment::Transition Trial::after(int motion) {
  try {
    return environment_.after(motion);
  } catch (...) {
    agent_->cancel();
    throw;
  }
}

// The agent's choice; one outside M, or that is not allowed, is refused.
Choice Trial::chosen() {
  const Observation& here = environment_.look();
  const Choice choice = agent_->choose(here);
  if (choice.motion < 0 || choice.motion >= here.motion_count) {
    agent_->cancel();
    require_count("agent's motion", choice.motion, 0, here.motion_count - 1);
  }
  if (!here.allowed(choice.motion)) {
    agent_->cancel();
    throw InvalidValue("agent's motion", std::to_string(choice.motion),
                       "one that the robot's safety layer allows, see Observation.allowed");
  }
  return choice;
}

void Trial::begin_round() { place(world().def().start); }

void Trial::place(const Pose& pose) {
  const OneCall call(under_way_);
  put(pose);
}

void Trial::change_world(const World& world) {
  const OneCall call(under_way_);
  Environment changed = environment_.in(world);
  close_round(false);
  earlier_worlds_.push_back({environment_.world(), environment_.state().place.steps});
  environment_ = std::move(changed);
}

void Trial::resume(const Environment::Place& place, std::int32_t round, bool round_open,
                   std::vector<EarlierWorld> earlier_worlds) {
  const OneCall call(under_way_);
  require_count("round", round, 0, kLastRound);
  environment_.enter(environment_.standing(place));
  round_ = round;
  round_open_ = round_open;
  earlier_worlds_ = std::move(earlier_worlds);
}

// A new round, from a pose.
void Trial::put(const Pose& pose) {
  require_count("round", std::int64_t{round_} + 1, 1, kLastRound);
  const Environment::State there = environment_.standing(pose);
  close_round(false);
  open_round();
  environment_.enter(there);
  ++round_;
}

void Trial::open_round() {
  if (round_open_) return;
  agent_->begin_round();
  round_open_ = true;
}

void Trial::close_round(bool arrived) {
  if (!round_open_) return;
  agent_->end_round(arrived);
  round_open_ = false;
}

void Trial::run(Record& record, std::int64_t steps, const RunOptions& options) {
  go_on(record, steps, false, options);
}

void Trial::free_learning(Record& record, std::int64_t steps, const RunOptions& options) {
  require_count("steps", steps, 0, kMostSteps);
  const OneCall call(under_way_);
  open(record, options);
  put(world().def().start);
  run_on(record, steps, false, options);
}

void Trial::path_learning(Record& record, std::int64_t rounds, std::int64_t step_limit,
                          const RunOptions& options) {
  require_count("rounds", rounds, 0, kLastRound);
  require_count("step_limit", step_limit, 1, kMostSteps);
  const OneCall call(under_way_);
  open(record, options);
  for (std::int64_t i = 0; i < rounds; ++i) {
    put(world().def().start);
    if (!run_on(record, step_limit, true, options)) return;
  }
}

void Trial::finish_round(Record& record, std::int64_t steps, const RunOptions& options) {
  go_on(record, steps, true, options);
}

// The present round, or the first.
void Trial::go_on(Record& record, std::int64_t steps, bool until_arrival,
                  const RunOptions& options) {
  require_count("steps", steps, 0, kMostSteps);
  const OneCall call(under_way_);
  open(record, options);
  round_ = std::max(round_, 1);
  run_on(record, steps, until_arrival, options);
}

// A record holds every step or none, and echoes of every one or of none.
void Trial::open(Record& record, const RunOptions& options) const {
  if (options.rounds_only && options.echoes) {
    throw InvalidValue("rounds_only", "true, and echoes too", "only one of them");
  }
  if (!record.rounds.empty() && record.rounds_only() != options.rounds_only) {
    throw InvalidValue("rounds_only", options.rounds_only ? "true" : "false",
                       "as in the rounds that the record already has");
  }
  const int sonars = options.echoes ? config().robot.sonar_count : 0;
  if (record.steps() > 0 && record.sonar_count != sonars) {
    throw InvalidValue("record.sonar_count", std::to_string(record.sonar_count),
                       std::to_string(sonars) + ", as many echoes a step as now are recorded");
  }
  record.sonar_count = sonars;
}

// Steps of the present round, into the record; false where it was interrupted.
bool Trial::run_on(Record& record, std::int64_t steps, bool until_arrival,
                   const RunOptions& options) {
  if (!options.rounds_only) {
    record.begin_round(round_, pose(), environment_.state().place.steps);
    if (!until_arrival) record.reserve(static_cast<std::size_t>(std::min(steps, kStepsAtOnce)));
  } else if (record.rounds.empty() || record.rounds.back().round != round_) {
    record.rounds.push_back({round_, 0, false, environment_.state().place.steps});
  }
  if (options.tally != nullptr) options.tally->begin_round(round_, pose());
  for (std::int64_t i = 0;; ++i) {
    const bool ended = until_arrival && arrived() && steps > 0;
    if (ended) {
      record.rounds.back().arrived = true;
      if (options.tally != nullptr) options.tally->arrive();
      close_round(true);
    }
    if (options.interrupt && i % kStepsBetweenInterrupts == 0 && options.interrupt()) return false;
    if (ended || i == steps) return true;
    const Step step = tick();
    if (options.tally != nullptr) options.tally->count(step);
    if (options.rounds_only) {
      record.count(step);
      continue;
    }
    record.append(step);
    if (options.echoes) {
      const std::vector<double> echoes = environment_.echoes();
      record.echoes.insert(record.echoes.end(), echoes.begin(), echoes.end());
    }
  }
}

std::shared_ptr<Learner> Trial::learner() const noexcept {
  const LearnerAgent* paper = dynamic_cast<const LearnerAgent*>(agent_.get());
  return paper == nullptr ? nullptr : paper->learner();
}

std::shared_ptr<AdaptiveLearner> Trial::adaptive_learner() const noexcept {
  const auto* adaptive = dynamic_cast<const AdaptiveAgent*>(agent_.get());
  return adaptive == nullptr ? nullptr : adaptive->learner();
}

}  // namespace devlearn
