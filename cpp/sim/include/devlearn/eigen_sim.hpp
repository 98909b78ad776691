#pragma once

#include <cstddef>
#include <vector>

#include "devlearn/eigen.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

/// As devlearn/eigen.hpp, for worlds and robots.

/// d_o of many points at a time [s], one a column [m]: World::clearance of each, which must be
/// finite.
inline void fill_clearances(const World& world, const Eigen::Ref<const Eigen::Matrix2Xd>& points,
                            Eigen::Ref<Eigen::ArrayXd> clearances, bool walls_count = false,
                            double time = 0.0) {
  require_size("clearances", static_cast<std::size_t>(clearances.size()),
               static_cast<std::size_t>(points.cols()));
  require_each(static_cast<std::size_t>(points.cols()), [&](std::size_t i) {
    const auto column = static_cast<Eigen::Index>(i);
    require_finite("points.x", points(0, column));
    require_finite("points.y", points(1, column));
  });
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    clearances(i) = world.clearance({points(0, i), points(1, i)}, walls_count, time);
  }
}

/// Robot::sonar at a time [s]: sonar_count echoes [m].
inline void fill_echoes(const Robot& robot, const Pose& pose, Eigen::Ref<Eigen::ArrayXd> echoes,
                        double time = 0.0) {
  require_size("echoes", static_cast<std::size_t>(echoes.size()),
               static_cast<std::size_t>(robot.def().sonar_count));
  robot.sonar(pose, echoes.data(), time);
}

/// A polygon whose corners are the columns [m].
inline Polygon to_polygon(const Eigen::Ref<const Eigen::Matrix2Xd>& corners) {
  Polygon polygon;
  polygon.corners.reserve(static_cast<std::size_t>(corners.cols()));
  for (Eigen::Index i = 0; i < corners.cols(); ++i) {
    polygon.corners.push_back({corners(0, i), corners(1, i)});
  }
  return polygon;
}

}  // namespace devlearn
