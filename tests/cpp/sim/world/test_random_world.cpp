#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "body/kinematics.hpp"
#include "devlearn/error.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/shortest_path.hpp"
#include "devlearn/world.hpp"
#include "many.hpp"
#include "world/fine_direction.hpp"
#include "world/surfaces.hpp"

using namespace devlearn;

namespace {

const std::vector<std::string> kKinds{"similar", "clutter", "corridors", "rooms", "traps"};

// Whether free steps of the default robot lead from the start into the target's surroundings: a
// search in depth over poses, by cells of a step.
bool gets_there(const World& world) {
  const RobotDef robot;
  std::vector<bool> seen(101 * 101 * 12);
  std::vector<Pose> open{world.def().start};
  while (!open.empty()) {
    const Pose pose = open.back();
    open.pop_back();
    const double dx = world.def().target.x - pose.x, dy = world.def().target.y - pose.y;
    if (std::hypot(dx, dy) <= 0.1) return true;
    const long cell = std::lround(pose.y / 0.05) * 101 + std::lround(pose.x / 0.05);
    auto here = seen[static_cast<std::size_t>(cell * 12 + std::lround(pose.heading / 30.0) % 12)];
    if (here) continue;
    here = true;
    // What leads nearest goes first, so it is put down last.
    std::vector<std::pair<double, Pose>> next;
    for (int motion = 0; motion < 5; ++motion) {
      const auto step = free_step(world, robot, pose, motion);
      if (!step) continue;
      next.emplace_back(-std::hypot(world.def().target.x - step->x, world.def().target.y - step->y),
                        *step);
    }
    std::sort(next.begin(), next.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [nearness, step] : next) open.push_back(step);
  }
  return false;
}

std::string refusal(const std::string& kind, double difficulty) {
  try {
    World::random(kind, 1, difficulty);
  } catch (const InvalidValue& e) {
    return e.what();
  }
  return "accepted";
}

// The obstacles of a world of that kind, how many there are.
std::size_t count(const std::string& kind, std::uint64_t seed, double difficulty) {
  return World::random(kind, seed, difficulty).def().obstacles.size();
}

}  // namespace

TEST_CASE("In every random world the robot gets from the start to the target") {
  for (const std::string& kind : kKinds) {
    for (const double difficulty : {0.0, 0.5, 1.0}) {
      for (std::uint64_t seed = 1; seed <= many(40); ++seed) {
        CAPTURE(kind);
        CAPTURE(difficulty);
        CAPTURE(seed);
        REQUIRE(gets_there(World::random(kind, seed, difficulty)));
      }
    }
    const World hardest = World::random(kind, 41, 1.0);
    CHECK(shortest_path(Robot(hardest, {}), hardest.def().start).found());
  }
}

TEST_CASE(
    "A random world is the same at every call, and another for another kind, seed, difficulty") {
  std::set<std::string> texts;
  for (const std::string& kind : kKinds) {
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
      for (const double difficulty : {0.1, 0.5, 0.9}) {
        const World world = World::random(kind, seed, difficulty);
        CHECK(World::random(kind, seed, difficulty).to_json() == world.to_json());
        CHECK(World::parse(world.to_json()).to_json() == world.to_json());
        texts.insert(world.to_json());
      }
    }
    CHECK(World::random(kind, 7).to_json() == World::random(kind, 7, 0.5).to_json());
  }
  CHECK(texts.size() == kKinds.size() * 9);
}

TEST_CASE("A random world's name says its kind, its seed and a difficulty that is not the usual") {
  for (const std::string& kind : kKinds) {
    CHECK(World::random(kind, 12).def().name == kind + " 12");
    CHECK(World::random(kind, 3, 0.75).def().name == kind + " 3, difficulty 0.75");
    CHECK_FALSE(World::random(kind, 12).def().description.empty());
  }
}

TEST_CASE("A kind or a difficulty that is none is refused with those that are") {
  CHECK(refusal("maze", 0.5) ==
        "kind: got maze; expected one of similar, clutter, corridors, rooms, traps");
  CHECK(refusal("", 0.5).find("one of similar") != std::string::npos);
  for (const double bad : {-0.01, 1.01, std::nan(""), HUGE_VAL}) {
    CHECK(refusal("rooms", bad).find("expected in [0, 1]") != std::string::npos);
  }
}

