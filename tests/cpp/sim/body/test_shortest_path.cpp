#include <doctest/doctest.h>

#include <cmath>

#include "core/refusal.hpp"
#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/shortest_path.hpp"

using namespace devlearn;

namespace {

// Two walls with a gap of 1 m each: too far around for the search to end of itself.
WorldDef long_way() {
  WorldDef def;
  def.width = def.height = 60.0;
  def.target = {59.0, 59.0};
  def.obstacles = {Rectangle{{29.5, 20.0}, 59.0, 0.1, 0.0},
                   Rectangle{{30.5, 40.0}, 59.0, 0.1, 0.0}};
  return def;
}

}  // namespace

TEST_CASE(
    "A search that is interrupted says what it knows, and one that is not is the same again") {
  const WorldDef def = long_way();
  const Robot robot(World(def), {});
  const ShortestPath whole = shortest_path(robot, def.start);
  REQUIRE(whole.found());
  CHECK(whole.lower_bound <= whole.steps());
  int calls = 0;
  const ShortestPath again = shortest_path(robot, def.start, 0.1, [&] {
    ++calls;
    return false;
  });
  CHECK(again.poses == whole.poses);
  CHECK(again.lower_bound == whole.lower_bound);
  REQUIRE(calls > 100);
  for (const int last : {1, calls / 4, calls / 2, calls - 1}) {
    CAPTURE(last);
    int left = last;
    const ShortestPath part = shortest_path(robot, def.start, 0.1, [&] { return --left <= 0; });
    CHECK_FALSE(part.found());
    CHECK_FALSE(part.exact());
    CHECK(part.steps() == ShortestPath::kNoWay);
    CHECK(part.lower_bound <= whole.lower_bound);
    CHECK(part.lower_bound >= std::floor((std::hypot(58.5, 58.5) - 0.1) / 0.05));
  }
}

TEST_CASE("Where a wall closes the way there is none, wherever the robot's motions lead") {
  WorldDef def = long_way();
  def.obstacles.push_back(Rectangle{{30.0, 30.0}, 60.0, 0.02, 0.0});
  const Robot robot(World(def), {});
  CHECK_FALSE(may_reach_target(robot, def.start));
  const ShortestPath path = shortest_path(robot, def.start);
  CHECK_FALSE(path.found());
  CHECK(path.exact());
  CHECK(path.lower_bound == ShortestPath::kNoWay);
}

TEST_CASE("Every motion list has its bound: no path is shorter than the crow flies") {
  WorldDef def;
  def.width = def.height = 4.0;
  def.start = {0.5, 0.5, 17.0};
  def.target = {3.3, 2.9};
  for (const std::vector<double>& angles : {std::vector<double>{-90.0, 0.0, 90.0},
                                            {-120.0, 120.0, 0.0},
                                            {-7.0, 0.0, 7.0},
                                            {-33.3, 0.0, 33.3},
                                            {-10.0, 10.0, 0.0},
                                            {180.0, 45.0}}) {
    CAPTURE(angles.front());
    RobotDef def_of_robot;
    def_of_robot.steering_angles = angles;
    const ShortestPath path = shortest_path(Robot(World(def), def_of_robot), def.start);
    REQUIRE(path.found());
    CHECK(path.exact());
    CHECK(path.steps() >= std::ceil((std::hypot(2.8, 2.4) - 0.1) / 0.05));
  }
}

TEST_CASE("starts are drawn where no mover is at that time, and where one was or will be") {
  WorldDef def;
  def.width = def.height = 2.0;
  def.start = {0.3, 0.3, 0.0};
  def.target = {0.3, 1.7};
  MoverPath path;
  path.points = {{1.5, 0.4}, {1.5, 1.6}};
  path.speed = 0.1;
  path.then = MoverPath::Then::kStop;
  def.movers = {Mover{Circle{{}, 0.35}, path}};
  const World world(def);
  const Robot robot(world, {});
  const StartPlaces places(robot);
  Random random(3, "starts");
  for (const double time : {0.0, 6.0, 12.0}) {
    CAPTURE(time);
    const Point mover{1.5, 0.4 + 0.1 * time}, other{1.5, time < 12.0 ? 1.6 : 0.4};
    int near_other = 0;
    for (int i = 0; i < 2000; ++i) {
      const Pose start = places.draw(random, time);
      REQUIRE(std::hypot(start.x - mover.x, start.y - mover.y) > 0.35 + 0.1);
      robot.require_free(start, time);
      near_other += std::hypot(start.x - other.x, start.y - other.y) < 0.35;
    }
    CHECK(near_other > 100);
  }
}

TEST_CASE("where movers leave no room for others an episode begins at the world's start") {
  WorldDef def;
  def.width = def.height = 2.0;
  def.start = {1.0, 1.0, 30.0};
  def.target = {0.3, 1.7};
  // Four about the start, 0.102 m off, that go away to the walls and beyond.
  const auto away = [&](Point from, Point to) {
    MoverPath path;
    path.points = {from, to};
    path.speed = 0.1;
    path.then = MoverPath::Then::kStop;
    return path;
  };
  def.movers = {Mover{Rectangle{{}, 0.898, 2.0, 0.0}, away({0.449, 1.0}, {0.449, 1.9})},
                Mover{Rectangle{{}, 0.898, 2.0, 0.0}, away({1.551, 1.0}, {1.551, 1.9})},
                Mover{Rectangle{{}, 2.0, 0.898, 0.0}, away({1.0, 0.449}, {1.9, 0.449})},
                Mover{Rectangle{{}, 2.0, 0.898, 0.0}, away({1.0, 1.551}, {1.9, 1.551})}};
  const StartPlaces places(Robot(World(def), {}));
  Random random(3, "starts");
  CHECK(places.draw(random, 0.0) == def.start);
  CHECK_FALSE(places.draw(random, 9.0) == def.start);
}
