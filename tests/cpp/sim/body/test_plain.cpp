#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/trial.hpp"
#include "many.hpp"
#include "sim/body/plain.hpp"
#include "sim/world/random_worlds.hpp"

// Every fast path gives what the plain rules of plain.hpp give, to the last bit.

using namespace devlearn;

namespace {

bool same(const Robot::Move& a, const Robot::Move& b) {
  return a.pose == b.pose && a.collided == b.collided;
}

}  // namespace

TEST_CASE("Clearances and surroundings are those of a look at everything, to the bit") {
  Random random(11, "plain clearance");
  long differ = 0, inside = 0, free = 0;
  for (int n = 0; n < many(100); ++n) {
    const World world = n % 10 == 0
                            ? pebbles(random, 20, 4.0)
                            : random_world(random, 1 + static_cast<int>(random.index(60)), 4.0);
    for (int i = 0; i < 500; ++i) {
      const Point p{between(random, -1.5, 5.5), between(random, -1.5, 5.5)};
      const Point q{p.x + between(random, -0.3, 0.3), p.y + between(random, -0.3, 0.3)};
      const double room = between(random, 0.01, 0.5), clearance = world.clearance(p);
      differ += clearance != plain::clearance(world, p);
      const bool clear = world.surfaces().keep_clear_of(p, q, room);
      differ += clear != (plain::swept_clearance(world, p, q) > room);
      plain::Surroundings near;
      for (const std::uint32_t surface : world.surfaces().around(p, room)) {
        world.surfaces().apply(surface, [&](const auto& shape) { near.add(shape); });
      }
      const plain::Surroundings expected = plain::around(world, p, room);
      differ += !std::equal(near.edges.begin(), near.edges.end(), expected.edges.begin(),
                            expected.edges.end(),
                            [](auto& a, auto& b) { return a.a == b.a && a.b == b.b; });
      differ += !std::equal(near.circles.begin(), near.circles.end(), expected.circles.begin(),
                            expected.circles.end(), [](auto& a, auto& b) {
                              return a.center == b.center && a.radius == b.radius;
                            });
      inside += clearance == 0.0;
      free += clear;
    }
  }
  CHECK(differ == 0);
  CHECK(inside > many(1000));
  CHECK(free > many(1000));
}

namespace {

struct Compared {
  long steps = 0, contacts = 0, different = 0;
};

// Random robots at random in worlds that `world` makes, each for so long.
template <typename Worlds>
Compared compare_steps(Random& random, long steps, int each, const Worlds& world) {
  Compared compared;
  while (compared.steps < steps) {
    RobotDef def;
    def.radius = between(random, 0.03, 0.15);
    def.speed = between(random, 0.02, random.index(20) == 0 ? 1.0 : 0.2);
    const Robot robot(world(random), def);
    const auto start = free_pose(random, robot.world(), def.radius);
    if (!start) continue;
    Pose pose = *start;
    for (int i = 0; i < each; ++i, ++compared.steps) {
      const int motion = static_cast<int>(random.index(5));
      const Robot::Move step = robot.step(pose, motion);
      compared.different += !same(step, plain::step(robot, pose, motion));
      compared.contacts += step.collided;
      pose = step.pose;
    }
  }
  MESSAGE(compared.steps << " steps, " << compared.contacts << " with contact");
  return compared;
}

}  // namespace

TEST_CASE("Steps are those of Box2D's own world wherever they are not free, to the bit") {
  Random random(12, "plain steps");
  const Compared compared = compare_steps(
      random, many(800'000), 4000, [](Random& chance) { return random_world(chance, 15, 4.0); });
  CHECK(compared.different == 0);
  CHECK(compared.contacts * 20 >= compared.steps);
}

TEST_CASE("Steps among heaps of pebbles, too, where several are touched at once") {
  Random random(14, "plain pebbles");
  const Compared compared = compare_steps(random, many(8'000), 500,
                                          [](Random& chance) { return pebbles(chance, 20, 4.0); });
  CHECK(compared.different == 0);
  CHECK(compared.contacts * 20 >= compared.steps);
}

TEST_CASE("Histories of learning are those of the plain loop, to the bit") {
  constexpr int kSteps = 5000;
  Random random(13, "plain histories");
  long steps = 0, contacts = 0;
  for (int n = 0; steps < many(200'000); ++n) {
    TrialConfig config = n % 2 == 0 ? TrialConfig::paper() : TrialConfig::step5();
    const World world = random_world(random, 12, 3.0);
    const Pose& start = world.def().start;
    if (world.clearance({start.x, start.y}, true) < config.robot.radius) continue;
    const auto seed = static_cast<std::uint64_t>(n);
    Record record;
    Trial(world, config, seed).free_learning(record, kSteps);
    const Record expected = plain::free_learning(world, config, seed, kSteps);
    REQUIRE(record.situation == expected.situation);
    REQUIRE(record.motion == expected.motion);
    REQUIRE(record.sef == expected.sef);
    REQUIRE(record.smf_used == expected.smf_used);
    REQUIRE(record.collided == expected.collided);
    REQUIRE(record.clearance == expected.clearance);
    REQUIRE(record.event == expected.event);
    REQUIRE(record.x == expected.x);
    REQUIRE(record.y == expected.y);
    REQUIRE(record.heading == expected.heading);
    steps += kSteps;
    contacts += std::count(record.collided.begin(), record.collided.end(), 1);
  }
  MESSAGE(steps << " steps, " << contacts << " with contact");
  CHECK(contacts * 20 >= steps);
}
