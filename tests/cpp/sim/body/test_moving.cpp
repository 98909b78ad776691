#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/shortest_path.hpp"
#include "devlearn/shortest_path_agent.hpp"
#include "many.hpp"
#include "sim/world/random_movers.hpp"

using namespace devlearn;

namespace {

constexpr double kSlop = 0.005;  // of Box2D [m]

double apart(const Pose& a, const Pose& b) { return std::hypot(a.x - b.x, a.y - b.y); }

Mover patrol(const std::variant<Circle, Rectangle>& shape, Point from, Point to, double speed,
             MoverPath::Then then = MoverPath::Then::kBack) {
  return {shape, MoverPath{{from, to}, speed, then}};
}

World with(const Mover& mover, std::vector<Obstacle> obstacles = {}) {
  WorldDef def;
  def.obstacles = std::move(obstacles);
  def.movers = {mover};
  return World(def);
}

bool same(const Robot::Move& a, const Robot::Move& b) {
  return a.pose == b.pose && a.collided == b.collided;
}

// The distance to what stands still.
double room(const Robot& robot, const Pose& pose) {
  return robot.world().standing().clearance({pose.x, pose.y}, true);
}

// How far the centre is from the nearest mover, below 0 inside, in another way than the product's.
double from_movers(const World& world, const Pose& pose, double time) {
  double least = std::numeric_limits<double>::infinity();
  for (const Obstacle& there : world.movers_at(time)) {
    if (const auto* circle = std::get_if<Circle>(&there)) {
      const double gap = std::hypot(pose.x - circle->center.x, pose.y - circle->center.y);
      least = std::min(least, gap - circle->radius);
      continue;
    }
    const auto& box = std::get<Rectangle>(there);
    const double angle = box.angle * 3.14159265358979323846 / 180.0;
    const double x = pose.x - box.center.x, y = pose.y - box.center.y;
    const double u = std::abs(std::cos(angle) * x + std::sin(angle) * y) - 0.5 * box.width;
    const double v = std::abs(std::cos(angle) * y - std::sin(angle) * x) - 0.5 * box.height;
    const double gap = u <= 0.0 || v <= 0.0 ? std::max(u, v) : std::hypot(u, v);
    least = std::min(least, gap);
  }
  return least;
}

double greatest_speed(const World& world) {
  double greatest = 0.0;
  for (const Mover& mover : world.def().movers) {
    if (const auto* path = std::get_if<MoverPath>(&mover.course)) {
      greatest = std::max(greatest, path->speed);
    } else {
      const auto& walk = std::get<MoverWalk>(mover.course);
      greatest = std::max(
          greatest, std::hypot(walk.high.x - walk.low.x, walk.high.y - walk.low.y) / walk.leg_time);
    }
  }
  return greatest;
}

}  // namespace

TEST_CASE("Where no mover comes near, a step is to the bit what it is without movers") {
  Random random(1, "far movers");
  long far = 0, contacts = 0;
  for (int n = 0; n < 100; ++n) {
    const World world = random_moving_world(random, 12, 2, 5.0);
    const Robot robot(world, {}), alone(world.standing(), {});
    const auto start = free_pose(random, world, 0.1);
    if (!start) continue;
    Pose pose = *start;
    for (int i = 0; i < 300; ++i) {
      const int motion = random.index(4) == 0 ? static_cast<int>(random.index(5)) : 2;
      const double time = 0.5 * i;
      const Robot::Move expected = alone.step(pose, motion);
      // In half a second a mover comes half a metre nearer, the robot 0.05 m.
      if (from_movers(world, pose, time) > 0.1 + 0.5 + 0.05 + 0.06) {
        ++far;
        contacts += expected.collided;
        REQUIRE(same(robot.step(pose, motion, time), expected));
      }
      pose = expected.pose;
    }
  }
  CHECK(far > 5000);
  CHECK(contacts > 200);
}

