// The adaptive learner in a loop of one's own, where the straight way is a trap.
//
// A robot goes from S to G, cell by cell. The wall between them is open towards S: who goes nearer
// and nearer ends in it. The adaptive learner finds out that its estimate is wrong there, goes
// round, and makes its best round a habit. It is told what each step cost, and an estimate of the
// cost to go.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "devlearn/adaptive.hpp"

const std::string kCells =
    "###############"
    "#.............#"
    "#.....#####...#"
    "#.........#...#"
    "#.S.......#.G.#"
    "#.........#...#"
    "#.....#####...#"
    "#.............#"
    "###############";
constexpr int kWidth = 15;
const int kStart = static_cast<int>(kCells.find('S')), kGoal = static_cast<int>(kCells.find('G'));
constexpr int kMotions[] = {-kWidth, 1, kWidth, -1};  // up, right, down, left
constexpr int kShortest = 16;                         // steps

// Steps to the goal if nothing were in the way; 0 there and nowhere else.
double estimate(int cell) {
  return std::abs(cell / kWidth - kGoal / kWidth) + std::abs(cell % kWidth - kGoal % kWidth);
}

// What a round costs: 1 a step, and 1 more where it bumps into a wall.
int learned_round(devlearn::AdaptiveLearner& learner) {
  learner.begin_round();
  int cell = kStart, cost = 0;
  while (cell != kGoal) {
    const devlearn::Choice choice = learner.choose(cell, estimate(cell));
    const int there = cell + kMotions[choice.motion];
    const bool bumped = kCells[static_cast<std::size_t>(there)] == '#';
    if (!bumped) cell = there;
    learner.learn(1.0 + bumped, cell, estimate(cell), bumped);
    cost += 1 + bumped;
  }
  learner.end_round(true);
  return cost;
}

void print_summary(const char* what, std::vector<int> values) {
  std::sort(values.begin(), values.end());
  std::printf("  %-14s %4d (%d ... %d)\n", what, values[values.size() / 2], values.front(),
              values.back());
}

int main() {
  std::vector<int> first, last, habit;
  devlearn::AdaptiveConfig config;
  config.motion_count = 4;
  devlearn::AdaptiveLearner learner(config);
  for (int seed = 1; seed <= 11; ++seed) {
    learner = devlearn::AdaptiveLearner(config, seed);
    std::vector<int> costs;
    for (int i = 0; i < 60; ++i) costs.push_back(learned_round(learner));
    first.push_back(costs.front());
    last.push_back(costs.back());
    habit.push_back(static_cast<int>(learner.habit_cost().value()));
  }

  std::printf("cost from S to G: median of 11 seeds (least ... most)\n");
  print_summary("first round", first);
  print_summary("60th round", last);
  print_summary("the habit", habit);
  std::printf("  %-14s %4d\n", "shortest way", kShortest);

  const int deep = 4 * kWidth + 9;  // in the trap, before its wall
  std::printf(
      "what the last one knows of the bottom of the trap; motions are up, right, down, left\n");
  std::printf("%s", to_text(learner.explain(deep)).c_str());
  std::printf("adaptive SEF there: %.4g\n",
              -(estimate(deep) + learner.expected_loss(deep).value()));
  return *std::max_element(habit.begin(), habit.end()) <= 1.25 * kShortest ? 0 : 1;
}
