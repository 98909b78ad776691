// The floor for body and sonars: the closed-form move and five rays of 3 m among the eight shapes
// of the world `paper`. No trigonometry: a heading is a unit vector, turned by constants. A shape
// whose bounding circle a ray passes by is left out.

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "bench.hpp"

namespace devlearn::bench {
namespace {

constexpr double kRange = 3.0, kRadius = 0.1, kStep = 0.05;
constexpr double kHalf = 0.5, kRoot = 0.86602540378443864676;  // cos and sin of 60 degrees

struct Vector {
  double x, y;
};
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
Vector turned(Vector heading, Vector by) {
  return {heading.x * by.x - heading.y * by.y, heading.x * by.y + heading.y * by.x};
}

constexpr std::array<Vector, 5> kTurns{
    {{kHalf, -kRoot}, {kRoot, -kHalf}, {1.0, 0.0}, {kRoot, kHalf}, {kHalf, kRoot}}};
constexpr double kDiagonal = 0.70710678118654752440;
constexpr std::array<Vector, 5> kSonars{
    {{0.0, -1.0}, {kDiagonal, -kDiagonal}, {1.0, 0.0}, {kDiagonal, kDiagonal}, {0.0, 1.0}}};

struct Edge {
  Vector from, along;
  double inverse_squared_length;
};

// A circle has no edges; its bound is itself.
struct Shape {
  Vector centre;
  double bound;
  std::vector<Edge> edges;
};

Shape shape_of(const Circle& circle) {
  return {{circle.center.x, circle.center.y}, circle.radius, {}};
}

Shape outlined(const std::vector<Vector>& corners) {
  Shape shape{{0.0, 0.0}, 0.0, {}};
  for (const Vector& corner : corners) {
    shape.centre.x += corner.x / static_cast<double>(corners.size());
    shape.centre.y += corner.y / static_cast<double>(corners.size());
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector along = corners[(i + 1) % corners.size()] - corners[i];
    const Vector out = corners[i] - shape.centre;
    shape.bound = std::max(shape.bound, std::sqrt(dot(out, out)));
    shape.edges.push_back({corners[i], along, 1.0 / dot(along, along)});
  }
  return shape;
}

Shape shape_of(const Rectangle& r) {  // upright, as all of this world are
  const double w = 0.5 * r.width, h = 0.5 * r.height, x = r.center.x, y = r.center.y;
  return outlined({{x - w, y - h}, {x + w, y - h}, {x + w, y + h}, {x - w, y + h}});
}

Shape shape_of(const Polygon& polygon) {  // without holes, as all of this world are
  std::vector<Vector> corners;
  for (const Point& p : polygon.corners) corners.push_back({p.x, p.y});
  return outlined(corners);
}

Shape shape_of(const Polyline& polyline) {  // there and back
  std::vector<Vector> corners;
  for (const Point& p : polyline.points) corners.push_back({p.x, p.y});
  for (std::size_t i = corners.size() - 2; i > 0; --i) corners.push_back(corners[i]);
  return outlined(corners);
}

double squared_distance(Vector p, Vector from, Vector along, double inverse_squared_length) {
  const Vector to = p - from;
  const double t = std::clamp(dot(to, along) * inverse_squared_length, 0.0, 1.0);
  const Vector off{to.x - t * along.x, to.y - t * along.y};
  return dot(off, off);
}

class Floor {
 public:
  explicit Floor(const WorldDef& def) : width_(def.width), height_(def.height) {
    for (const Obstacle& obstacle : def.obstacles) {
      shapes_.push_back(std::visit([](const auto& o) { return shape_of(o); }, obstacle));
    }
  }

  // Eq. 1 where the way is free; the body stays where it is not.
  Vector move(Vector at, Vector heading) const {
    const Vector along{kStep * heading.x, kStep * heading.y};
    const Vector end{at.x + along.x, at.y + along.y};
    return free(at, along, end) ? end : at;
  }

