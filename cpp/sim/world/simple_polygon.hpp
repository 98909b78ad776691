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

#include "world/exact.hpp"
#include "world/geometry.hpp"

// Whether rings cross or touch, and which lies in which: in O(n log n) and without rounding errors.
namespace devlearn {

/// Shamos and Hoey's sweep: passes over the corners of all rings from left to right and compares
/// only edges that become neighbours on the sweep line.
class RingSweep {
 public:
  /// An edge by its first corner.
  struct EdgeOf {
    std::size_t ring, corner;
  };

  /// Of rings of at least 3 corners.
  explicit RingSweep(const std::vector<const Ring*>& rings)
      : around_(rings.size()), counter_clockwise_(rings.size()) {
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
      const std::size_t first = corners_.size(), count = rings[ring]->size();
      corners_.insert(corners_.end(), rings[ring]->begin(), rings[ring]->end());
      for (std::size_t i = 0; i < count; ++i) {
        links_.push_back({ring, first + (i + count - 1) % count, first + (i + 1) % count});
      }
      first_.push_back(first);
    }
  }

  /// Two edges that share a point they should not, in the order of their rings.
  std::optional<std::pair<EdgeOf, EdgeOf>> contact() {
    const auto found = sweep();
    if (!found) return std::nullopt;
    return std::pair{named(found->first), named(found->second)};
  }

  /// The ring directly around a ring, if any; once there is no contact.
  std::optional<std::size_t> around(std::size_t ring) const { return around_[ring]; }

 private:
  struct Link {
    std::size_t ring, before, next;
  };

  std::optional<std::pair<std::size_t, std::size_t>> sweep() {
    const std::size_t n = corners_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (doubles_back(i)) return std::minmax(before(i), i);
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
    std::vector<bool> met(first_.size());
    for (const std::size_t corner : order) {
      const std::size_t edges[] = {before(corner), corner};
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
        const bool lowest = here == line.begin();
        if (!lowest && meet(*std::prev(here), edge)) return std::minmax(*std::prev(here), edge);
        if (std::next(here) != line.end() && meet(edge, *std::next(here))) {
          return std::minmax(edge, *std::next(here));
        }
        const std::size_t ring = links_[edge].ring;
        if (met[ring]) continue;
        met[ring] = true;
        counter_clockwise_[ring] =
            turn(corners_[before(corner)], corners_[corner], corners_[next(corner)]) > 0;
        if (!lowest) around_[ring] = around_above(*std::prev(here));
      }
    }
    return std::nullopt;
  }

  EdgeOf named(std::size_t edge) const {
    const std::size_t ring = links_[edge].ring;
    return {ring, edge - first_[ring]};
  }

  std::size_t before(std::size_t i) const { return links_[i].before; }
  std::size_t next(std::size_t i) const { return links_[i].next; }
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

  // The innermost ring around what lies directly above an edge.
  std::optional<std::size_t> around_above(std::size_t edge) const {
    const std::size_t ring = links_[edge].ring;
    const bool inside_above = counter_clockwise_[ring] == (first(edge) == edge);
    return inside_above ? ring : around_[ring];
  }

  // Whether the two edges at a corner lie on top of each other.
  bool doubles_back(std::size_t i) const {
    const Point before = corners_[this->before(i)], here = corners_[i], after = corners_[next(i)];
    return turn(before, here, after) == 0 && dot(before - here, after - here) > 0.0;
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

  std::vector<Point> corners_;      // of all rings
  std::vector<Link> links_;         // a corner
  std::vector<std::size_t> first_;  // a ring's first corner
  std::vector<std::optional<std::size_t>> around_;
  std::vector<bool> counter_clockwise_;
};

}  // namespace devlearn
