#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "body/direct_contact.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "sim/world/random_worlds.hpp"

// What a contact does: the body loses what leads it into a surface, and keeps what leads along it.

using namespace devlearn;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr int kAhead = 2;
constexpr double kLength = 0.05;  // v t_s

World with(std::vector<Obstacle> obstacles, double side = 5.0) {
  WorldDef def;
  def.width = def.height = side;
  def.start = {0.2, 0.2, 0.0};
  def.target = {0.3, 0.3};
  def.obstacles = std::move(obstacles);
  return World(def);
}

// A long wall at an angle through the middle of the arena.
struct Wall {
  explicit Wall(double degrees) : along(direction(degrees)), angle(degrees) {}
  World world() const { return with({Rectangle{{5.0, 5.0}, 8.0, 0.5, angle}}, 10.0); }
  // A pose beside it, headed for it at an angle.
  Pose at(double away, double towards) const {
    return {5.0 - away * along.y, 5.0 + away * along.x, wrapped_heading(angle - towards)};
  }
  Direction along;
  double angle;
};

}  // namespace

TEST_CASE("Along a wall a step moves v t cos(angle), wherever the wall begins to be touched") {
  double worst = 0.0;
  long contacts = 0;
  for (const double degrees : {0.0, 17.0, 90.0, 135.0, 200.0}) {
    const Wall wall(degrees);
    for (const double radius : {0.03, 0.1, 0.15}) {
      RobotDef def;
      def.radius = radius;
      const Robot robot(wall.world(), def);
      for (const double towards : {5.0, 20.0, 45.0, 70.0, 89.0, 100.0, 135.0, 170.0}) {
        // From within the slop, at the surface, in Box2D's skin, and short of it.
        for (const double gap : {-0.004, 0.0, 0.008, 0.02}) {
          Pose pose = wall.at(0.25 + radius + gap, towards);
          for (int i = 0; i < 20; ++i) {
            const Robot::Move move = robot.step(pose, kAhead);
            const double dx = move.pose.x - pose.x, dy = move.pose.y - pose.y;
            const double gone = dx * wall.along.x + dy * wall.along.y;
            worst = std::max(worst, std::abs(gone - kLength * std::cos(towards * kDegree)));
            contacts += move.collided;
            pose = move.pose;
          }
        }
      }
    }
  }
  MESSAGE(contacts << " contacts, off by at most " << worst << " m");
  CHECK(contacts > 5000);
  CHECK(worst < 1e-7);
}

namespace {

// A body driven straight on around a circle.
struct Rounding {
  double obstacle, radius, heading, length;  // v t_s
  static constexpr Point kCenter{2.5, 2.5};