  // The nearest hits of the five rays.
  std::array<double, 5> rays(Vector at, Vector heading) const {
    std::array<Vector, 5> ray;
    std::array<double, 5> nearest;
    for (std::size_t i = 0; i < 5; ++i) {
      ray[i] = turned(heading, kSonars[i]);
      const double x = ray[i].x > 0.0 ? (width_ - at.x) / ray[i].x : -at.x / ray[i].x;
      const double y = ray[i].y > 0.0 ? (height_ - at.y) / ray[i].y : -at.y / ray[i].y;
      nearest[i] = std::min({kRange, x, y});
    }
    for (const Shape& shape : shapes_) {
      const Vector to = shape.centre - at;
      const double squared = dot(to, to), bound = shape.bound * shape.bound;
      for (std::size_t i = 0; i < 5; ++i) {
        const double ahead = dot(to, ray[i]);
        const double room = bound - (squared - ahead * ahead);
        if (room < 0.0 || ahead < -shape.bound || ahead - shape.bound > nearest[i]) continue;
        if (shape.edges.empty()) {
          const double hit = ahead - std::sqrt(room);
          if (hit >= 0.0) nearest[i] = std::min(nearest[i], hit);
        } else {
          nearest[i] = std::min(nearest[i], outline_hit(shape, at, ray[i]));
        }
      }
    }
    return nearest;
  }

 private:
  bool free(Vector at, Vector along, Vector end) const {
    if (std::min({end.x, end.y, width_ - end.x, height_ - end.y}) < kRadius) return false;
    for (const Shape& shape : shapes_) {
      const double reach = shape.bound + kRadius;
      if (squared_distance(shape.centre, at, along, 1.0 / (kStep * kStep)) > reach * reach)
        continue;
      if (shape.edges.empty()) return false;
      for (const Edge& edge : shape.edges) {
        if (squared_distance(end, edge.from, edge.along, edge.inverse_squared_length) <
                kRadius * kRadius ||
            squared_distance(edge.from, at, along, 1.0 / (kStep * kStep)) < kRadius * kRadius) {
          return false;
        }
      }
    }
    return true;
  }

  // Only sides that face the ray: at them cross(ray, side) > 0.
  static double outline_hit(const Shape& shape, Vector at, Vector ray) {
    for (const Edge& edge : shape.edges) {
      const double facing = cross(ray, edge.along);
      if (facing <= 0.0) continue;
      const Vector to = edge.from - at;
      const double u = cross(to, ray), t = cross(to, edge.along);
      if (u >= 0.0 && u <= facing && t >= 0.0) return t / facing;
    }
    return kRange;
  }

  double width_, height_;
  std::vector<Shape> shapes_;
};

struct Place {
  Vector at, heading;
  std::size_t motion;
};

std::vector<Place> places() {
  std::vector<Place> found;
  for (const PastStep& step : steps_where(false)) {
    const double radians = step.pose.heading * (3.14159265358979323846 / 180.0);
    found.push_back({{step.pose.x, step.pose.y},
                     {std::cos(radians), std::sin(radians)},
                     static_cast<std::size_t>(step.motion)});
  }
  return found;
}

template <typename F>
void over_places(benchmark::State& state, F f) {
  const Floor floor(paper().def());
  const std::vector<Place> all = places();
  for (auto _ : state) {
    for (const Place& place : all) f(floor, place);
  }
  per_step(state, static_cast<double>(all.size()));
}

const auto* const move_and_rays = add("floor/move_and_5_rays", [](benchmark::State& state) {
  over_places(state, [](const Floor& floor, const Place& place) {
    const Vector heading = turned(place.heading, kTurns[place.motion]);
    benchmark::DoNotOptimize(floor.rays(floor.move(place.at, heading), heading));
  });
});

const auto* const move_alone = add("floor/move", [](benchmark::State& state) {
  over_places(state, [](const Floor& floor, const Place& place) {
    benchmark::DoNotOptimize(floor.move(place.at, turned(place.heading, kTurns[place.motion])));
  });
});

const auto* const rays_alone = add("floor/5_rays", [](benchmark::State& state) {
  over_places(state, [](const Floor& floor, const Place& place) {
    benchmark::DoNotOptimize(floor.rays(place.at, place.heading));
  });
});

}  // namespace
}  // namespace devlearn::bench
