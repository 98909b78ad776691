#include "world/movers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "devlearn/random.hpp"
#include "world/geometry.hpp"

namespace devlearn {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double counted(double time) noexcept { return time > 0.0 ? std::min(time, Movers::kLatest) : 0.0; }

Point between(Point a, Point b, double part) noexcept { return along(a, b - a, part); }

// p as a rectangle sees it, along its own sides from its centre.
Point in_frame_of(const Rectangle& rectangle, Point p) noexcept {
  const Direction side = direction(rectangle.angle);
  return {p.x * side.x + p.y * side.y, p.y * side.x - p.x * side.y};
}

double distance_to(const Circle& circle, Point p) noexcept {
  return std::sqrt(squared_length(p)) - circle.radius;
}
double distance_to(const Rectangle& rectangle, Point p) noexcept {
  const Point seen = in_frame_of(rectangle, p);
  const double x = std::abs(seen.x) - 0.5 * rectangle.width;
  const double y = std::abs(seen.y) - 0.5 * rectangle.height;
  const Point beyond{std::max(x, 0.0), std::max(y, 0.0)};
  return std::sqrt(squared_length(beyond)) + std::min(std::max(x, y), 0.0);
}

double distance_swept(const Circle& circle, Point p, Point q) noexcept {
  return swept_distance(Circle{{}, circle.radius}, p, q);
}
double distance_swept(const Rectangle& rectangle, Point p, Point q) noexcept {
  if (distance_to(rectangle, p) <= 0.0) return 0.0;
  const Point from = in_frame_of(rectangle, p), to = in_frame_of(rectangle, q);
  const double w = 0.5 * rectangle.width, h = 0.5 * rectangle.height;
  const Point corners[] = {{-w, -h}, {w, -h}, {w, h}, {-w, h}};
  double least = kInfinite;
  for (std::size_t i = 0; i < 4; ++i) {
    const Edge side{{}, corners[i], corners[(i + 1) % 4], {}};
    least = std::min(least, swept_distance(side, from, to));
  }
  return least;
}

double reach_of(const Circle& circle) noexcept { return circle.radius; }
double reach_of(const Rectangle& rectangle) noexcept {
  return 0.5 * std::sqrt(rectangle.width * rectangle.width + rectangle.height * rectangle.height);
}

// How far around a path goes before it begins anew [m].
std::vector<double> distances_along(const MoverPath& path) {
  std::vector<double> gone{0.0};
  const std::size_t n = path.points.size();
  const std::size_t legs = path.then == MoverPath::Then::kAround ? n : n - 1;
  for (std::size_t i = 0; i < legs; ++i) {
    gone.push_back(gone.back() + distance(path.points[i], path.points[(i + 1) % n]));
  }
  return gone;
}

// As std::visit, but of what is never without a value, so that nothing is thrown.
template <typename First, typename Second, typename Visit>
auto either(const std::variant<First, Second>& one, const Visit& visit) noexcept {
  const First* const first = std::get_if<First>(&one);
  return first != nullptr ? visit(*first) : visit(*std::get_if<Second>(&one));
}

}  // namespace

Movers::Movers(const std::vector<Mover>& movers) {
  for (const Mover& mover : movers) {
    Moving moving;
    moving.shape = mover.shape;
    moving.reach = std::visit([](const auto& shape) { return reach_of(shape); }, mover.shape);
    if (const auto* const path = std::get_if<MoverPath>(&mover.course)) {
      moving.course = Way{*path, distances_along(*path)};
    } else {
      const auto& walk = std::get<MoverWalk>(mover.course);
      moving.course = Wandering{walk, Random(walk.seed, "mover").next()};
    }
    movers_.push_back(std::move(moving));
  }
}

