#include <doctest/doctest.h>

#include <cmath>

#include "agents/grid_world.hpp"
#include "devlearn/dyna_q.hpp"
#include "devlearn/prioritized_sweeping.hpp"

using namespace devlearn;

namespace {

// Steps until the greedy path is, by a factor, as short as it can be.
template <class ValueAgent>
int steps_until_short(ValueAgent& agent, const GridWorld& maze, double factor) {
  const double long_enough = factor * maze.shortest(maze.start);
  int cell = maze.start;
  for (int step = 1;; ++step) {
    REQUIRE(step < 1000000);
    const int motion = agent.choose(maze.observation(cell)).motion;
    const Outcome outcome = maze.outcome(cell, motion);
    agent.observe(outcome);
    cell = outcome.arrived ? maze.start : static_cast<int>(outcome.situation);
    if (step % 20 != 0) continue;
    const auto path = greedy_path(agent, maze);
    if (path && static_cast<double>(path->size()) - 1.0 <= long_enough) return step;
  }
}

template <class Config>
Config maze_config() {
  Config config;
  config.alpha = 1.0;  // the maze is deterministic
  config.gamma = 0.95;
  config.epsilon = 0.1;
  config.planning_steps = 5;
  return config;
}

}  // namespace

TEST_CASE("prioritized sweeping needs a fraction of Dyna-Q's updates, as in Example 8.4") {
  const auto updates = [](int scale, double factor) {
    const GridWorld maze = dyna_maze(scale);
    double swept = 0.0, planned = 0.0;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      PrioritizedSweeping sweeping(maze_config<PrioritizedSweepingConfig>(), seed);
      steps_until_short(sweeping, maze, factor);
      swept += static_cast<double>(sweeping.updates());
      DynaQ dyna(maze_config<DynaQConfig>(), seed);
      planned += 6.0 * steps_until_short(dyna, maze, factor);  // a real one, and five planned
    }
    return planned / swept;
  };
  CHECK(updates(1, 1.0) > 3.0);  // to the optimal path
  for (const int scale : {1, 2, 3}) CHECK(updates(scale, 1.2) > 3.0);
}

TEST_CASE("what is learned once is swept back along all that led there") {
  PrioritizedSweepingConfig config = maze_config<PrioritizedSweepingConfig>();
  config.gamma = 0.5;
  config.planning_steps = 100;
  config.theta = 0.01;
  PrioritizedSweeping agent(config);
  Observation seen;
  seen.motion_count = 1;
  for (SituationId place = 0; place < 12; ++place) {
    seen.situation = place;
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = place + 1;
    outcome.arrived = place == 11;
    outcome.cost = outcome.arrived ? -1.0 : 0.0;
    agent.observe(outcome);
  }
  for (int back = 0; back <= 6; ++back) {
    CHECK(*agent.value(11 - back, 0) == std::ldexp(1.0, -back));
  }
  CHECK(*agent.value(11 - 7, 0) == 0.0);  // below theta
  CHECK(agent.updates() == 7);
}

TEST_CASE("what is left in the queue is swept after the next steps") {
  PrioritizedSweepingConfig config = maze_config<PrioritizedSweepingConfig>();
  config.planning_steps = 2;
  PrioritizedSweeping agent(config);
  Observation seen;
  seen.motion_count = 1;
  const auto step = [&](SituationId from, SituationId to, double cost, bool arrived) {
    seen.situation = from;
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = to;
    outcome.cost = cost;
    outcome.arrived = arrived;
    agent.observe(outcome);
  };
  for (SituationId place = 0; place < 6; ++place) step(place, place + 1, 0.0, false);
  step(6, 7, -1.0, true);
  CHECK(*agent.value(5, 0) == 0.95);
  CHECK(*agent.value(4, 0) == 0.0);
  step(100, 101, 0.0, false);
  CHECK(*agent.value(4, 0) == doctest::Approx(0.95 * 0.95));
  CHECK(*agent.value(3, 0) == doctest::Approx(0.95 * 0.95 * 0.95));
  CHECK(*agent.value(2, 0) == 0.0);
}
