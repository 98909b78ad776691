#include "world/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "world/exact.hpp"
#include "world/geometry.hpp"

namespace devlearn {
namespace {

constexpr std::uint32_t kWalls = 4;  // edges that are no obstacles, the first

// How far the tree reaches beyond the arena [m]: as far as what a robot may touch in a step.
constexpr double kBorder = 1.1;
// A cell is split unless it holds few surfaces or is small [m]. Where more than so many things
// would have to be looked at one by one, they are searched for instead.
constexpr std::size_t kFew = 4, kMany = 64;
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

Surfaces::Surfaces(const Box& arena, const std::vector<std::vector<Ring>>& outlines,
                   const std::vector<Ring>& thin_walls, std::vector<Circle> circles)
    : arena_(arena), circles_(std::move(circles)) {
  // Clockwise, since walls are solid on the outside.
  const auto [low, high] = arena;
  add_edges({low, {low.x, high.y}, high, {high.x, low.y}}, kNone);
  std::vector<Box> outline_bounds;
  for (const std::vector<Ring>& rings : outlines) {
    const auto first = static_cast<std::uint32_t>(edges_.size());
    for (const Ring& ring : rings) add_edges(ring, static_cast<std::uint32_t>(outlines_.size()));
    Box bound = bound_of(edges_[first]);
    for (std::size_t i = first; i < edges_.size(); ++i) bound = bound.joined(bound_of(edges_[i]));
    outlines_.push_back({first, static_cast<std::uint32_t>(edges_.size()), bound});
    outline_bounds.push_back(bound);
  }
  bounds_ = BoxTree(outline_bounds);
  for (const Ring& ring : thin_walls) add_edges(ring, kNone);
  std::vector<Box> bounds;
  for (std::size_t i = kWalls; i < edges_.size() + circles_.size(); ++i) {
    const auto surface = static_cast<std::uint32_t>(i);
    bounds.push_back(
        apply(surface, [](const auto& shape) { return bound_of(shape).grown_by(kMargin); }));
  }
  near_ = BoxTree(bounds);
  root_ = {{low.x - kBorder, low.y - kBorder},
           std::max(high.x - low.x, high.y - low.y) + 2.0 * kBorder};
  finest_per_metre_ = static_cast<double>(kFinest) / root_.side;
  build();
}

void Surfaces::add_edges(const Ring& ring, std::uint32_t outline) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    edges_.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n], ring[(i + 2) % n]});
    outline_of_.push_back(outline);
  }
}

