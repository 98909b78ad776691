#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "devlearn/math.hpp"
#include "maneuver.hpp"

using namespace devlearn_ros2;
using devlearn::Pose;

namespace {

constexpr double kTick = 0.05;  // [s]

// A robot that does as it is told.
void drive(Pose& pose, const Command& command) {
  pose.heading = devlearn::wrapped_heading(pose.heading + command.angular * kTick * 57.29577951);
  const devlearn::Direction ahead = devlearn::direction(pose.heading);
  pose.x += command.linear * kTick * ahead.x;
  pose.y += command.linear * kTick * ahead.y;
}

bool stands(const Command& command) { return command.linear == 0.0 && command.angular == 0.0; }

}  // namespace

TEST_CASE("a motion turns on the spot, then drives its way, whatever the turn and the heading") {
  for (const double from : {0.0, 10.0, 200.0, 350.0}) {
    for (const double turn : {0.0, 60.0, -60.0, 120.0, -120.0, 180.0}) {
      CAPTURE(from);
      CAPTURE(turn);
      Pose pose{1.0, 2.0, from};
      Maneuver maneuver(pose, turn, 0.25, 100.0, {});
      int ticks = 0, wrong = 0;
      while (maneuver.outcome() == Outcome::kUnderWay) {
        REQUIRE(++ticks < 200);
        const Command command = maneuver.tick(pose, 100.0 + ticks * kTick);
        wrong += command.linear != 0.0 && command.angular != 0.0;
        wrong += std::abs(command.linear) > 0.1 || std::abs(command.angular) > 0.8;
        wrong += maneuver.driving() != (command.linear > 0.0);
        drive(pose, command);
      }
      CHECK(maneuver.outcome() == Outcome::kDone);
      CHECK(ticks > 40);  // it takes many of them
      CHECK(wrong == 0);
      CHECK(std::abs(std::remainder(pose.heading - from - turn, 360.0)) <= 3.0);
      CHECK(std::hypot(pose.x - 1.0, pose.y - 2.0) == doctest::Approx(0.25).epsilon(0.03));
      CHECK(stands(maneuver.tick(pose, 200.0)));
      CHECK(maneuver.outcome() == Outcome::kDone);
    }
  }
}

TEST_CASE("a motion that gets nowhere times out and stops") {
  const Pose stuck{0.0, 0.0, 0.0};
  for (const double turn : {0.0, 60.0}) {
    Maneuver maneuver(stuck, turn, 0.25, 5.0, {});
    CHECK_FALSE(stands(maneuver.tick(stuck, 15.0)));
    CHECK(stands(maneuver.tick(stuck, 15.01)));
    CHECK(maneuver.outcome() == Outcome::kTimedOut);
    maneuver.preempt();  // too late: it was over
    CHECK(maneuver.outcome() == Outcome::kTimedOut);
  }
}

TEST_CASE("a clock that goes backwards or says nothing ends a motion and teaches nothing") {
  for (const double now : {4.9, std::numeric_limits<double>::quiet_NaN()}) {
    Maneuver maneuver({}, 0.0, 0.25, 5.0, {});
    CHECK(stands(maneuver.tick({}, now)));
    CHECK(maneuver.outcome() == Outcome::kPreempted);
    CHECK_FALSE(lesson(maneuver.outcome(), 10.0, 10.5));
  }
}

TEST_CASE("a preempted motion commands nothing any more") {
  Maneuver maneuver({}, 60.0, 0.25, 0.0, {});
  CHECK_FALSE(stands(maneuver.tick({}, 0.05)));
  maneuver.preempt();
  CHECK(stands(maneuver.tick({}, 0.10)));
  CHECK(maneuver.outcome() == Outcome::kPreempted);
  CHECK_FALSE(maneuver.driving());
}

TEST_CASE("what was done teaches what it was, a time-out never good, a preemption nothing") {
  CHECK(lesson(Outcome::kDone, 10.0, 10.5) == 0.5);
  CHECK(lesson(Outcome::kDone, 10.5, 10.0) == -0.5);
  CHECK(lesson(Outcome::kTimedOut, 10.0, 10.5) == -1.0);
  CHECK(lesson(Outcome::kTimedOut, 10.0, 7.0) == -3.0);
  CHECK_FALSE(lesson(Outcome::kPreempted, 10.0, 10.5));
  CHECK_FALSE(lesson(Outcome::kUnderWay, 10.0, 10.5));
}

TEST_CASE("a robot that is turned aside while it drives, or is nowhere, stops and learns nothing") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Pose& pushed : {Pose{0.1, 0.0, 80.0}, Pose{0.1, 0.0, 300.0}, Pose{nan, 0.0, 0.0},
                             Pose{0.0, nan, 0.0}, Pose{0.0, 0.0, nan}}) {
    Maneuver maneuver({}, 0.0, 0.25, 0.0, {});
    CHECK(maneuver.tick({0.0, 0.0, 0.0}, 0.9).linear > 0.0);
    CHECK(maneuver.tick({0.1, 0.0, 20.0}, 1.0).linear > 0.0);
    CHECK(stands(maneuver.tick(pushed, 1.1)));
    CHECK(maneuver.outcome() == Outcome::kPreempted);
    CHECK_FALSE(lesson(maneuver.outcome(), 0.0, 5.0));
  }
  // A way that is no number is none.
  Maneuver maneuver({}, 0.0, nan, 0.0, {});
  CHECK(stands(maneuver.tick({}, 0.1)));
  CHECK(maneuver.outcome() == Outcome::kDone);
}
