#include "devlearn/robot.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "body/contact.hpp"
#include "body/direct_contact.hpp"
#include "body/kinematics.hpp"
#include "body/sonars.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

// Box2D's slop: a body may rest this deep in what it touches [m]. Both what a step may return and
// what counts as a place to stand follow it, so that every pose a step returns is accepted again.
constexpr double kSlop = 0.005;
constexpr double kLongestStep = 1.0;  // [m]

// Where surfaces wedge the body deeper than one substep leads [m], the drive is done again with
// more iterations of Box2D's solver.
constexpr double kShallow = 0.0035;

bool is_finite(const Pose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.heading);
}

}  // namespace

// --- RobotDef ----------------------------------------------------------------------------------

void RobotDef::validate() const {
  detail::require_fields(*this);
  require_above("RobotDef.speed * sample_time", speed * sample_time, 0.0, kLongestStep, "m");
  require_in("RobotDef.sonar_least_range", sonar_least_range, 0.0, sonar_range, "m");
}

std::vector<double> RobotDef::sonar_angles() const {
  if (sonar_count == 1) return {0.0};
  const int gaps = sonar_fov == 360.0 ? sonar_count : sonar_count - 1;
  std::vector<double> angles(static_cast<std::size_t>(sonar_count));
  for (int i = 0; i < sonar_count; ++i) {
    angles[static_cast<std::size_t>(i)] = i * sonar_fov / gaps - 0.5 * sonar_fov;
  }
  return angles;
}

bool operator==(const RobotDef& a, const RobotDef& b) noexcept { return detail::same_fields(a, b); }

// --- Robot -------------------------------------------------------------------------------------

Robot::Robot(const World& world, const RobotDef& def)
    : world_(std::make_shared<World>(world)),
      def_((def.validate(), def)),
      sonars_(std::make_unique<Sonars>(world_, def_)) {
  prepare_box2d();
}
Robot::~Robot() = default;
Robot::Robot(Robot&&) noexcept = default;
Robot& Robot::operator=(Robot&&) noexcept = default;

Robot::Move Robot::step(const Pose& pose, int motion) const {
  return move(pose, steering_angle(def_, motion), def_.speed);
}

Robot::Move Robot::drive(const Pose& pose, double turn, double speed) const {
  require_finite("turn", turn);
  require_in("speed", speed, 0.0, kLongestStep / def_.sample_time, "m/s");
  return move(pose, turn, speed);
}

Robot::Move Robot::move(const Pose& pose, double turn, double speed) const {
  if (!is_finite(pose)) require_place(pose);
  const double heading = wrapped_heading(pose.heading + turn), length = speed * def_.sample_time;
  const Pose straight = driven(pose, heading, length);
  if (way_is_free(*world_, def_, pose, straight, length)) return {straight, false};

  require_place(pose);
  const Scene scene(*world_, def_, pose, heading, speed);
  for (const int iterations : {kFewIterations, kManyIterations}) {
    auto drive = drive_directly(scene, iterations);
    if (!drive) drive = drive_in_box2d(scene, iterations);
    const Pose end =
        drive->touched ? Pose{pose.x + drive->moved.x, pose.y + drive->moved.y, heading} : straight;
    const double depth = iterations == kFewIterations ? kShallow : kSlop;
    if (!drive->passed && world_->clearance({end.x, end.y}, true) >= def_.radius - depth)
      return {end, drive->touched};
  }
  // Deeper than the slop even so, or out on the other side: the body stays where it was.
  return {{pose.x, pose.y, heading}, true};
}

bool Robot::allowed(const Pose& pose, bool* allowed) const {
  if (!is_finite(pose)) require_place(pose);
  const std::size_t motions = def_.steering_angles.size();
  std::fill_n(allowed, motions, true);
  if (!def_.safety_margin) return false;
  const double room = def_.radius + *def_.safety_margin;
  for (std::size_t motion = 0; motion < motions; ++motion) {
    const double heading = heading_after(def_, pose, static_cast<int>(motion));
    const Pose end = driven(pose, heading, step_length(def_));
    allowed[motion] = world_->surfaces().keep_clear_of({pose.x, pose.y}, {end.x, end.y}, room);
  }
  bool* const last = allowed + motions;
  if (std::find(allowed, last, true) == last) std::fill(allowed, last, true);
  return std::find(allowed, last, false) != last;
}

void Robot::sonar(const Pose& pose, double* echoes) const { sonar(pose, nullptr, echoes); }

void Robot::sonar(const Pose& pose, const double* aside, double* echoes) const {
  require_place(pose);
  sonars_->listen(pose, aside, echoes);
}

std::vector<double> Robot::sonar(const Pose& pose) const {
  std::vector<double> echoes(static_cast<std::size_t>(def_.sonar_count));
  sonar(pose, echoes.data());
  return echoes;
}

void Robot::require_place(const Pose& pose, const char* what) const {
  if (is_finite(pose) && world_->clearance({pose.x, pose.y}, true) >= def_.radius - kSlop) return;
  const std::string name = what;
  const Point low = world_->def().origin, high = world_->def().far_corner();
  require_in(name + ".x", pose.x, low.x, high.x, "m");
  require_in(name + ".y", pose.y, low.y, high.y, "m");
  require_finite(name + ".heading", pose.heading);
  const double clearance = world_->clearance({pose.x, pose.y}, true);
  throw InvalidValue(name, "a place " + to_text(clearance) + " m from the nearest surface",
                     "at least " + to_text(def_.radius - kSlop) + " m, the robot's radius less " +
                         to_text(kSlop) + " m");
}

}  // namespace devlearn
