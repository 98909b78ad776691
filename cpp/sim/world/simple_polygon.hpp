#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "devlearn/world.hpp"

// Whether an outline crosses or touches itself, in O(n log n) and without rounding errors.
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

/// Shamos and Hoey's sweep: passes over the corners from left to right and compares only edges
/// that become neighbours on the sweep line.
class SelfContact {
 public:
  explicit SelfContact(const std::vector<Point>& corners) : corners_(corners) {}

  /// Two edges (each named by its first corner) that share a point they should not.
  std::optional<std::pair<std::size_t, std::size_t>> find() const {
    const std::size_t n = corners_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (doubles_back(i)) return std::pair{(i + n - 1) % n, i};
    }
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto i, auto j) { return comes_first(i, j); });
    for (std::size_t k = 1; k < n; ++k) {
      if (corners_[order[k - 1]] == corners_[order[k]]) return std::minmax(order[k - 1], order[k]);
    }

    const auto below = [this](std::size_t s, std::size_t t) { return lies_below(s, t); };
    std::set<std::size_t, decltype(below)> line(below);
    std::vector<decltype(line.begin())> place(n);
    for (const std::size_t corner : order) {
      const std::size_t edges[] = {(corner + n - 1) % n, corner};
      for (const std::size_t edge : edges) {
        if (last(edge) != corner) continue;
        const auto above = line.erase(place[edge]);
        if (above != line.begin() && above != line.end() && meet(*std::prev(above), *above)) {
          return std::minmax(*std::prev(above), *above);
        }
      }
      for (const std::size_t edge : edges) {
        if (first(edge) != corner) continue;
        const auto here = place[edge] = line.insert(edge).first;
        if (here != line.begin() && meet(*std::prev(here), edge)) {
          return std::minmax(*std::prev(here), edge);
        }
        if (std::next(here) != line.end() && meet(edge, *std::next(here))) {
          return std::minmax(edge, *std::next(here));
        }
      }
    }
    return std::nullopt;
  }

 private:
  std::size_t next(std::size_t i) const { return i + 1 == corners_.size() ? 0 : i + 1; }
  bool comes_first(std::size_t i, std::size_t j) const {
    const Point a = corners_[i], b = corners_[j];
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  }
  // The corners at which the sweep enters and leaves an edge.
  std::size_t first(std::size_t edge) const {
    return comes_first(edge, next(edge)) ? edge : next(edge);
  }
  std::size_t last(std::size_t edge) const {
    return comes_first(edge, next(edge)) ? next(edge) : edge;
  }

  // Whether the two edges at a corner lie on top of each other.
  bool doubles_back(std::size_t i) const {
    const Point before = corners_[(i + corners_.size() - 1) % corners_.size()], here = corners_[i],
                after = corners_[next(i)];
    return turn(before, here, after) == 0 &&
           (before.x - here.x) * (after.x - here.x) + (before.y - here.y) * (after.y - here.y) > 0;
  }

  // The order of two edges on the sweep line, decided where the later one enters it.
  bool lies_below(std::size_t s, std::size_t t) const {
    if (s == t) return false;
    if (comes_first(first(s), first(t))) return !lies_below(t, s);
    const Point low = corners_[first(t)], high = corners_[last(t)];
    int side = turn(low, high, corners_[first(s)]);
    if (side == 0 && first(s) == first(t)) side = turn(low, high, corners_[last(s)]);
    return side == 0 ? s < t : side < 0;
  }

  bool meet(std::size_t s, std::size_t t) const {
    if (next(s) == t || next(t) == s) return false;
    const Point a = corners_[s], b = corners_[next(s)], c = corners_[t], d = corners_[next(t)];
    const int side_a = turn(c, d, a), side_b = turn(c, d, b);
    const int side_c = turn(a, b, c), side_d = turn(a, b, d);
    const auto within = [](Point p, Point u, Point v) {
      return std::min(u.x, v.x) <= p.x && p.x <= std::max(u.x, v.x) && std::min(u.y, v.y) <= p.y &&
             p.y <= std::max(u.y, v.y);
    };
    return (side_a * side_b < 0 && side_c * side_d < 0) || (side_a == 0 && within(a, c, d)) ||
           (side_b == 0 && within(b, c, d)) || (side_c == 0 && within(c, a, b)) ||
           (side_d == 0 && within(d, a, b));
  }

  const std::vector<Point>& corners_;
};

}  // namespace devlearn
