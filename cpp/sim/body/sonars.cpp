#include "body/sonars.hpp"

#include <algorithm>
#include <cmath>

#include "body/box2d_vector.hpp"
#include "devlearn/math.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

class NearestHit : public b2RayCastCallback {
 public:
  float ReportFixture(b2Fixture*, const b2Vec2&, const b2Vec2&, float at) override {
    hit = true;
    return fraction = at;
  }
  bool hit = false;
  float fraction = 1.0f;
};

// Both ends overlap the next edge by some units in the last place of a float, so that no ray slips
// through a corner.
b2EdgeShape overlapping(const Edge& edge) {
  const Point side = edge.b - edge.a;
  const double furthest = std::max(
      {1.0, std::abs(edge.a.x), std::abs(edge.a.y), std::abs(edge.b.x), std::abs(edge.b.y)});
  const double overlap = 1e-6 * furthest / std::sqrt(squared_length(side));
  b2EdgeShape shape;
  shape.SetTwoSided(vector(along(edge.a, side, -overlap)), vector(along(edge.b, side, overlap)));
  return shape;
}

}  // namespace

Sonars::Sonars(const World& world, const RobotDef& robot)
    : standing_(b2Vec2(0.0f, 0.0f)),
      angles_(robot.sonar_angles()),
      radius_(robot.radius),
      range_(robot.sonar_range) {
  b2BodyDef ground_def;
  b2Body* ground = standing_.CreateBody(&ground_def);
  for (const Edge& edge : world.surfaces().edges()) {
    const b2EdgeShape shape = overlapping(edge);
    ground->CreateFixture(&shape, 0.0f);
  }
  for (const Circle& circle : world.surfaces().circles()) {
    b2CircleShape shape;
    shape.m_p = vector(circle.center);
    shape.m_radius = static_cast<float>(circle.radius);
    ground->CreateFixture(&shape, 0.0f);
  }
}

void Sonars::listen(const Pose& pose, double* echoes) const {
  // From the centre: the body holds nothing but slop, and no ray begins inside a shape.
  const double reach = radius_ + range_;
  for (const double angle : angles_) {
    const Direction ray = direction(pose.heading + angle);
    NearestHit nearest;
    standing_.RayCast(&nearest, vector({pose.x, pose.y}),
                      vector({pose.x + reach * ray.x, pose.y + reach * ray.y}));
    const double echo = static_cast<double>(nearest.fraction) * reach - radius_;
    *echoes++ = nearest.hit ? std::clamp(echo, 0.0, range_) : range_;
  }
}

}  // namespace devlearn
