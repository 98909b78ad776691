#include "body/sonars.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
b2EdgeShape overlapping(Point a, Point b) {
  const Point side = b - a;
  const double furthest =
      std::max({1.0, std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
  const double overlap = 1e-6 * furthest / std::sqrt(squared_length(side));
  b2EdgeShape shape;
  shape.SetTwoSided(vector(along(a, side, -overlap)), vector(along(b, side, overlap)));
  return shape;
}

}  // namespace

Sonars::Sonars(std::shared_ptr<const World> world, const RobotDef& robot)
    : world_(std::move(world)),
      angles_(robot.sonar_angles()),
      radius_(robot.radius),
      range_(robot.sonar_range) {}

void Sonars::build() const {
  auto standing = std::make_unique<b2World>(b2Vec2(0.0f, 0.0f));
  const Point origin = world_->def().origin;
  b2BodyDef ground_def;
  b2Body* ground = standing->CreateBody(&ground_def);
  for (const Edge& edge : world_->surfaces().edges()) {
    const b2EdgeShape shape = overlapping(edge.a - origin, edge.b - origin);
    ground->CreateFixture(&shape, 0.0f);
  }
  for (const Circle& circle : world_->surfaces().circles()) {
    b2CircleShape shape;
    shape.m_p = vector(circle.center - origin);
    shape.m_radius = static_cast<float>(circle.radius);
    ground->CreateFixture(&shape, 0.0f);
  }
  standing_ = std::move(standing);
}

void Sonars::listen(const Pose& pose, double* echoes) const {
  std::call_once(built_, [this] { build(); });
  // From the centre: the body holds nothing but slop, and no ray begins inside a shape.
  const double reach = radius_ + range_;
  const Point at = Point{pose.x, pose.y} - world_->def().origin;
  for (const double angle : angles_) {
    const Direction ray = direction(pose.heading + angle);
    NearestHit nearest;
    standing_->RayCast(&nearest, vector(at), vector(along(at, {ray.x, ray.y}, reach)));
    const double echo = static_cast<double>(nearest.fraction) * reach - radius_;
    *echoes++ = nearest.hit ? std::clamp(echo, 0.0, range_) : range_;
  }
}

}  // namespace devlearn
