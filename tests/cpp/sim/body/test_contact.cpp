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

TEST_CASE("Beside its middle a thin wall is met as a thick one, from either side, to the bit") {
  const World thick = with({Rectangle{{5.0, 5.0}, 8.0, 0.5, 0.0}}, 10.0);
  const World thin =
      with({Polyline{{{1.0, 4.75}, {9.0, 4.75}}}, Polyline{{{9.0, 5.25}, {1.0, 5.25}}}}, 10.0);
  Random random(16, "thin and thick");
  long contacts = 0, differ = 0;
  for (int n = 0; n < 200; ++n) {
    RobotDef def;
    def.radius = between(random, 0.03, 0.15);
    def.speed = between(random, 0.02, 0.2);
    const Robot robot(thick, def), other(thin, def);
    const double above = 5.25 + def.radius + between(random, -0.004, 0.03);
    const double x = between(random, 3.5, 6.5);
    Pose pose{x, n % 2 == 0 ? above : 10.0 - above, between(random, 0.0, 360.0)};
    for (int i = 0; i < 10; ++i) {
      const Robot::Move a = robot.step(pose, kAhead), b = other.step(pose, kAhead);
      differ += !(a.pose == b.pose) || a.collided != b.collided;
      contacts += a.collided;
      pose = a.pose;
    }
  }
  CHECK(differ == 0);
  CHECK(contacts > 500);
}

TEST_CASE("A room that is a hole is touched as an arena of its outline, to the bit") {
  const Point low{2.0, 1.5}, high{4.5, 3.5};
  WorldDef inner;
  inner.origin = low;
  inner.width = high.x - low.x;
  inner.height = high.y - low.y;
  inner.start = {3.0, 2.5, 0.0};
  inner.target = {4.0, 3.0};
  WorldDef around = inner;
  around.origin = {};
  around.width = around.height = 6.0;
  const std::vector<Point> outline{low, {low.x, high.y}, high, {high.x, low.y}};
  for (const bool turned : {false, true}) {
    std::vector<Point> hole = outline;
    if (turned) std::reverse(hole.begin() + 1, hole.end());
    around.obstacles = {Polygon{{{0.5, 0.5}, {5.5, 0.5}, {5.5, 5.5}, {0.5, 5.5}}, {hole}}};
    const World arena(inner), room(around);
    const Robot robot(arena, {}), other(room, {});
    Random random(17, "room");
    Pose pose = inner.start;
    long contacts = 0, differ = 0;
    double worst = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const int motion = random.index(4) == 0 ? static_cast<int>(random.index(5)) : kAhead;
      const Robot::Move a = robot.step(pose, motion), b = other.step(pose, motion);
      differ += !(a.pose == b.pose) || a.collided != b.collided;
      const Point at{a.pose.x, a.pose.y};
      worst = std::max(worst, std::abs(arena.wall_distance(at) - room.clearance(at)));
      contacts += a.collided;
      pose = a.pose;
    }
    CHECK(differ == 0);
    CHECK(worst < 1e-15);
    CHECK(contacts > 2000);
  }
}

namespace {

// A thin wall whose end lies in the middle of the arena, and places seen from there along a
// heading.
struct WallEnd {
  Direction ahead;
  Point at(double forwards, double left) const {
    return {5.0 + forwards * ahead.x - left * ahead.y, 5.0 + forwards * ahead.y + left * ahead.x};
  }
  double forwards(const Pose& pose) const {
    return (pose.x - 5.0) * ahead.x + (pose.y - 5.0) * ahead.y;
  }
  // With its other end there.
  Robot robot(Point other, const RobotDef& def) const {
    return Robot(with({Polyline{{at(0.0, 0.0), other}}}, 10.0), def);
  }
};

RobotDef random_body(Random& random) {
  RobotDef def;
  def.radius = between(random, 0.01, 0.15);
  def.speed = between(random, 0.02, 0.3);
  return def;
}

}  // namespace

TEST_CASE("Where its way leads beside the end of a thin wall a body gets past it, else not") {
  Random random(18, "ends");
  long wrong = 0;
  double deepest = 0.0;
  for (int n = 0; n < 400; ++n) {
    const RobotDef def = random_body(random);
    const double heading = between(random, 0.0, 360.0);
    const WallEnd end{direction(heading)};
    const Robot robot = end.robot(end.at(0.0, 1.0), def);
    const bool at_wall = n % 2 == 0;
    const Point from = end.at(-0.5, def.radius * between(random, 0.05, 0.9) * (at_wall ? 1 : -1));
    Pose pose{from.x, from.y, heading};
    for (int i = 0; i < 400 && end.forwards(pose) < 0.5; ++i) {
      pose = robot.step(pose, kAhead).pose;
      const double room = robot.world().clearance({pose.x, pose.y}, true);
      deepest = std::max(deepest, def.radius - room);
    }
    wrong += at_wall ? std::abs(end.forwards(pose) + def.radius) > 0.011 : end.forwards(pose) < 0.5;
  }
  CHECK(wrong == 0);
  CHECK(deepest <= 0.005);
}

