#include "devlearn/robot.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "body/box2d_vector.hpp"
#include "body/drive.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "world/geometry.hpp"

namespace devlearn {
namespace {

// Box2D's slop: a body may rest this deep in what it touches [m]. Both what a step may return and
// what counts as a place to stand follow it, so that every pose a step returns is accepted again.
constexpr double kSlop = 0.005;
// The way is free with more room than Box2D's skin of 0.01 m around edges, and a little [m].
constexpr double kFreeMargin = 0.0105;
// Where surfaces wedge the body deeper than one substep leads [m], the drive is done again with
// more rounds of Box2D's solver.
constexpr double kShallow = 0.0035;

constexpr int kMostSubsteps = 1000;  // of step_simulated

constexpr double kPi = 3.14159265358979323846;

class NearestHit : public b2RayCastCallback {
 public:
  float ReportFixture(b2Fixture*, const b2Vec2&, const b2Vec2&, float at) override {
    hit = true;
    return fraction = at;
  }
  bool hit = false;
  float fraction = 1.0f;
};

bool is_finite(const Pose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.heading);
}

}  // namespace

// --- RobotDef ----------------------------------------------------------------------------------

void RobotDef::validate() const {
  require_in("radius", radius, 0.01, 10.0, "m");
  require_above("speed", speed, 0.0, 10.0, "m/s");
  require_above("sample_time", sample_time, 0.0, 10.0, "s");
  require_above("speed * sample_time", speed * sample_time, 0.0, 1.0, "m");
  if (track != 0.0) require_above("track", track, 0.0, 10.0, "m");
  require_count("the number of steering_angles", static_cast<long long>(steering_angles.size()), 1,
                65535);
  for (std::size_t i = 0; i < steering_angles.size(); ++i) {
    if (!(std::abs(steering_angles[i]) <= 360.0)) {
      require_in("steering_angles[" + std::to_string(i) + "]", steering_angles[i], -360.0, 360.0,
                 "degrees");
    }
  }
  require_count("sonar_count", sonar_count, 0, 720);
  require_in("sonar_fov", sonar_fov, 0.0, 360.0, "degrees");
  require_in("sonar_range", sonar_range, 0.01, 100.0, "m");
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

bool operator==(const RobotDef& a, const RobotDef& b) noexcept {
  return a.radius == b.radius && a.speed == b.speed && a.sample_time == b.sample_time &&
         a.track == b.track && a.steering_angles == b.steering_angles &&
         a.sonar_count == b.sonar_count && a.sonar_fov == b.sonar_fov &&
         a.sonar_range == b.sonar_range;
}

// --- Robot -------------------------------------------------------------------------------------

// What the sonars hear: everything in the world that stands still.
struct Robot::Physics {
  Physics(const World& world, const RobotDef& def)
      : standing(b2Vec2(0.0f, 0.0f)), sonar_angles(def.sonar_angles()) {
    b2BodyDef ground_def;
    b2Body* ground = standing.CreateBody(&ground_def);
    for (const World::Edge& edge : world.edges()) {
      // Both ends overlap the next edge by some units in the last place of a float, so that no
      // ray slips through a corner.
      const Point side = edge.b - edge.a;
      const double furthest = std::max(
          {1.0, std::abs(edge.a.x), std::abs(edge.a.y), std::abs(edge.b.x), std::abs(edge.b.y)});
      const double overlap = 1e-6 * furthest / std::sqrt(squared_length(side));
      b2EdgeShape shape;
      shape.SetTwoSided(vector(along(edge.a, side, -overlap)),
                        vector(along(edge.b, side, overlap)));
      ground->CreateFixture(&shape, 0.0f);
    }
    for (const Circle& circle : world.circles()) {
      b2CircleShape shape;
      shape.m_p = vector(circle.center);
      shape.m_radius = static_cast<float>(circle.radius);
      ground->CreateFixture(&shape, 0.0f);
    }
  }

  b2World standing;
  std::vector<double> sonar_angles;
};

Robot::Robot(const World& world, const RobotDef& def)
    : world_(std::make_shared<World>(world)), def_(def) {
  def_.validate();
}
Robot::~Robot() = default;
Robot::Robot(Robot&&) noexcept = default;
Robot& Robot::operator=(Robot&&) noexcept = default;

double Robot::steering_angle(int motion) const {
  require_count("motion", motion, 0, static_cast<long long>(def_.steering_angles.size()) - 1);
  return def_.steering_angles[static_cast<std::size_t>(motion)];
}

double Robot::heading_after(const Pose& pose, int motion) const {
  return wrapped_heading(pose.heading + steering_angle(motion));
}

double Robot::step_length() const noexcept { return def_.speed * def_.sample_time; }

std::optional<Pose> Robot::free_step(const Pose& pose, int motion) const {
  const double heading = heading_after(pose, motion);
  if (!is_finite(pose)) require_place(pose);
  const Step straight = straight_drive(pose, heading);
  if (keeps_clear(pose, straight)) return straight.pose;
  return std::nullopt;
}

Robot::Step Robot::step(const Pose& pose, int motion) const {
  const double heading = heading_after(pose, motion);
  if (!is_finite(pose)) require_place(pose);
  const Step straight = straight_drive(pose, heading);
  if (keeps_clear(pose, straight)) return straight;

  require_place(pose);
  const Point from{pose.x, pose.y};
  const World::Surroundings near = world_->around(from, reach_of(def_));
  const int substeps = substeps_of(def_);
  for (const int rounds : {kFewRounds, kManyRounds}) {
    auto drive = drive_directly(near, def_, from, heading, substeps, rounds);
    if (!drive) drive = drive_in_box2d(near, def_, from, heading, substeps, rounds);
    const Step end = drive->touched ? ended(pose, heading, *drive) : straight;
    if (fits(end, rounds == kFewRounds ? kShallow : kSlop)) return end;
  }
  // Deeper than the slop even so: the body stays where it was, which is no deeper.
  return ended(pose, heading, {{0.0, 0.0}, true});
}

Robot::Step Robot::step_simulated(const Pose& pose, int motion, int substeps) const {
  require_count("substeps", substeps, 1, kMostSubsteps);
  require_place(pose);
  const double heading = heading_after(pose, motion);
  const Point from{pose.x, pose.y};
  const World::Surroundings near = world_->around(from, reach_of(def_));
  return ended(pose, heading, drive_in_box2d(near, def_, from, heading, substeps, kFewRounds));
}

Robot::Step Robot::straight_drive(const Pose& pose, double heading) const noexcept {
  const Direction ahead = direction(heading);
  return ended(pose, heading, {{step_length() * ahead.x, step_length() * ahead.y}, false});
}

Robot::Step Robot::ended(const Pose& pose, double heading, const Drive& drive) const noexcept {
  const Point at{pose.x + drive.moved.x, pose.y + drive.moved.y};
  return {{at.x, at.y, heading}, drive.touched, world_->clearance(at)};
}

// Whether the way straight ahead is free: World::keeps_clear, decided where it can be by what is
// known of its ends. No point on the way is nearer to anything than an end less its way there.
bool Robot::keeps_clear(const Pose& pose, const Step& straight) const noexcept {
  constexpr double kRounding = 1e-9;  // [m], more than all of it
  const Point from{pose.x, pose.y}, to{straight.pose.x, straight.pose.y};
  const double room = def_.radius + kFreeMargin;
  const double at_end = std::min(straight.clearance, world_->wall_distance(to));
  if (at_end < room - kRounding) return false;
  if (at_end > room + step_length() + kRounding) return true;
  const double at_start = world_->clearance(from, true);
  if (at_start < room - kRounding) return false;
  if (at_start + at_end - step_length() > 2.0 * (room + kRounding)) return true;
  return world_->keeps_clear(from, to, room);
}

const Robot::Physics& Robot::physics() const {
  if (!physics_) physics_ = std::make_unique<Physics>(*world_, def_);
  return *physics_;
}

void Robot::sonar(const Pose& pose, double* echoes) const {
  require_place(pose);
  // From the centre: the body holds nothing but slop, and no ray begins inside a shape.
  const double reach = def_.radius + def_.sonar_range;
  for (const double angle : physics().sonar_angles) {
    const Direction ray = direction(pose.heading + angle);
    NearestHit nearest;
    physics().standing.RayCast(&nearest, vector({pose.x, pose.y}),
                               vector({pose.x + reach * ray.x, pose.y + reach * ray.y}));
    const double echo = static_cast<double>(nearest.fraction) * reach - def_.radius;
    *echoes++ = nearest.hit ? std::clamp(echo, 0.0, def_.sonar_range) : def_.sonar_range;
  }
}

std::vector<double> Robot::sonar(const Pose& pose) const {
  std::vector<double> echoes(static_cast<std::size_t>(def_.sonar_count));
  sonar(pose, echoes.data());
  return echoes;
}

WheelSpeeds Robot::turn_speeds(int motion) const {
  const double turn = steering_angle(motion) * (kPi / 180.0);
  const double track = def_.track == 0.0 ? def_.radius : def_.track;
  const double right = turn * track / (2.0 * def_.sample_time);
  return {-right, right};
}

WheelSpeeds Robot::drive_speeds() const noexcept { return {def_.speed, def_.speed}; }

bool Robot::fits(const Step& step, double depth) const noexcept {
  const Point at{step.pose.x, step.pose.y};
  return std::min(step.clearance, world_->wall_distance(at)) >= def_.radius - depth;
}

void Robot::require_place(const Pose& pose, const char* what) const {
  if (is_finite(pose) && world_->clearance({pose.x, pose.y}, true) >= def_.radius - kSlop) return;
  const std::string name = what;
  require_in(name + ".x", pose.x, 0.0, world_->def().width, "m");
  require_in(name + ".y", pose.y, 0.0, world_->def().height, "m");
  require_finite(name + ".heading", pose.heading);
  const double clearance = world_->clearance({pose.x, pose.y}, true);
  throw InvalidValue(name, "a place " + to_text(clearance) + " m from the nearest surface",
                     "at least " + to_text(def_.radius - kSlop) + " m, the robot's radius less " +
                         to_text(kSlop) + " m");
}

}  // namespace devlearn
