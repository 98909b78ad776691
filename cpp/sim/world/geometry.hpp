#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "devlearn/world.hpp"

// The plane geometry that world and robot share.
namespace devlearn {

/// Corners joined all around, the last one with the first.
using Ring = std::vector<Point>;

/// One straight piece of an obstacle's outline or a wall, solid on its left: a-b, and the corners
/// next to it.
struct Edge {
  Point before, a, b, after;
};

inline Point operator-(Point a, Point b) noexcept { return {a.x - b.x, a.y - b.y}; }
inline double dot(Point u, Point v) noexcept { return u.x * v.x + u.y * v.y; }
inline double cross(Point u, Point v) noexcept { return u.x * v.y - u.y * v.x; }
inline double squared_length(Point u) noexcept { return dot(u, u); }
inline double distance(Point a, Point b) noexcept { return std::sqrt(squared_length(a - b)); }

/// The point `from` + length * direction.
inline Point along(Point from, Point direction, double length) noexcept {
  return {from.x + length * direction.x, from.y + length * direction.y};
}

/// Squared distance from p to the segment a-b, which may be a mere point.
inline double squared_distance(Point p, Point a, Point b) noexcept {
  const Point along = b - a, to = p - a;
  const double length = squared_length(along), foot = dot(to, along);
  if (foot <= 0.0) return squared_length(to);
  if (foot >= length) return squared_length(p - b);
  const double aside = cross(along, to);
  return aside * aside / length;
}

/// Distance to a circle of a point so far (squared) from its centre; 0 inside.
inline double outside(const Circle& circle, double squared) noexcept {
  return std::max(0.0, std::sqrt(squared) - circle.radius);
}

/// Least distance from the segment p-q to a surface.
inline double swept_distance(const Circle& circle, Point p, Point q) noexcept {
  return outside(circle, squared_distance(circle.center, p, q));
}
inline double swept_distance(const Edge& edge, Point p, Point q) noexcept {
  const Point a = edge.a, b = edge.b;
  const bool parted = (cross(b - a, p - a) > 0.0) == (cross(b - a, q - a) > 0.0) ||
                      (cross(q - p, a - p) > 0.0) == (cross(q - p, b - p) > 0.0);
  if (!parted) return 0.0;
  return std::sqrt(std::min({squared_distance(p, a, b), squared_distance(q, a, b),
                             squared_distance(a, p, q), squared_distance(b, p, q)}));
}

}  // namespace devlearn