TEST_CASE("A step that touches nothing is Eq. 1, and was clear of every mover at every moment") {
  Random random(2, "free among movers");
  long free = 0;
  for (int n = 0; n < 100; ++n) {
    const World world = random_moving_world(random, 3, 6, 3.0);
    const Robot robot(world, {});
    for (int i = 0; i < 100; ++i) {
      const double time = between(random, 0.0, 300.0);
      const auto pose = free_pose(random, world, 0.1);
      if (!pose || from_movers(world, *pose, time) < 0.1) continue;
      const int motion = static_cast<int>(random.index(5));
      const Robot::Move move = robot.step(*pose, motion, time);
      if (move.collided) continue;
      ++free;
      const double turn = robot.def().steering_angles[static_cast<std::size_t>(motion)];
      const Direction ahead = direction(pose->heading + turn);
      REQUIRE(move.pose.x == doctest::Approx(pose->x + 0.05 * ahead.x));
      REQUIRE(move.pose.y == doctest::Approx(pose->y + 0.05 * ahead.y));
      REQUIRE(from_movers(world, move.pose, time + 0.5) > 0.1 - kSlop);
    }
  }
  CHECK(free > 1000);
}

TEST_CASE("A mover that hits a robot from behind pushes it along, and the step collides") {
  // The robot drives along at 0.1 m/s, the mover comes after it at 0.5 m/s.
  for (const bool round : {true, false}) {
    CAPTURE(round);
    std::variant<Circle, Rectangle> shape = Rectangle{{}, 0.4, 0.4, 0.0};
    if (round) shape = Circle{{}, 0.2};
    const World world = with(patrol(shape, {0.5, 2.5}, {4.5, 2.5}, 0.5));
    const Robot robot(world, {});
    Pose pose{1.0, 2.5, 0.0};
    bool touched = false;
    for (int i = 0; i < 12; ++i) {
      const Robot::Move move = robot.step(pose, 2, 0.5 * i);
      touched = touched || move.collided;
      pose = move.pose;
    }
    // After 6 s the mover's front is at 3.7 m; alone the robot were at 1.6 m.
    CHECK(touched);
    CHECK(pose.x > 3.7 + 0.1 - kSlop);
    CHECK(pose.x < 3.7 + 0.1 + 0.05);
    CHECK(pose.y == doctest::Approx(2.5));
    CHECK(pose.heading == 0.0);
  }
}

TEST_CASE("A robot that only presses against a wall collides with what comes along it") {
  const World world = with(patrol(Circle{{}, 0.2}, {4.0, 0.2}, {1.5, 0.2}, 0.2));
  const Robot robot(world, {});
  Pose pose = robot.step({2.5, 0.12, 270.0}, 2).pose;
  double furthest = 0.0;
  for (int i = 1; i < 30; ++i) {
    const Robot::Move move = robot.step(pose, 2, 0.5 * i);
    CHECK(move.collided);
    furthest = std::max(furthest, 2.5 - move.pose.x);
    pose = move.pose;
  }
  CHECK(furthest > 0.5);
}

TEST_CASE(
    "A mover pins a robot against a wall, goes over it, and leaves it where it can drive off") {
  for (const double speed : {0.05, 0.3, 1.0}) {
    for (const bool round : {true, false}) {
      CAPTURE(speed);
      CAPTURE(round);
      std::variant<Circle, Rectangle> shape = Rectangle{{}, 1.0, 1.0, 0.0};
      if (round) shape = Circle{{}, 0.5};
      const World world = with(patrol(shape, {2.5, 2.5}, {2.5, 0.1}, speed));
      const Robot robot(world, {});
      Pose pose{2.5, 0.3, 270.0};
      bool pinned = false;
      const int steps = static_cast<int>(std::ceil(2.4 / speed / 0.5));
      for (int i = 0; i < 2 * steps; ++i) {
        const Robot::Move move = robot.step(pose, 2, 0.5 * i);
        REQUIRE(room(robot, move.pose) >= 0.1 - kSlop);
        if (i > 0) REQUIRE(apart(move.pose, pose) <= 0.05 + 0.5 * speed + 0.05);
        pinned = pinned || from_movers(world, move.pose, 0.5 * (i + 1)) < 0.1 - kSlop;
        if (pinned && from_movers(world, move.pose, 0.5 * (i + 1)) < 0.1) CHECK(move.collided);
        pose = move.pose;
      }
      CHECK(pinned);
      // The mover is back where it was: the robot turns round and drives.
      const double later = 2.0 * steps * 0.5;
      REQUIRE(from_movers(world, pose, later) > 0.3);
      Robot::Move move{pose, false};
      for (int turn = 0; turn < 3; ++turn) move = robot.step(move.pose, 4, later);
      const Robot::Move off = robot.step(move.pose, 2, later);
      CHECK_FALSE(off.collided);
      CHECK(apart(off.pose, move.pose) == doctest::Approx(0.05));
    }
  }
}

