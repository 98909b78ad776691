#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "devlearn/learner.hpp"
#include "devlearn/situation.hpp"
#include "senses.hpp"

using namespace devlearn_ros2;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kDegree = kPi / 180.0;

// The fields of sensor_msgs/msg/LaserScan that are read: floats, as there.
struct Scan {
  float angle_min = -static_cast<float>(kPi);
  float angle_increment = static_cast<float>(kDegree);
  float range_min = 0.25F, range_max = 8.0F;
  std::vector<float> ranges = std::vector<float>(360, kInfinity);

  // The beam at whole degrees from straight ahead.
  float& at(int degrees) { return ranges[static_cast<std::size_t>(180 + degrees)]; }
};

struct Vector {
  double x, y, z;
};
struct Quaternion {
  double x, y, z, w;
};
struct Transform {
  Vector translation;
  Quaternion rotation;
};

Quaternion rotation(double yaw_degrees) {
  return {0.0, 0.0, std::sin(yaw_degrees * kDegree / 2), std::cos(yaw_degrees * kDegree / 2)};
}

}  // namespace

TEST_CASE("a beam's infinity is free, minus infinity too near, and NaN or out of range unknown") {
  CHECK(beam_distance(1.5, 0.25, 8.0) == 1.5);
  CHECK(beam_distance(0.25, 0.25, 8.0) == 0.25);
  CHECK(beam_distance(8.0, 0.25, 8.0) == 8.0);
  CHECK(beam_distance(kInfinity, 0.25, 8.0) == 8.0);
  CHECK(beam_distance(-kInfinity, 0.25, 8.0) == 0.0);
  for (const double unknown : {0.0, 0.2499, 8.001, 65.533, -1.0, double{kNaN}}) {
    CAPTURE(unknown);
    CHECK_FALSE(beam_distance(unknown, 0.25, 8.0));
  }
  // Of a scanner whose range is none, nothing is believed.
  CHECK_FALSE(beam_distance(1.0, kNaN, 8.0));
  CHECK_FALSE(beam_distance(kInfinity, 0.25, kNaN));
  CHECK_FALSE(beam_distance(kInfinity, 0.25, -1.0));
}

TEST_CASE("a sonar hears the nearest echo of its cone and nothing beside it") {
  Scan scan;
  CHECK(nearest_echo(scan, 0.0, 15 * kDegree) == 8.0);
  scan.at(10) = 2.0F;
  scan.at(-5) = 3.0F;
  scan.at(20) = 1.0F;
  scan.at(0) = kNaN;
  scan.at(1) = 0.0F;
  CHECK(nearest_echo(scan, 0.0, 15 * kDegree) == 2.0);
  CHECK(nearest_echo(scan, 30 * kDegree, 15 * kDegree) == 1.0);
  CHECK(nearest_echo(scan, -20 * kDegree, 10 * kDegree) == 8.0);
  scan.at(-5) = -kInfinity;
  CHECK(nearest_echo(scan, 0.0, 15 * kDegree) == 0.0);
}

TEST_CASE("a cone goes on behind the robot, where the scan's ends meet") {
  Scan scan;
  scan.at(-175) = 1.0F;
  scan.at(175) = 2.0F;
  for (const double back : {180.0, -180.0, 540.0}) {
    CHECK(nearest_echo(scan, back * kDegree, 10 * kDegree) == 1.0);
  }
  CHECK(nearest_echo(scan, 172 * kDegree, 6 * kDegree) == 2.0);
}

TEST_CASE("a scanner that is mounted turned hears in the robot's directions") {
  Scan scan;
  scan.at(0) = 1.0F;
  CHECK(nearest_echo(scan, 90 * kDegree, 5 * kDegree, 90 * kDegree) == 1.0);
  CHECK(nearest_echo(scan, 0.0, 5 * kDegree, 90 * kDegree) == 8.0);
}

