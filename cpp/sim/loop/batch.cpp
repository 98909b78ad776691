#include "devlearn/batch.hpp"

#include <algorithm>
#include <utility>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"

namespace devlearn {
namespace {

constexpr int kMostEnvironments = 1 << 20;

Random starts_of(std::uint64_t seed) { return Random(seed, "starts"); }

}  // namespace

Batch::Batch(const World& world, int count, const TrialConfig& config, const BatchConfig& batch,
             std::uint64_t seed)
    : config_((batch.validate(), batch)) {
  require_count("Batch.count", count, 1, kMostEnvironments);
  if (config_.sonars && config.robot.sonar_count == 0) {
    throw InvalidValue("BatchConfig.sonars", "true for a robot that has none",
                       "false, or a RobotDef.sonar_count of at least 1");
  }
  environments_.reserve(static_cast<std::size_t>(count));
  environments_.emplace_back(world, config, seed);
  while (this->count() < count) {
    environments_.push_back(
        environments_.front().twin(seed + static_cast<std::uint64_t>(this->count())));
  }
  const std::size_t n = environments_.size();
  for (std::size_t i = 0; i < n; ++i) episodes_.push_back({starts_of(seed + i)});
  if (config_.random_starts) places_.emplace(environments_[0].robot(), config.goal_radius);
  rows_ = empty_rows();
  if (config_.autoreset == Autoreset::kSameStep) final_rows_ = empty_rows();
  for (auto* const column : {&outcomes_.reward, &outcomes_.smf, &outcomes_.cost}) column->resize(n);
  for (auto* const column :
       {&outcomes_.collided, &outcomes_.terminated, &outcomes_.truncated, &outcomes_.begun}) {
    column->resize(n);
  }
  reset(Reset{});
}

Batch::Rows Batch::empty_rows() const {
  const RobotDef& robot = environments_.front().config().robot;
  const std::size_t n = environments_.size();
  Rows rows;
  rows.pose.resize(3 * n);
  rows.situation.resize(n);
  for (auto* const column : {&rows.goal_distance, &rows.clearance, &rows.estimate}) {
    column->resize(n);
  }
  if (config_.sonars) rows.echoes.resize(n * static_cast<std::size_t>(robot.sonar_count));
  rows.allowed.resize(n * robot.steering_angles.size());
  return rows;
}

void Batch::reset(std::uint64_t seed) {
  std::vector<std::uint64_t> seeds(environments_.size());
  for (std::uint64_t& one : seeds) one = seed++;
  Reset asked;
  asked.seeds = seeds.data();
  reset(asked);
}

void Batch::reset(const Reset& asked) {
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < environments_.size(); ++i) {
      if (asked.which == nullptr || asked.which[i]) visit(i);
    }
  };
  if (asked.poses != nullptr) {
    each([&](std::size_t i) {
      const double time = asked.seeds != nullptr ? 0.0 : environments_[i].time();
      environments_[i].robot().require_free(asked.poses[i], time);
    });
  }
  each([&](std::size_t i) {
    if (asked.seeds != nullptr) {
      environments_[i] = environments_[i].twin(asked.seeds[i]);
      episodes_[i].starts = starts_of(asked.seeds[i]);
    }
    if (asked.poses != nullptr) {
      begin(i, asked.poses[i]);
    } else {
      begin(i);
    }
  });
}

void Batch::step(const std::int64_t* motions) {
  const std::size_t n = environments_.size();
  const int last = environments_.front().config().motion_count() - 1;
  require_each(n, [&](std::size_t i) { require_count("motion", motions[i], 0, last); });
  step_each([&](std::size_t i) { return static_cast<int>(motions[i]); });
}

void Batch::drive_wheels(const WheelSpeeds* speeds) {
  const Robot& robot = environments_.front().robot();
  const double most = robot.def().speed;
  require_each(environments_.size(), [&](std::size_t i) {
    require_in("wheel_speeds.left", speeds[i].left, -most, most, "m/s");
    require_in("wheel_speeds.right", speeds[i].right, -most, most, "m/s");
    robot.arc(speeds[i]);
  });
  step_each([&](std::size_t i) { return speeds[i]; });
}

