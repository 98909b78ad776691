#include "devlearn/trial.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "devlearn/adaptive_agent.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/learner_agent.hpp"

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
                       config.heading_bins, world.def().origin);
}

Senses senses_of(const Observation& there) {
  return {there.pose, there.goal_distance, there.clearance};
}

// SEFs differ by what a double can hold.
constexpr double kMostSef = 1e300;

double require_sef(const std::string& quantity, double sef) {
  require_in(quantity, sef, -kMostSef, kMostSef);
  return sef;
}

template <typename Value>
void require_named(const char* quantity, const NamedFunction<Value>& part) {
  if (part.function && part.name.empty()) {
    throw InvalidValue(std::string(quantity) + ".name", "''", "a name, by which snapshots know it");
  }
  if (!part.function && !part.name.empty()) {
    throw InvalidValue(std::string(quantity) + ".function", "null", "a function of that name");
  }
}

// What the record is told.
Step row(std::int32_t round, const Observation& before, const Choice& choice,
         const Observation& after, double smf, const Outcome& outcome,
         const Development& development) {
  Step step;
  step.round = round;
  step.situation = before.situation;
  step.motion = choice.motion;
  step.kind = choice.kind;
  step.sef = after.sef;
  step.smf = smf;
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
  step.pose = after.pose;
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

TrialConfig TrialConfig::step5() {
  TrialConfig config;
  config.learner = LearnerConfig::step5();
  return config;
}

TrialConfig TrialConfig::adaptive() {
  TrialConfig config;
  config.learner = AdaptiveConfig{};
  return config;
}

int TrialConfig::motion_count() const {
  return std::visit([](const auto& def) { return def.motion_count; }, learner);
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
  if (motion_count() != motions) {
    throw InvalidValue("TrialConfig.learner.motion_count", std::to_string(motion_count()),
                       std::to_string(motions) + ", the number of robot.steering_angles");
  }
}

bool operator==(const TrialConfig& a, const TrialConfig& b) { return detail::same_fields(a, b); }

// --- the trial ---------------------------------------------------------------------------------

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed)
    : Trial(world, config, seed, TrialParts{}) {}

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed, TrialParts parts)
    : Trial(world, config, seed, own_agent(config, seed), std::move(parts)) {}

Trial::Trial(const World& world, const TrialConfig& config, std::uint64_t seed,
             std::shared_ptr<Agent> agent, TrialParts parts)
    : config_((config.validate(), config)),
      seed_(seed),
      robot_(world, config.robot),
      grid_(grid_over(world, config)),
      agent_(std::move(agent)),
      parts_(std::move(parts)),
      allowed_(std::make_unique<bool[]>(config.robot.steering_angles.size())) {
  if (!agent_) throw InvalidValue("Trial.agent", "null", "an agent");
  if (const auto paper = learner()) require_motions(paper->config().motion_count);
  if (const auto adaptive = adaptive_learner()) require_motions(adaptive->config().motion_count);
  require_parts();
  robot_.require_place(world.def().start, "start");
  here_ = sense(world.def().start);
}

// An agent of devlearn's own says how many motions it has.
void Trial::require_motions(int motions) const {
  if (motions == config_.motion_count()) return;
  throw InvalidValue(
      "Trial.agent.config.motion_count", std::to_string(motions),
      std::to_string(config_.motion_count()) + ", the number of robot.steering_angles");
}

void Trial::require_parts() const {
  require_named("TrialParts.evaluation", parts_.evaluation);
  require_named("TrialParts.situations", parts_.situations);
  const std::vector<double>& table = parts_.sef_table;
  if (table.empty()) return;
  const char* const quantity = "TrialParts.sef_table";
  if (parts_.evaluation.function) {
    throw InvalidValue(quantity, "given, and an evaluation too", "only one of them");
  }
  if (parts_.situations.function) {
    throw InvalidValue(quantity, "given, and situations of one's own too",
                       "an evaluation: a table is of the grid's situations");
  }
  require_size(quantity, table.size(), static_cast<std::uint64_t>(grid_.count()));
  require_each(table.size(), [&](std::size_t i) { require_sef(quantity, table[i]); });
}

Step Trial::step() {
  const OneCall call(under_way_);
  return tick();
}

// The loop: a line a stage, equations as in the paper.
Step Trial::tick() {
  open_round();
  // world -> sense -> situation: as it was when the robot came here
  const Observation before = here_;
  // -> choice (Eq. 5 and 7), of what the robot can make
  const Choice choice = chosen();
  // -> motion (Eq. 1)
  const Robot::Move moved = robot_.step(before.pose, choice.motion);
  // world -> sense -> situation, and its SEF (Eq. 6)
  const Observation after = sense_after(moved.pose);
  // -> evaluation (Eq. 8)
  const double smf = after.sef - before.sef;
  const Outcome outcome = outcome_of(after, smf, moved.collided);
  // -> development (Eq. 9-17)
  const Development development = agent_->observe(outcome);
  // -> record
  here_ = after;
  round_ = std::max(round_, 1);
  return row(round_, before, choice, after, smf, outcome, development);
}