TEST_CASE("From under a mover that stays on it, a robot drives out") {
  // It comes to rest over the wall at which the robot stands.
  const World world =
      with(patrol(Circle{{}, 0.4}, {2.5, 2.5}, {2.5, 0.35}, 0.3, MoverPath::Then::kStop));
  const Robot robot(world, {});
  Pose pose{2.5, 0.15, 270.0};
  double time = 0.0;
  for (; time < 20.0; time += 0.5) pose = robot.step(pose, 2, time).pose;
  REQUIRE(from_movers(world, pose, time) < 0.0);
  Random random(3, "out");
  long tries = 0;
  bool out = false;
  for (; tries < 3000 && !out; ++tries, time += 0.5) {
    const Robot::Move move = robot.step(pose, static_cast<int>(random.index(5)), time);
    REQUIRE(from_movers(world, move.pose, time) >= from_movers(world, pose, time) - 1e-6);
    pose = move.pose;
    out = from_movers(world, pose, time) > 0.1 + 0.01;
  }
  MESSAGE("out after " << tries << " steps by chance");
  CHECK(out);
}

TEST_CASE("A mover that leaves the body room never gets deeper into it than the slop") {
  Random random(7, "room");
  long pushed = 0;
  double deepest = 0.0;
  for (int n = 0; n < 6000; ++n) {
    const World world = random_moving_world(random, 0, 1, 10.0);
    const Robot robot(world, {});
    const double begin = between(random, 0.0, 200.0);
    // Beside it, far from the walls.
    const Point mover = centre_of(world.movers_at(begin)[0]);
    Pose pose{mover.x + between(random, -0.6, 0.6), mover.y + between(random, -0.6, 0.6),
              between(random, 0.0, 360.0)};
    if (from_movers(world, pose, begin) < 0.1) continue;
    for (int i = 0; i < 5 && room(robot, pose) > 1.2; ++i) {
      const double time = begin + 0.5 * i;
      const Robot::Move move = robot.step(pose, static_cast<int>(random.index(5)), time);
      pushed += move.collided;
      const double depth = 0.1 - from_movers(world, move.pose, time + 0.5);
      REQUIRE(depth <= kSlop + 1e-5);
      deepest = std::max(deepest, depth);
      pose = move.pose;
    }
  }
  MESSAGE(pushed << " steps pushed by a mover; deepest " << deepest << " m");
  CHECK(pushed > 1000);
}

