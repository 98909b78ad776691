#pragma once

#include <cmath>

#include "world/geometry.hpp"

// What a rounding error must not decide.
namespace devlearn {

/// The sign of the turn a-b-c, exact: 1 to the left, -1 to the right, 0 straight.
inline int turn(Point a, Point b, Point c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double area = left - right;
  // Shewchuk's filter: beyond this bound rounding cannot have changed the sign.
  if (std::abs(area) > 3.4e-16 * (std::abs(left) + std::abs(right))) return area > 0.0 ? 1 : -1;

  // Sums the twelve halves of six exact products as Shewchuk's growing expansion.
  double parts[12];
  int count = 0;
  const auto add = [&](double value) {
    for (int i = 0; i < count; ++i) {
      const double sum = value + parts[i], taken = sum - value;
      parts[i] = (value - (sum - taken)) + (parts[i] - taken);
      value = sum;
    }
    parts[count++] = value;
  };
  const auto add_product = [&](double u, double v) {
    const double product = u * v;
    add(std::fma(u, v, -product));
    add(product);
  };
  add_product(a.x, b.y);
  add_product(-a.x, c.y);
  add_product(b.x, c.y);
  add_product(-b.x, a.y);
  add_product(c.x, a.y);
  add_product(-c.x, b.y);
  while (--count >= 0) {
    if (parts[count] != 0.0) return parts[count] > 0.0 ? 1 : -1;
  }
  return 0;
}

/// Whether an edge lies across the way p-q, neither end of which is on it. Corners on the way count
/// as to its right, so that the edges of a ring across it are even in number if and only if both
/// ends lie inside, or both outside.
inline bool lies_across(const Edge& edge, Point p, Point q) {
  return (turn(p, q, edge.a) > 0) != (turn(p, q, edge.b) > 0) &&
         (turn(edge.a, edge.b, p) > 0) != (turn(edge.a, edge.b, q) > 0);
}

}  // namespace devlearn
