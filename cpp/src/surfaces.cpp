#include "surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "geometry.hpp"

namespace devlearn {
namespace {

constexpr std::uint32_t kWalls = 4;  // edges that are no obstacles, the first

// How far the tree reaches beyond the arena [m]: as far as what a robot may touch in a step.
constexpr double kBorder = 1.1;
// A cell is split unless it holds few surfaces or is small [m].
constexpr std::size_t kFew = 4;
constexpr double kLeastSide = 0.02;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Whether a ray from p along the x axis crosses the side a-b.
bool crosses_ray(Point p, Point a, Point b) {
  return (a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0.0) == (b.y > a.y);
}

}  // namespace

Surfaces::Surfaces(double width, double height, std::vector<std::vector<Point>> outlines,
                   std::vector<Circle> circles)
    : circles_(std::move(circles)) {
  // Clockwise, since walls are solid on the outside.
  add_edges({{0.0, 0.0}, {0.0, height}, {width, height}, {width, 0.0}});
  for (std::vector<Point>& corners : outlines) {
    add_edges(corners);
    Box bound{corners[0], corners[0]};
    for (const Point& corner : corners) {
      bound.low = {std::min(bound.low.x, corner.x), std::min(bound.low.y, corner.y)};
      bound.high = {std::max(bound.high.x, corner.x), std::max(bound.high.y, corner.y)};
    }
    outlines_.push_back({std::move(corners), bound});
  }
  root_ = {{-kBorder, -kBorder}, std::max(width, height) + 2.0 * kBorder};
  finest_per_metre_ = static_cast<double>(kFinest) / root_.side;
  build();
}

void Surfaces::add_edges(const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    edges_.push_back(
        {corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n], corners[(i + 2) % n]});
  }
}

// Level by level, so that where room ends all regions have come equally far.
void Surfaces::build() {
  struct Unfinished {
    std::size_t cell;
    Square square;
    Candidates held;
  };
  std::deque<Unfinished> unfinished(1);
  Candidates& all = unfinished.front().held;
  for (std::size_t i = kWalls; i < edges_.size() + circles_.size(); ++i) {
    all.surfaces.push_back(static_cast<std::uint32_t>(i));
  }
  for (std::size_t i = 0; i < outlines_.size(); ++i) {
    all.outlines.push_back(static_cast<std::uint32_t>(i));
  }
  unfinished.front().square = root_;
  everything_ = store(all);
  // What all cells together may come to hold, where surfaces lie so that no split parts them.
  auto room = static_cast<std::ptrdiff_t>(4096 + 32 * (all.surfaces.size() + all.outlines.size()));

  cells_.resize(1);
  for (; !unfinished.empty(); unfinished.pop_front()) {
    const Unfinished here = std::move(unfinished.front());
    if (here.held.surfaces.size() <= kFew || here.square.side < kLeastSide || room < 0) {
      cells_[here.cell] = store(here.held);
      continue;
    }
    const std::size_t first = cells_.size();
    cells_[here.cell].first = static_cast<std::uint32_t>(first);
    cells_.resize(first + 16);
    for (int i = 0; i < 16; ++i) {
      const Square part = here.square.part(i);
      unfinished.push_back({first + static_cast<std::size_t>(i), part, held_in(part, here.held)});
      const Candidates& held = unfinished.back().held;
      room -= static_cast<std::ptrdiff_t>(held.surfaces.size() + held.outlines.size());
    }
  }
}

double Surfaces::distance(std::uint32_t surface, Point p) const noexcept {
  if (surface < edges_.size()) {
    const World::Edge& edge = edges_[surface];
    return std::sqrt(squared_distance(p, edge.a, edge.b));
  }
  const Circle& circle = circles_[surface - edges_.size()];
  return outside(circle, squared_length(p - circle.center));
}

Surfaces::Candidates Surfaces::held_in(const Square& square, const Candidates& candidates) const {
  const double half = 0.5 * square.side;
  const Point centre{square.low.x + half, square.low.y + half};
  std::vector<double> distances;
  distances.reserve(candidates.surfaces.size());
  double least = kInfinite;
  for (const std::uint32_t surface : candidates.surfaces) {
    distances.push_back(distance(surface, centre));
    least = std::min(least, distances.back());
  }
  const double rho = std::sqrt(2.0) * half;
  Candidates held;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] > least + 2.0 * rho + kMargin) continue;
    held.surfaces.push_back(candidates.surfaces[i]);
  }
  const Box box = square.box().grown_by(kMargin);
  for (const std::uint32_t outline : candidates.outlines) {
    if (outlines_[outline].bound.overlaps(box)) held.outlines.push_back(outline);
  }
  return held;
}

Surfaces::Cell Surfaces::store(const Candidates& held) {
  Cell cell;
  const auto end = [this] { return static_cast<std::uint32_t>(held_.size()); };
  cell.first = cell.circles = end();
  for (const std::uint32_t surface : held.surfaces) {
    if (surface < edges_.size()) {
      held_.push_back(surface);
      cell.circles = end();
    } else {
      held_.push_back(surface - static_cast<std::uint32_t>(edges_.size()));
    }
  }
  cell.outlines = end();
  held_.insert(held_.end(), held.outlines.begin(), held.outlines.end());
  cell.last = end();
  return cell;
}

