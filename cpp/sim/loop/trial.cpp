#include "devlearn/trial.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn {
namespace {

// A collision is never effective, whatever it gained.
constexpr double kCollisionSmf = -1.0;

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

// Cells of cell_size over the arena, from its origin; the last ones may reach beyond it.
SituationGrid grid_over(const World& world, const TrialConfig& config) {
  const auto cells = [&](double side) {
    return static_cast<int>(std::max(1.0, std::ceil(side / config.cell_size - 1e-9)));
  };
  const auto covered = [&](double side) { return std::max(side, cells(side) * config.cell_size); };
  const double width = world.def().width, height = world.def().height;
  return SituationGrid(covered(width), covered(height), cells(width), cells(height),
                       config.heading_bins);
}

std::shared_ptr<Agent> paper_agent(const TrialConfig& config, std::uint64_t seed) {
  return std::make_shared<LearnerAgent>(std::make_shared<Learner>(config.learner, seed));
}

}  // namespace

TrialConfig TrialConfig::step5() {
  TrialConfig config;
  config.learner = LearnerConfig::step5();
  return config;
}

void TrialConfig::validate() const {
  detail::require_fields(*this);
  if (clearance_source == ClearanceSource::kSonar) {
    if (!walls_count) {
      throw InvalidValue("TrialConfig.walls_count", "false with clearance_source sonar",
                         "true: an echo does not say whether it came from a wall");
    }
    require_count("TrialConfig.robot.sonar_count with clearance_source sonar", robot.sonar_count, 1,
                  720);
  }
  const auto motions = static_cast<long long>(robot.steering_angles.size());
  if (learner.motion_count != motions) {
    throw InvalidValue("TrialConfig.learner.motion_count", std::to_string(learner.motion_count),
                       std::to_string(motions) + ", the number of robot.steering_angles");
  }
}

bool operator==(const TrialConfig& a, const TrialConfig& b) noexcept {
  return detail::same_fields(a, b);
}

// --- the trial ---------------------------------------------------------------------------------

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed)
    : Trial(world, config, seed, paper_agent(config, seed)) {}

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed,
             std::shared_ptr<Agent> agent)
    : config_((config.validate(), config)),
      seed_(seed),
      robot_(world, config.robot),
      grid_(grid_over(world, config)),
      agent_(std::move(agent)),
      pose_(world.def().start) {
  if (!agent_) throw InvalidValue("Trial.agent", "null", "an agent");
  if (const auto paper = learner()) {
    const int motions = paper->config().motion_count;
    if (motions != config.learner.motion_count) {
      throw InvalidValue(
          "Trial.agent.config.motion_count", std::to_string(motions),
          std::to_string(config.learner.motion_count) + ", the number of robot.steering_angles");
    }
  }
  robot_.require_place(pose_, "start");
  state_ = sense(pose_);
}

Step Trial::step() {
  const OneCall call(under_way_);
  return tick();
}

Step Trial::tick() {
  const State before = state_;

  // situation -> choice
  const Choice choice = agent_->choose({before.situation, pose_, before.sef, before.goal_distance,
                                        before.clearance, config_.learner.motion_count});
  if (choice.motion < 0 || choice.motion >= config_.learner.motion_count) {
    agent_->cancel();
    require_count("agent's motion", choice.motion, 0, config_.learner.motion_count - 1);
  }

  // choice -> motion (Eq. 1)
  const Robot::Move moved = robot_.step(pose_, choice.motion);

  // motion -> next situation and its SEF (Eq. 6)
  const State after = sense(moved.pose);

  // evaluation (Eq. 8)
  const double smf = after.sef - before.sef;
  const double smf_used = moved.collided ? std::min(smf, kCollisionSmf) : smf;

  // development (Eq. 9-17)
  const Development development =
      agent_->observe({after.situation, after.sef, smf_used, moved.collided, after.arrived});

  // record
  pose_ = moved.pose;
  state_ = after;
  round_ = std::max(round_, 1);
  Step step;
  step.round = round_;
  step.situation = before.situation;
  step.motion = choice.motion;
  step.kind = choice.kind;
  step.sef = after.sef;
  step.smf = smf;
  step.smf_used = smf_used;
  step.collided = moved.collided;
  step.arrived = after.arrived;
  step.goal_distance = after.goal_distance;
  step.clearance = after.clearance;
  step.event = development.event;
  step.reduced = development.reduced;
  step.explored_count = agent_->explored_count();
  step.effective_count = agent_->effective_count();
  step.pose = moved.pose;
  return step;
}

Trial::State Trial::sense(const Pose& pose) const {
  State state;
  state.situation = grid_.situation(pose.x, pose.y, pose.heading);
  const double dx = pose.x - world().def().target.x;
  const double dy = pose.y - world().def().target.y;
  state.goal_distance = std::sqrt(dx * dx + dy * dy);
  state.clearance = clearance(pose);
  state.sef = config_.evaluation(state.goal_distance, state.clearance);
  state.arrived = state.goal_distance <= config_.goal_radius;
  return state;
}

