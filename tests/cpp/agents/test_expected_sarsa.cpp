#include <doctest/doctest.h>

#include "agents/grid_world.hpp"
#include "devlearn/expected_sarsa.hpp"
#include "devlearn/q_learning.hpp"
#include "devlearn/sarsa_lambda.hpp"

using namespace devlearn;

TEST_CASE("on the cliff, Expected SARSA's first 100 rounds beat the others' at every step size") {
  // Fig. 6.3, interim
  for (const double alpha : {0.2, 0.5, 0.9}) {
    CAPTURE(alpha);
    ExpectedSarsaConfig expected;
    expected.alpha = alpha;
    SarsaLambdaConfig sampled;
    sampled.alpha = alpha;
    sampled.trace_decay = 0.0;
    const double by_mean = mean_reward<ExpectedSarsa>(expected, cliff_world(), 60, 0, 100);
    const double by_sample = mean_reward<SarsaLambda>(sampled, cliff_world(), 60, 0, 100);
    QLearningConfig off_policy;
    off_policy.alpha = alpha;
    const double by_maximum = mean_reward<QLearning>(off_policy, cliff_world(), 60, 0, 100);
    CHECK(by_mean > by_sample + 4.0);
    CHECK(by_mean > by_maximum + 4.0);
  }
}

TEST_CASE("in the long run Expected SARSA is as good at any step size, SARSA at small ones alone") {
  // Fig. 6.3, asymptotic
  const auto late = [](double alpha) {
    ExpectedSarsaConfig expected;
    expected.alpha = alpha;
    SarsaLambdaConfig sampled;
    sampled.alpha = alpha;
    sampled.trace_decay = 0.0;
    return std::pair(mean_reward<ExpectedSarsa>(expected, cliff_world(), 3, 600, 400),
                     mean_reward<SarsaLambda>(sampled, cliff_world(), 3, 600, 400));
  };
  const auto [expected_small, sarsa_small] = late(0.2);
  const auto [expected_large, sarsa_large] = late(0.9);
  CHECK(std::abs(expected_small - expected_large) < 2.0);
  CHECK(std::abs(expected_small - sarsa_small) < 5.0);
  CHECK(sarsa_large < 2.0 * expected_large);
}

TEST_CASE("under a greedy policy Expected SARSA is Q-learning") {
  ExpectedSarsaConfig expected;
  QLearningConfig q;
  expected.epsilon = q.epsilon = 0.0;
  ExpectedSarsa a(expected, 4);
  QLearning b(q, 4);
  for (int i = 0; i < 50; ++i) {
    CHECK(run_round(a, cliff_world()).reward == run_round(b, cliff_world()).reward);
  }
  for (int motion = 0; motion < 4; ++motion) CHECK(a.value(36, motion) == b.value(36, motion));
}