TEST_CASE("Whatever moves around it, the body stays in the arena and out of what stands still") {
  Random random(4, "crowds");
  long steps = 0, collided = 0, pinned = 0;
  double deepest = 0.0, widest = 0.0;
  for (int n = 0; n < many(150); ++n) {
    RobotDef def;
    def.radius = between(random, 0.03, 0.15);
    def.speed = between(random, 0.02, 0.2);
    const World world = random_moving_world(random, 6, 5, 2.5);
    const Robot robot(world, def);
    const World still = world.standing();
    const auto start = free_pose(random, world, def.radius);
    if (!start) continue;
    Pose pose = *start;
    const double push = greatest_speed(world) * def.sample_time;
    for (int i = 0; i < 400; ++i) {
      const int motion = random.index(4) == 0 ? static_cast<int>(random.index(5)) : 2;
      const double time = 0.5 * i;
      const Robot::Move move = robot.step(pose, motion, time);
      ++steps;
      collided += move.collided;
      REQUIRE(std::isfinite(move.pose.x));
      REQUIRE(std::isfinite(move.pose.y));
      const double stand = still.clearance({move.pose.x, move.pose.y}, true);
      REQUIRE(stand >= def.radius - kSlop);
      deepest = std::max(deepest, def.radius - stand);
      widest = std::max(widest, apart(move.pose, pose) - def.speed * def.sample_time - push);
      const double depth = def.radius - from_movers(world, move.pose, time + 0.5);
      if (depth > kSlop) {
        ++pinned;
        REQUIRE(move.collided);
      }
      CHECK_NOTHROW(robot.sonar(move.pose, time));
      pose = move.pose;
    }
  }
  MESSAGE(steps << " steps, " << collided << " with contact, " << pinned
                << " pinned; deepest in what stands still " << deepest
                << " m; further than a step and the fastest mover by " << widest << " m");
  CHECK(steps > many(30'000));
  CHECK(pinned > many(100));
  CHECK(widest <= 0.05 + 1e-9);
}

TEST_CASE(
    "A step is a pure function of world, time, pose and motion, and of the world's own time") {
  Random random(5, "purity among movers");
  const World world = random_moving_world(random, 6, 6, 2.5);
  const Robot robot(world, {}), twin(world, {});
  struct Asked {
    Pose pose;
    int motion;
    double time;
    Robot::Move answer;
  };
  std::vector<Asked> history;
  Pose pose = free_pose(random, world, 0.1).value();
  for (int i = 0; i < 1500; ++i) {
    const int motion = random.index(4) == 0 ? static_cast<int>(random.index(5)) : 2;
    history.push_back({pose, motion, 0.5 * i, robot.step(pose, motion, 0.5 * i)});
    pose = history.back().answer.pose;
  }
  long contacts = 0, differ = 0, at_another_time = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const Asked& asked = history[random.index(static_cast<std::uint32_t>(history.size()))];
    contacts += asked.answer.collided;
    differ += !same(robot.step(asked.pose, asked.motion, asked.time), asked.answer);
    differ += !same(twin.step(asked.pose, asked.motion, asked.time), asked.answer);
    at_another_time += !same(robot.step(asked.pose, asked.motion, asked.time + 7.3), asked.answer);
  }
  CHECK(contacts > 200);
  CHECK(differ == 0);
  CHECK(at_another_time > 50);
}

TEST_CASE("A safety layer allows no motion into the way of what comes") {
  RobotDef def;
  def.safety_margin = 0.05;
  const Robot robot(with(patrol(Circle{{}, 0.2}, {2.5, 4.0}, {2.5, 1.0}, 0.5)), def);
  bool allowed[5];
  // Straight on leads over the mover's line, 0.4 m ahead.
  CHECK_FALSE(robot.allowed({2.12, 2.5, 0.0}, allowed, 0.0));
  CHECK(robot.allowed({2.12, 2.5, 0.0}, allowed, 2.5));
  CHECK_FALSE(allowed[2]);
  CHECK(allowed[0]);
}

TEST_CASE("Where a robot is put, no mover may be; where a mover pinned it, it may go on") {
  const Robot robot(with(patrol(Circle{{}, 0.2}, {1.0, 2.5}, {4.0, 2.5}, 0.1)), {});
  const Pose pose{2.0, 2.5, 0.0};
  CHECK_NOTHROW(robot.require_free(pose, 0.0));
  CHECK_THROWS_AS(robot.require_free(pose, 10.0), InvalidValue);
  CHECK_NOTHROW(robot.require_place(pose));
  CHECK_NOTHROW(robot.step(pose, 2, 10.0));
  CHECK_NOTHROW(robot.sonar(pose, 10.0));
  for (const double bad : {-0.1, 1.1e9, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(robot.step(pose, 2, bad), InvalidValue);
  }
  CHECK_NOTHROW(Robot(World(), {}).step(pose, 2, 1e12));
}

TEST_CASE("A course that leaves the body no room at the start is refused where a robot enters") {
  // The start is (0.5, 0.5).
  const World world = with(patrol(Circle{{}, 0.2}, {0.79, 0.2}, {0.79, 4.0}, 0.1));
  CHECK_THROWS_AS(Robot(world, {}).require_start(), InvalidValue);
  CHECK_NOTHROW(
      Robot(with(patrol(Circle{{}, 0.2}, {0.81, 0.2}, {0.81, 4.0}, 0.1)), {}).require_start());
  RobotDef small;
  small.radius = 0.05;
  CHECK_NOTHROW(Robot(world, small).require_start());
}

TEST_CASE("The shortest path, and who follows it, know of what stands still alone") {
  WorldDef def;
  def.target = {4.5, 0.5};
  def.movers = {patrol(Rectangle{{}, 0.1, 4.0, 0.0}, {2.5, 2.5}, {2.5, 2.4}, 0.1)};
  const World world(def);
  const Robot robot(world, {}), alone(world.standing(), {});
  CHECK(shortest_path(robot, def.start).poses.size() ==
        shortest_path(alone, def.start).poses.size());
  CHECK(may_reach_target(robot, def.start));
  ShortestPathAgent agent(robot);
  Observation observation;
  observation.pose = {2.36, 1.0, 0.0};
  observation.motion_count = 5;
  CHECK(agent.choose(observation).motion >= 0);
}

TEST_CASE("Nothing that a caller can say of movers reaches one of Box2D's asserts") {
  Random random(6, "hostile movers");
  const double sizes[] = {0.0, 1e-300, 0.0099, 0.01, 0.0101, 0.1, 1.0, 50.0, 1000.0, 1e9};
  const auto size = [&] { return sizes[random.index(10)]; };
  const double times[] = {0.0, 1e-300, 0.1, 1.0, 1e3, 1e6, 1e9};
  int stood = 0, refused = 0;
  for (int n = 0; n < 6000; ++n) {
    WorldDef def;
    const double side = def.width = def.height = between(random, 0.5, 6.0);
    def.start = {between(random, 0.0, side), between(random, 0.0, side), between(random, 0, 360)};
    def.target = point_in(random, side);
    for (unsigned i = random.index(3); i > 0; --i) {
      def.obstacles.push_back(random_obstacle(random, side));
    }
    for (unsigned i = 1 + random.index(3); i > 0; --i) {
      Mover mover = random_mover(random, side);
      if (random.index(5) == 0) mover.shape = Circle{{}, size()};
      if (random.index(3) == 0)
        mover.shape = Rectangle{{}, size(), size(), between(random, -360, 360)};
      if (auto* path = std::get_if<MoverPath>(&mover.course)) {
        if (random.index(4) == 0) path->speed = size();
        if (random.index(4) == 0) path->points[0] = path->points[1];
        if (random.index(4) == 0) {
          path->points = {{path->points[0].x, path->points[0].y}, path->points[0]};
          path->points[1].x += 0.01;
        }
        if (random.index(4) == 0) path->points[0] = {def.start.x, def.start.y};
      } else if (auto& walk = std::get<MoverWalk>(mover.course); random.index(4) == 0) {
        walk.leg_time = size();
        if (random.index(2) == 0) walk.high = walk.low;
      }
      def.movers.push_back(mover);
    }
    RobotDef robot_def;
    robot_def.radius = random.index(3) == 0 ? size() : between(random, 0.01, 0.2);
    robot_def.speed = random.index(3) == 0 ? size() : between(random, 0.01, 1.0);
    robot_def.sample_time = random.index(6) == 0 ? size() : 0.5;
    try {
      const World world(def);
      const Robot robot(world, robot_def);
      robot.require_start();
      const double begin = times[random.index(7)];
      Pose pose = def.start;
      // Right into a mover, too.
      if (random.index(3) == 0) {
        const Point there = centre_of(world.movers_at(begin)[0]);
        pose = {there.x, there.y, pose.heading};
      }
      for (int i = 0; i < 15; ++i) {
        const double time = std::min(1e9, begin + i * robot_def.sample_time);
        robot.sonar(pose, time);
        pose = robot.step(pose, static_cast<int>(random.index(5)), time).pose;
        REQUIRE(world.standing().clearance({pose.x, pose.y}, true) >= robot_def.radius - kSlop);
      }
      ++stood;
    } catch (const InvalidValue&) {
      ++refused;
    }
  }
  MESSAGE(stood << " hostile worlds with movers stood up to, " << refused << " refused");
  CHECK(stood > 300);
  CHECK(refused > 300);
}