TEST_CASE("where the scan says too little, the distance is unknown and not free") {
  Scan scan;
  // Of 21 beams ten are enough by half, nine are not.
  for (int degrees = -10; degrees <= -1; ++degrees) scan.at(degrees) = kNaN;
  CHECK(nearest_echo(scan, 0.0, 10.5 * kDegree) == 8.0);
  scan.at(0) = kNaN;
  CHECK_FALSE(nearest_echo(scan, 0.0, 10.5 * kDegree));
  scan.ranges.assign(360, kNaN);
  CHECK_FALSE(nearest_echo(scan, 0.0, kPi));
  scan.ranges.clear();
  CHECK_FALSE(nearest_echo(scan, 0.0, kPi));
  // Before the robot alone: it does not know what is behind it.
  Scan front;
  front.angle_min = -1.0F;
  front.ranges.assign(115, 2.0F);
  CHECK(nearest_echo(front, 0.0, 0.3) == 2.0);
  CHECK_FALSE(nearest_echo(front, kPi, 0.3));
  Scan broken;
  broken.angle_increment = kNaN;
  CHECK_FALSE(nearest_echo(broken, 0.0, 0.3));
}

TEST_CASE("motions towards what is near or unknown are not allowed, and never chosen") {
  const std::array<double, 4> turns{0.0, 90.0, 180.0, -90.0};
  Scan scan;
  scan.at(5) = 0.4F;
  scan.at(85) = 0.6F;
  for (int degrees = -100; degrees <= -80; ++degrees) scan.at(degrees) = kNaN;
  const auto allowed = allowed_motions(scan, turns, 0.5, 10 * kDegree);
  CHECK(allowed == std::array<bool, 4>{false, true, true, false});

  devlearn::LearnerConfig config;
  config.motion_count = 4;
  devlearn::Learner learner(config, 1);
  for (int i = 0; i < 200; ++i) {
    const int motion = learner.choose(7, allowed).motion;
    REQUIRE(allowed[static_cast<std::size_t>(motion)]);
    learner.learn(i % 3 - 1.0);
  }
}

TEST_CASE("a quaternion's yaw is its heading, whatever its length and sign") {
  for (const double yaw : {0.0, 30.0, 90.0, 179.0, -179.0, -45.0}) {
    CAPTURE(yaw);
    const Quaternion q = rotation(yaw);
    CHECK(*yaw_of(q) == doctest::Approx(yaw * kDegree));
    CHECK(*yaw_of(Quaternion{-q.x, -q.y, -q.z, -q.w}) == doctest::Approx(yaw * kDegree));
    CHECK(*yaw_of(Quaternion{0.0, 0.0, 3 * q.z, 3 * q.w}) == doctest::Approx(yaw * kDegree));
  }
  // On a slope of 20 degrees, pitched about the robot's own y axis.
  const Quaternion q = rotation(60.0);
  const double s = std::sin(10 * kDegree), c = std::cos(10 * kDegree);
  CHECK(*yaw_of(Quaternion{-q.z * s, q.w * s, q.z * c, q.w * c}) ==
        doctest::Approx(60.0 * kDegree));
}

TEST_CASE("what is no rotation or no place gives no pose") {
  CHECK_FALSE(yaw_of(Quaternion{0.0, 0.0, 0.0, 0.0}));
  CHECK_FALSE(yaw_of(Quaternion{0.0, 0.0, double{kNaN}, 1.0}));
  CHECK_FALSE(yaw_of(Quaternion{0.0, 0.0, double{kInfinity}, 1.0}));
  CHECK_FALSE(pose_of(Transform{{double{kNaN}, 0.0, 0.0}, rotation(0.0)}));
  CHECK_FALSE(pose_of(Transform{{0.0, double{kInfinity}, 0.0}, rotation(0.0)}));
  CHECK_FALSE(pose_of(Transform{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}}));
}

TEST_CASE("a transform's radians become the situation of its degrees, outside the map, too") {
  const devlearn::SituationGrid grid(5.0, 5.0, 20, 20, 12, {-2.5, -2.5}, devlearn::Outside::kClamp);
  const auto pose = pose_of(Transform{{1.0, -2.0, 0.3}, rotation(-90.0)});
  REQUIRE(pose);
  CHECK(pose->x == 1.0);
  CHECK(pose->y == -2.0);
  CHECK(pose->heading == doctest::Approx(270.0));
  CHECK(grid.situation(*pose) == grid.situation(1.0, -2.0, 270.0));
  const auto outside = pose_of(Transform{{2.7, 0.0, 0.0}, rotation(30.0)});
  CHECK(grid.situation(*outside) == grid.situation(2.49, 0.0, 30.0));
}
