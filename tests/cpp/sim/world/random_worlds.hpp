#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/world.hpp"

// Worlds to state laws on.

inline double between(devlearn::Random& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

inline devlearn::Point point_in(devlearn::Random& random, double side) {
  return {between(random, 0.0, side), between(random, 0.0, side)};
}

/// Corners all around a centre, so far from it, in either direction of turning.
inline std::vector<devlearn::Point> random_ring(devlearn::Random& random, devlearn::Point center,
                                                unsigned count, double least, double most) {
  std::vector<devlearn::Point> corners;
  for (unsigned i = 0; i < count; ++i) {
    const double angle = 2.0 * 3.14159265358979 * (i + between(random, 0.1, 0.9)) / count;
    const double reach = between(random, least, most);
    corners.push_back({center.x + reach * std::cos(angle), center.y + reach * std::sin(angle)});
  }
  if (random.index(2) == 1) std::reverse(corners.begin(), corners.end());
  return corners;
}

/// A star-shaped polygon, seldom convex.
inline devlearn::Polygon random_polygon(devlearn::Random& random, devlearn::Point center,
                                        double size) {
  return {random_ring(random, center, 3 + random.index(7), 0.25 * size, size)};
}

/// One that leads around a hole.
inline devlearn::Polygon random_frame(devlearn::Random& random, devlearn::Point center,
                                      double size) {
  const auto count = 8 + random.index(5);
  devlearn::Polygon frame{random_ring(random, center, count, 0.7 * size, size)};
  frame.holes.push_back(random_ring(random, center, 5 + random.index(5), 0.2 * size, 0.5 * size));
  return frame;
}

/// A thin wall, which may cross itself, open or closed.
inline devlearn::Polyline random_polyline(devlearn::Random& random, devlearn::Point from) {
  devlearn::Polyline wall{{from}};
  for (auto count = 1 + random.index(5); count > 0; --count) {
    const double angle = between(random, 0.0, 6.28), length = between(random, 0.1, 0.6);
    from = {from.x + length * std::cos(angle), from.y + length * std::sin(angle)};
    wall.points.push_back(from);
  }
  if (random.index(2) == 1) wall.points.push_back(wall.points.front());
  return wall;
}

inline devlearn::Obstacle random_obstacle(devlearn::Random& random, double side) {
  const devlearn::Point center = point_in(random, side);
  const double size = between(random, 0.1, 0.4);
  switch (random.index(5)) {
    case 0:
      return devlearn::Circle{center, size};
    case 1:
      return devlearn::Rectangle{center, 2.0 * size, between(random, 0.05, 2.0 * size),
                                 between(random, -180.0, 180.0)};
    case 2:
      return random_polygon(random, center, 1.5 * size);
    case 3:
      return random_frame(random, center, 3.0 * size);
    default:
      return random_polyline(random, center);
  }
}

/// A square world of obstacles of all shapes that overlap each other and the walls.
inline devlearn::World random_world(devlearn::Random& random, int obstacles, double side) {
  while (true) {
    devlearn::WorldDef def;
    def.width = def.height = side;
    for (int i = 0; i < obstacles; ++i) def.obstacles.push_back(random_obstacle(random, side));
    const devlearn::Point start = point_in(random, side);
    def.start = {start.x, start.y, 30.0 * random.index(12)};
    def.target = point_in(random, side);
    try {
      return devlearn::World(def);
    } catch (const devlearn::InvalidValue&) {  // a start or target in an obstacle, close corners
    }
  }
}

/// Calls f of every point that says where an obstacle lies.
template <typename F>
void each_point(devlearn::Obstacle& obstacle, const F& f) {
  if (auto* circle = std::get_if<devlearn::Circle>(&obstacle)) {
    f(circle->center);
  } else if (auto* rectangle = std::get_if<devlearn::Rectangle>(&obstacle)) {
    f(rectangle->center);
  } else if (auto* polygon = std::get_if<devlearn::Polygon>(&obstacle)) {
    for (devlearn::Point& p : polygon->corners) f(p);
    for (auto& hole : polygon->holes) {
      for (devlearn::Point& p : hole) f(p);
    }
  } else {
    for (devlearn::Point& p : std::get<devlearn::Polyline>(obstacle).points) f(p);
  }
}

/// The same world elsewhere.
inline devlearn::WorldDef shifted(devlearn::WorldDef def, devlearn::Point by) {
  const auto shift = [by](devlearn::Point& p) { p = {p.x + by.x, p.y + by.y}; };
  shift(def.origin);
  shift(def.target);
  def.start.x += by.x;
  def.start.y += by.y;
  for (devlearn::Obstacle& obstacle : def.obstacles) each_point(obstacle, shift);
  return def;
}

/// A pose with at least so much room around its centre, if one is soon found.
inline std::optional<devlearn::Pose> free_pose(devlearn::Random& random,
                                               const devlearn::World& world, double room) {
  for (int i = 0; i < 1000; ++i) {
    const devlearn::Point p{world.def().origin.x + world.def().width * random.uniform(),
                            world.def().origin.y + world.def().height * random.uniform()};
    if (world.clearance(p, true) >= room) return devlearn::Pose{p.x, p.y, 30.0 * random.index(12)};
  }
  return std::nullopt;
}

/// A square world of heaps of round and square pebbles: whatever touches one touches several, and
/// many are near.
inline devlearn::World pebbles(devlearn::Random& random, int heaps, double side) {
  devlearn::WorldDef def;
  def.width = def.height = side;
  def.start = {0.01, 0.01, 0.0};
  for (int heap = 0; heap < heaps; ++heap) {
    const devlearn::Point center{between(random, 0.8, side), between(random, 0.8, side)};
    for (int i = 0; i < 200; ++i) {
      const devlearn::Point out{between(random, -0.25, 0.25), between(random, -0.25, 0.25)};
      const devlearn::Point place{center.x + out.x, center.y + out.y};
      if (heap % 2 == 0) {
        def.obstacles.push_back(devlearn::Circle{place, 0.02});
      } else {
        def.obstacles.push_back(devlearn::Rectangle{place, 0.04, 0.03, between(random, 0.0, 90.0)});
      }
    }
  }
  def.target = {0.02, 0.02};
  return devlearn::World(def);
}
