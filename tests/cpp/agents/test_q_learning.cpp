#include <doctest/doctest.h>

#include <vector>

#include "agents/grid_world.hpp"
#include "devlearn/q_learning.hpp"
#include "devlearn/sarsa_lambda.hpp"

using namespace devlearn;

// Sutton & Barto, Example 6.6: epsilon 0.1, no discount, a step size of 0.5.

TEST_CASE("Q-learning learns the optimal path along the cliff's edge, SARSA a safer one") {
  const GridWorld world = cliff_world();
  QLearningConfig off_policy;
  off_policy.alpha = 0.5;
  SarsaLambdaConfig on_policy;
  on_policy.trace_decay = 0.0;
  on_policy.alpha = 0.1;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    QLearning q(off_policy, seed);
    SarsaLambda sarsa(on_policy, seed);
    for (int i = 0; i < 1000; ++i) {
      run_round(q, world);
      run_round(sarsa, world);
    }
    const auto along = greedy_path(q, world), around = greedy_path(sarsa, world);
    REQUIRE(along.has_value());
    REQUIRE(around.has_value());
    CHECK(along->size() == 1 + 13);
    for (std::size_t i = 1; i + 1 < along->size(); ++i) CHECK(world.row((*along)[i]) == 2);
    CHECK(around->size() > along->size());
  }
}

TEST_CASE("on the cliff SARSA's rounds are worth about -25, Q-learning's about -50") {
  SarsaLambdaConfig on_policy;
  on_policy.trace_decay = 0.0;
  on_policy.alpha = 0.5;
  QLearningConfig off_policy;
  off_policy.alpha = 0.5;
  const double sarsa = mean_reward<SarsaLambda>(on_policy, cliff_world(), 20, 300, 200);
  const double q = mean_reward<QLearning>(off_policy, cliff_world(), 20, 300, 200);
  CHECK(sarsa > -32.0);
  CHECK(sarsa < -20.0);
  CHECK(q > -57.0);
  CHECK(q < -43.0);
}

TEST_CASE("what was learned of one step is Eq. 6.8") {
  QLearningConfig config;
  config.alpha = 0.25;
  config.gamma = 0.5;
  config.epsilon = 0.0;
  QLearning agent(config);
  const auto step = [&](SituationId from, SituationId to, double cost, bool arrived) {
    Observation seen;
    seen.situation = from;
    seen.motion_count = 2;
    const int motion = agent.choose(seen).motion;
    Outcome outcome;
    outcome.situation = to;
    outcome.cost = cost;
    outcome.arrived = arrived;
    agent.observe(outcome);
    return motion;
  };
  const int second = step(7, 9, -8.0, true);
  CHECK(*agent.value(7, second) == 0.25 * 8.0);
  CHECK(*agent.value(7, 1 - second) == 0.0);
  CHECK_FALSE(agent.value(9, 0).has_value());  // nothing is learned of where one arrives
  const int first = step(3, 7, 1.0, false);
  CHECK(*agent.value(3, first) == 0.25 * (-1.0 + 0.5 * 2.0));
  CHECK(step(7, 9, 4.0, true) == second);
  CHECK(*agent.value(7, second) == 2.0 + 0.25 * (-4.0 - 2.0));
}

TEST_CASE("a shaped reward learns as the potential in first values does (Wiewiora 2003)") {
  const GridWorld world = cliff_world();
  QLearningConfig first, shaped;
  first.first_value = FirstValue::kEstimate;
  shaped.shaping = Shaping::kEstimate;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    QLearning a(first, seed), b(shaped, seed);
    for (int i = 0; i < 8; ++i) {
      const Round by_first = run_round(a, world), by_shaping = run_round(b, world);
      CHECK(by_first.steps == by_shaping.steps);
      CHECK(by_first.reward == by_shaping.reward);
    }
    for (int cell = 0; cell < world.cells(); ++cell) {
      for (int motion = 0; motion < 4; ++motion) {
        if (!a.value(cell, motion)) continue;
        CHECK(*a.value(cell, motion) ==
              doctest::Approx(*b.value(cell, motion) - world.observation(cell).estimate));
      }
    }
  }
}

TEST_CASE("the estimate as first value, or as potential, saves steps") {
  const auto steps = [](const QLearningConfig& config) {
    int sum = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      QLearning agent(config, seed);
      for (int i = 0; i < 5; ++i) {
        sum += run_round(agent, GridWorld({"..........", "S........G", ".........."})).steps;
      }
    }
    return sum;
  };
  QLearningConfig plain, first, shaped, by_sef;
  first.first_value = FirstValue::kEstimate;
  shaped.shaping = Shaping::kEstimate;
  by_sef.shaping = Shaping::kSef;
  CHECK(2 * steps(first) < steps(plain));
  CHECK(2 * steps(shaped) < steps(plain));
  CHECK(steps(by_sef) < steps(plain));
}