const Surfaces::Cell& Surfaces::leaf(Point p) const noexcept {
  const double u = (p.x - root_.low.x) * finest_per_metre_;
  const double v = (p.y - root_.low.y) * finest_per_metre_;
  if (!(u >= 0.0 && v >= 0.0 && u < kFinest && v < kFinest)) return everything_;
  const auto column = static_cast<std::uint32_t>(u), row = static_cast<std::uint32_t>(v);
  const Cell* cell = cells_.data();
  for (int shift = 2 * kDepth - 2; cell->is_split(); shift -= 2) {
    cell = &cells_[cell->first + (row >> shift & 3U) * 4U + (column >> shift & 3U)];
  }
  return *cell;
}

double Surfaces::distance(Point p) const noexcept {
  const Cell& cell = leaf(p);
  double squared = kInfinite;
  for (std::uint32_t i = cell.first; i < cell.circles; ++i) {
    const World::Edge& edge = edges_[held_[i]];
    squared = std::min(squared, squared_distance(p, edge.a, edge.b));
  }
  double least = std::sqrt(squared);
  for (std::uint32_t i = cell.circles; i < cell.outlines; ++i) {
    const Circle& circle = circles_[held_[i]];
    least = std::min(least, outside(circle, squared_length(p - circle.center)));
  }
  return inside_outline(cell, p) ? 0.0 : least;
}

bool Surfaces::inside_outline(const Cell& leaf, Point p) const noexcept {
  for (std::uint32_t i = leaf.outlines; i < leaf.last; ++i) {
    if (outlines_[held_[i]].contains(p)) return true;
  }
  return false;
}

bool Surfaces::Outline::contains(Point p) const noexcept {
  if (!bound.contains(p)) return false;
  bool inside = false;
  Point a = corners.back();
  for (const Point& b : corners) {
    if (crosses_ray(p, a, b)) inside = !inside;
    a = b;
  }
  return inside;
}

template <typename F>
bool Surfaces::visit(const Box& box, const F& f) const {
  const Box grown = box.grown_by(kMargin);
  if (!root_.box().contains(grown.low) || !root_.box().contains(grown.high)) return f(everything_);
  return visit(cells_[0], root_, grown, f);
}

template <typename F>
bool Surfaces::visit(const Cell& cell, const Square& square, const Box& box, const F& f) const {
  if (!cell.is_split()) return f(cell);
  const auto part_at = [&](double value, double low) {
    return static_cast<int>(std::clamp((value - low) * (4.0 / square.side), 0.0, 3.0));
  };
  const int left = part_at(box.low.x, square.low.x), right = part_at(box.high.x, square.low.x);
  const int bottom = part_at(box.low.y, square.low.y), top = part_at(box.high.y, square.low.y);
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) {
      const int i = 4 * row + column;
      if (!visit(cells_[cell.first + i], square.part(i), box, f)) return false;
    }
  }
  return true;
}

bool Surfaces::keep_clear_of(Point p, Point q, double room) const noexcept {
  const Box way{{std::min(p.x, q.x), std::min(p.y, q.y)}, {std::max(p.x, q.x), std::max(p.y, q.y)}};
  if (inside_outline(leaf(p), p)) return false;
  return visit(way.grown_by(room), [&](const Cell& cell) {
    for (std::uint32_t i = cell.first; i < cell.circles; ++i) {
      if (!(swept_distance(edges_[held_[i]], p, q) > room)) return false;
    }
    for (std::uint32_t i = cell.circles; i < cell.outlines; ++i) {
      if (!(swept_distance(circles_[held_[i]], p, q) > room)) return false;
    }
    return true;
  });
}

World::Surroundings Surfaces::around(Point p, double reach) const {
  std::vector<std::uint32_t> edges, circles;
  edges.reserve(16);
  const auto edge_reached = [&](std::uint32_t i) {
    return squared_distance(p, edges_[i].a, edges_[i].b) <= reach * reach;
  };
  const auto circle_reached = [&](std::uint32_t i) {
    return devlearn::distance(p, circles_[i].center) - circles_[i].radius <= reach;
  };
  for (std::uint32_t i = 0; i < kWalls; ++i) {
    if (edge_reached(i)) edges.push_back(i);
  }
  visit(Box{p, p}.grown_by(reach), [&](const Cell& cell) {
    for (std::uint32_t k = cell.first; k < cell.circles; ++k) {
      const std::uint32_t i = held_[k];
      if (edge_reached(i)) edges.push_back(i);
    }
    for (std::uint32_t k = cell.circles; k < cell.outlines; ++k) {
      const std::uint32_t i = held_[k];
      if (circle_reached(i)) circles.push_back(i);
    }
    return true;
  });
  // Several leaves may hold the same surface.
  for (std::vector<std::uint32_t>* const found : {&edges, &circles}) {
    std::sort(found->begin(), found->end());
    found->erase(std::unique(found->begin(), found->end()), found->end());
  }

  World::Surroundings near;
  near.edges.reserve(edges.size());
  near.circles.reserve(circles.size());
  for (const std::uint32_t i : edges) near.edges.push_back(edges_[i]);
  for (const std::uint32_t i : circles) near.circles.push_back(circles_[i]);
  return near;
}

}  // namespace devlearn