Point Movers::Way::place(double time) const noexcept {
  const double length = gone.back();
  double far = path.speed * time;
  switch (path.then) {
    case MoverPath::Then::kStop:
      far = std::min(far, length);
      break;
    case MoverPath::Then::kAround:
      far = std::fmod(far, length);
      break;
    case MoverPath::Then::kBack:
      far = std::fmod(far, 2.0 * length);
      far = std::min(far, 2.0 * length - far);
  }
  const auto next = std::upper_bound(gone.begin() + 1, gone.end() - 1, far);
  const auto leg = static_cast<std::size_t>(next - gone.begin()) - 1;
  const double part = std::min(1.0, (far - gone[leg]) / (gone[leg + 1] - gone[leg]));
  return between(path.points[leg], path.points[(leg + 1) % path.points.size()], part);
}

Point Movers::Wandering::waypoint(std::uint64_t number) const noexcept {
  Random random(draws + number, "waypoint");
  const double x = random.uniform(), y = random.uniform();
  return {walk.low.x + x * (walk.high.x - walk.low.x), walk.low.y + y * (walk.high.y - walk.low.y)};
}

Point Movers::Wandering::place(double time) const noexcept {
  const double into = std::fmod(time, walk.leg_time);
  const auto leg = static_cast<std::uint64_t>(std::llround((time - into) / walk.leg_time));
  return between(waypoint(leg), waypoint(leg + 1), into / walk.leg_time);
}

double Movers::Moving::distance(Point p) const noexcept {
  return either(shape, [p](const auto& of) { return distance_to(of, p); });
}

double Movers::Moving::swept_distance(Point p, Point q) const noexcept {
  return either(shape, [p, q](const auto& of) { return distance_swept(of, p, q); });
}

double Movers::Moving::distance_ever(const Way& way, Point p) const noexcept {
  const std::vector<Point>& points = way.path.points;
  double least = kInfinite;
  for (std::size_t leg = 0; leg + 1 < way.gone.size(); ++leg) {
    least = std::min(least, swept_distance(p - points[leg], p - points[(leg + 1) % points.size()]));
  }
  return least;
}

// What lies nearest of a box to a shape whose centre it does not hold lies on its rim.
double Movers::Moving::distance_ever(const Wandering& walk, Point p) const noexcept {
  const Point low = p - walk.walk.high, high = p - walk.walk.low;
  if (low.x <= 0.0 && 0.0 <= high.x && low.y <= 0.0 && 0.0 <= high.y) return 0.0;
  const Point corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
  double least = kInfinite;
  for (std::size_t i = 0; i < 4; ++i) {
    least = std::min(least, swept_distance(corners[i], corners[(i + 1) % 4]));
  }
  return least;
}

Point Movers::place(std::size_t mover, double time) const noexcept {
  return either(movers_[mover].course,
                [now = counted(time)](const auto& course) { return course.place(now); });
}

double Movers::distance(std::size_t mover, Point p, double time) const noexcept {
  return movers_[mover].distance(p - place(mover, time));
}

double Movers::distance(Point p, double time) const noexcept {
  double least = kInfinite;
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    least = std::min(least, distance(i, p, time));
  }
  return least;
}

double Movers::distance_ever(std::size_t mover, Point p) const noexcept {
  const Moving& moving = movers_[mover];
  return either(moving.course, [&](const auto& course) { return moving.distance_ever(course, p); });
}

// Seen from a mover that goes straight and evenly, so does what goes from p to q.
bool Movers::keep_clear_of(Point p, Point q, double room, const TimeSpan& step) const noexcept {
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    const Point from = p - place(i, step.begin), to = q - place(i, step.end());
    const double far = room + movers_[i].reach;
    if (squared_distance({}, from, to) > far * far) continue;
    if (!(movers_[i].swept_distance(from, to) > room)) return false;
  }
  return true;
}

std::vector<std::size_t> Movers::around(Point p, double reach, const TimeSpan& step) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    const Point from = p - place(i, step.begin), to = p - place(i, step.end());
    if (movers_[i].swept_distance(from, to) <= reach) found.push_back(i);
  }
  return found;
}

}  // namespace devlearn
