#include "devlearn/environment.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"

namespace devlearn {
namespace {

// Its own: noise never shifts what an agent draws.
constexpr const char* kStream = "noise";

// A collision is never effective, whatever it gained.
constexpr double kCollisionSmf = -1.0;

// Cells of cell_size over the arena, from its origin; the last ones may reach beyond it. Only where
// odometry errs is the robot ever believed to be outside.
SituationGrid grid_over(const World& world, const TrialConfig& config) {
  const auto cells = [&](double side) {
    return static_cast<int>(std::max(1.0, std::ceil(side / config.cell_size - 1e-9)));
  };
  const auto covered = [&](double side) { return std::max(side, cells(side) * config.cell_size); };
  const double width = world.def().width, height = world.def().height;
  return SituationGrid(covered(width), covered(height), cells(width), cells(height),
                       config.heading_bins, world.def().origin,
                       config.noise.of_odometry() ? Outside::kClamp : Outside::kRefuse);
}

std::string text_of_arena(const WorldDef& def) {
  return to_text(def.width) + " m x " + to_text(def.height) + " m from (" + to_text(def.origin.x) +
         ", " + to_text(def.origin.y) + ")";
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

}  // namespace

Environment::Environment(const World& world, const TrialConfig& config, std::uint64_t seed,
                         TrialParts parts)
    : Environment(std::make_shared<const Fixed>(world, config, std::move(parts)),
                  Random(seed, kStream)) {}

Environment::Environment(std::shared_ptr<const Fixed> fixed, const Random& noise,
                         std::int64_t steps)
    : fixed_(std::move(fixed)),
      state_(sensed({world().def().start, world().def().start, noise, steps})),
      allowed_(std::make_unique<bool[]>(static_cast<std::size_t>(config().motion_count()))) {}

Environment::~Environment() = default;
Environment::Environment(Environment&&) noexcept = default;
Environment& Environment::operator=(Environment&&) noexcept = default;

Environment Environment::twin(std::uint64_t seed) const {
  return Environment(fixed_, Random(seed, kStream));
}

Environment Environment::in(const World& other) const {
  const WorldDef &was = world().def(), &is = other.def();
  if (is.width != was.width || is.height != was.height || !(is.origin == was.origin)) {
    throw InvalidValue("world.arena", text_of_arena(is),
                       text_of_arena(was) + ", the arena as it was");
  }
  return Environment(std::make_shared<const Fixed>(other, config(), parts()), noise_to_come(),
                     state_.place.steps);
}

Environment::Fixed::Fixed(const World& world, const TrialConfig& given, TrialParts own)
    : config((given.validate(), given)),
      robot(world, config.robot),
      grid(grid_over(world, config)),
      parts(std::move(own)) {
  require_parts();
  robot.require_start();
}

void Environment::Fixed::require_parts() const {
  require_named("TrialParts.evaluation", parts.evaluation);
  require_named("TrialParts.situations", parts.situations);
  const std::vector<double>& table = parts.sef_table;
  if (table.empty()) return;
  const char* const quantity = "TrialParts.sef_table";
  if (parts.evaluation.function) {
    throw InvalidValue(quantity, "given, and an evaluation too", "only one of them");
  }
  if (parts.situations.function) {
    throw InvalidValue(quantity, "given, and situations of one's own too",
                       "an evaluation: a table is of the grid's situations");
  }
  require_size(quantity, table.size(), static_cast<std::uint64_t>(grid.count()));
  require_each(table.size(), [&](std::size_t i) { require_sef(quantity, table[i]); });
}

// What an agent chooses by.
const Observation& Environment::look() {
  const bool any_refused = robot().allowed(pose(), allowed_.get(), time());
  state_.here.allowed = {};
  if (any_refused) {
    state_.here.allowed = {allowed_.get(), static_cast<std::size_t>(state_.here.motion_count)};
  }
  return state_.here;
}

Environment::Transition Environment::after(int motion) const { return transition(motion); }

Environment::Transition Environment::after(const WheelSpeeds& speeds) const {
  return transition(speeds);
}

template <typename Command>
Environment::Transition Environment::transition(const Command& command) const {
  Random noise = noise_to_come();
  // -> motion (Eq. 1)
  const Robot::Move made = moved(command, noise);
  const Pose estimate = config().noise.of_odometry() ? reckoned(made.pose, noise) : made.pose;
  // world -> sense -> situation, and its SEF (Eq. 6)
  Transition transition{sensed({made.pose, estimate, noise, state_.place.steps + 1}), 0.0, {}};
  // -> evaluation (Eq. 8)
  transition.smf = transition.next.here.sef - state_.here.sef;
  transition.outcome = outcome_of(transition.next, transition.smf, made.collided);
  return transition;
}

Environment::State Environment::standing(const Pose& pose) const {
  robot().require_free(pose, time());
  return standing({pose, pose, noise_to_come(), state_.place.steps});
}

Environment::State Environment::standing(const Place& place) const {
  robot().require_place(place.pose);
  return sensed(place);
}

// As well as the robot makes it.
Robot::Move Environment::moved(int motion, Random& noise) const {
  const NoiseDef& def = config().noise;
  const RobotDef& body = config().robot;
  require_count("motion", motion, 0, config().motion_count() - 1);
  motion = slipped(noise).value_or(motion);
  if (!def.of_motion()) return robot().step(pose(), motion, time());
  const double turn = body.steering_angles[static_cast<std::size_t>(motion)];
  const double off = def.turn * noise.normal();
  const double faster = def.drive * noise.normal() / body.sample_time;
  return robot().drive(pose(), turn + off,
                       std::clamp(body.speed + faster, 0.0, 1.0 / body.sample_time), time());
}

Robot::Move Environment::moved(const WheelSpeeds& speeds, Random& noise) const {
  const NoiseDef& def = config().noise;
  Arc arc = robot().arc(speeds);
  if (const std::optional<int> motion = slipped(noise)) return moved(*motion, noise);
  if (def.of_motion()) {
    const double fastest = 1.0 / config().robot.sample_time;
    arc.turn += def.turn * noise.normal();
    arc.chord_speed += def.drive * noise.normal() / config().robot.sample_time;
    arc.chord_speed = std::clamp(arc.chord_speed, -fastest, fastest);
  }
  return robot().follow(pose(), arc, time());
}

// The motion that chance puts in the place of what was chosen.
std::optional<int> Environment::slipped(Random& noise) const {
  const double chance = config().noise.slip;
  if (!(chance > 0.0) || noise.uniform() >= chance) return std::nullopt;
  return static_cast<int>(noise.index(static_cast<std::uint32_t>(config().motion_count())));
}

// The pose that odometry makes of the way to another, seen from where it believed the robot to be.
Pose Environment::reckoned(const Pose& to, Random& noise) const {
  const NoiseDef& def = config().noise;
  const auto& [from, believed, stream, steps] = state_.place;
  const double turned = def.odometry_turn * noise.normal();
  const double driven = 1.0 + def.odometry_drive * noise.normal();
  const double heading = wrapped_heading(believed.heading + (to.heading - from.heading) + turned);
  const Direction ahead = direction(to.heading), ahead_as_believed = direction(heading);
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double along = driven * (dx * ahead.x + dy * ahead.y);
  const double aside = driven * (dy * ahead.x - dx * ahead.y);
  return {believed.x + along * ahead_as_believed.x - aside * ahead_as_believed.y,
          believed.y + along * ahead_as_believed.y + aside * ahead_as_believed.x, heading};
}

// What is sensed at a place, and its situation and SEF.
Environment::State Environment::sensed(const Place& place) const {
  State state{place, {}, -1, false};
  const auto& [pose, estimate, stream, steps] = place;
  Observation& here = state.here;
  here.pose = estimate;
  here.goal_distance = distance_to_target(estimate);
  here.clearance = clearance(place);
  const Senses senses{estimate, here.goal_distance, here.clearance};
  here.situation = state.true_situation = situation(senses);
  here.sef = sef(senses, here.situation);
  double distance = here.goal_distance;
  if (config().noise.of_odometry()) {
    distance = distance_to_target(pose);
    state.true_situation = situation({pose, distance, here.clearance});
  }
  state.arrived = distance <= config().goal_radius;
  if (!state.arrived) {
    here.estimate = here.goal_distance / (config().robot.speed * config().robot.sample_time);
  }
  here.motion_count = config().motion_count();
  return state;
}

// d_o of Eq. 6.
double Environment::clearance(const Place& place) const {
  const auto& [pose, estimate, stream, steps] = place;
  if (config().clearance_source != ClearanceSource::kSonar) {
    return world().clearance({pose.x, pose.y}, config().walls_count, time_of(place));
  }
  const std::vector<double> echoes = heard(place);
  return *std::min_element(echoes.begin(), echoes.end()) + config().robot.radius;
}

// Where sonars err, they do so by a stream that one draw begins: what they hear is a function of
// the place.
void Environment::hear(const Place& place, double* echoes) const {
  const NoiseDef& def = config().noise;
  const double time = time_of(place);
  if (!def.of_sonars()) return robot().sonar(place.pose, echoes, time);
  Random noise(Random(place.noise).next(), "sonars");
  const auto count = static_cast<std::size_t>(config().robot.sonar_count);
  std::vector<double> aside(count);
  for (double& angle : aside) angle = def.bearing * noise.normal();
  robot().sonar(place.pose, aside.data(), echoes, time);
  const double range = config().robot.sonar_range;
  std::for_each(echoes, echoes + count, [&](double& echo) {
    const double off = def.echo * noise.normal();
    const bool lost = noise.uniform() < def.dropout;
    echo = lost || echo >= range ? range : std::clamp(echo + off, 0.0, range);
  });
}

std::vector<double> Environment::heard(const Place& place) const {
  std::vector<double> echoes(static_cast<std::size_t>(config().robot.sonar_count));
  hear(place, echoes.data());
  return echoes;
}

// The stream, after what it began for the sonars here.
Random Environment::noise_to_come() const noexcept {
  Random noise = state_.place.noise;
  if (config().noise.of_sonars()) noise.next();
  return noise;
}

double Environment::distance_to_target(const Pose& pose) const noexcept {
  const double dx = pose.x - world().def().target.x;
  const double dy = pose.y - world().def().target.y;
  return std::sqrt(dx * dx + dy * dy);
}

// Step 1, or what stands in its place.
SituationId Environment::situation(const Senses& senses) const {
  const NamedFunction<SituationId>& own = parts().situations;
  const auto& [x, y, heading] = senses.pose;
  if (!own.function) return grid().situation(x, y, heading);
  const SituationId id = own.function(senses);
  if (id < 0) {
    throw InvalidValue("situation by " + own.name, std::to_string(id), "in [0, 2^63 - 1]");
  }
  return id;
}

// Eq. 6, or what stands in its place.
double Environment::sef(const Senses& senses, SituationId situation) const {
  const NamedFunction<double>& own = parts().evaluation;
  if (own.function) return require_sef("SEF by " + own.name, own.function(senses));
  const std::vector<double>& table = parts().sef_table;
  if (!table.empty()) return table[static_cast<std::size_t>(situation)];
  return config().evaluation(senses.goal_distance, senses.clearance);
}

// What an agent is told of a motion.
Outcome Environment::outcome_of(const State& next, double smf, bool collided) const {
  Outcome outcome;
  outcome.situation = next.here.situation;
  outcome.sef = next.here.sef;
  outcome.smf = collided ? std::min(smf, kCollisionSmf) : smf;
  outcome.collided = collided;
  outcome.arrived = next.arrived;
  outcome.estimate = next.here.estimate;
  if (collided) {
    outcome.cost += config().touch_cost;
    outcome.event = kTouchEvent;
  }
  if (next.arrived) outcome.event = kArrivalEvent;
  return outcome;
}

}  // namespace devlearn