// Level by level, so that where room ends all regions have come equally far.
void Surfaces::build() {
  struct Unfinished {
    std::size_t cell;
    Square square;
    Candidates held;
  };
  Candidates all;
  Box bound = root_.box();
  for (std::size_t i = kWalls; i < edges_.size() + circles_.size(); ++i) {
    all.surfaces.push_back(static_cast<std::uint32_t>(i));
    if (i >= edges_.size() || outline_of_[i] == kNone) continue;
    all.sides.push_back(static_cast<std::uint32_t>(i));
    bound = bound.joined(bound_of(edges_[i]));
  }
  all.middle = bound.grown_by(1.0).low;  // outside of everything
  // What all cells together may come to hold, where surfaces lie so that no split parts them.
  auto room = static_cast<std::ptrdiff_t>(4096 + 48 * all.surfaces.size());

  std::deque<Unfinished> unfinished;
  unfinished.push_back({0, root_, held_in(root_, all)});
  cells_.resize(1);
  for (; !unfinished.empty(); unfinished.pop_front()) {
    const Unfinished here = std::move(unfinished.front());
    if (filled(here.held)) {
      cells_[here.cell].kind = Cell::Kind::kFilled;
      continue;
    }
    if (here.held.surfaces.size() <= kFew || here.square.side < kLeastSide || room < 0) {
      cells_[here.cell] = leaf_of(here.held);
      continue;
    }
    const std::size_t first = cells_.size();
    cells_[here.cell].kind = Cell::Kind::kSplit;
    cells_[here.cell].first = static_cast<std::uint32_t>(first);
    cells_.resize(first + 16);
    for (int i = 0; i < 16; ++i) {
      const Square part = here.square.part(i);
      unfinished.push_back({first + static_cast<std::size_t>(i), part, held_in(part, here.held)});
      room -= static_cast<std::ptrdiff_t>(unfinished.back().held.surfaces.size());
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
    const std::uint32_t surface = candidates.surfaces[i];
    if (distances[i] > least + 2.0 * rho + kMargin) continue;
    held.surfaces.push_back(surface);
    if (surface >= edges_.size() || outline_of_[surface] == kNone) continue;
    if (distances[i] <= rho + kMargin) held.sides.push_back(surface);
  }
  held.middle = middle_of(square, held.sides);
  held.around = around(held.middle, candidates);
  return held;
}

// The centre unless a side leads through it; else points of a sequence that fills the square
// evenly, so that no side holds many of them.
Point Surfaces::middle_of(const Square& square, const std::vector<std::uint32_t>& sides) const {
  constexpr double kStepX = 0.7548776662466927, kStepY = 0.5698402909980532;
  Point p = square.centre();
  const auto on = [&](std::uint32_t side) { return distance(side, p) <= kMargin; };
  for (int i = 1; std::any_of(sides.begin(), sides.end(), on); ++i) {
    const double u = 0.5 + i * kStepX, v = 0.5 + i * kStepY;
    p = {square.low.x + square.side * (u - std::floor(u)),
         square.low.y + square.side * (v - std::floor(v))};
  }
  return p;
}

// From a square's middle to another point of it.
std::vector<std::uint32_t> Surfaces::around(Point p, const Candidates& candidates) const {
  std::vector<std::uint32_t> around = candidates.around;
  for (const std::uint32_t side : candidates.sides) {
    if (!lies_across(edges_[side], p, candidates.middle)) continue;
    const std::uint32_t outline = outline_of_[side];
    const auto place = std::lower_bound(around.begin(), around.end(), outline);
    if (place != around.end() && *place == outline) {
      around.erase(place);
    } else {
      around.insert(place, outline);
    }
  }
  return around;
}

// Whether an outline is around it that has no side in it.
bool Surfaces::filled(const Candidates& held) const {
  return std::any_of(held.around.begin(), held.around.end(), [&](std::uint32_t outline) {
    return std::none_of(held.sides.begin(), held.sides.end(),
                        [&](std::uint32_t side) { return outline_of_[side] == outline; });
  });
}

Surfaces::Cell Surfaces::leaf_of(const Candidates& held) {
  Cell cell;
  const auto end = [this] { return static_cast<std::uint32_t>(held_.size()); };
  cell.first = end();
  cell.surfaces_listed = held.surfaces.size() <= kMany;
  cell.outlines_listed = held.sides.size() <= kMany;
  if (cell.surfaces_listed) {
    held_.insert(held_.end(), held.surfaces.begin(), held.surfaces.end());
  }
  const auto first_circle = std::lower_bound(held_.begin() + cell.first, held_.end(),
                                             static_cast<std::uint32_t>(edges_.size()));
  cell.circles = static_cast<std::uint32_t>(first_circle - held_.begin());
  cell.outlines = end();
  if (cell.outlines_listed) {
    for (auto first = held.sides.begin(); first != held.sides.end();) {
      const std::uint32_t outline = outline_of_[*first];
      const auto last = std::find_if(first, held.sides.end(), [&](std::uint32_t side) {
        return outline_of_[side] != outline;
      });
      const bool inside = std::binary_search(held.around.begin(), held.around.end(), outline);
      held_.push_back(static_cast<std::uint32_t>(last - first) * 2 + (inside ? 1 : 0));
      held_.insert(held_.end(), first, last);
      first = last;
    }
  }
  cell.last = end();
  cell.middle = held.middle;
  cell.clearance = distance(cell, cell.middle);
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
  return cell.clearance - devlearn::distance(p, cell.middle) - kMargin;
}

double Surfaces::distance(const Cell& cell, Point p) const noexcept {
  if (inside_any(cell, p)) return 0.0;
  if (!cell.surfaces_listed) return searched_distance(p);
  double squared = kInfinite;
  for (std::uint32_t i = cell.first; i < cell.circles; ++i) {
    const Edge& edge = edges_[held_[i]];
    squared = std::min(squared, squared_distance(p, edge.a, edge.b));
  }
  double least = std::sqrt(squared);
  for (std::uint32_t i = cell.circles; i < cell.outlines; ++i) {
    const Circle& circle = circles_[held_[i] - edges_.size()];
    least = std::min(least, outside(circle, squared_length(p - circle.center)));
  }
  return least;
}

// Calls meet(surface) as BoxTree::search does.
template <typename Meet>
void Surfaces::search(const Box& place, double& limit, const Meet& meet) const {
  near_.search(place, limit, [&](std::uint32_t i) { meet(kWalls + i); });
}

double Surfaces::searched_distance(Point p) const noexcept {
  double least = kInfinite, limit = kInfinite;
  search({p, p}, limit, [&](std::uint32_t surface) {
    least = std::min(least, distance(surface, p));
    limit = least * least;
  });
  return least;
}

bool Surfaces::inside_any(const Cell& leaf, Point p) const noexcept {
  if (leaf.kind == Cell::Kind::kFilled) return true;
  if (!leaf.outlines_listed) {
    bool any = false;
    double limit = 0.0;
    bounds_.search({p, p}, limit, [&](std::uint32_t i) { any = any || inside(outlines_[i], p); });
    return any;
  }
  // Of each outline twice the number of its sides, and whether the middle lies in it; then these.
  for (std::uint32_t i = leaf.outlines; i < leaf.last;) {
    const std::uint32_t head = held_[i++], end = i + head / 2;
    bool inside = head % 2 != 0;
    for (; i < end; ++i) inside = inside != lies_across(edges_[held_[i]], p, leaf.middle);
    if (inside) return true;
  }
  return false;
}

// By a ray to the right, however long.
bool Surfaces::inside(const Outline& outline, Point p) const noexcept {
  if (!outline.bound.contains(p)) return false;
  bool inside = false;
  double limit = 0.0;
  search({p, {outline.bound.high.x, p.y}}, limit, [&](std::uint32_t surface) {
    if (surface < outline.first || surface >= outline.last) return;
    const Edge& side = edges_[surface];
    inside = inside != crosses_ray(p, side.a, side.b);
  });
  return inside;
}

bool Surfaces::keep_clear_of(Point p, Point q, double room) const noexcept {
  if (std::min(wall_distance(p), wall_distance(q)) <= room) return false;
  if (inside_any(leaf(p), p)) return false;
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
