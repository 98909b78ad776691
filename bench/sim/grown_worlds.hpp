#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "bench.hpp"

// The world `paper` with a thousand times as many obstacles.
namespace devlearn::bench {

inline Point moved(Point p, double x, double y) { return {p.x + x, p.y + y}; }
inline Obstacle moved(Circle circle, double x, double y) {
  circle.center = moved(circle.center, x, y);
  return circle;
}
inline Obstacle moved(Rectangle rectangle, double x, double y) {
  rectangle.center = moved(rectangle.center, x, y);
  return rectangle;
}
inline std::vector<Point> moved(std::vector<Point> points, double x, double y) {
  for (Point& point : points) point = moved(point, x, y);
  return points;
}
inline Obstacle moved(Polygon polygon, double x, double y) {
  polygon.corners = moved(std::move(polygon.corners), x, y);
  for (auto& hole : polygon.holes) hole = moved(std::move(hole), x, y);
  return polygon;
}
inline Obstacle moved(Polyline polyline, double x, double y) {
  polyline.points = moved(std::move(polyline.points), x, y);
  return polyline;
}

// The world `paper` side by side, 32 times along x and along y, without walls between; start and
// target in the middle.
inline World grown() {
  constexpr int kTiles = 32;
  const WorldDef tile = paper().def();
  const double x = tile.width * (kTiles / 2), y = tile.height * (kTiles / 2);
  WorldDef def = tile;
  def.width *= kTiles;
  def.height *= kTiles;
  def.start.x += x;
  def.start.y += y;
  def.target = moved(def.target, x, y);
  def.obstacles.clear();
  for (int i = 0; i < kTiles; ++i) {
    for (int j = 0; j < kTiles; ++j) {
      for (const Obstacle& obstacle : tile.obstacles) {
        def.obstacles.push_back(std::visit(
            [&](const auto& shape) { return moved(shape, i * tile.width, j * tile.height); },
            obstacle));
      }
    }
  }
  return World(std::move(def));
}

// The world `paper`, each obstacle made of a thousand circles that lie in it.
inline World shattered() {
  constexpr double kPiece = 0.015;
  constexpr int kPieces = 1000;
  WorldDef def = paper().def();
  const std::vector<Obstacle> whole = std::move(def.obstacles);
  def.obstacles.clear();
  Random random(1, "pieces");
  for (const Obstacle& obstacle : whole) {
    WorldDef alone;
    alone.start = {0.01, 0.01, 0.0};
    alone.target = {4.99, 4.99};
    alone.obstacles = {obstacle};
    const World inside(alone);
    for (int made = 0; made < kPieces;) {
      const Point p{random.uniform() * def.width, random.uniform() * def.height};
      if (inside.clearance(p) > 0.0) continue;
      def.obstacles.push_back(Circle{p, kPiece});
      ++made;
    }
  }
  return World(std::move(def));
}

}  // namespace devlearn::bench
