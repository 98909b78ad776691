#include <doctest/doctest.h>

#include <cmath>

#include "core/refusal.hpp"
#include "devlearn/error.hpp"
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
