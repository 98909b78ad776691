// What a ROS robot senses, as devlearn wants it. Nothing here includes ROS: a message is anything
// with its fields, so that all of it is tested without ROS.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "devlearn/situation.hpp"

namespace devlearn_ros2 {

constexpr double kPi = 3.14159265358979323846;

// What one beam says of the distance [m]; nothing where it says nothing. By REP 117, inf is no echo
// (free as far as the scanner reaches), -inf too near to measure, NaN a failure. Finite values out
// of range are to be discarded; there are drivers that say "no echo" by 0.
inline std::optional<double> beam_distance(double range, double range_min, double range_max) {
  if (!(0.0 <= range_min && range_min <= range_max)) return std::nullopt;
  if (range == std::numeric_limits<double>::infinity()) return range_max;
  if (range == -std::numeric_limits<double>::infinity()) return 0.0;
  if (range_min <= range && range <= range_max) return range;  // never NaN
  return std::nullopt;
}

// The sonar that a scan amounts to: the nearest echo [m from the scanner] within half_width of a
// direction, counter-clockwise from straight ahead; range_max where nothing came back. mounting:
// how the scanner is turned on the robot. All in radians. Nothing where fewer than half of the
// beams there say anything, or where there are none: unknown is not free.
template <typename LaserScan>
std::optional<double> nearest_echo(const LaserScan& scan, double direction, double half_width,
                                   double mounting = 0.0) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t beams = 0, heard = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double angle =
        mounting + scan.angle_min + static_cast<double>(i) * double{scan.angle_increment};
    if (!(std::abs(std::remainder(angle - direction, 2.0 * kPi)) <= half_width)) continue;
    ++beams;
    const auto distance = beam_distance(scan.ranges[i], scan.range_min, scan.range_max);
    if (!distance) continue;
    ++heard;
    nearest = std::fmin(nearest, *distance);
  }
  if (heard == 0 || 2 * heard < beams) return std::nullopt;
  return nearest;
}

// Which motions may be chosen now: those into whose direction (turns [degrees]) it is free for
// `needed` m.
template <typename LaserScan, std::size_t N>
std::array<bool, N> allowed_motions(const LaserScan& scan, const std::array<double, N>& turns,
                                    double needed, double half_width, double mounting = 0.0) {
  std::array<bool, N> allowed{};
  for (std::size_t motion = 0; motion < N; ++motion) {
    const auto free = nearest_echo(scan, turns[motion] * kPi / 180.0, half_width, mounting);
    allowed[motion] = free && *free >= needed;
  }
  return allowed;
}

// The yaw of a quaternion, of any length [radians]; nothing where it is no rotation, such as the
// zeros of a message that nobody filled in.
template <typename Quaternion>
std::optional<double> yaw_of(const Quaternion& q) {
  const double length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(length > 1e-6) || !std::isfinite(length)) return std::nullopt;
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

// A transform of tf from the map to the robot as devlearn's pose, its heading in degrees.
template <typename Transform>
std::optional<devlearn::Pose> pose_of(const Transform& transform) {
  const auto yaw = yaw_of(transform.rotation);
  const double x = transform.translation.x, y = transform.translation.y;
  if (!yaw || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  return devlearn::Pose::from_radians(x, y, *yaw);
}

}  // namespace devlearn_ros2
