#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "agents/grid_world.hpp"
#include "devlearn/r_max.hpp"

using namespace devlearn;

namespace {

// A grid in which one motion in five is another one, by chance.
constexpr double kSlip = 0.2;

Round slippery_round(Agent& agent, const GridWorld& world, Random& random) {
  Round round;
  agent.begin_round();
  for (int cell = world.start; !round.arrived; ++round.steps) {
    const int chosen = agent.choose(world.observation(cell)).motion;
    const bool slips = random.uniform() < kSlip;
    const Outcome outcome = world.outcome(cell, slips ? static_cast<int>(random.index(4)) : chosen);
    agent.observe(outcome);
    cell = static_cast<int>(outcome.situation);
    round.arrived = outcome.arrived;
  }
  agent.end_round(true);
  return round;
}

// Mean steps of the best policy there, by value iteration over the true probabilities.
double best_mean_steps(const GridWorld& world) {
  std::vector<double> steps(static_cast<std::size_t>(world.cells()));
  for (int sweep = 0; sweep < 2000; ++sweep) {
    for (int cell = 0; cell < world.cells(); ++cell) {
      if (cell == world.goal) continue;
      double least = 1e9, any = 0.0;
      for (int motion = 0; motion < 4; ++motion) {
        const double there = steps[static_cast<std::size_t>(world.after(cell, motion))];
        least = std::min(least, there);
        any += there / 4.0;
      }
      steps[static_cast<std::size_t>(cell)] = 1.0 + (1.0 - kSlip) * least + kSlip * any;
    }
  }
  return steps[static_cast<std::size_t>(world.start)];
}

}  // namespace

TEST_CASE("R-max wastes no more steps than there is to find out, and is optimal then") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    const GridWorld world = random_world(seed, 6);
    const int shortest = world.shortest(world.start);
    int pairs = 0, farthest = 0;
    for (int cell = 0; cell < world.cells(); ++cell) {
      if (world.at(cell) == '#' || world.shortest(cell) < 0) continue;
      pairs += 4;
      farthest = std::max(farthest, world.shortest(cell));
    }
    for (const FirstValue prior : {FirstValue::kConstant, FirstValue::kEstimate}) {
      for (const int m : {1, 3}) {
        RMaxConfig config;
        config.m = m;
        config.first_value = prior;
        RMax agent(config, seed);
        int wasted = 0;
        for (int i = 0; i < 400; ++i) wasted += run_round(agent, world).steps - shortest;
        CHECK(wasted <= m * pairs * farthest);
        for (int i = 0; i < 20; ++i) CHECK(run_round(agent, world).steps == shortest);
      }
    }
  }
}

TEST_CASE("a motion is known after m visits, is counted no further, and the best path is known") {
  const GridWorld world = random_world(3, 6);
  RMaxConfig config;
  config.m = 4;
  RMax agent(config, 1);
  std::vector<int> tried(static_cast<std::size_t>(4 * world.cells()));
  int cell = world.start;
  for (int step = 0; step < 4000; ++step) {
    const int motion = agent.choose(world.observation(cell)).motion;
    const Outcome outcome = world.outcome(cell, motion);
    agent.observe(outcome);
    ++tried[static_cast<std::size_t>(4 * cell + motion)];
    cell = outcome.arrived ? world.start : static_cast<int>(outcome.situation);
  }
  for (int i = 0; i < 4 * world.cells(); ++i) {
    const int visits = agent.visits(i / 4, i % 4), times = tried[static_cast<std::size_t>(i)];
    CHECK(visits == std::min(times, 4));
    if (times == 0 || visits == 4) continue;
    CHECK(*agent.value(i / 4, i % 4) == -world.observation(i / 4).estimate);
  }
  const auto path = greedy_path(agent, world);
  REQUIRE(path.has_value());
  for (std::size_t i = 0; i + 1 < path->size(); ++i) {
    int best = 0;
    for (int motion = 1; motion < 4; ++motion) {
      if (agent.value((*path)[i], motion) > agent.value((*path)[i], best)) best = motion;
    }
    CHECK(agent.visits((*path)[i], best) == 4);
  }
}

