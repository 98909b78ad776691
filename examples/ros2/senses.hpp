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
// (free as far as the scanner reaches), -inf too near to measure, NaN a failure. So is what lies
// beyond range_max, and 0, by which some drivers say "no echo". What is nearer than range_min is
// measured badly, and is there.
inline std::optional<double> beam_distance(double range, double range_min, double range_max) {
  if (!(0.0 <= range_min && range_min <= range_max)) return std::nullopt;
  if (range == std::numeric_limits<double>::infinity()) return range_max;
  if (range == -std::numeric_limits<double>::infinity()) return 0.0;
  if (0.0 < range && range < range_min) return 0.0;
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

constexpr double kLooked = 80.0 * kPi / 180.0;  // to either side of the way
constexpr double kBlind = 10.0 * kPi / 180.0;   // in a row: what may hide in it is small, or far

// How far it is free in a direction [m from the scanner], for what is 2 half_width [m] wide: up to
// the nearest echo in the strip that it would drive through; range_max where there is none. Nothing
// where more than kBlind in a row, within kLooked of the way, says nothing or is not looked at.
template <typename LaserScan>
std::optional<double> free_way(const LaserScan& scan, double direction, double half_width,
                               double mounting = 0.0) {
  const double step = scan.angle_increment;
  if (!(std::abs(step) > 1e-6) || !(std::abs(step) <= kBlind)) return std::nullopt;
  double nearest = scan.range_max;
  double heard_last = -kLooked - kBlind;
  const auto count = static_cast<double>(scan.ranges.size());
  // The beams from right to left, whichever way the scanner turns.
  const double first = direction - mounting - scan.angle_min;
  for (double beside = -kLooked; beside <= kLooked; beside += std::abs(step)) {
    const double turned = std::remainder(first + beside, 2.0 * kPi);
    double beam = std::round(turned / step);
    if (beam < 0.0) beam = std::round((turned + std::copysign(2.0 * kPi, step)) / step);
    if (!(beam >= 0.0 && beam < count)) continue;
    const auto distance =
        beam_distance(scan.ranges[static_cast<std::size_t>(beam)], scan.range_min, scan.range_max);
    if (!distance) continue;
    if (beside - heard_last > kBlind + std::abs(step)) return std::nullopt;
    heard_last = beside;
    const bool echo = *distance < scan.range_max;
    if (echo && *distance * std::abs(std::sin(beside)) < half_width) {
      nearest = std::fmin(nearest, *distance * std::cos(beside));
    }
  }
  if (kLooked - heard_last > kBlind) return std::nullopt;
  return nearest;
}

// Which motions may be chosen now: those into whose direction (turns [degrees]) it is free for
// `needed` m, half_width m to either side.
template <typename LaserScan, std::size_t N>
std::array<bool, N> allowed_motions(const LaserScan& scan, const std::array<double, N>& turns,
                                    double needed, double half_width, double mounting = 0.0) {
  std::array<bool, N> allowed{};
  for (std::size_t motion = 0; motion < N; ++motion) {
    const auto free = free_way(scan, turns[motion] * kPi / 180.0, half_width, mounting);
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
