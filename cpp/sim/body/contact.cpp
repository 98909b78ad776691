#include "body/contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

#include "body/box2d_vector.hpp"
#include "body/kinematics.hpp"
#include "devlearn/math.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

// Nothing comes nearer at once, less than the slop [m].
constexpr double kLongestSubstep = 0.0034;
constexpr int kLeastSubsteps = 15;

// What stands still only ever slows the body, so it stays within a step, and a little [m], of its
// beginning; what moves takes it along no further than it goes itself.
constexpr double kReachMargin = 0.05;
// No more of an edge takes part than lies so far beyond what can be reached [m], so that floats
// lose nothing to faraway corners.
constexpr double kEdgeMargin = 1.0;
// Where a thin wall ends, each of its sides takes in so much of the other's [m], more than floats
// may be off: what comes straight at the end is on one of them, or on both.
constexpr double kOverlap = 1e-6;

Edge near_part(const Edge& edge, Point point, double reach) {
  const double length = distance(edge.a, edge.b);
  const Point unit{(edge.b.x - edge.a.x) / length, (edge.b.y - edge.a.y) / length};
  const double foot = dot(point - edge.a, unit), aside = cross(unit, point - edge.a);
  const double half = std::sqrt(std::max(0.0, reach * reach - aside * aside));
  Edge part = edge;
  if (foot > half) {
    part.a = along(edge.a, unit, foot - half);
    part.before = along(part.a, unit, -1.0);
  }
  if (foot + half < length) {
    part.b = along(edge.a, unit, foot + half);
    part.after = along(part.b, unit, 1.0);
  }
  // A thin wall ends where an edge leads on to its own other side.
  if ((edge.before == edge.b && foot <= half) || (edge.after == edge.a && foot + half >= length)) {
    const Point left{-unit.y, unit.x};
    part.a = along(part.a, left, kOverlap);
    part.b = along(part.b, left, kOverlap);
  }
  return part;
}

// Whether the way p-q leads through an edge from its front.
bool leads_through(b2Vec2 p, b2Vec2 q, const b2EdgeShape& edge) {
  const auto left = [](b2Vec2 from, b2Vec2 to, b2Vec2 of) {
    return b2Cross(to - from, of - from) > 0.0f;
  };
  const b2Vec2 a = edge.m_vertex1, b = edge.m_vertex2;
  return !left(a, b, p) && left(a, b, q) && left(p, q, a) != left(p, q, b);
}

}  // namespace

Scene::Scene(const World& world, const RobotDef& robot, const Pose& pose, double heading,
             double speed, const TimeSpan& step) {
  const Point from{pose.x, pose.y};
  double way = speed * robot.sample_time;
  if (world.moves()) {
    way += add_movers(world.movers(), from, robot.radius + way + kReachMargin, step);
  }
  furthest = way + kReachMargin;
  const double reach = robot.radius + way + kReachMargin;
  const std::vector<std::uint32_t> near = world.surfaces().around(from, reach);
  edges.reserve(near.size());
  for (const std::uint32_t surface : near) {
    world.surfaces().apply(surface, [&](const auto& shape) { add(shape, from, reach); });
  }
  for_each_surface([&](std::size_t, const auto& shape) {
    b2Transform here;
    here.SetIdentity();
    shape.ComputeAABB(&bounds.emplace_back(), here, 0);
  });
  body.m_radius = static_cast<float>(robot.radius);
  const Direction ahead = direction(heading);
  velocity = vector({speed * ahead.x, speed * ahead.y});
  substeps = std::max(kLeastSubsteps, static_cast<int>(std::ceil(way / kLongestSubstep)));
  substep = static_cast<float>(robot.sample_time / substeps);
}

