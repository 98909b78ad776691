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
#include "world/geometry.hpp"
#include "world/movers.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

// Box2D's slop: a body may rest this deep in what it touches [m]. Both what a step may return and
// what counts as a place to stand follow it, so that every pose a step returns is accepted again.
constexpr double kSlop = 0.005;

// Where surfaces wedge the body deeper than one substep leads [m], the drive is done again with
// more iterations of Box2D's solver.
constexpr double kShallow = 0.0035;

bool is_finite(const Pose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.heading);
}

Point centre(const Pose& pose) noexcept { return {pose.x, pose.y}; }

Pose moved_by(const Drive& drive, const Pose& pose, double heading) noexcept {
  return {pose.x + drive.moved.x, pose.y + drive.moved.y, heading};
}

[[noreturn]] void refuse_distance(const std::string& quantity, const std::string& what,
                                  double distance, const std::string& from, const RobotDef& def) {
  throw InvalidValue(quantity, what + " " + to_text(distance) + " m from " + from,
                     "at least " + to_text(def.radius - kSlop) + " m, the robot's radius less " +
                         to_text(kSlop) + " m");
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

Robot::Move Robot::step(const Pose& pose, int motion, double time) const {
  return move(pose, steering_angle(def_, motion), def_.speed, time);
}

Robot::Move Robot::drive(const Pose& pose, double turn, double speed, double time) const {
  require_finite("turn", turn);
  require_in("speed", speed, 0.0, kLongestStep / def_.sample_time, "m/s");
  return move(pose, turn, speed, time);
}

Robot::Move Robot::follow(const Pose& pose, const Arc& arc, double time) const {
  const double speed = std::abs(arc.chord_speed);
  require_finite("arc.turn", arc.turn);
  require_in("|arc.chord_speed|", speed, 0.0, kLongestStep / def_.sample_time, "m/s");
  // A round body drives backwards as it drives forwards when it has turned about.
  const double about = arc.chord_speed < 0.0 ? 180.0 : 0.0;
  Move made = move(pose, 0.5 * arc.turn + about, speed, time);
  made.pose.heading = wrapped_heading(pose.heading + arc.turn);
  return made;
}

Robot::Move Robot::move(const Pose& pose, double turn, double speed, double time) const {
  if (!is_finite(pose)) require_place(pose);
  if (world_->moves()) require_in("time", time, 0.0, Movers::kLatest, "s");
  const double heading = wrapped_heading(pose.heading + turn), length = speed * def_.sample_time;
  const Pose straight = driven(pose, heading, length);
  if (way_is_free(*world_, def_, pose, straight, length) &&
      movers_keep_clear(pose, straight, free_room(def_), time)) {
    return {straight, false};
  }
  require_place(pose);
  const TimeSpan step{time, def_.sample_time};
  const Scene scene(*world_, def_, pose, heading, speed, step);
  return scene.movers.empty() ? among_standing(scene, pose, straight)
                              : among_moving(scene, pose, straight, step.end());
}

// Whether what moves keeps more than that from a body that goes straight from a pose to another.
bool Robot::movers_keep_clear(const Pose& from, const Pose& to, double room, double time) const {
  if (!world_->moves()) return true;
  return world_->movers().keep_clear_of(centre(from), centre(to), room, {time, def_.sample_time});
}

// Whether the body is no deeper than that in what stands still.
bool Robot::stands(const Pose& pose, double depth) const noexcept {
  return world_->surfaces().room(centre(pose)) >= def_.radius - depth;
}

Robot::Move Robot::among_standing(const Scene& scene, const Pose& pose,
                                  const Pose& straight) const {
  for (const int iterations : {kFewIterations, kManyIterations}) {
    auto drive = drive_directly(scene, iterations);
    if (!drive) drive = drive_in_box2d(scene, iterations);
    const Pose end = drive->touched ? moved_by(*drive, pose, straight.heading) : straight;
    if (!drive->passed && stands(end, iterations == kFewIterations ? kShallow : kSlop))
      return {end, drive->touched};
  }
  // Deeper than the slop even so, or out on the other side: the body stays where it was.
  return {{pose.x, pose.y, straight.heading}, true};
}

// What moves is held up by nothing, so it can leave no room. Then what stands still has its way.
Robot::Move Robot::among_moving(const Scene& scene, const Pose& pose, const Pose& straight,
                                double end_time) const {
  const Movers& movers = world_->movers();
  const auto distance_to_movers = [&](const Pose& p) {
    return movers.distance(centre(p), end_time);
  };
  for (const int iterations : {kFewIterations, kManyIterations}) {
    const Drive drive = drive_in_box2d(scene, iterations);
    const Pose end = drive.touched ? moved_by(drive, pose, straight.heading) : straight;
    const bool few = iterations == kFewIterations;
    if (!stands(end, few ? kShallow : kSlop) || !went_between(drive, scene, pose)) continue;
    if (few && distance_to_movers(end) < def_.radius - kSlop) continue;
    return {end, drive.touched};
  }
  Scene alone = scene;
  alone.movers.clear();
  const Pose stay{pose.x, pose.y, straight.heading};
  const Pose own = among_standing(alone, pose, straight).pose;
  return {distance_to_movers(own) >= distance_to_movers(stay) ? own : stay, true};
}

// Whether a drive led nowhere through what stands still, and no further than movers push.
bool Robot::went_between(const Drive& drive, const Scene& scene, const Pose& pose) const {
  if (drive.passed || distance({}, drive.moved) > scene.furthest) return false;
  Point before = centre(pose);
  for (const Point& moved : drive.trail) {
    const Point now{pose.x + moved.x, pose.y + moved.y};
    if (!world_->surfaces().keep_clear_of(before, now, 0.5 * def_.radius)) return false;
    before = now;
  }
  return true;
}

bool Robot::allowed(const Pose& pose, bool* allowed, double time) const {
  if (!is_finite(pose)) require_place(pose);
  const std::size_t motions = def_.steering_angles.size();
  std::fill_n(allowed, motions, true);
  if (!def_.safety_margin) return false;
  const double room = def_.radius + *def_.safety_margin;
  for (std::size_t motion = 0; motion < motions; ++motion) {
    const double heading = heading_after(def_, pose, static_cast<int>(motion));
    const Pose end = driven(pose, heading, step_length(def_));
    allowed[motion] = world_->surfaces().keep_clear_of(centre(pose), centre(end), room) &&
                      movers_keep_clear(pose, end, room, time);
  }
  bool* const last = allowed + motions;
  if (std::find(allowed, last, true) == last) std::fill(allowed, last, true);
  return std::find(allowed, last, false) != last;
}

void Robot::sonar(const Pose& pose, double* echoes, double time) const {
  sonar(pose, nullptr, echoes, time);
}

void Robot::sonar(const Pose& pose, const double* aside, double* echoes, double time) const {
  require_place(pose);
  sonars_->listen(pose, aside, echoes, time);
}

std::vector<double> Robot::sonar(const Pose& pose, double time) const {
  std::vector<double> echoes(static_cast<std::size_t>(def_.sonar_count));
  sonar(pose, echoes.data(), time);
  return echoes;
}

void Robot::require_place(const Pose& pose, const char* what) const {
  if (is_finite(pose) && stands(pose, kSlop)) return;
  const std::string name = what;
  const Point low = world_->def().origin, high = world_->def().far_corner();
  require_in(name + ".x", pose.x, low.x, high.x, "m");
  require_in(name + ".y", pose.y, low.y, high.y, "m");
  require_finite(name + ".heading", pose.heading);
  refuse_distance(name, "a place", world_->surfaces().room(centre(pose)), "the nearest surface",
                  def_);
}

void Robot::require_free(const Pose& pose, double time, const char* what) const {
  require_place(pose, what);
  const double distance = world_->movers().distance(centre(pose), time);
  if (distance >= def_.radius - kSlop) return;
  refuse_distance(what, "a place", std::max(0.0, distance),
                  "what moves, at " + to_text(time) + " s", def_);
}

void Robot::require_start() const {
  const Pose& start = world_->def().start;
  require_place(start, "start");
  for (std::size_t i = 0; i < world_->movers().size(); ++i) {
    const double distance = world_->movers().distance_ever(i, centre(start));
    if (distance >= def_.radius - kSlop) continue;
    refuse_distance("movers[" + std::to_string(i) + "]", "a course that comes", distance,
                    "the start, where rounds begin at any time", def_);
  }
}

}  // namespace devlearn
