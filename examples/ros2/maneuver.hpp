// One motion of the learner's, carried out over many ticks of control: a turn, then a way ahead.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "devlearn/math.hpp"
#include "devlearn/situation.hpp"

namespace devlearn_ros2 {

struct Command {
  double linear = 0.0;   // [m/s]
  double angular = 0.0;  // counter-clockwise [rad/s]
};

enum class Outcome {
  kUnderWay,
  kDone,
  kTimedOut,   // it tried, and the world did not let it
  kPreempted,  // someone else took over, turned the robot aside, or set the clock back
};

class Maneuver {
 public:
  struct Limits {
    double linear = 0.1;     // [m/s]
    double angular = 0.8;    // [rad/s]
    double tolerance = 3.0;  // of the heading [degrees]
    double patience = 10.0;  // [s]
    double astray = 30.0;    // of the heading, while it drives [degrees]
  };

  // turn: counter-clockwise [degrees]; way: then ahead [m]; now: of any clock [s].
  Maneuver(const devlearn::Pose& from, double turn, double way, double now, const Limits& limits)
      : from_(from), way_(way), began_(now), limits_(limits) {
    from_.heading = devlearn::wrapped_heading(from.heading + turn);
  }

  // What to drive until the next tick; nothing once it is over.
  Command tick(const devlearn::Pose& here, double now) {
    if (outcome_ != Outcome::kUnderWay) return {};
    // The clock was set back, or the robot is nowhere: nobody knows what was done.
    if (!(now >= began_) || !std::isfinite(here.x + here.y + here.heading)) {
      outcome_ = Outcome::kPreempted;
      return {};
    }
    if (now - began_ > limits_.patience) {
      outcome_ = Outcome::kTimedOut;
      return {};
    }
    if (!turned_) {
      const double left = to_turn(here);
      turned_ = std::abs(left) <= limits_.tolerance;
      if (!turned_) return {0.0, std::clamp(left / 30.0, -1.0, 1.0) * limits_.angular};
    }
    if (std::abs(to_turn(here)) > limits_.astray) {
      outcome_ = Outcome::kPreempted;
      return {};
    }
    const devlearn::Direction ahead = devlearn::direction(from_.heading);
    const double driven = (here.x - from_.x) * ahead.x + (here.y - from_.y) * ahead.y;
    if (!(driven < way_)) {
      outcome_ = Outcome::kDone;
      return {};
    }
    return {limits_.linear, 0.0};
  }

  // Someone else drives from now on: a person, a safety stop, a planner.
  void preempt() {
    if (outcome_ == Outcome::kUnderWay) outcome_ = Outcome::kPreempted;
  }

  Outcome outcome() const { return outcome_; }
  bool driving() const { return turned_ && outcome_ == Outcome::kUnderWay; }

 private:
  // [degrees]; a turn of half a circle may begin either way, and then goes on.
  double to_turn(const devlearn::Pose& here) const {
    return std::remainder(from_.heading - here.heading, 360.0);
  }

  devlearn::Pose from_;  // with the heading to drive in
  double way_, began_;
  Limits limits_;
  bool turned_ = false;
  Outcome outcome_ = Outcome::kUnderWay;
};

// The SMF to learn from, or nothing, where the choice is to be cancelled. What was done is learned
// as it came out. What timed out is what this motion comes to here: a lesson, and never a good one.
// After a preemption the pose is someone else's doing: it says nothing about the motion.
inline std::optional<double> lesson(Outcome outcome, double sef_before, double sef_after) {
  switch (outcome) {
    case Outcome::kDone:
      return sef_after - sef_before;
    case Outcome::kTimedOut:
      return std::min(sef_after - sef_before, -1.0);
    default:
      return std::nullopt;
  }
}

}  // namespace devlearn_ros2
