#include "body/contact.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "body/box2d_vector.hpp"
#include "devlearn/math.hpp"
#include "world/geometry.hpp"

namespace devlearn {
namespace {

// No part of a drive moves further at once, less than the slop [m].
constexpr double kLongestSubstep = 0.0034;
constexpr int kLeastSubsteps = 15;
constexpr int kPositionIterations = 3;

// So near where it began the body keeps the box in which Box2D first put it, grown by
// b2_aabbExtension to all sides [m].
constexpr float kFirstBox = 0.09f;
static_assert(kFirstBox < b2_aabbExtension);

// The part of an edge near a point, so that floats lose nothing to faraway corners.
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
  return part;
}

// What takes part in a drive, its origin where the body begins.
struct Scene {
  Scene(const Surroundings& near, const RobotDef& robot, Point from, double heading) {
    edges.resize(near.edges.size());
    circles.resize(near.circles.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Edge part = near_part(near.edges[i], from, reach_of(robot) + 1.0);
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

// What is touched, and how.
struct Contact {
  std::size_t surface = 0;  // edges by index, then circles
  b2Manifold manifold;
  float radius = 0.0f;  // of the surface
  b2Vec2 normal = b2Vec2_zero;
  float impulse = 0.0f;
};

// The places of a scene's surfaces in the order in which Box2D solves the body's contacts: the
// reverse of that in which its tree of boxes, which depends on all of them, finds what is near.
class SolvingOrder {
 public:
  explicit SolvingOrder(const Scene& scene) : left_(scene.edges.size() + scene.circles.size() + 1) {
    places_.resize(left_);
    std::size_t* place = places_.data();
    const auto add = [&](const b2Shape& shape) {
      b2AABB box;
      shape.ComputeAABB(&box, {b2Vec2_zero, b2Rot(0.0f)}, 0);
      return tree_.CreateProxy(box, place++);
    };
    for (const b2EdgeShape& edge : scene.edges) add(edge);
    for (const b2CircleShape& circle : scene.circles) add(circle);
    tree_.Query(this, tree_.GetFatAABB(add(scene.body)));
  }
  SolvingOrder(const SolvingOrder&) = delete;
  SolvingOrder& operator=(const SolvingOrder&) = delete;

  std::size_t place(const Contact& contact) const { return places_[contact.surface]; }

  // Box2D's.
  bool QueryCallback(int32 proxy) {
    *static_cast<std::size_t*>(tree_.GetUserData(proxy)) = --left_;
    return true;
  }

 private:
  b2DynamicTree tree_;
  std::size_t left_;
  std::vector<std::size_t> places_;
};

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

Drive drive_in_box2d(const Surroundings& near, const RobotDef& robot, Point from, double heading,
                     int substeps, int iterations) {
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
    physics.Step(substep_time(robot, substeps), iterations, kPositionIterations);
    for (const b2ContactEdge* c = body->GetContactList(); c && !drive.touched; c = c->next) {
      drive.touched = c->contact->IsTouching();
    }
  }
  drive.moved = {body->GetPosition().x, body->GetPosition().y};
  return drive;
}

// b2World::Step, with b2ContactSolver's operations in their order. What they multiply by zero here
// (turning, friction, restitution, the ground's motion) is left out.
std::optional<Drive> drive_directly(const Surroundings& near, const RobotDef& robot, Point from,
                                    double heading, int substeps, int iterations) {
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
  std::vector<Contact> contacts;
  std::optional<SolvingOrder> order;
  bool in_first_box = true;
  for (int i = 0; i < substeps; ++i) {
    contacts.clear();
    std::size_t surface = 0;
    const float gone = at.p.Length();
    const auto meet = [&](auto collide, const auto& shape) {
      const std::size_t here = surface++;
      if (gone < ways[here]) return;
      Contact contact;
      collide(&contact.manifold, &shape, ground, &scene.body, at);
      if (contact.manifold.pointCount == 0) return;
      contact.surface = here;
      contact.radius = shape.m_radius;
      contacts.push_back(contact);
    };
    for (const b2EdgeShape& edge : scene.edges) meet(b2CollideEdgeAndCircle, edge);
    for (const b2CircleShape& circle : scene.circles) meet(b2CollideCircles, circle);
    in_first_box = in_first_box && gone < kFirstBox;
    if (contacts.size() > 1) {
      if (!in_first_box) return std::nullopt;
      if (!order) order.emplace(scene);
      std::sort(contacts.begin(), contacts.end(), [&](const Contact& a, const Contact& b) {
        return order->place(a) < order->place(b);
      });
    }
    drive.touched = drive.touched || !contacts.empty();

    for (Contact& contact : contacts) {
      b2WorldManifold place;
      place.Initialize(&contact.manifold, ground, contact.radius, at, scene.body.m_radius);
      contact.normal = place.normal;
    }
    // Impulses take away what leads into the surfaces, and never pull.
    bool changing = true;
    for (int i_v = 0; i_v < iterations && changing; ++i_v) {
      changing = false;
      for (Contact& contact : contacts) {
        const float inward = b2Dot(velocity, contact.normal);
        const float sum = b2Max(contact.impulse - normal_mass * inward, 0.0f);
        const float added = sum - contact.impulse;
        contact.impulse = sum;
        velocity += inverse_mass * (added * contact.normal);
        changing = changing || added != 0.0f;
      }
    }
    at.p += time * velocity;

    // What lies deeper than the slop is pushed out, a part an iteration.
    float deepest = -b2_maxFloat;
    for (int i_p = 0; i_p < kPositionIterations && deepest < -3.0f * b2_linearSlop; ++i_p) {
      deepest = 0.0f;
      for (const Contact& contact : contacts) {
        const bool round_surface = contact.manifold.type == b2Manifold::e_circles;
        b2Vec2 normal =
            round_surface ? at.p - contact.manifold.localPoint : contact.manifold.localNormal;
        if (round_surface) normal.Normalize();
        const float separation = b2Dot(at.p - contact.manifold.localPoint, normal) -
                                 contact.radius - scene.body.m_radius;
        deepest = b2Min(deepest, separation);
        const float push =
            b2Clamp(b2_baumgarte * (separation + b2_linearSlop), -b2_maxLinearCorrection, 0.0f);
        at.p += inverse_mass * ((-push / inverse_mass) * normal);
      }
    }
  }
  drive.moved = {at.p.x, at.p.y};
  return drive;
}

}  // namespace devlearn
