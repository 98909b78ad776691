#pragma once

#include <box2d/box2d.h>

#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "devlearn/world.hpp"

namespace devlearn::bench {

constexpr double kRadians = 3.14159265358979323846 / 180.0;  // of one degree

inline b2Vec2 vector(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

/// A world as a user of Box2D would write it: circles, convex polygons of at most eight corners,
/// walls of edges. It persists; a body drives in it.
class Box2dWorld {
 public:
  explicit Box2dWorld(const WorldDef& def, double radius = 0.1) : world_(b2Vec2(0.0f, 0.0f)) {
    world_.SetContinuousPhysics(false);  // what moves 1.7 mm at a time tunnels through nothing
    b2BodyDef ground_def;
    b2Body* ground = world_.CreateBody(&ground_def);
    smooth_.friction = 0.0f;
    for (const Obstacle& obstacle : def.obstacles) {
      std::visit([&](const auto& shape) { add(ground, shape); }, obstacle);
    }
    const std::array<b2Vec2, 4> corners{vector(0.0, 0.0), vector(def.width, 0.0),
                                        vector(def.width, def.height), vector(0.0, def.height)};
    for (std::size_t i = 0; i < 4; ++i) {
      b2EdgeShape wall;
      wall.SetTwoSided(corners[i], corners[(i + 1) % 4]);
      attach(ground, wall);
    }
    if (radius <= 0.0) return;
    b2BodyDef body_def;
    body_def.type = b2_dynamicBody;
    body_def.fixedRotation = true;
    body_def.allowSleep = false;
    body_ = world_.CreateBody(&body_def);
    b2CircleShape disc;
    disc.m_radius = static_cast<float>(radius);
    smooth_.density = 1.0f;
    attach(body_, disc);
  }

  /// Drives for half a second at 0.1 m/s, by `substeps` steps of Box2D.
  Pose drive(const Pose& from, double heading, int substeps) {
    const double radians = heading * kRadians;
    body_->SetTransform(vector(from.x, from.y), static_cast<float>(radians));
    body_->SetLinearVelocity(vector(0.1 * std::cos(radians), 0.1 * std::sin(radians)));
    const float time = 0.5f / static_cast<float>(substeps);
    for (int i = 0; i < substeps; ++i) world_.Step(time, 8, 3);
    return {body_->GetPosition().x, body_->GetPosition().y, heading};
  }

  /// Where a ray first hits, as a fraction of it.
  float ray(b2Vec2 from, b2Vec2 to) const {
    struct Nearest : b2RayCastCallback {
      float ReportFixture(b2Fixture*, const b2Vec2&, const b2Vec2&, float at) override {
        return fraction = at;
      }
      float fraction = 1.0f;
    } nearest;
    world_.RayCast(&nearest, from, to);
    return nearest.fraction;
  }

 private:
  void attach(b2Body* body, const b2Shape& shape) {
    smooth_.shape = &shape;
    body->CreateFixture(&smooth_);
  }
  void add(b2Body* ground, const Circle& circle) {
    b2CircleShape shape;
    shape.m_p = vector(circle.center.x, circle.center.y);
    shape.m_radius = static_cast<float>(circle.radius);
    attach(ground, shape);
  }
  void add(b2Body* ground, const Rectangle& r) {
    b2PolygonShape shape;
    shape.SetAsBox(static_cast<float>(0.5 * r.width), static_cast<float>(0.5 * r.height),
                   vector(r.center.x, r.center.y), static_cast<float>(r.angle * kRadians));
    attach(ground, shape);
  }
  void add(b2Body* ground, const Polygon& polygon) {
    std::vector<b2Vec2> corners;
    for (const Point& p : polygon.corners) corners.push_back(vector(p.x, p.y));
    b2PolygonShape shape;
    shape.Set(corners.data(), static_cast<int>(corners.size()));
    attach(ground, shape);
  }
  void add(b2Body* ground, const Polyline& polyline) {
    for (std::size_t i = 1; i < polyline.points.size(); ++i) {
      const Point a = polyline.points[i - 1], b = polyline.points[i];
      b2EdgeShape shape;
      shape.SetTwoSided(vector(a.x, a.y), vector(b.x, b.y));
      attach(ground, shape);
    }
  }

  b2World world_;
  b2FixtureDef smooth_;
  b2Body* body_ = nullptr;
};

}  // namespace devlearn::bench
