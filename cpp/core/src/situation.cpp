#include "devlearn/situation.hpp"

#include <algorithm>

#include "devlearn/detail/require.hpp"
#include "devlearn/math.hpp"

namespace devlearn {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFurthest = 1e7;  // of an origin from 0 [m]: doubles still tell nanometres

}  // namespace

Pose Pose::from_radians(double x, double y, double yaw) {
  require_finite("yaw", yaw);
  return {x, y, wrapped_heading(yaw / kPi * 180.0)};
}

double Pose::yaw() const noexcept {
  const double wrapped = wrapped_heading(heading);
  return (wrapped > 180.0 ? wrapped - 360.0 : wrapped) / 180.0 * kPi;
}

SituationGrid::SituationGrid(double width, double height, int columns, int rows, int headings,
                             Point origin, Outside outside)
    : width_(width),
      height_(height),
      columns_(columns),
      rows_(rows),
      headings_(headings),
      origin_(origin),
      outside_(outside) {
  require_above("SituationGrid.width", width, 0.0, 10000.0, "m");
  require_above("SituationGrid.height", height, 0.0, 10000.0, "m");
  require_count("SituationGrid.columns", columns, 1, 100000);
  require_count("SituationGrid.rows", rows, 1, 100000);
  require_count("SituationGrid.headings", headings, 1, 3600);
  require_in("SituationGrid.origin.x", origin.x, -kFurthest, kFurthest, "m");
  require_in("SituationGrid.origin.y", origin.y, -kFurthest, kFurthest, "m");
  cell_width_ = width / columns;
  cell_height_ = height / rows;
  heading_step_ = 360.0 / headings;
}

SituationId SituationGrid::situation(double x, double y, double heading) const {
  require_inside(x, y, heading);
  return id_of(x, y, heading);
}

void SituationGrid::situations(const double* poses, std::size_t stride, std::size_t count,
                               SituationId* ids) const {
  require_each(count, [&](std::size_t i) {
    const double* const pose = poses + i * stride;
    require_inside(pose[0], pose[1], pose[2]);
  });
  for (std::size_t i = 0; i < count; ++i) {
    const double* const pose = poses + i * stride;
    ids[i] = id_of(pose[0], pose[1], pose[2]);
  }
}

void SituationGrid::require_inside(double x, double y, double heading) const {
  if (outside_ == Outside::kRefuse) {
    require_in("x", x, origin_.x, origin_.x + width_, "m");
    require_in("y", y, origin_.y, origin_.y + height_, "m");
  } else {
    require_finite("x", x);
    require_finite("y", y);
  }
  require_finite("heading", heading);
}

SituationId SituationGrid::id_of(double x, double y, double heading) const noexcept {
  const double across = std::clamp(x - origin_.x, 0.0, width_);
  const double up = std::clamp(y - origin_.y, 0.0, height_);
  const int column = std::min(static_cast<int>(across / cell_width_), columns_ - 1);
  const int row = std::min(static_cast<int>(up / cell_height_), rows_ - 1);
  // The nearest bin; adding a half before rounding down would itself round, up across a border.
  const double wrapped = wrapped_heading(heading);
  int bin = static_cast<int>(wrapped / heading_step_);
  if (wrapped - bin * heading_step_ >= 0.5 * heading_step_) ++bin;
  return (static_cast<SituationId>(row) * columns_ + column) * headings_ + bin % headings_;
}

Pose SituationGrid::centre(SituationId situation) const {
  require_count("situation", situation, 0, count() - 1);
  const SituationId cell = situation / headings_;
  return {origin_.x + (static_cast<double>(cell % columns_) + 0.5) * cell_width_,
          origin_.y + (static_cast<double>(cell / columns_) + 0.5) * cell_height_,
          static_cast<double>(situation % headings_) * heading_step_};
}

SituationId SituationGrid::count() const noexcept {
  return static_cast<SituationId>(rows_) * columns_ * headings_;
}

}  // namespace devlearn