// What is sensed at a pose, and its situation and SEF.
Observation Trial::sense(const Pose& pose) const {
  Observation there;
  there.pose = pose;
  const double dx = pose.x - world().def().target.x;
  const double dy = pose.y - world().def().target.y;
  there.goal_distance = std::sqrt(dx * dx + dy * dy);
  there.clearance = clearance(pose);
  there.situation = parts_.situations.function ? own_situation(there)
                                               : grid_.situation(pose.x, pose.y, pose.heading);
  // Eq. 6, or what stands in its place
  there.sef = parts_.evaluation.function || !parts_.sef_table.empty()
                  ? own_sef(there)
                  : config_.evaluation(there.goal_distance, there.clearance);
  if (!arrived_at(there)) {
    there.estimate = there.goal_distance / (config_.robot.speed * config_.robot.sample_time);
  }
  there.motion_count = config_.motion_count();
  return there;
}

// The same after a motion: where it cannot be told, the motion was not made.
Observation Trial::sense_after(const Pose& pose) const {
  try {
    return sense(pose);
  } catch (...) {
    agent_->cancel();
    throw;
  }
}

SituationId Trial::own_situation(const Observation& there) const {
  const NamedFunction<SituationId>& own = parts_.situations;
  const SituationId id = own.function(senses_of(there));
  if (id < 0) {
    throw InvalidValue("situation by " + own.name, std::to_string(id), "in [0, 2^63 - 1]");
  }
  return id;
}

double Trial::own_sef(const Observation& there) const {
  const NamedFunction<double>& own = parts_.evaluation;
  if (own.function) return require_sef("SEF by " + own.name, own.function(senses_of(there)));
  return parts_.sef_table[static_cast<std::size_t>(there.situation)];
}

// d_o of Eq. 6.
double Trial::clearance(const Pose& pose) const {
  if (config_.clearance_source == ClearanceSource::kSonar) {
    const std::vector<double> echoes = robot_.sonar(pose);
    return *std::min_element(echoes.begin(), echoes.end()) + config_.robot.radius;
  }
  return world().clearance({pose.x, pose.y}, config_.walls_count);
}

// What the robot can make of its motions here.
AllowedMotions Trial::allowed() const {
  if (!robot_.allowed(here_.pose, allowed_.get())) return {};
  return {allowed_.get(), static_cast<std::size_t>(here_.motion_count)};
}

// The agent's choice; one outside M, or that is not allowed, is refused.
Choice Trial::chosen() {
  here_.allowed = allowed();
  const Choice choice = agent_->choose(here_);
  if (choice.motion < 0 || choice.motion >= here_.motion_count) {
    agent_->cancel();
    require_count("agent's motion", choice.motion, 0, here_.motion_count - 1);
  }
  if (!here_.allowed(choice.motion)) {
    agent_->cancel();
    throw InvalidValue("agent's motion", std::to_string(choice.motion),
                       "one that the robot's safety layer allows, see Observation.allowed");
  }
  return choice;
}

// What the agent is told of a motion.
Outcome Trial::outcome_of(const Observation& after, double smf, bool collided) const {
  Outcome outcome;
  outcome.situation = after.situation;
  outcome.sef = after.sef;
  outcome.smf = collided ? std::min(smf, kCollisionSmf) : smf;
  outcome.collided = collided;
  outcome.arrived = arrived_at(after);
  outcome.estimate = after.estimate;
  if (collided) outcome.cost += config_.touch_cost;
  return outcome;
}

void Trial::begin_round() { place(world().def().start); }

void Trial::place(const Pose& pose) {
  const OneCall call(under_way_);
  put(pose);
}

void Trial::resume(const Pose& pose, std::int32_t round, bool round_open) {
  const OneCall call(under_way_);
  require_count("round", round, 0, kLastRound);
  robot_.require_place(pose);
  here_ = sense(pose);
  round_ = round;
  round_open_ = round_open;
}

// A new round, from a pose.
void Trial::put(const Pose& pose) {
  require_count("round", std::int64_t{round_} + 1, 1, kLastRound);
  robot_.require_place(pose);
  const Observation there = sense(pose);
  close_round(false);
  open_round();
  here_ = there;
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
  const int sonars = options.echoes ? config_.robot.sonar_count : 0;
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
    record.begin_round(round_, pose());
    if (!until_arrival) record.reserve(static_cast<std::size_t>(std::min(steps, kStepsAtOnce)));
  } else if (record.rounds.empty() || record.rounds.back().round != round_) {
    record.rounds.push_back({round_, 0, false});
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
      const std::vector<double> echoes = robot_.sonar(pose());
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
