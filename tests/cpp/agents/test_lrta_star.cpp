#include <doctest/doctest.h>

#include <algorithm>

#include "agents/grid_world.hpp"
#include "core/refusal.hpp"
#include "devlearn/lrta_star.hpp"

using namespace devlearn;

namespace {

// h of a cell, by the values of its motions.
double heuristic(const LrtaStar& agent, int cell) {
  double highest = *agent.value(cell, 0);
  for (int motion = 1; motion < 4; ++motion) {
    highest = std::max(highest, *agent.value(cell, motion));
  }
  return -highest;
}

}  // namespace

TEST_CASE("LRTA* arrives in every round, and its rounds become the shortest (Korf 1990)") {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    CAPTURE(seed);
    const GridWorld world = random_world(seed, 8);
    const int shortest = world.shortest(world.start);
    LrtaStar agent({}, seed);
    for (int i = 0; i < 150; ++i) REQUIRE(run_round(agent, world, 10000).arrived);
    for (int i = 0; i < 20; ++i) CHECK(run_round(agent, world).steps == shortest);
    CHECK(heuristic(agent, world.start) == shortest);
  }
}

TEST_CASE("LRTA*'s h never exceeds the cost to go, and never falls below the estimate") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    const GridWorld world = random_world(seed, 10);
    LrtaStar agent({}, seed);
    for (int i = 0; i < 30; ++i) {
      run_round(agent, world);
      for (int cell = 0; cell < world.cells(); ++cell) {
        if (cell == world.goal || !agent.value(cell, 0)) continue;
        CHECK(heuristic(agent, cell) <= world.shortest(cell));
        CHECK(heuristic(agent, cell) >= world.observation(cell).estimate);
      }
    }
  }
}

TEST_CASE("without an estimate LRTA* becomes optimal, too, after more steps") {
  LrtaStarConfig blind;
  blind.first_value = FirstValue::kConstant;
  int with_estimate = 0, without = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const GridWorld world = random_world(seed, 8);
    LrtaStar informed({}, seed), uninformed(blind, seed);
    for (int i = 0; i < 250; ++i) {
      with_estimate += run_round(informed, world).steps;
      without += run_round(uninformed, world).steps;
    }
    CHECK(run_round(uninformed, world).steps == world.shortest(world.start));
  }
  CHECK(with_estimate < without);
}

TEST_CASE("LRTA* looks ahead along every motion that it tried, not the last one alone") {
  // Motion 0 leads from 1 to 2, motion 1 to 3; what lies behind 2 turns out to be far.
  LrtaStar agent;
  const auto step = [&](SituationId from, int motion, SituationId to, double estimate) {
    const bool allowed[2] = {motion == 0, motion == 1};
    Observation seen;
    seen.situation = from;
    seen.motion_count = 2;
    seen.estimate = 2.0;
    seen.allowed = allowed;
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = to;
    outcome.estimate = estimate;
    agent.observe(outcome);
  };
  step(1, 0, 2, 1.0);
  step(1, 1, 3, 1.0);
  CHECK(*agent.value(1, 0) == -2.0);
  step(2, 0, 4, 50.0);  // and its motion 1 is not allowed
  CHECK(*agent.value(1, 0) == -2.0);
  Observation seen;
  seen.situation = 1;
  seen.motion_count = 2;
  seen.estimate = 2.0;
  CHECK(agent.choose(seen).motion == 1);
  CHECK(*agent.value(1, 0) == -52.0);
  CHECK(*agent.value(1, 1) == -2.0);
}

TEST_CASE("LRTA* believes what a motion last led to") {
  LrtaStar agent;
  Observation seen;
  seen.situation = 1;
  seen.motion_count = 1;
  seen.estimate = 2.0;
  const auto step = [&](SituationId to, double estimate) {
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = to;
    outcome.estimate = estimate;
    agent.observe(outcome);
  };
  step(2, 9.0);
  CHECK(*agent.value(1, 0) == -10.0);
  step(3, 4.0);
  CHECK(*agent.value(1, 0) == -5.0);
}

TEST_CASE("LRTA* refuses costs that are not above 0, and goes on waiting") {
  LrtaStar agent;
  Observation seen;
  seen.situation = 1;
  seen.motion_count = 2;
  agent.choose(seen);
  Outcome outcome;
  outcome.situation = 2;
  outcome.cost = 0.0;
  check_refused([&] { agent.observe(outcome); }, "cost", "0");
  outcome.cost = -1.0;
  check_refused([&] { agent.observe(outcome); }, "cost", "-1");
  outcome.cost = 1e-9;
  CHECK_NOTHROW(agent.observe(outcome));
}