TEST_CASE("Head-on a body drives up to the end of a thin wall") {
  Random random(19, "head-on");
  long wrong = 0, touched = 0;
  for (int n = 0; n < 2000; ++n) {
    const RobotDef def = random_body(random);
    const double heading = n % 4 == 0 ? 90.0 * random.index(4) : between(random, 0.0, 360.0);
    const WallEnd end{direction(heading)};
    const Robot robot = end.robot(end.at(1.0, 0.0), def);
    const double length = def.speed * def.sample_time;
    const Point from = end.at(-def.radius - between(random, 0.0, 0.9) * length, 0.0);
    const Robot::Move move = robot.step({from.x, from.y, heading}, kAhead);
    touched += move.collided;
    wrong += std::abs(end.forwards(move.pose) + def.radius) > 0.011;
  }
  CHECK(wrong == 0);
  CHECK(touched == 2000);
}

TEST_CASE("A drive is solved directly where it can be, however many surfaces it meets") {
  const World world = with({Circle{{2.5, 2.5}, 0.3}, Circle{{2.5, 3.1}, 0.3}});
  const RobotDef robot;
  const auto direct = [&](const Pose& pose) {
    return drive_directly(Scene(world, robot, pose, pose.heading, robot.speed, {}), kFewIterations);
  };
  MESSAGE("solved directly: " << solves_directly());
  CHECK(direct({0.105, 2.0, 180.0}).has_value() == solves_directly());
  CHECK(direct({2.1, 2.5, 0.0}).has_value() == solves_directly());
  CHECK(direct({0.105, 0.105, 225.0}).has_value() == solves_directly());
  CHECK(direct({2.24, 2.8, 0.0}).has_value() == solves_directly());
}

namespace {

// As lasers see a wall: corners a few centimetres apart, each a little off the line.
std::vector<Point> ragged_line(Random& random, double y) {
  std::vector<Point> line;
  for (double x = 0.5; x < 4.5; x += between(random, 0.02, 0.15)) {
    line.push_back({x, y + between(random, -0.06, 0.06)});
  }
  return line;
}

Polygon ragged_wall(Random& random) {
  std::vector<Point> corners = ragged_line(random, 2.5);
  corners.insert(corners.end(), {{4.5, 3.0}, {0.5, 3.0}});
  return {corners};
}

}  // namespace

TEST_CASE("A drive solved directly is that of a Box2D world, to the bit") {
  Random random(15, "direct");
  long drives = 0, touched = 0, passed = 0, differ = 0;
  // Of bodies near obstacles in a part of the arena.
  const auto compare = [&](const World& world, Point low, Point high, double least_radius) {
    RobotDef def;
    def.radius = between(random, least_radius, 0.15);
    // A third of them go further than the room that Box2D's tree leaves around a body.
    def.speed = random.index(3) == 0 ? between(random, 0.3, 2.0) : between(random, 0.02, 0.3);
    for (int i = 0; i < 400; ++i) {
      const Pose pose{between(random, low.x, high.x), between(random, low.y, high.y), 0.0};
      const double room = world.clearance({pose.x, pose.y}, true) - def.radius;
      if (room < -0.005 || room > 0.05) continue;
      const Scene scene(world, def, pose, between(random, 0.0, 360.0), def.speed, {});
      const int iterations = i % 4 == 0 ? kManyIterations : kFewIterations;
      const std::optional<Drive> solved = drive_directly(scene, iterations);
      const Drive expected = drive_in_box2d(scene, iterations);
      ++drives;
      touched += expected.touched;
      passed += expected.passed;
      if (!solved) continue;
      differ += !(solved->moved == expected.moved && solved->touched == expected.touched &&
                  solved->passed == expected.passed);
    }
  };
  for (int n = 0; n < 60; ++n) {
    compare(random_world(random, 12, 2.5), {0.0, 0.0}, {2.5, 2.5}, 0.03);
    compare(with({ragged_wall(random)}), {0.5, 2.2}, {4.5, 2.5}, 0.03);
    compare(with({Polyline{ragged_line(random, 2.4)}, Polyline{ragged_line(random, 2.5)}}),
            {0.5, 2.2}, {4.5, 2.7}, 0.01);
  }
  MESSAGE(drives << " drives, " << touched << " with contact, " << passed << " through an edge");
  CHECK(differ == 0);
  CHECK(touched > 8000);
}
