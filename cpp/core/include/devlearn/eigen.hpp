#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <type_traits>

#include "devlearn/choice.hpp"
#include "devlearn/detail/require.hpp"
#include "devlearn/evaluation.hpp"
#include "devlearn/math.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// For those who embed with Eigen: what devlearn computes of many, filled in one call into memory
/// of the caller's, and poses as transforms. Blocks, columns and maps are taken as they lie;
/// nothing is allocated where their values are next to each other. All throw InvalidValue where
/// shapes do not fit or a value is refused; nothing was written then.

/// SEF of many (Eq. 6): of the goal distances d_g [m] and obstacle distances d_o [m], n of each,
/// one value for each pair.
inline void fill_evaluations(const StateEvaluation& evaluation,
                             const Eigen::Ref<const Eigen::ArrayXd>& goal_distances,
                             const Eigen::Ref<const Eigen::ArrayXd>& obstacle_distances,
                             Eigen::Ref<Eigen::ArrayXd> sef) {
  const auto count = static_cast<std::size_t>(goal_distances.size());
  require_size("obstacle_distances", static_cast<std::size_t>(obstacle_distances.size()), count);
  require_size("sef", static_cast<std::size_t>(sef.size()), count);
  evaluation.evaluate(goal_distances.data(), obstacle_distances.data(), count, sef.data());
}

/// The situations of many poses: one a column, x [m], y [m], heading [degrees].
inline void fill_situations(const SituationGrid& grid,
                            const Eigen::Ref<const Eigen::Matrix3Xd>& poses,
                            Eigen::Ref<Eigen::Array<SituationId, Eigen::Dynamic, 1>> ids) {
  const auto count = static_cast<std::size_t>(poses.cols());
  require_size("ids", static_cast<std::size_t>(ids.size()), count);
  grid.situations(poses.data(), static_cast<std::size_t>(poses.outerStride()), count, ids.data());
}

/// Which motions may be chosen, of an array or vector of bools with one a motion: a view of it.
template <typename Derived>
AllowedMotions allowed_motions(const Eigen::PlainObjectBase<Derived>& allowed) {
  static_assert(std::is_same_v<typename Derived::Scalar, bool>, "an array of bool");
  return {allowed.data(), static_cast<std::size_t>(allowed.size())};
}
template <typename Derived>
AllowedMotions allowed_motions(Eigen::PlainObjectBase<Derived>&&) = delete;  // it would be gone

/// The transform from the robot's frame, x ahead and y to the left, into the world's. The heading
/// must be finite.
inline Eigen::Isometry2d to_isometry(const Pose& pose) {
  require_finite("heading", pose.heading);
  const Direction ahead = direction(pose.heading);
  Eigen::Isometry2d isometry = Eigen::Isometry2d::Identity();
  isometry.linear() << ahead.x, -ahead.y, ahead.y, ahead.x;
  isometry.translation() << pose.x, pose.y;
  return isometry;
}

/// The reverse: the pose of a robot whose frame this is, its heading in [0, 360) degrees. A heading
/// of whole degrees comes back as it was. Where it points must be finite, and not zero.
inline Pose to_pose(const Eigen::Isometry2d& isometry) {
  const Eigen::Vector2d ahead = isometry.linear().col(0), place = isometry.translation();
  require_finite("linear.x", ahead.x());
  require_finite("linear.y", ahead.y());
  if (ahead.isZero(0.0)) refuse("linear", "zero", "a rotation");
  return {place.x(), place.y(), heading_of({ahead.x(), ahead.y()})};
}

}  // namespace devlearn
