#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "devlearn/world.hpp"
#include "world/box_tree.hpp"
#include "world/geometry.hpp"

namespace devlearn {

/// What a world's obstacles are bounded by, and how to find what is near: a hierarchy of boxes and,
/// for what is asked at every step, a tree of square cells that leads from a point straight to the
/// few surfaces that can be the nearest there. Where they are many the hierarchy serves.
///
/// A surface (an edge or a circle) is d_s away from a cell's centre, the nearest one d. No point of
/// the cell is further than rho from the centre, so the nearest there is at most d + rho away, and
/// what is nearest anywhere in the cell has d_s - rho <= d + rho. These a cell holds; leaving out
/// the others changes no result, since kMargin exceeds what rounding can do to the comparison.
///
/// Of each outline that has edges in a cell it also holds whether the cell's middle lies inside,
/// and these edges. A point of the cell lies inside as the middle does if an even number of them
/// lies across the way there: what is near tells, however long the outline is.
class Surfaces {
 public:
  /// Of an arena with walls all around. An outline has rings, of which one holds the others, all
  /// solid on their left; along thin walls a ring leads there and back.
  Surfaces(const Box& arena, const std::vector<std::vector<Ring>>& outlines,
           const std::vector<Ring>& thin_walls, std::vector<Circle> circles);

  /// Least distance from p to an obstacle, 0 inside one, infinite where there is none.
  double distance(Point p) const noexcept;

  /// No more than that distance, and less work: what p's cell tells without looking at a surface.
  /// Below 0 where it tells nothing.
  double distance_at_least(Point p) const noexcept;

  /// Least distance from p to the walls, 0 outside.
  double wall_distance(Point p) const noexcept {
    const auto [low, high] = arena_;
    return std::max(0.0, std::min({p.x - low.x, high.x - p.x, p.y - low.y, high.y - p.y}));
  }

  /// Least distance from p to obstacles and walls, 0 in them.
  double room(Point p) const noexcept { return std::min(distance(p), wall_distance(p)); }

  /// Whether obstacles and walls keep more than `room` > 0 from the segment p-q.
  bool keep_clear_of(Point p, Point q, double room) const noexcept;

  /// Which surfaces lie no further than `reach` from p, and no others: edges by index, then circles
  /// by index + edges().size().
  std::vector<std::uint32_t> around(Point p, double reach) const;

  /// f of the edge or circle that has this number.
  template <typename F>
  auto apply(std::uint32_t surface, const F& f) const {
    return surface < edges_.size() ? f(edges_[surface]) : f(circles_[surface - edges_.size()]);
  }

  const std::vector<Edge>& edges() const noexcept { return edges_; }  ///< walls first
  const std::vector<Circle>& circles() const noexcept { return circles_; }

 private:
  static constexpr double kMargin = 1e-9;  // [m]
  static constexpr int kDepth = 10;        // of the tree; each level has cells a quarter as wide
  static constexpr std::uint32_t kFinest = 1U << (2 * kDepth);

  struct Square {
    Point low;
    double side = 0.0;
    Box box() const noexcept { return {low, {low.x + side, low.y + side}}; }
    Point centre() const noexcept { return {low.x + 0.5 * side, low.y + 0.5 * side}; }
    Square part(int i) const noexcept {
      const double quarter = 0.25 * side;
      return {{low.x + i % 4 * quarter, low.y + i / 4 * quarter}, quarter};
    }
  };
  struct Outline {              // of a polygon or rectangle
    std::uint32_t first, last;  // of its edges
    Box bound;
  };
  static constexpr std::uint32_t kNone = 0xffffffff;  // the outline of walls
  // What a cell may hold, in order. Surfaces are edges by index, then circles by index +
  // edges_.size().
  struct Candidates {
    std::vector<std::uint32_t> surfaces;  // which may be the nearest
    std::vector<std::uint32_t> sides;     // edges of outlines that may lead through it
    Point middle;                         // a point in it that is on none of these
    std::vector<std::uint32_t> around;    // the outlines that the middle lies in
  };
  struct Cell {
    enum class Kind : std::uint32_t {
      kSplit,   // into sixteen parts, cells_[first] and what follows, row by row
      kLeaf,    // held_ from `first` on: edges, circles, and outlines with their sides (inside_any)
      kFilled,  // lies in an outline as a whole
    };
    Kind kind = Kind::kLeaf;
    bool surfaces_listed = false, outlines_listed = false;  // or so many that they are searched for
    std::uint32_t first = 0, circles = 0, outlines = 0, last = 0;
    Point middle;
    double clearance = 0.0;  // distance(middle)
  };

  void add_edges(const Ring& ring, std::uint32_t outline);
  void build();
  Candidates held_in(const Square& square, const Candidates& candidates) const;
  Point middle_of(const Square& square, const std::vector<std::uint32_t>& sides) const;
  std::vector<std::uint32_t> around(Point p, const Candidates& candidates) const;
  bool filled(const Candidates& held) const;
  Cell leaf_of(const Candidates& held);
  template <typename Meet>
  void search(const Box& place, double& limit, const Meet& meet) const;
  double distance(std::uint32_t surface, Point p) const noexcept;
  double distance(const Cell& leaf, Point p) const noexcept;
  double searched_distance(Point p) const noexcept;
  const Cell& leaf(Point p) const noexcept;
  bool inside_any(const Cell& leaf, Point p) const noexcept;
  bool inside(const Outline& outline, Point p) const noexcept;

  Box arena_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> outline_of_;  // each edge
  std::vector<Circle> circles_;
  std::vector<Outline> outlines_;

  BoxTree near_;    // of all surfaces but the walls, numbered from the first that is none
  BoxTree bounds_;  // of the outlines

  Square root_;
  double finest_per_metre_ = 0.0;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> held_;
  Cell outside_;  // of the root
};

}  // namespace devlearn
