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

TEST_CASE(
    "a beam's infinity is free, minus infinity and the nearest too near, and NaN or beyond "
    "unknown") {
  CHECK(beam_distance(1.5, 0.25, 8.0) == 1.5);
  CHECK(beam_distance(0.25, 0.25, 8.0) == 0.25);
  CHECK(beam_distance(8.0, 0.25, 8.0) == 8.0);
  CHECK(beam_distance(kInfinity, 0.25, 8.0) == 8.0);
  CHECK(beam_distance(-kInfinity, 0.25, 8.0) == 0.0);
  for (const double unknown : {0.0, 8.001, 65.533, -1.0, double{kNaN}}) {
    CAPTURE(unknown);
    CHECK_FALSE(beam_distance(unknown, 0.25, 8.0));
  }
  CHECK(beam_distance(0.2499, 0.25, 8.0) == 0.0);
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

TEST_CASE("a way is free up to what stands in the strip that the body drives through") {
  Scan scan;
  CHECK(free_way(scan, 0.0, 0.3) == 8.0);
  // 0.5 m off at 46 degrees: 0.36 m beside the way, 0.35 m ahead.
  scan.at(46) = 0.5F;
  CHECK(*free_way(scan, 0.0, 0.4) == doctest::Approx(0.5 * std::cos(46 * kDegree)).epsilon(0.03));
  CHECK(free_way(scan, 0.0, 0.35) == 8.0);
  CHECK(*free_way(scan, 46 * kDegree, 0.35) == doctest::Approx(0.5));
  CHECK(free_way(scan, kPi, 0.35) == 8.0);
  // What is too near to measure is there.
  scan.at(-20) = 0.1F;
  CHECK(free_way(scan, 0.0, 0.1) == 0.0);
  // The other way round, and across the scan's ends.
  Scan back;
  back.angle_min = static_cast<float>(kPi);
  back.angle_increment = -back.angle_increment;
  back.at(10) = 2.0F;  // ten degrees to the right
  CHECK(*free_way(back, -10 * kDegree, 0.1) == doctest::Approx(2.0).epsilon(0.001));
  scan.at(-178) = 3.0F;
  CHECK(*free_way(scan, 178 * kDegree, 0.3) == doctest::Approx(3.0).epsilon(0.01));
}

TEST_CASE("a way that is not looked at is not free") {
  Scan scan;
  for (int degrees = -4; degrees <= 4; ++degrees) scan.at(degrees) = kNaN;
  CHECK(free_way(scan, 0.0, 0.3) == 8.0);
  for (int degrees = -12; degrees <= 12; ++degrees) scan.at(degrees) = kNaN;
  CHECK_FALSE(free_way(scan, 0.0, 0.3));
  CHECK_FALSE(free_way(scan, 40 * kDegree, 0.3));
  CHECK(free_way(scan, 120 * kDegree, 0.3) == 8.0);
  // Of a scanner that looks ahead, the way ahead alone, and of a narrow one none.
  Scan front;
  front.angle_min = static_cast<float>(-kPi / 2);
  front.ranges.assign(181, 8.0F);
  CHECK(free_way(front, 0.0, 0.3) == 8.0);
  CHECK_FALSE(free_way(front, 60 * kDegree, 0.3));
  CHECK_FALSE(free_way(front, kPi, 0.3));
  front.angle_min = static_cast<float>(-kPi / 4);
  front.ranges.assign(91, 8.0F);
  CHECK_FALSE(free_way(front, 0.0, 0.3));
  Scan broken;
  broken.angle_increment = kNaN;
  CHECK_FALSE(free_way(broken, 0.0, 0.3));
  broken.angle_increment = 0.0F;
  CHECK_FALSE(free_way(broken, 0.0, 0.3));
}

TEST_CASE("motions towards what is near or unknown are not allowed, and never chosen") {
  const std::array<double, 4> turns{0.0, 90.0, 180.0, -90.0};
  Scan scan;
  scan.at(5) = 0.4F;
  scan.at(85) = 0.6F;
  for (int degrees = -100; degrees <= -80; ++degrees) scan.at(degrees) = kNaN;
  const auto allowed = allowed_motions(scan, turns, 0.5, 0.2);
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

TEST_CASE("a motion that is allowed never comes nearer than the margin to what was seen") {
  const std::array<double, 6> turns{0.0, 60.0, 120.0, 180.0, -120.0, -60.0};
  const double step = 0.25, margin = 0.1;
  double least_gap = 1.0;
  for (const double radius : {0.2, 0.3, 0.4}) {
    for (double away = radius + margin + 0.001; away < 1.2; away += 0.02) {
      for (int degrees = -180; degrees < 180; degrees += 2) {
        Scan scan;
        scan.at(degrees) = static_cast<float>(away);
        const auto allowed = allowed_motions(scan, turns, step + radius + margin, radius + margin);
        for (std::size_t m = 0; m < turns.size(); ++m) {
          for (double way = 0.0; allowed[m] && way <= step; way += 0.01) {
            least_gap = std::fmin(least_gap, std::hypot(away * std::cos(degrees * kDegree) -
                                                            way * std::cos(turns[m] * kDegree),
                                                        away * std::sin(degrees * kDegree) -
                                                            way * std::sin(turns[m] * kDegree)) -
                                                 radius);
          }
        }
      }
    }
  }
  // A beam is a degree wide.
  CHECK(least_gap > margin - 0.01);
  CHECK(least_gap < margin + 0.01);
}
