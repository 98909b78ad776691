#include "body/kinematics.hpp"

#include <algorithm>
#include <cmath>

#include "devlearn/detail/require.hpp"
#include "devlearn/math.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

// The way is free with more room than Box2D's skin of 0.01 m around edges, and a little [m].
constexpr double kFreeMargin = 0.0105;

constexpr double kPi = 3.14159265358979323846;

// Distance between the wheels [m].
double track(const RobotDef& robot) noexcept { return robot.track.value_or(robot.radius); }

}  // namespace

double steering_angle(const RobotDef& robot, int motion) {
  const auto count = static_cast<long long>(robot.steering_angles.size());
  require_count("motion", motion, 0, count - 1);
  return robot.steering_angles[static_cast<std::size_t>(motion)];
}

double step_length(const RobotDef& robot) noexcept { return robot.speed * robot.sample_time; }

double free_room(const RobotDef& robot) noexcept { return robot.radius + kFreeMargin; }

// Eq. 1: theta' = theta + dtheta
double heading_after(const RobotDef& robot, const Pose& pose, int motion) {
  return wrapped_heading(pose.heading + steering_angle(robot, motion));
}

// Eq. 1: x' = x + v t_s cos theta', y' = y + v t_s sin theta'
Pose driven(const Pose& pose, double heading, double length) noexcept {
  const Direction ahead = direction(heading);
  return {pose.x + length * ahead.x, pose.y + length * ahead.y, heading};
}

// Eq. 2: v_r = -v_l = dtheta track / (2 t_s)
WheelSpeeds Robot::turn_speeds(int motion) const {
  const double turn = steering_angle(def_, motion) * (kPi / 180.0);
  const double right = turn * track(def_) / (2.0 * def_.sample_time);
  return {-right, right};
}

// Eq. 2: v_r = v_l = v
WheelSpeeds Robot::drive_speeds() const noexcept { return {def_.speed, def_.speed}; }

// dtheta = (v_r - v_l) t_s / track; an arc's chord is as long as it by sin(a) / a, a = dtheta / 2.
Arc Robot::arc(const WheelSpeeds& speeds) const {
  const double mean = 0.5 * (speeds.left + speeds.right);
  const double fastest = kLongestStep / def_.sample_time;
  require_in("mean of the wheel speeds", mean, -fastest, fastest, "m/s");
  const double half = 0.5 * (speeds.right - speeds.left) * def_.sample_time / track(def_);
  const double turn = 2.0 * half * (180.0 / kPi);
  require_finite("turn of the wheel speeds", turn);
  constexpr double kStraight = 1e-9;  // sin(a) / a is 1 in double precision
  if (std::abs(half) < kStraight) return {turn, mean};
  return {turn, mean * std::min(1.0, direction(0.5 * turn).y / half)};
}

// Decided where it can be by what is known of the ends: no point on the way is nearer to anything
// than an end less its way there.
bool way_is_free(const World& world, const RobotDef& robot, const Pose& from, const Pose& to,
                 double length) noexcept {
  constexpr double kRounding = 1e-9;  // [m], more than all of it
  const Point start{from.x, from.y}, end{to.x, to.y};
  const double room = free_room(robot);
  const double in_sight = world.surfaces().distance_at_least(end);
  if (std::min(in_sight, world.wall_distance(end)) > room + length + kRounding) return true;
  const double at_end = world.surfaces().room(end);
  if (at_end < room - kRounding) return false;
  if (at_end > room + length + kRounding) return true;
  const double at_start = world.surfaces().room(start);
  if (at_start < room - kRounding) return false;
  if (at_start + at_end - length > 2.0 * (room + kRounding)) return true;
  return world.surfaces().keep_clear_of(start, end, room);
}

std::optional<Pose> free_step(const World& world, const RobotDef& robot, const Pose& pose,
                              int motion) {
  const double length = step_length(robot);
  const Pose next = driven(pose, heading_after(robot, pose, motion), length);
  if (way_is_free(world, robot, pose, next, length)) return next;
  return std::nullopt;
}

}  // namespace devlearn
