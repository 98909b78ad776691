#include "devlearn/situation.hpp"

#include <algorithm>

#include "devlearn/detail/require.hpp"
#include "devlearn/math.hpp"

namespace devlearn {

SituationGrid::SituationGrid(double width, double height, int columns, int rows, int headings)
    : width_(width), height_(height), columns_(columns), rows_(rows), headings_(headings) {
  require_above("SituationGrid.width", width, 0.0, 10000.0, "m");
  require_above("SituationGrid.height", height, 0.0, 10000.0, "m");
  require_count("SituationGrid.columns", columns, 1, 100000);
  require_count("SituationGrid.rows", rows, 1, 100000);
  require_count("SituationGrid.headings", headings, 1, 3600);
  cell_width_ = width / columns;
  cell_height_ = height / rows;
  heading_step_ = 360.0 / headings;
}

SituationId SituationGrid::situation(double x, double y, double heading) const {
  require_in("x", x, 0.0, width_, "m");
  require_in("y", y, 0.0, height_, "m");
  require_finite("heading", heading);
  const int column = std::min(static_cast<int>(x / cell_width_), columns_ - 1);
  const int row = std::min(static_cast<int>(y / cell_height_), rows_ - 1);
  // The nearest bin; adding a half before rounding down would itself round, up across a border.
  const double wrapped = wrapped_heading(heading);
  int bin = static_cast<int>(wrapped / heading_step_);
  if (wrapped - bin * heading_step_ >= 0.5 * heading_step_) ++bin;
  return (static_cast<SituationId>(row) * columns_ + column) * headings_ + bin % headings_;
}

Pose SituationGrid::centre(SituationId situation) const {
  require_count("situation", situation, 0, count() - 1);
  const SituationId cell = situation / headings_;
  return {(static_cast<double>(cell % columns_) + 0.5) * cell_width_,
          (static_cast<double>(cell / columns_) + 0.5) * cell_height_,
          static_cast<double>(situation % headings_) * heading_step_};
}

SituationId SituationGrid::count() const noexcept {
  return static_cast<SituationId>(rows_) * columns_ * headings_;
}

}  // namespace devlearn
