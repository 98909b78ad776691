#pragma once

#include <cmath>

#include "devlearn/world.hpp"

// The plane geometry that world and robot share.
namespace devlearn {

inline Point operator-(Point a, Point b) noexcept { return {a.x - b.x, a.y - b.y}; }
inline double dot(Point u, Point v) noexcept { return u.x * v.x + u.y * v.y; }
inline double cross(Point u, Point v) noexcept { return u.x * v.y - u.y * v.x; }
inline double squared_length(Point u) noexcept { return dot(u, u); }
inline double distance(Point a, Point b) noexcept { return std::sqrt(squared_length(a - b)); }

/// Squared distance from p to the segment a-b, which may be a mere point.
inline double squared_distance(Point p, Point a, Point b) noexcept {
  const Point along = b - a, to = p - a;
  const double length = squared_length(along), foot = dot(to, along);
  if (foot <= 0.0) return squared_length(to);
  if (foot >= length) return squared_length(p - b);
  const double aside = cross(along, to);
  return aside * aside / length;
}

}  // namespace devlearn
