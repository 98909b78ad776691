#include "world/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "world/geometry.hpp"

namespace devlearn {
namespace {

constexpr std::uint32_t kWalls = 4;  // edges that are no obstacles, the first

// How far the tree reaches beyond the arena [m]: as far as what a robot may touch in a step.
constexpr double kBorder = 1.1;
// A cell is split unless it holds few surfaces or is small [m]. Where more than so many things
// would have to be looked at one by one, they are searched for instead.
constexpr std::size_t kFew = 4, kMany = 16;
constexpr double kLeastSide = 0.02;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Whether a ray from p along the x axis crosses the side a-b.
bool crosses_ray(Point p, Point a, Point b) {
  return (a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0.0) == (b.y > a.y);
}

Box bound_of(const Edge& edge) { return Box{edge.a, edge.a}.joined({edge.b, edge.b}); }
Box bound_of(const Circle& circle) {
  return Box{circle.center, circle.center}.grown_by(circle.radius);
}

double distance_to(const Edge& edge, Point p) {
  return std::sqrt(squared_distance(p, edge.a, edge.b));
}
double distance_to(const Circle& circle, Point p) {
  return outside(circle, squared_length(p - circle.center));
}

bool reaches(const Edge& edge, Point p, double reach) {
  return squared_distance(p, edge.a, edge.b) <= reach * reach;
}
bool reaches(const Circle& circle, Point p, double reach) {
  return distance(p, circle.center) - circle.radius <= reach;
}

}  // namespace

Surfaces::Surfaces(const Box& arena, std::vector<std::vector<Point>> outlines,
                   std::vector<Circle> circles)
    : arena_(arena), circles_(std::move(circles)) {
  // Clockwise, since walls are solid on the outside.
  const auto [low, high] = arena;
  add_edges({low, {low.x, high.y}, high, {high.x, low.y}});
  for (std::vector<Point>& corners : outlines) {
    add_edges(corners);
    Box bound{corners[0], corners[0]};
    for (const Point& corner : corners) bound = bound.joined({corner, corner});
    outlines_.push_back({std::move(corners), bound});
  }
  std::vector<Box> bounds;
  for (std::size_t i = kWalls; i < edges_.size() + circles_.size(); ++i) {
    const auto surface = static_cast<std::uint32_t>(i);
    bounds.push_back(
        apply(surface, [](const auto& shape) { return bound_of(shape).grown_by(kMargin); }));
  }
  for (const Outline& outline : outlines_) bounds.push_back(outline.bound);
  near_ = BoxTree(bounds);
  root_ = {{low.x - kBorder, low.y - kBorder},
           std::max(high.x - low.x, high.y - low.y) + 2.0 * kBorder};
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
  // What all cells together may come to hold, where surfaces lie so that no split parts them.
  auto room = static_cast<std::ptrdiff_t>(4096 + 32 * (all.surfaces.size() + all.outlines.size()));

  cells_.resize(1);
  for (; !unfinished.empty(); unfinished.pop_front()) {
    const Unfinished here = std::move(unfinished.front());
    if (here.held.surfaces.size() <= kFew || here.square.side < kLeastSide || room < 0) {
      if (here.held.surfaces.size() + here.held.outlines.size() <= kMany) {
        cells_[here.cell] = listed(here.square, here.held);
      }
      continue;
    }
    const std::size_t first = cells_.size();
    cells_[here.cell].kind = Cell::Kind::kSplit;
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
  return apply(surface, [p](const auto& shape) { return distance_to(shape, p); });
}

Surfaces::Candidates Surfaces::held_in(const Square& square, const Candidates& candidates) const {
  const Point centre = square.centre();
  std::vector<double> distances;
  distances.reserve(candidates.surfaces.size());
  double least = kInfinite;
  for (const std::uint32_t surface : candidates.surfaces) {
    distances.push_back(distance(surface, centre));
    least = std::min(least, distances.back());
  }
  const double rho = std::sqrt(0.5) * square.side;
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

Surfaces::Cell Surfaces::listed(const Square& square, const Candidates& held) {
  Cell cell;
  cell.kind = Cell::Kind::kListed;
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
  cell.centre = square.centre();
  cell.clearance = distance(cell, cell.centre);
  return cell;
}

const Surfaces::Cell& Surfaces::leaf(Point p) const noexcept {
  const double u = (p.x - root_.low.x) * finest_per_metre_;
  const double v = (p.y - root_.low.y) * finest_per_metre_;
  if (!(u >= 0.0 && v >= 0.0 && u < kFinest && v < kFinest)) return outside_;
  const auto column = static_cast<std::uint32_t>(u), row = static_cast<std::uint32_t>(v);
  const Cell* cell = cells_.data();
  for (int shift = 2 * kDepth - 2; cell->kind == Cell::Kind::kSplit; shift -= 2) {
    cell = &cells_[cell->first + (row >> shift & 3U) * 4U + (column >> shift & 3U)];
  }
  return *cell;
}

double Surfaces::distance(Point p) const noexcept { return distance(leaf(p), p); }

// No point is nearer to anything than another one less the way there.
double Surfaces::distance_at_least(Point p) const noexcept {
  const Cell& cell = leaf(p);
  return cell.clearance - devlearn::distance(p, cell.centre) - kMargin;
}

double Surfaces::distance(const Cell& cell, Point p) const noexcept {
  if (inside_outline(cell, p)) return 0.0;
  if (cell.kind == Cell::Kind::kSearched) return searched_distance(p);
  double squared = kInfinite;
  for (std::uint32_t i = cell.first; i < cell.circles; ++i) {
    const Edge& edge = edges_[held_[i]];
    squared = std::min(squared, squared_distance(p, edge.a, edge.b));
  }
  double least = std::sqrt(squared);
  for (std::uint32_t i = cell.circles; i < cell.outlines; ++i) {
    const Circle& circle = circles_[held_[i]];
    least = std::min(least, outside(circle, squared_length(p - circle.center)));
  }
  return least;
}

// Calls meet(surface) as BoxTree::search does, outlines left out.
template <typename Meet>
void Surfaces::search(const Box& place, double& limit, const Meet& meet) const {
  const auto count = static_cast<std::uint32_t>(edges_.size() + circles_.size());
  near_.search(place, limit, [&](std::uint32_t i) {
    if (kWalls + i < count) meet(kWalls + i);
  });
}

double Surfaces::searched_distance(Point p) const noexcept {
  double least = kInfinite, limit = kInfinite;
  search({p, p}, limit, [&](std::uint32_t surface) {
    least = std::min(least, distance(surface, p));
    limit = least * least;
  });
  return least;
}

bool Surfaces::inside_outline(const Cell& leaf, Point p) const noexcept {
  bool inside = false;
  if (leaf.kind == Cell::Kind::kSearched) {
    const auto first = static_cast<std::uint32_t>(edges_.size() + circles_.size()) - kWalls;
    double limit = 0.0;
    near_.search({p, p}, limit, [&](std::uint32_t i) {
      inside = inside || (i >= first && outlines_[i - first].contains(p));
    });
  }
  for (std::uint32_t i = leaf.outlines; i < leaf.last && !inside; ++i) {
    inside = outlines_[held_[i]].contains(p);
  }
  return inside;
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

bool Surfaces::keep_clear_of(Point p, Point q, double room) const noexcept {
  if (std::min(wall_distance(p), wall_distance(q)) <= room) return false;
  if (inside_outline(leaf(p), p)) return false;
  bool clear = true;
  double limit = room * room;
  search(Box{p, p}.joined({q, q}).grown_by(kMargin), limit, [&](std::uint32_t surface) {
    const double distance =
        apply(surface, [&](const auto& shape) { return swept_distance(shape, p, q); });
    if (distance > room) return;
    clear = false;
    limit = -1.0;
  });
  return clear;
}

std::vector<std::uint32_t> Surfaces::around(Point p, double reach) const {
  std::vector<std::uint32_t> found;
  found.reserve(32);
  const auto reached = [&](std::uint32_t surface) {
    return apply(surface, [&](const auto& shape) { return reaches(shape, p, reach); });
  };
  for (std::uint32_t i = 0; i < kWalls; ++i) {
    if (reached(i)) found.push_back(i);
  }
  double limit = reach * reach;
  search({p, p}, limit, [&](std::uint32_t surface) {
    if (reached(surface)) found.push_back(surface);
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace devlearn