// The movers that a body can touch, and those among which these may push it. Returns how far the
// fastest of them goes [m].
double Scene::add_movers(const Movers& all, Point from, double reach, const TimeSpan& step) {
  const auto fastest = [&](const std::vector<std::size_t>& some) {
    double furthest_way = 0.0;
    for (const std::size_t i : some) {
      furthest_way =
          std::max(furthest_way, distance(all.place(i, step.begin), all.place(i, step.end())));
    }
    return furthest_way;
  };
  const std::vector<std::size_t> touchable = all.around(from, reach, step);
  if (touchable.empty()) return 0.0;
  const std::vector<std::size_t> near = all.around(from, reach + fastest(touchable), step);
  for (const std::size_t i : near) {
    const Point begin = all.place(i, step.begin), way = all.place(i, step.end()) - begin;
    movers.push_back({moving_shape(all.shape(i)), vector(begin - from),
                      vector(along({}, way, 1.0 / step.duration))});
  }
  return fastest(near);
}

void Scene::add(const Edge& edge, Point from, double reach) {
  const Edge part = near_part(edge, from, reach + kEdgeMargin);
  edges.emplace_back().SetOneSided(vector(part.before - from), vector(part.a - from),
                                   vector(part.b - from), vector(part.after - from));
}

void Scene::add(const Circle& circle, Point from, double) {
  circles.emplace_back().m_p = vector(circle.center - from);
  circles.back().m_radius = static_cast<float>(circle.radius);
}

bool Scene::passes(b2Vec2 p, b2Vec2 q) const {
  const b2AABB way{b2Min(p, q), b2Max(p, q)};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (b2TestOverlap(way, bounds[i]) && leads_through(p, q, edges[i])) return true;
  }
  return false;
}

void prepare_box2d() {
  static std::once_flag prepared;
  std::call_once(prepared, [] {
    b2World physics(b2Vec2(0.0f, 0.0f));
    b2CircleShape shape;
    shape.m_radius = 1.0f;
    b2BodyDef body;
    body.type = b2_dynamicBody;
    for (int i = 0; i < 2; ++i) physics.CreateBody(&body)->CreateFixture(&shape, 1.0f);
    physics.Step(0.01f, 1, 1);
  });
}

Drive drive_in_box2d(const Scene& scene, int iterations) {
  b2World physics(b2Vec2(0.0f, 0.0f));
  physics.SetAllowSleeping(false);
  physics.SetWarmStarting(false);
  physics.SetContinuousPhysics(false);

  b2BodyDef ground_def;
  b2Body* ground = physics.CreateBody(&ground_def);
  b2FixtureDef smooth;
  smooth.friction = 0.0f;
  const auto add = [&](b2Body* owner, const b2Shape& shape) {
    smooth.shape = &shape;
    owner->CreateFixture(&smooth);
  };
  scene.for_each_surface([&](std::size_t, const b2Shape& shape) { add(ground, shape); });

  b2BodyDef body_def;
  body_def.type = b2_dynamicBody;
  body_def.fixedRotation = true;
  body_def.linearVelocity = scene.velocity;
  b2Body* body = physics.CreateBody(&body_def);
  smooth.density = Scene::kDensity;
  add(body, scene.body);

  for (const Scene::Moving& mover : scene.movers) {
    b2BodyDef moving_def;
    moving_def.type = b2_kinematicBody;
    moving_def.position = mover.place;
    moving_def.linearVelocity = mover.velocity;
    add(physics.CreateBody(&moving_def), as_shape(mover.shape));
  }

  Drive drive;
  for (int i = 0; i < scene.substeps; ++i) {
    const b2Vec2 place = body->GetPosition(), velocity = body->GetLinearVelocity();
    physics.Step(scene.substep, iterations, kPositionIterations);
    for (const b2ContactEdge* c = body->GetContactList(); c && !drive.touched; c = c->next) {
      drive.touched = c->contact->IsTouching();
    }
    drive.passed = drive.passed || scene.passes(place, body->GetPosition());
    if (!scene.movers.empty()) {
      drive.trail.push_back({body->GetPosition().x, body->GetPosition().y});
      continue;
    }
    // A step that changes nothing is followed by others like it.
    if (body->GetPosition() == place && body->GetLinearVelocity() == velocity) break;
  }
  drive.moved = {body->GetPosition().x, body->GetPosition().y};
  return drive;
}

}  // namespace devlearn