TEST_CASE("A more difficult world has more of what its kind is made of") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CHECK(count("similar", seed, 0.0) == 4);
    CHECK(count("similar", seed, 0.5) == 8);
    CHECK(count("similar", seed, 1.0) == 12);
    CHECK(count("clutter", seed, 0.0) == 20);
    CHECK(count("clutter", seed, 0.5) == 40);
    CHECK(count("clutter", seed, 1.0) == 60);
    // Two pieces of wall beside each door, and one door less than rooms.
    CHECK(count("rooms", seed, 0.0) == 2 * (4 - 1));
    CHECK(count("rooms", seed, 0.5) == 2 * (8 - 1));
    CHECK(count("rooms", seed, 1.0) == 2 * (12 - 1));
    CHECK(count("traps", seed, 0.0) == 1);
    CHECK(count("traps", seed, 0.5) == 3);
    CHECK(count("traps", seed, 1.0) == 4);
  }
}

TEST_CASE("What would close the way is left out of a random world, and nothing else") {
  const World world = World::random("clutter", 233, 1.0);
  CHECK(world.def().obstacles.size() == 59);
  CHECK(gets_there(world));
}

TEST_CASE("Obstacles of clutter are small and keep the gap of their difficulty") {
  for (const double difficulty : {0.0, 0.5, 1.0}) {
    const WorldDef def = World::random("clutter", 2, difficulty).def();
    for (std::size_t i = 0; i < def.obstacles.size(); ++i) {
      WorldDef alone = def, rest = def;
      alone.obstacles = {def.obstacles[i]};
      rest.obstacles.erase(rest.obstacles.begin() + static_cast<std::ptrdiff_t>(i));
      const World one(alone), others(rest);
      // Where one is, the others are further than their gap.
      const double least = 0.3 - 0.1 * difficulty;
      int inside = 0;
      for (double x = 0.01; x < 5.0; x += 0.02) {
        for (double y = 0.01; y < 5.0; y += 0.02) {
          if (one.clearance({x, y}) > 0.0) continue;
          ++inside;
          REQUIRE(others.clearance({x, y}) >= least);
        }
      }
      CHECK(inside * 0.0004 < 0.1);  // its area [m^2]
    }
  }
}

TEST_CASE("Corridors are as wide as their number leaves, from any cell's middle") {
  for (const auto& [difficulty, size] : {std::pair{0.0, 4}, {0.25, 5}, {0.5, 6}, {1.0, 8}}) {
    const World world = World::random("corridors", 5, difficulty);
    const double cell = 5.0 / size;
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        const Point middle{(i + 0.5) * cell, (j + 0.5) * cell};
        // Every cell of a tree has a wall beside it or a corner; none is nearer than half a cell.
        CHECK(world.clearance(middle, true) >= 0.5 * cell - 0.04 - 1e-12);
      }
    }
  }
}

TEST_CASE("A trap lies in the way as the crow flies, and the way round it is longer") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const double difficulty : {0.0, 1.0}) {
      const World world = World::random("traps", seed, difficulty);
      const Pose start = world.def().start;
      const Point target = world.def().target;
      CHECK_FALSE(world.surfaces().keep_clear_of({start.x, start.y}, target, 1e-9));
    }
  }
}

TEST_CASE("The fine direction is cosine and sine, rounded correctly") {
  if (std::numeric_limits<long double>::digits < 64) return;  // nothing finer to compare with
  double worst = 0.0;
  for (int i = 0; i <= 100000; ++i) {
    const double angle = i * (6.283185307179586 / 100000);
    const Direction d = fine_direction(angle);
    const auto off = [](double value, long double exact) {
      const double ulp = std::nextafter(std::abs(value), 2.0) - std::abs(value);
      return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) / ulp;
    };
    worst = std::max({worst, off(d.x, std::cos(static_cast<long double>(angle))),
                      off(d.y, std::sin(static_cast<long double>(angle)))});
  }
  CHECK(worst < 0.501);
  CHECK(worst > 0.45);
}