TEST_CASE("after every step a known motion is worth its cost and the best of where it leads") {
  const GridWorld world({"S.......", ".######.", "........", ".####.#.", "...G..#."});
  RMax agent({}, 1);
  int cell = world.start, known = 0, off = 0;
  for (int step = 0; step < 3000; ++step) {
    const int motion = agent.choose(world.observation(cell)).motion;
    const Outcome outcome = world.outcome(cell, motion);
    agent.observe(outcome);
    cell = outcome.arrived ? world.start : static_cast<int>(outcome.situation);
    if (step % 10 != 0) continue;
    for (int i = 0; i < 4 * world.cells(); ++i) {
      if (agent.visits(i / 4, i % 4) < RMaxConfig{}.m) continue;
      const int next = world.after(i / 4, i % 4);
      double best = next == world.goal ? 0.0 : *agent.value(next, 0);
      for (int then = 1; next != world.goal && then < 4; ++then) {
        best = std::max(best, *agent.value(next, then));
      }
      ++known;
      if (std::abs(*agent.value(i / 4, i % 4) - (best - 1.0)) > 1e-3) ++off;
    }
  }
  CHECK(known > 10000);
  CHECK(off == 0);
}

TEST_CASE("the estimate as prior leaves out what cannot be on a short way") {
  const GridWorld field({"..........", "..........", "S........G", "..........", ".........."});
  const auto motions_tried = [&](FirstValue prior) {
    RMaxConfig config;
    config.m = 1;
    config.first_value = prior;
    RMax agent(config, 2);
    for (int i = 0; i < 200; ++i) run_round(agent, field);
    CHECK(run_round(agent, field).steps == 9);
    int count = 0;
    for (int i = 0; i < 4 * field.cells(); ++i) count += agent.visits(i / 4, i % 4);
    return count;
  };
  CHECK(4 * motions_tried(FirstValue::kEstimate) < 3 * motions_tried(FirstValue::kConstant));
}

TEST_CASE("on slippery ground R-max comes near to the best policy") {
  const GridWorld world({"S...", ".##.", "....", "..#G"});
  RMaxConfig config;
  config.m = 40;
  RMax agent(config, 1);
  Random random(1, "slip");
  for (int i = 0; i < 600; ++i) slippery_round(agent, world, random);
  double sum = 0.0;
  for (int i = 0; i < 600; ++i) sum += slippery_round(agent, world, random).steps;
  const double best = best_mean_steps(world);
  CHECK(sum / 600.0 < 1.1 * best);
  CHECK(sum / 600.0 > 0.9 * best);
}

TEST_CASE("what nothing leads out of is worth the least value, and entered once") {
  for (const double gamma : {1.0, 0.9}) {
    CAPTURE(gamma);
    RMaxConfig config;
    config.m = 1;
    config.gamma = gamma;
    config.first_value = FirstValue::kConstant;
    config.least_value = -50.0;
    RMax agent(config, 1);
    // Situation 0: motion 0 falls into situation 1, which nothing leads out of; 1 arrives.
    int fallen = 0;
    for (int round = 0; round < 20; ++round) {
      SituationId here = 0;
      bool arrived = false;
      for (int step = 0; step < 10 && !arrived; ++step) {
        Observation seen;
        seen.situation = here;
        seen.motion_count = 2;
        const int motion = agent.choose(seen).motion;
        fallen += here == 0 && motion == 0 ? 1 : 0;
        Outcome outcome;
        arrived = here == 0 && motion == 1;
        outcome.arrived = arrived;
        outcome.situation = arrived ? 2 : 1;
        agent.observe(outcome);
        here = outcome.situation;
      }
    }
    CHECK(fallen == 1);
    CHECK(*agent.value(0, 1) == -1.0);
    CHECK(*agent.value(1, 0) == doctest::Approx(gamma == 1.0 ? -50.0 : -10.0));
  }
}
