#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "agents/grid_world.hpp"
#include "devlearn/sarsa_lambda.hpp"

using namespace devlearn;

namespace {

// Sutton & Barto, Example 7.1: 19 states in a row, from the middle one; off the left end the reward
// is -1, off the right end 1.
constexpr int kStates = 19;

// walk(from, to, cost, arrived) for each step of a round.
template <class Walk>
void random_walk(Random& random, const Walk& walk) {
  for (int state = (kStates + 1) / 2; state > 0 && state <= kStates;) {
    const int next = random.uniform() < 0.5 ? state - 1 : state + 1;
    const bool arrived = next == 0 || next > kStates;
    walk(state, next, next == 0 ? 1.0 : arrived ? -1.0 : 0.0, arrived);
    state = next;
  }
}

// One that has no choice: what it learns is TD(lambda).
class Predictor {
 public:
  explicit Predictor(const SarsaLambdaConfig& config) : agent_(config) {}

  void round(Random& random) {
    agent_.begin_round();
    random_walk(random, [&](int from, int to, double cost, bool arrived) {
      Observation seen;
      seen.situation = from;
      seen.motion_count = 1;
      agent_.choose(seen);
      Outcome outcome;
      outcome.situation = to;
      outcome.cost = cost;
      outcome.arrived = arrived;
      agent_.observe(outcome);
    });
    agent_.end_round(true);
  }
  double value(int state) const { return agent_.value(state, 0).value_or(0.0); }

 private:
  SarsaLambda agent_;
};

// The RMS error over the states, over the first 10 rounds, over walks.
double rms_error(double lambda, double alpha, int walks) {
  SarsaLambdaConfig config;
  config.trace_decay = lambda;
  config.alpha = alpha;
  double sum = 0.0;
  for (int walk = 0; walk < walks; ++walk) {
    Random random(static_cast<std::uint64_t>(walk), "walk");
    Predictor predictor(config);
    for (int round = 0; round < 10; ++round) {
      predictor.round(random);
      double squares = 0.0;
      for (int state = 1; state <= kStates; ++state) {
        const double truth = (state - 10) / 10.0;
        squares += (predictor.value(state) - truth) * (predictor.value(state) - truth);
      }
      sum += std::sqrt(squares / kStates);
    }
  }
  return sum / (10.0 * walks);
}

// At the best of the step sizes.
double least_error(double lambda) {
  double least = 1.0;
  for (const double alpha : {0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8}) {
    least = std::min(least, rms_error(lambda, alpha, 20));
  }
  return least;
}

}  // namespace

TEST_CASE(
    "on the 19-state random walk the error is least between lambda 0 and 1, as in Fig. 12.6") {
  const double none = least_error(0.0), some = least_error(0.4), most = least_error(0.8);
  const double nearly_all = least_error(0.95), all = least_error(1.0);
  CHECK(none == doctest::Approx(0.34).epsilon(0.1));
  CHECK(some < 0.85 * none);
  CHECK(most < 0.85 * none);
  CHECK(nearly_all > 1.15 * most);
  CHECK(all > 1.5 * nearly_all);
}

TEST_CASE("with one motion SARSA(lambda) is TD(lambda), written out with a trace for each state") {
  for (const Traces kind : {Traces::kAccumulating, Traces::kReplacing}) {
    SarsaLambdaConfig config;
    config.alpha = 0.2;
    config.gamma = 0.9;
    config.trace_decay = 0.8;
    config.traces = kind;
    Predictor predictor(config);
    std::array<double, kStates + 2> values{};
    Random random(5, "walk"), same(5, "walk");
    for (int round = 0; round < 20; ++round) {
      predictor.round(random);
      std::array<double, kStates + 2> traces{};
      random_walk(same, [&](int from, int to, double cost, bool) {
        const auto s = static_cast<std::size_t>(from);
        const double delta = -cost + 0.9 * values[static_cast<std::size_t>(to)] - values[s];
        traces[s] = kind == Traces::kReplacing ? 1.0 : traces[s] + 1.0;
        for (std::size_t i = 1; i <= kStates; ++i) {
          values[i] += 0.2 * delta * traces[i];
          traces[i] *= 0.9 * 0.8;
        }
      });
    }
    for (int state = 1; state <= kStates; ++state) {
      CHECK(predictor.value(state) ==
            doctest::Approx(values[static_cast<std::size_t>(state)]).epsilon(1e-6));
    }
  }
}

TEST_CASE("an outcome reaches back along the round by gamma lambda a step, and no further back") {
  SarsaLambdaConfig config;
  config.alpha = 0.5;
  config.gamma = 0.5;
  config.trace_decay = 0.5;
  SarsaLambda agent(config);
  const auto step = [&](SituationId from, SituationId to, double cost, bool arrived) {
    Observation seen;
    seen.situation = from;
    seen.motion_count = 1;
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = to;
    outcome.cost = cost;
    outcome.arrived = arrived;
    agent.observe(outcome);
  };
  step(1, 2, 0.0, false);
  step(2, 3, 0.0, false);
  agent.end_round(false);  // broken off
  agent.begin_round();
  step(4, 5, 0.0, false);
  step(5, 6, 0.0, false);
  step(6, 7, -16.0, true);
  CHECK(*agent.value(6, 0) == 8.0);
  CHECK(*agent.value(5, 0) == 2.0);
  CHECK(*agent.value(4, 0) == 0.5);
  CHECK(*agent.value(2, 0) == 0.0);
  CHECK(*agent.value(1, 0) == 0.0);
  // After an arrival a step stands alone, and one elsewhere than the last led to does, too.
  step(8, 9, 0.0, false);
  step(6, 7, -16.0, true);
  CHECK(*agent.value(6, 0) == 12.0);
  CHECK(*agent.value(8, 0) == 0.0);
  CHECK(*agent.value(5, 0) == 2.0);
}

TEST_CASE("traces find a way through a maze in fewer steps than SARSA does") {
  const GridWorld maze({"..........", "...####...", "S..#..#..G", "......#...", ".........."});
  const auto steps = [&](double lambda) {
    SarsaLambdaConfig config;
    config.trace_decay = lambda;
    config.traces = Traces::kReplacing;
    config.alpha = 0.1;
    config.gamma = 0.95;
    GridWorld rewarding = maze;  // of the arrival alone
    rewarding.step_cost = 0.0;
    rewarding.arrival_cost = -1.0;
    int sum = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      SarsaLambda agent(config, seed);
      for (int i = 0; i < 10; ++i) sum += run_round(agent, rewarding).steps;
    }
    return sum;
  };
  CHECK(2 * steps(0.9) < steps(0.0));
}