  Robot robot() const {
    RobotDef def;
    def.radius = radius;
    def.speed = length / def.sample_time;
    return Robot(with({Circle{kCenter, obstacle}}), def);
  }
  double rho() const { return obstacle + radius; }
  // The pose at an angle [radians] from where the heading leads straight at the circle, so deep in
  // it [m].
  Pose at(double t, double depth = 0.0) const {
    const double facing = (heading + 180.0) * kDegree + t;
    const double away = rho() - depth;
    return {kCenter.x + away * std::cos(facing), kCenter.y + away * std::sin(facing), heading};
  }
  double angle_of(const Pose& pose) const {
    const double facing = std::atan2(pose.y - kCenter.y, pose.x - kCenter.x) / kDegree;
    return std::remainder(facing - heading - 180.0, 360.0) * kDegree;
  }
};

template <typename F>
void for_each_rounding(const F& f) {
  for (const double obstacle : {0.05, 0.2, 1.0}) {
    for (const double radius : {0.05, 0.1, 0.15}) {
      for (const double heading : {0.0, 30.0, 137.0, 270.0}) {
        for (const double length : {0.05, 0.02, 0.005}) {
          for (const double t : {-75.0, -60.0, -20.0, -3.0, 5.0, 15.0, 45.0}) {
            f(Rounding{obstacle, radius, heading, length}, t * kDegree);
          }
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("Touching a circle a step moves v t cos(angle to the tangent) along that tangent") {
  double worst = 0.0;
  for_each_rounding([&](const Rounding& rounding, double t) {
    const Pose pose = rounding.at(t, 0.001);  // less than the slop, so that nothing pushes it out
    const Robot::Move move = rounding.robot().step(pose, kAhead);
    CHECK(move.collided);
    const double facing = (rounding.heading + 180.0) * kDegree + t;
    const double along = rounding.length * std::sin(t);
    worst = std::max(worst, std::hypot(move.pose.x - pose.x + along * std::sin(facing),
                                       move.pose.y - pose.y - along * std::cos(facing)));
  });
  MESSAGE("off by at most " << worst << " m");
  CHECK(worst < 1e-7);
}

// At the angle t from where the heading leads straight at the circle, the speed along the tangent
// is v sin t, so that dt/dtime = v sin(t) / rho: tan(t/2) grows by exp(v time / rho). Steps along
// tangents follow that as Euler's rule does, each off by no more than half of length^2 / rho.
TEST_CASE("Around a circle steps follow the integral of v cos(angle to the tangent)") {
  double worst = 0.0;
  long steps = 0;
  for_each_rounding([&](const Rounding& rounding, double first) {
    const Robot robot = rounding.robot();
    Pose pose = rounding.at(first);
    for (int i = 0; i < 100; ++i, ++steps) {
      const double turn = rounding.length / rounding.rho();
      const double after =
          2.0 * std::atan(std::tan(0.5 * rounding.angle_of(pose)) * std::exp(turn));
      if (std::abs(after) > 85.0 * kDegree) break;  // soon past it
      pose = robot.step(pose, kAhead).pose;
      worst = std::max(worst, std::abs(rounding.angle_of(pose) - after) / (0.5 * turn * turn));
    }
  });
  MESSAGE(steps << " steps, off by at most " << worst << " of what their length allows");
  CHECK(steps > 5000);
  CHECK(worst <= 1.0);
}

TEST_CASE("A drive along one surface is solved directly where it can be, along several never") {
  const World world = with({Circle{{2.5, 2.5}, 0.3}, Circle{{2.5, 3.1}, 0.3}});
  const RobotDef robot;
  const auto direct = [&](const Pose& pose) {
    return drive_directly(Scene(world, robot, pose, pose.heading), kFewIterations);
  };
  MESSAGE("solved directly: " << solves_directly());
  CHECK(direct({0.105, 2.0, 180.0}).has_value() == solves_directly());
  CHECK(direct({2.1, 2.5, 0.0}).has_value() == solves_directly());
  CHECK_FALSE(direct({0.105, 0.105, 225.0}));
  CHECK_FALSE(direct({2.24, 2.8, 0.0}));
}

TEST_CASE("A drive solved directly is that of a Box2D world, to the bit") {
  Random random(15, "direct");
  long direct = 0, several = 0, differ = 0;
  for (int n = 0; n < 60; ++n) {
    RobotDef def;
    def.radius = between(random, 0.03, 0.15);
    def.speed = between(random, 0.02, 0.3);
    const World world = random_world(random, 12, 2.5);
    for (int i = 0; i < 300; ++i) {
      const auto pose = free_pose(random, world, def.radius - 0.005);
      if (!pose || world.clearance({pose->x, pose->y}, true) > def.radius + 0.05) continue;
      const Scene scene(world, def, *pose, between(random, 0.0, 360.0));
      const std::optional<Drive> solved = drive_directly(scene, kFewIterations);
      const Drive expected = drive_in_box2d(scene, kFewIterations);
      several += !solved;
      if (!solved) continue;
      ++direct;
      differ += !(solved->moved == expected.moved && solved->touched == expected.touched);
    }
  }
  MESSAGE(direct << " drives solved directly, " << several << " not");
  CHECK(differ == 0);
  CHECK(direct + several > 2000);
}
