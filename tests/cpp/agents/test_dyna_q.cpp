#include <doctest/doctest.h>

#include <vector>

#include "agents/grid_world.hpp"
#include "devlearn/dyna_q.hpp"
#include "devlearn/q_learning.hpp"

using namespace devlearn;

namespace {

// The setting of Example 8.1.
DynaQConfig maze_config(int planning_steps) {
  DynaQConfig config;
  config.alpha = 0.1;
  config.gamma = 0.95;
  config.epsilon = 0.1;
  config.planning_steps = planning_steps;
  return config;
}

// Steps of each of the first rounds, as a mean over runs.
std::vector<double> learning_curve(int planning_steps, int rounds, int runs) {
  const GridWorld maze = dyna_maze();
  std::vector<double> steps(static_cast<std::size_t>(rounds));
  for (int run = 0; run < runs; ++run) {
    DynaQ agent(maze_config(planning_steps), static_cast<std::uint64_t>(run));
    for (double& mean : steps) mean += run_round(agent, maze).steps / static_cast<double>(runs);
  }
  return steps;
}

// The first round, from 1, as short as that of a policy that is optimal but for a tenth of its
// motions.
int first_good_round(const std::vector<double>& steps) {
  int round = 1;
  for (const double mean : steps) {
    if (mean < 20.0) break;
    ++round;
  }
  return round;
}

// What is rewarded until a change of the world, in all, and in the last 500 steps.
struct Rewards {
  double before = 0.0, all = 0.0, last = 0.0;
  int optimal = 0;  // runs whose greedy path is the shortest in the end
};

Rewards through_a_change(double kappa, const GridWorld& first, const GridWorld& then, int change,
                         int steps, int runs) {
  DynaQConfig config = maze_config(10);
  config.alpha = 0.5;
  config.kappa = kappa;
  Rewards rewards;
  for (int run = 0; run < runs; ++run) {
    DynaQ agent(config, static_cast<std::uint64_t>(run));
    int cell = first.start;
    for (int step = 0; step < steps; ++step) {
      const GridWorld& world = step < change ? first : then;
      const int motion = agent.choose(world.observation(cell)).motion;
      const Outcome outcome = world.outcome(cell, motion);
      agent.observe(outcome);
      cell = outcome.arrived ? world.start : static_cast<int>(outcome.situation);
      const double reward = outcome.reward() / runs;
      rewards.all += reward;
      if (step < change) rewards.before += reward;
      if (step >= steps - 500) rewards.last += reward;
    }
    const auto path = greedy_path(agent, then);
    const auto shortest = static_cast<std::size_t>(then.shortest(then.start));
    if (path && path->size() == shortest + 1) ++rewards.optimal;
  }
  return rewards;
}

GridWorld with_wall(const char* wall) {
  return rewarding_arrival({"........G", ".........", ".........", wall, ".........", "...S....."});
}

}  // namespace

TEST_CASE("in the Dyna maze more planning needs fewer rounds, as in Fig. 8.2") {
  const GridWorld maze = dyna_maze();
  CHECK(maze.shortest(maze.start) == 14);
  const int none = first_good_round(learning_curve(0, 40, 15));
  const int five = first_good_round(learning_curve(5, 20, 15));
  const int fifty = first_good_round(learning_curve(50, 10, 15));
  CHECK(none >= 18);  // about 25 in the book
  CHECK(none <= 35);
  CHECK(five >= 4);  // about 5
  CHECK(five <= 8);
  CHECK(fifty >= 2);  // about 3
  CHECK(fifty <= 4);
}

TEST_CASE("where a way is blocked, Dyna-Q+ soon finds the other one, as in Fig. 8.4") {
  const GridWorld right = with_wall("########."), left = with_wall(".########");
  CHECK(right.shortest(right.start) == 10);
  CHECK(left.shortest(left.start) == 16);
  const Rewards plain = through_a_change(0.0, right, left, 1000, 3000, 12);
  const Rewards plus = through_a_change(1e-3, right, left, 1000, 3000, 12);
  CHECK(plain.before > 30.0);
  CHECK(plus.before > 30.0);
  CHECK(plus.all > 1.3 * plain.all);
  CHECK(plus.last > 2.0 * plain.last);
}

TEST_CASE("where a short cut opens, Dyna-Q+ finds it and Dyna-Q does not, as in Fig. 8.5") {
  const GridWorld left = with_wall(".########"), both = with_wall(".#######.");
  const Rewards plain = through_a_change(0.0, left, both, 3000, 6000, 12);
  const Rewards plus = through_a_change(1e-3, left, both, 3000, 6000, 12);
  CHECK(plain.optimal == 0);
  CHECK(plus.optimal >= 8);
  CHECK(plus.last > 1.3 * plain.last);
}

TEST_CASE("without planning Dyna-Q is Q-learning") {
  QLearningConfig config;
  config.alpha = 0.1;
  config.gamma = 0.95;
  DynaQ dyna(maze_config(0), 4);
  QLearning q(config, 4);
  for (int i = 0; i < 20; ++i) {
    CHECK(run_round(dyna, dyna_maze()).steps == run_round(q, dyna_maze()).steps);
  }
}
