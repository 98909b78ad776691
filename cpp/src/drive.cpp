#include "drive.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "box2d_vector.hpp"
#include "devlearn/math.hpp"
#include "geometry.hpp"

namespace devlearn {
namespace {

// No part of a drive moves further at once, less than the slop [m].
constexpr double kLongestSubstep = 0.0034;
constexpr int kLeastSubsteps = 15;
constexpr int kPositionRounds = 3;

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

// What takes part in a drive, its origin where the body begins.
struct Scene {
  Scene(const World::Surroundings& near, const RobotDef& robot, Point from, double heading) {
    edges.resize(near.edges.size());
    circles.resize(near.circles.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const World::Edge part = near_part(near.edges[i], from, reach_of(robot) + 1.0);
      edges[i].SetOneSided(vector(part.before - from), vector(part.a - from), vector(part.b - from),
                           vector(part.after - from));
    }
    for (std::size_t i = 0; i < circles.size(); ++i) {
      circles[i].m_p = vector(near.circles[i].center - from);
      circles[i].m_radius = static_cast<float>(near.circles[i].radius);
    }
    body.m_radius = static_cast<float>(robot.radius);
    const Direction ahead = direction(heading);
    velocity = vector({robot.speed * ahead.x, robot.speed * ahead.y});
  }

  std::vector<b2EdgeShape> edges;
  std::vector<b2CircleShape> circles;
  b2CircleShape body;
  b2Vec2 velocity;
  static constexpr float kDensity = 1.0f;  // of the body; no outcome depends on it
};

// How far the body must go before it can touch a shape; a little less, for skin and rounding.
constexpr double kTouchMargin = 0.015;
float way_to(const b2EdgeShape& edge, const b2CircleShape& body) {
  const auto point = [](b2Vec2 v) { return Point{v.x, v.y}; };
  const double squared = squared_distance({}, point(edge.m_vertex1), point(edge.m_vertex2));
  return static_cast<float>(std::sqrt(squared) - body.m_radius - kTouchMargin);
}
float way_to(const b2CircleShape& circle, const b2CircleShape& body) {
  return static_cast<float>(circle.m_p.Length() - circle.m_radius - body.m_radius - kTouchMargin);
}

float substep_time(const RobotDef& robot, int substeps) {
  return static_cast<float>(robot.sample_time / substeps);
}

}  // namespace

int substeps_of(const RobotDef& robot) {
  const double length = robot.speed * robot.sample_time;
  return std::max(kLeastSubsteps, static_cast<int>(std::ceil(length / kLongestSubstep)));
}

double reach_of(const RobotDef& robot) {
  // Contacts only ever slow the body, so it stays within a step of where it began.
  constexpr double kMargin = 0.05;
  return robot.radius + robot.speed * robot.sample_time + kMargin;
}

Drive drive_in_box2d(const World::Surroundings& near, const RobotDef& robot, Point from,
                     double heading, int substeps, int rounds) {
  const Scene scene(near, robot, from, heading);
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
  for (const b2EdgeShape& edge : scene.edges) add(ground, edge);
  for (const b2CircleShape& circle : scene.circles) add(ground, circle);

  b2BodyDef body_def;
  body_def.type = b2_dynamicBody;
  body_def.fixedRotation = true;
  body_def.linearVelocity = scene.velocity;
  b2Body* body = physics.CreateBody(&body_def);
  smooth.density = Scene::kDensity;
  add(body, scene.body);

  Drive drive;
  for (int i = 0; i < substeps; ++i) {
    physics.Step(substep_time(robot, substeps), rounds, kPositionRounds);
    for (const b2ContactEdge* c = body->GetContactList(); c && !drive.touched; c = c->next) {
      drive.touched = c->contact->IsTouching();
    }
  }
  drive.moved = {body->GetPosition().x, body->GetPosition().y};
  return drive;
}

// b2World::Step, with b2ContactSolver's operations in their order. What they multiply by zero here
// (turning, friction, restitution, the ground's motion) is left out.
std::optional<Drive> drive_along_one(const World::Surroundings& near, const RobotDef& robot,
                                     Point from, double heading, int substeps, int rounds) {
  const Scene scene(near, robot, from, heading);
  const float time = substep_time(robot, substeps);
  b2MassData mass;
  scene.body.ComputeMass(&mass, Scene::kDensity);
  const float inverse_mass = 1.0f / mass.mass, normal_mass = 1.0f / inverse_mass;
  b2Transform ground, at;
  ground.SetIdentity();
  at.SetIdentity();
  b2Vec2 velocity = scene.velocity;
  std::vector<float> ways;
  ways.reserve(scene.edges.size() + scene.circles.size());
  for (const b2EdgeShape& edge : scene.edges) ways.push_back(way_to(edge, scene.body));
  for (const b2CircleShape& circle : scene.circles) ways.push_back(way_to(circle, scene.body));

  Drive drive;
  for (int i = 0; i < substeps; ++i) {
    // What is touched?
    int touching = 0;
    b2Manifold contact;
    float radius = 0.0f;
    const float* way = ways.data();
    const float gone = at.p.Length();
    const auto meet = [&](auto collide, const auto& shape) {
      if (gone < *way++) return;
      b2Manifold manifold;
      collide(&manifold, &shape, ground, &scene.body, at);
      if (manifold.pointCount == 0) return;
      ++touching;
      contact = manifold;
      radius = shape.m_radius;
    };
    for (const b2EdgeShape& edge : scene.edges) meet(b2CollideEdgeAndCircle, edge);
    for (const b2CircleShape& circle : scene.circles) meet(b2CollideCircles, circle);
    if (touching > 1) return std::nullopt;
    if (touching == 0) {
      at.p += time * velocity;
      continue;
    }
    drive.touched = true;

    // Impulses take away what leads into the surface, and never pull.
    b2WorldManifold place;
    place.Initialize(&contact, ground, radius, at, scene.body.m_radius);
    float impulse = 0.0f;
    for (int round = 0; round < rounds; ++round) {
      const float sum = b2Max(impulse - normal_mass * b2Dot(velocity, place.normal), 0.0f);
      const float added = sum - impulse;
      if (added == 0.0f) break;  // nor will a further round
      impulse = sum;
      velocity += inverse_mass * (added * place.normal);
    }
    at.p += time * velocity;

    // What lies deeper than the slop is pushed out, a part a round.
    for (int round = 0; round < kPositionRounds; ++round) {
      const bool round_surface = contact.type == b2Manifold::e_circles;
      b2Vec2 normal = round_surface ? at.p - contact.localPoint : contact.localNormal;
      if (round_surface) normal.Normalize();
      const float separation =
          b2Dot(at.p - contact.localPoint, normal) - radius - scene.body.m_radius;
      const float push =
          b2Clamp(b2_baumgarte * (separation + b2_linearSlop), -b2_maxLinearCorrection, 0.0f);
      at.p += inverse_mass * ((-push / inverse_mass) * normal);
      if (separation >= -3.0f * b2_linearSlop) break;
    }
  }
  drive.moved = {at.p.x, at.p.y};
  return drive;
}

}  // namespace devlearn