// By command(i) in environment i.
template <typename Command>
void Batch::step_each(const Command& command) {
  const std::size_t n = environments_.size();
  if (config_.autoreset == Autoreset::kDisabled) {
    require_each(n, [&](std::size_t i) {
      if (!episodes_[i].over) return;
      throw InvalidValue("episode", "one that has ended", "a reset before the next step");
    });
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (episodes_[i].over) {
      begin(i);
    } else {
      advance(i, command(i));
    }
  }
}

void Batch::begin(std::size_t i) {
  const Environment& environment = environments_[i];
  begin(i, places_ ? places_->draw(episodes_[i].starts, environment.time())
                   : environment.world().def().start);
}

// An episode, by which nothing has come yet.
void Batch::begin(std::size_t i, const Pose& pose) {
  environments_[i].enter(environments_[i].standing(pose));
  episodes_[i].steps = 0;
  episodes_[i].over = false;
  tell(i, rows_);
  outcomes_.reward[i] = outcomes_.smf[i] = outcomes_.cost[i] = 0.0;
  outcomes_.collided[i] = outcomes_.terminated[i] = outcomes_.truncated[i] = 0;
  outcomes_.begun[i] = 1;
}

template <typename Command>
void Batch::advance(std::size_t i, const Command& command) {
  Environment& environment = environments_[i];
  Episode& episode = episodes_[i];
  const double estimate_before = environment.state().here.estimate;
  const Environment::Transition made = environment.after(command);
  environment.enter(made.next);
  const bool arrived = made.outcome.arrived;
  const bool too_long = ++episode.steps >= config_.step_limit && !arrived;
  episode.over = arrived || too_long;
  // The next episode begins here, or later.
  const bool at_once = episode.over && config_.autoreset == Autoreset::kSameStep;
  tell(i, at_once ? final_rows_ : rows_);
  if (at_once) begin(i);
  outcomes_.reward[i] = reward_of(made.outcome, estimate_before);
  outcomes_.smf[i] = made.outcome.smf;
  outcomes_.cost[i] = made.outcome.cost;
  outcomes_.collided[i] = made.outcome.collided;
  outcomes_.terminated[i] = arrived;
  outcomes_.truncated[i] = too_long;
  outcomes_.begun[i] = 0;
}

// What is known where the robot is.
void Batch::tell(std::size_t i, Rows& rows) {
  Environment& environment = environments_[i];
  const Observation& here = environment.look();
  double* const pose = &rows.pose[3 * i];
  pose[0] = here.pose.x;
  pose[1] = here.pose.y;
  pose[2] = wrapped_heading(here.pose.heading);
  rows.situation[i] = here.situation;
  rows.goal_distance[i] = here.goal_distance;
  rows.clearance[i] = here.clearance;
  rows.estimate[i] = here.estimate;
  const auto motions = static_cast<std::size_t>(here.motion_count);
  for (std::size_t motion = 0; motion < motions; ++motion) {
    rows.allowed[i * motions + motion] = here.allowed(static_cast<int>(motion));
  }
  if (!config_.sonars) return;
  const auto sonars = static_cast<std::size_t>(environment.config().robot.sonar_count);
  environment.echoes(&rows.echoes[i * sonars]);
}

double Batch::reward_of(const Outcome& outcome, double estimate_before) const noexcept {
  switch (config_.reward) {
    case Reward::kShaped:
      // Ng, Harada and Russell (1999): the potential is -estimate, without discount.
      return outcome.reward() + (estimate_before - outcome.estimate);
    case Reward::kCost:
      return outcome.reward();
    case Reward::kSmf:
      return outcome.smf;
    case Reward::kSparse:
      return outcome.arrived ? 1.0 : 0.0;
  }
  return 0.0;
}

}  // namespace devlearn
