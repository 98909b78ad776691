#pragma once

#include <cstddef>
#include <cstdint>

#include "devlearn/detail/cpp17.hpp"

namespace devlearn {

/// The name of a sensory situation S_i: any number in 0 ... 2^63 - 1. The learner gives it no
/// other meaning.
using SituationId = std::int64_t;

/// A point of the plane [m].
struct Point {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
};

inline bool operator==(const Point& a, const Point& b) noexcept { return a.x == b.x && a.y == b.y; }

/// The robot's place and heading.
struct Pose {
  double x = 0.0;        ///< of the robot's centre [m]
  double y = 0.0;        ///< of the robot's centre [m]
  double heading = 0.0;  ///< counter-clockwise from the x axis [degrees]

  /// The pose whose heading is yaw [radians, counter-clockwise from the x axis], brought into
  /// [0, 360) degrees. Throws InvalidValue unless yaw is finite.
  static Pose from_radians(double x, double y, double yaw);
  /// The heading in (-pi, pi] radians.
  double yaw() const noexcept;
};

inline bool operator==(const Pose& a, const Pose& b) noexcept {
  return a.x == b.x && a.y == b.y && a.heading == b.heading;
}
inline bool operator!=(const Pose& a, const Pose& b) noexcept { return !(a == b); }

/// What becomes of a pose outside a grid.
enum class Outside : std::uint8_t {
  kRefuse,  ///< it is refused
  kClamp,   ///< it is in the situation of the nearest cell
};

/// Step 1 of the method: which sensory situation a pose is, on an even grid of cells and headings.
///
/// Cells are half-open (a border belongs to the cell above and to the right; the arena's own far
/// borders to the last cells). Heading bin k is centred on k 360/headings degrees, so that the
/// multiples never sit on a border.  id = (row * columns + column) * headings + bin.
class SituationGrid {
 public:
  /// width, height: the arena's sides, in (0, 10 000] m. columns, rows: cells along x and y, in
  /// 1 ... 100 000. headings: heading bins, in 1 ... 3600. origin: the arena's corner of least x
  /// and y, each within 10 000 km of 0. outside: of poses beyond the arena, as a real robot's
  /// estimate may be. Throws InvalidValue.
  explicit SituationGrid(double width = 5.0, double height = 5.0, int columns = 20, int rows = 20,
                         int headings = 12, Point origin = {}, Outside outside = Outside::kRefuse);

  /// The situation of a pose: x in [origin.x, origin.x + width] m, y in [origin.y, origin.y +
  /// height] m, or any finite ones where what lies outside is clamped; any finite heading
  /// [degrees]. Throws InvalidValue.
  SituationId situation(double x, double y, double heading) const;
  /// The same; of a robot that has radians, situation(Pose::from_radians(x, y, yaw)).
  SituationId situation(const Pose& pose) const { return situation(pose.x, pose.y, pose.heading); }

  /// The same of many: pose i is poses[stride i] (x), [stride i + 1] (y), [stride i + 2] (heading).
  /// Where it throws, no id was written. devlearn/eigen.hpp has this for a matrix of poses.
  void situations(const double* poses, std::size_t stride, std::size_t count,
                  SituationId* ids) const;

  /// The pose at the middle of a situation's cell and heading bin. Throws InvalidValue unless
  /// 0 <= situation < count().
  Pose centre(SituationId situation) const;

  /// N_S, the number of situations.
  SituationId count() const noexcept;

  double width() const noexcept { return width_; }       ///< of the arena, along x [m]
  double height() const noexcept { return height_; }     ///< of the arena, along y [m]
  int columns() const noexcept { return columns_; }      ///< cells along x
  int rows() const noexcept { return rows_; }            ///< cells along y
  int headings() const noexcept { return headings_; }    ///< heading bins
  Point origin() const noexcept { return origin_; }      ///< the corner of least x and y [m]
  Outside outside() const noexcept { return outside_; }  ///< of poses beyond the arena

 private:
  void require_inside(double x, double y, double heading) const;
  SituationId id_of(double x, double y, double heading) const noexcept;

  double width_, height_;
  int columns_, rows_, headings_;
  Point origin_;
  Outside outside_;
  double cell_width_, cell_height_, heading_step_;
};

}  // namespace devlearn
