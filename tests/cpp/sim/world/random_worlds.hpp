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

/// A star-shaped polygon, seldom convex.
inline devlearn::Polygon random_polygon(devlearn::Random& random, devlearn::Point center,
                                        double size) {
  devlearn::Polygon polygon;
  const auto count = 3 + random.index(7);
  for (unsigned i = 0; i < count; ++i) {
    const double angle = 2.0 * 3.14159265358979 * (i + between(random, 0.1, 0.9)) / count;
    const double reach = between(random, 0.25, 1.0) * size;
    polygon.corners.push_back(
        {center.x + reach * std::cos(angle), center.y + reach * std::sin(angle)});
  }
  if (random.index(2) == 1) std::reverse(polygon.corners.begin(), polygon.corners.end());
  return polygon;
}

inline devlearn::Obstacle random_obstacle(devlearn::Random& random, double side) {
  const devlearn::Point center = point_in(random, side);
  const double size = between(random, 0.1, 0.4);
  switch (random.index(3)) {
    case 0:
      return devlearn::Circle{center, size};
    case 1:
      return devlearn::Rectangle{center, 2.0 * size, between(random, 0.05, 2.0 * size),
                                 between(random, -180.0, 180.0)};
    default:
      return random_polygon(random, center, 1.5 * size);
  }
}

/// A square world of circles, rectangles and polygons that overlap each other and the walls.
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

/// The same world elsewhere.
inline devlearn::WorldDef shifted(devlearn::WorldDef def, devlearn::Point by) {
  const auto shift = [by](devlearn::Point& p) { p = {p.x + by.x, p.y + by.y}; };
  shift(def.origin);
  shift(def.target);
  def.start.x += by.x;
  def.start.y += by.y;
  for (devlearn::Obstacle& obstacle : def.obstacles) {
    if (auto* circle = std::get_if<devlearn::Circle>(&obstacle)) {
      shift(circle->center);
    } else if (auto* rectangle = std::get_if<devlearn::Rectangle>(&obstacle)) {
      shift(rectangle->center);
    } else {
      for (devlearn::Point& p : std::get<devlearn::Polygon>(obstacle).corners) shift(p);
    }
  }
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
