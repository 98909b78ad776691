#pragma once

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/random.hpp"

/// The grid worlds of Sutton & Barto, drawn: S the start, G the goal, # a wall, ~ the cliff, from
/// which one is put back to the start. Motions: up, down, right, left; off the grid or into a wall,
/// one stays. A situation is a cell, numbered row by row.
class GridWorld {
 public:
  explicit GridWorld(std::vector<std::string> drawn) : drawn_(std::move(drawn)) {
    columns_ = static_cast<int>(drawn_[0].size());
    for (int cell = 0; cell < cells(); ++cell) {
      if (at(cell) == 'S') start = cell;
      if (at(cell) == 'G') goal = cell;
    }
  }

  double step_cost = 1.0, cliff_cost = 100.0, arrival_cost = 1.0;
  int start = 0, goal = 0;

  int cells() const { return columns_ * static_cast<int>(drawn_.size()); }
  char at(int cell) const {
    return drawn_[static_cast<std::size_t>(cell / columns_)]
                 [static_cast<std::size_t>(cell % columns_)];
  }
  int row(int cell) const { return cell / columns_; }

  /// Where a motion leads.
  int after(int cell, int motion) const {
    const int rows = static_cast<int>(drawn_.size());
    const int r = cell / columns_ + (motion == 1 ? 1 : 0) - (motion == 0 ? 1 : 0);
    const int c = cell % columns_ + (motion == 2 ? 1 : 0) - (motion == 3 ? 1 : 0);
    if (r < 0 || r >= rows || c < 0 || c >= columns_) return cell;
    const int next = r * columns_ + c;
    return at(next) == '#' ? cell : next;
  }

  devlearn::Observation observation(int cell) const {
    devlearn::Observation seen;
    seen.situation = cell;
    seen.estimate = std::abs(cell / columns_ - goal / columns_) +
                    std::abs(cell % columns_ - goal % columns_);  // steps, without walls
    seen.sef = -0.5 * seen.estimate;
    seen.motion_count = 4;
    return seen;
  }

  devlearn::Outcome outcome(int cell, int motion) const {
    int next = after(cell, motion);
    devlearn::Outcome outcome;
    outcome.cost = next == goal ? arrival_cost : step_cost;
    if (at(next) == '~') {
      next = start;
      outcome.cost = cliff_cost;
    }
    const devlearn::Observation there = observation(next);
    outcome.situation = next;
    outcome.arrived = next == goal;
    outcome.sef = there.sef;
    outcome.estimate = there.estimate;
    return outcome;
  }

  /// Steps of the shortest way from a cell to the goal, by breadth-first search that shuns the
  /// cliff; -1 where there is none.
  int shortest(int from) const {
    std::vector<int> steps(static_cast<std::size_t>(cells()), -1);
    std::deque<int> open{from};
    steps[static_cast<std::size_t>(from)] = 0;
    while (!open.empty()) {
      const int cell = open.front();
      open.pop_front();
      if (cell == goal) return steps[static_cast<std::size_t>(cell)];
      for (int motion = 0; motion < 4; ++motion) {
        const int next = after(cell, motion);
        if (at(next) == '~' || steps[static_cast<std::size_t>(next)] >= 0) continue;
        steps[static_cast<std::size_t>(next)] = steps[static_cast<std::size_t>(cell)] + 1;
        open.push_back(next);
      }
    }
    return -1;
  }

 private:
  std::vector<std::string> drawn_;
  int columns_ = 0;
};

/// What a round came to.
struct Round {
  int steps = 0;
  double reward = 0.0;
  bool arrived = false;
};

/// Steps from a cell until the agent arrives, or as many as the limit says.
inline Round run_round(devlearn::Agent& agent, const GridWorld& world, int limit = 100000) {
  Round round;
  agent.begin_round();
  for (int cell = world.start; round.steps < limit && !round.arrived; ++round.steps) {
    const int motion = agent.choose(world.observation(cell)).motion;
    const devlearn::Outcome outcome = world.outcome(cell, motion);
    agent.observe(outcome);
    cell = static_cast<int>(outcome.situation);
    round.reward += outcome.reward();
    round.arrived = outcome.arrived;
  }
  agent.end_round(round.arrived);
  return round;
}

/// The cells from the start to the goal along motions of the highest value, the first among equals;
/// nothing where that leads in circles.
template <class ValueAgent>
std::optional<std::vector<int>> greedy_path(const ValueAgent& agent, const GridWorld& world) {
  std::vector<int> path{world.start};
  while (path.back() != world.goal) {
    if (static_cast<int>(path.size()) > world.cells()) return std::nullopt;
    int best = 0;
    for (int motion = 1; motion < 4; ++motion) {
      if (agent.value(path.back(), motion) > agent.value(path.back(), best)) best = motion;
    }
    path.push_back(static_cast<int>(world.outcome(path.back(), best).situation));
  }
  return path;
}

/// A grid world of which the arrival alone is rewarded, with 1.
inline GridWorld rewarding_arrival(std::vector<std::string> drawn) {
  GridWorld world(std::move(drawn));
  world.step_cost = 0.0;
  world.arrival_cost = -1.0;
  return world;
}

/// The maze of Sutton & Barto, Example 8.1, each of its cells divided into scale x scale; start and
/// goal are one cell.
inline GridWorld dyna_maze(int scale = 1) {
  std::vector<std::string> drawn;
  for (const char* row :
       {".......#G", "..#....#.", "S.#....#.", "..#......", ".....#...", "........."}) {
    for (int i = 0; i < scale; ++i) {
      drawn.emplace_back();
      for (const char cell : std::string(row)) {
        for (int j = 0; j < scale; ++j) {
          const bool whole = cell == '#' || i + j == 0;
          drawn.back() += whole ? cell : '.';
        }
      }
    }
  }
  return rewarding_arrival(drawn);
}

/// A square of cells, a fourth of them walls, with a way from start to goal.
inline GridWorld random_world(std::uint64_t seed, int side) {
  devlearn::Random random(seed, "grid");
  const auto cells = static_cast<std::uint32_t>(side);
  for (;;) {
    std::vector<std::string> drawn(cells, std::string(cells, '.'));
    for (std::string& row : drawn) {
      for (char& cell : row) cell = random.uniform() < 0.25 ? '#' : '.';
    }
    const auto draw = [&]() -> char& {
      std::string& row = drawn[random.index(cells)];
      return row[random.index(cells)];
    };
    draw() = 'S';
    draw() = 'G';
    const GridWorld world(drawn);
    if (world.at(world.start) == 'S' && world.shortest(world.start) > 0) return world;
  }
}

/// Sutton & Barto, Example 6.6.
inline GridWorld cliff_world() {
  return GridWorld({"............",  //
                    "............",  //
                    "............",  //
                    "S~~~~~~~~~~G"});
}

/// The mean reward of a round over rounds [first, first + count), and over runs of seeds 0, 1, ...
template <class ValueAgent>
double mean_reward(const typename ValueAgent::Config& config, const GridWorld& world, int runs,
                   int first, int count) {
  double sum = 0.0;
  for (int run = 0; run < runs; ++run) {
    ValueAgent agent(config, static_cast<std::uint64_t>(run));
    for (int i = 0; i < first; ++i) run_round(agent, world);
    for (int i = 0; i < count; ++i) sum += run_round(agent, world).reward;
  }
  return sum / (static_cast<double>(runs) * count);
}