// d_o of Eq. 6.
double Trial::clearance(const Pose& pose) const {
  if (config_.clearance_source == ClearanceSource::kSonar) {
    const std::vector<double> echoes = robot_.sonar(pose);
    return *std::min_element(echoes.begin(), echoes.end()) + config_.robot.radius;
  }
  return world().clearance({pose.x, pose.y}, config_.walls_count);
}

void Trial::begin_round() { place(world().def().start); }

void Trial::place(const Pose& pose) {
  const OneCall call(under_way_);
  put(pose);
}

void Trial::resume(const Pose& pose, std::int32_t round) {
  const OneCall call(under_way_);
  require_count("round", round, 0, kLastRound);
  put(pose);
  round_ = round;
}

void Trial::put(const Pose& pose) {
  require_count("round", std::int64_t{round_} + 1, 1, kLastRound + 1);
  robot_.require_place(pose);
  const State state = sense(pose);
  pose_ = pose;
  state_ = state;
  ++round_;
}

void Trial::run(Record& record, std::int64_t steps, const RunOptions& options) {
  go_on(record, steps, false, options);
}

void Trial::free_learning(Record& record, std::int64_t steps, const RunOptions& options) {
  require_count("steps", steps, 0, kMostSteps);
  const OneCall call(under_way_);
  require_like(record, options);
  put(world().def().start);
  run_on(record, steps, false, options);
}

void Trial::path_learning(Record& record, std::int64_t rounds, std::int64_t step_limit,
                          const RunOptions& options) {
  require_count("rounds", rounds, 0, kLastRound);
  require_count("step_limit", step_limit, 1, kMostSteps);
  const OneCall call(under_way_);
  require_like(record, options);
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
  require_like(record, options);
  round_ = std::max(round_, 1);
  run_on(record, steps, until_arrival, options);
}

// A record holds every step or none, and echoes of every one or of none.
void Trial::require_like(const Record& record, const RunOptions& options) const {
  if (options.rounds_only && options.echoes) {
    throw InvalidValue("rounds_only", "true, and echoes too", "only one of them");
  }
  if (!record.rounds.empty() && record.x.empty() != options.rounds_only) {
    throw InvalidValue("rounds_only", options.rounds_only ? "true" : "false",
                       "as in the rounds that the record already has");
  }
  const int sonars = options.echoes ? config_.robot.sonar_count : 0;
  if (record.steps() > 0 && record.sonar_count != sonars) {
    throw InvalidValue("record.sonar_count", std::to_string(record.sonar_count),
                       std::to_string(sonars) + ", as many echoes a step as now are recorded");
  }
}

// Steps of the present round, into the record; false where it was interrupted.
bool Trial::run_on(Record& record, std::int64_t steps, bool until_arrival,
                   const RunOptions& options) {
  record.sonar_count = options.echoes ? config_.robot.sonar_count : 0;
  if (!options.rounds_only) {
    record.begin_round(round_, pose_);
    if (!until_arrival) record.reserve(static_cast<std::size_t>(std::min(steps, kStepsAtOnce)));
  } else if (record.rounds.empty() || record.rounds.back().round != round_) {
    record.rounds.push_back({round_, 0, false});
  }
  if (state_.arrived && steps > 0 && until_arrival) record.rounds.back().arrived = true;
  for (std::int64_t i = 0;; ++i) {
    if (options.interrupt && i % kStepsBetweenInterrupts == 0 && options.interrupt()) return false;
    if (i == steps || (until_arrival && state_.arrived)) return true;
    const Step step = tick();
    if (options.rounds_only) {
      record.count(step);
      continue;
    }
    record.append(step);
    if (options.echoes) {
      const std::vector<double> echoes = robot_.sonar(pose_);
      record.echoes.insert(record.echoes.end(), echoes.begin(), echoes.end());
    }
  }
}

Record Trial::run(std::int64_t steps, const RunOptions& options) {
  Record record;
  run(record, steps, options);
  return record;
}

Record Trial::free_learning(std::int64_t steps, const RunOptions& options) {
  Record record;
  free_learning(record, steps, options);
  return record;
}

Record Trial::path_learning(std::int64_t rounds, std::int64_t step_limit,
                            const RunOptions& options) {
  Record record;
  path_learning(record, rounds, step_limit, options);
  return record;
}

Record Trial::finish_round(std::int64_t steps, const RunOptions& options) {
  Record record;
  finish_round(record, steps, options);
  return record;
}

std::shared_ptr<Learner> Trial::learner() const noexcept {
  const LearnerAgent* paper = dynamic_cast<const LearnerAgent*>(agent_.get());
  return paper == nullptr ? nullptr : paper->learner();
}

}  // namespace devlearn
