#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "devlearn/math.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

/// So long a step takes: from a time of the world on [s].
struct TimeSpan {
  double begin = 0.0, duration = 0.0;
  double end() const noexcept { return begin + duration; }
};

/// The obstacles of a world that move: where each is at any time, in closed form. Within a step
/// each goes straight, from where it is when the step begins to where it is when that ends.
class Movers {
 public:
  /// Of movers that have been checked.
  explicit Movers(const std::vector<Mover>& movers);

  std::size_t size() const noexcept { return movers_.size(); }

  /// The shape of one, its centre at (0, 0).
  const std::variant<Circle, Rectangle>& shape(std::size_t mover) const noexcept {
    return movers_[mover].shape;
  }
  /// Where its centre is; before 0 as at 0, beyond kLatest as at kLatest.
  Point place(std::size_t mover, double time) const noexcept;

  /// Distance from p to one of them at a time, below 0 inside.
  double distance(std::size_t mover, Point p, double time) const noexcept;
  /// The least of them, infinite where there is none.
  double distance(Point p, double time) const noexcept;

  /// Least distance from p to wherever one of them ever comes, 0 there.
  double distance_ever(std::size_t mover, Point p) const noexcept;

  /// Whether they keep more than `room` > 0 from what goes straight and evenly from p to q within a
  /// step.
  bool keep_clear_of(Point p, Point q, double room, const TimeSpan& step) const noexcept;

  /// Which of them come within `reach` of p within a step.
  std::vector<std::size_t> around(Point p, double reach, const TimeSpan& step) const;

  static constexpr double kLatest = 1e9;  ///< the last time at which anything moves [s]

 private:
  // Along points: how far it has gone at each of them, and at the end of the way [m].
  struct Way {
    MoverPath path;
    std::vector<double> gone;
    Point place(double time) const noexcept;
  };
  struct Wandering {
    MoverWalk walk;
    std::uint64_t draws;  // of its own, whatever other seeds draw
    Point waypoint(std::uint64_t number) const noexcept;
    Point place(double time) const noexcept;
  };
  struct Moving {
    std::variant<Circle, Rectangle> shape;
    std::variant<Way, Wandering> course;
    double reach;  // of the shape from its centre [m]
    // Of p, seen from its centre; below 0 inside.
    double distance(Point p) const noexcept;
    // Of what goes from p to q, likewise; 0 where it comes in.
    double swept_distance(Point p, Point q) const noexcept;
    double distance_ever(const Way& way, Point p) const noexcept;
    double distance_ever(const Wandering& walk, Point p) const noexcept;
  };

  std::vector<Moving> movers_;
};

}  // namespace devlearn
