#include "devlearn/robot.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "geometry.hpp"

namespace devlearn {
namespace {

// Box2D's slop: a body may rest this deep in what it touches [m]. Both what a step may return and
// what counts as a place to stand follow it, so that every pose a step returns is accepted again.
constexpr double kSlop = 0.005;
// The way is free with more room than Box2D's skin of 0.01 m around edges, and a little [m].
constexpr double kFreeMargin = 0.0105;
// No part of a drive moves further at once, less than the slop [m].
constexpr double kLongestSubstep = 0.0034;
constexpr int kLeastSubsteps = 15, kMostSubsteps = 1000;
// Rounds of Box2D's solver. Few do, but where surfaces wedge the body deeper than one substep
// leads [m], the drive is done again with many.
constexpr double kShallow = 0.0035;
constexpr int kFewRounds = 8, kManyRounds = 60, kPositionRounds = 3;

constexpr double kPi = 3.14159265358979323846;

b2Vec2 vector(Point p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

Point along(Point from, Point direction, double length) {
  return {from.x + length * direction.x, from.y + length * direction.y};
}

Pose straight_drive(const Pose& pose, double heading, double length) {
  const Direction ahead = direction(heading);
  return {pose.x + length * ahead.x, pose.y + length * ahead.y, heading};
}

// The part of an edge near a point, so that floats lose nothing to faraway corners.
World::Edge near_part(const World::Edge& edge, Point point, double reach) {
  const double length = distance(edge.a, edge.b);
  const Point unit{(edge.b.x - edge.a.x) / length, (edge.b.y - edge.a.y) / length};
  const double foot = dot(point - edge.a, unit), aside = cross(unit, point - edge.a);
  const double half = std::sqrt(std::max(0.0, reach * reach - aside * aside));
  World::Edge part = edge;
  if (foot > half) {
    part.a = along(edge.a, unit, foot - half);
    part.before = along(part.a, unit, -1.0);
  }
  if (foot + half < length) {
    part.b = along(edge.a, unit, foot + half);
    part.after = along(part.b, unit, 1.0);
  }
  return part;
}

struct Drive {
  Point moved;           // from where it began
  bool touched = false;  // anything, at any time
};

// Drives with Box2D in a world of its own, made of what lies within reach, its origin at the
// body. Fresh every time: the outcome depends on nothing that happened before.
Drive simulate(const World& world, const RobotDef& robot, Point from, double heading, int substeps,
               int velocity_rounds) {
  b2World physics(b2Vec2(0.0f, 0.0f));
  physics.SetAllowSleeping(false);
  physics.SetWarmStarting(false);
  physics.SetContinuousPhysics(false);

  // Contacts only ever slow the body, so it stays within a step of where it began.
  constexpr double kMargin = 0.05;
  const double reach = robot.radius + robot.speed * robot.sample_time + kMargin;
  b2BodyDef ground_def;
  b2Body* ground = physics.CreateBody(&ground_def);
  b2FixtureDef smooth;
  smooth.friction = 0.0f;
  for (const World::Edge& edge : world.edges()) {
    if (squared_distance(from, edge.a, edge.b) > reach * reach) continue;
    const World::Edge part = near_part(edge, from, reach + 1.0);
    b2EdgeShape shape;
    shape.SetOneSided(vector(part.before - from), vector(part.a - from), vector(part.b - from),
                      vector(part.after - from));
    smooth.shape = &shape;
    ground->CreateFixture(&smooth);
  }
  for (const Circle& circle : world.circles()) {
    if (distance(from, circle.center) - circle.radius > reach) continue;
    b2CircleShape shape;
    shape.m_p = vector(circle.center - from);
    shape.m_radius = static_cast<float>(circle.radius);
    smooth.shape = &shape;
    ground->CreateFixture(&smooth);
  }

  const Direction ahead = direction(heading);
  b2BodyDef body_def;
  body_def.type = b2_dynamicBody;
  body_def.fixedRotation = true;
  body_def.linearVelocity = vector({robot.speed * ahead.x, robot.speed * ahead.y});
  b2Body* body = physics.CreateBody(&body_def);
  b2CircleShape disc;
  disc.m_radius = static_cast<float>(robot.radius);
  smooth.shape = &disc;
  smooth.density = 1.0f;
  body->CreateFixture(&smooth);

  Drive drive;
  const auto time = static_cast<float>(robot.sample_time / substeps);
  for (int i = 0; i < substeps; ++i) {
    physics.Step(time, velocity_rounds, kPositionRounds);
    for (const b2ContactEdge* c = body->GetContactList(); c && !drive.touched; c = c->next) {
      drive.touched = c->contact->IsTouching();
    }
  }
  drive.moved = {body->GetPosition().x, body->GetPosition().y};
  return drive;
}

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
  physics_ = std::make_unique<Physics>(*world_, def_);
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
  const Pose straight = straight_drive(pose, heading_after(pose, motion), step_length());
  if (!is_finite(pose)) require_place(pose);
  const double clearance = world_->swept_clearance({pose.x, pose.y}, {straight.x, straight.y});
  if (clearance > def_.radius + kFreeMargin) return straight;
  return std::nullopt;
}

Robot::Step Robot::step(const Pose& pose, int motion) const {
  if (const auto straight = free_step(pose, motion)) return {*straight, false};
  require_place(pose);
  const double heading = heading_after(pose, motion);
  const int substeps =
      std::max(kLeastSubsteps, static_cast<int>(std::ceil(step_length() / kLongestSubstep)));
  for (const int rounds : {kFewRounds, kManyRounds}) {
    const Drive drive = simulate(*world_, def_, {pose.x, pose.y}, heading, substeps, rounds);
    const Pose end = drive.touched ? Pose{pose.x + drive.moved.x, pose.y + drive.moved.y, heading}
                                   : straight_drive(pose, heading, step_length());
    if (fits({end.x, end.y}, rounds == kFewRounds ? kShallow : kSlop)) return {end, drive.touched};
  }
  // Deeper than the slop even so: the body stays where it was, which is no deeper.
  return {{pose.x, pose.y, heading}, true};
}

Robot::Step Robot::step_simulated(const Pose& pose, int motion, int substeps) const {
  require_count("substeps", substeps, 1, kMostSubsteps);
  require_place(pose);
  const double heading = heading_after(pose, motion);
  const Drive drive = simulate(*world_, def_, {pose.x, pose.y}, heading, substeps, kFewRounds);
  return {{pose.x + drive.moved.x, pose.y + drive.moved.y, heading}, drive.touched};
}

void Robot::sonar(const Pose& pose, double* echoes) const {
  require_place(pose);
  // From the centre: the body holds nothing but slop, and no ray begins inside a shape.
  const double reach = def_.radius + def_.sonar_range;
  for (const double angle : physics_->sonar_angles) {
    const Direction ray = direction(pose.heading + angle);
    NearestHit nearest;
    physics_->standing.RayCast(&nearest, vector({pose.x, pose.y}),
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

bool Robot::fits(Point centre, double depth) const noexcept {
  return world_->clearance(centre, true) >= def_.radius - depth;
}

void Robot::require_place(const Pose& pose, const char* what) const {
  if (is_finite(pose) && fits({pose.x, pose.y}, kSlop)) return;
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
