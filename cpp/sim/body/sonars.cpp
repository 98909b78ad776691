#include "body/sonars.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "body/box2d_vector.hpp"
#include "devlearn/math.hpp"
#include "world/movers.hpp"
#include "world/surfaces.hpp"

namespace devlearn {
namespace {

class NearestHit : public b2RayCastCallback {
 public:
  float ReportFixture(b2Fixture*, const b2Vec2&, const b2Vec2& outwards, float at) override {
    return meet(outwards, at);
  }
  float meet(const b2Vec2& outwards, float at) {
    hit = true;
    normal = outwards;
    return fraction = at;
  }
  bool hit = false;
  float fraction = 1.0f;
  b2Vec2 normal{0.0f, 0.0f};
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

// Sound goes there and back [m/s].
constexpr double kSpeedOfSound = 343.0;

std::vector<double> rays_of(const RobotDef& robot) {
  if (robot.sonar_beam == 0.0) return {0.0};
  std::vector<double> rays(static_cast<std::size_t>(robot.sonar_rays));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i] =
        robot.sonar_beam * (static_cast<double>(i) / static_cast<double>(rays.size() - 1) - 0.5);
  }
  return rays;
}

}  // namespace

Sonars::Sonars(std::shared_ptr<const World> world, const RobotDef& robot)
    : world_(std::move(world)),
      angles_(robot.sonar_angles()),
      cone_(rays_of(robot)),
      radius_(robot.radius),
      range_(robot.sonar_range),
      least_range_(robot.sonar_least_range),
      blind_range_(0.5 * kSpeedOfSound * robot.sonar_blind_time),
      least_cosine_(robot.sonar_specular < 90.0 ? direction(robot.sonar_specular).x : -1.0) {}

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
  for (std::size_t i = 0; i < world_->movers().size(); ++i) {
    moving_.push_back(moving_shape(world_->movers().shape(i)));
  }
  standing_ = std::move(standing);
}

void Sonars::listen(const Pose& pose, const double* aside, double* echoes, double time) const {
  std::call_once(built_, [this] { build(); });
  const Point at = Point{pose.x, pose.y} - world_->def().origin;
  const std::vector<Near> movers = movers_near(pose, time);
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    const double error = aside == nullptr ? 0.0 : aside[i];
    echoes[i] = nearest_echo(at, pose.heading + angles_[i] + error, movers);
  }
}

std::vector<Sonars::Near> Sonars::movers_near(const Pose& pose, double time) const {
  std::vector<Near> near;
  if (!world_->moves()) return near;
  const Movers& movers = world_->movers();
  const Point centre{pose.x, pose.y};
  for (const std::size_t i : movers.around(centre, radius_ + range_, {time, 0.0})) {
    const Point place = movers.place(i, time) - world_->def().origin;
    near.push_back({&as_shape(moving_[i]), b2Transform(vector(place), b2Rot(0.0f)),
                    movers.distance(i, centre, time) <= 0.0});
  }
  return near;
}

double Sonars::nearest_echo(Point at, double heading, const std::vector<Near>& movers) const {
  double nearest = range_;
  for (const double ray : cone_) nearest = std::min(nearest, echo(at, heading + ray, movers));
  return nearest;
}

// Of one ray; the range where none is heard.
double Sonars::echo(Point at, double heading, const std::vector<Near>& movers) const {
  // From the centre: the body holds nothing that stands still but slop, and no ray begins inside.
  const double reach = radius_ + range_;
  const Direction ray = direction(heading);
  const b2Vec2 from = vector(at), to = vector(along(at, {ray.x, ray.y}, reach));
  NearestHit hit;
  standing_->RayCast(&hit, from, to);
  for (const Near& mover : movers) {
    if (mover.holds_robot) {
      hit.meet(-vector({ray.x, ray.y}), 0.0f);
      continue;
    }
    b2RayCastOutput met;
    if (mover.shape->RayCast(&met, {from, to, hit.fraction}, mover.place, 0)) {
      hit.meet(met.normal, met.fraction);
    }
  }
  if (!hit.hit) return range_;
  const double echo = std::clamp(static_cast<double>(hit.fraction) * reach - radius_, 0.0, range_);
  const double cosine =
      -(ray.x * static_cast<double>(hit.normal.x) + ray.y * static_cast<double>(hit.normal.y));
  if (echo < blind_range_ || cosine < least_cosine_) return range_;
  return std::max(echo, least_range_);
}

}  // namespace devlearn
