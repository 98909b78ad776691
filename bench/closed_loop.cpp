// Free learning in the world `paper`: the trial as it is, the same loop with Box2D stepped at 60 Hz
// through every half second, and the learner alone.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "devlearn/trial.hpp"

namespace {

using namespace devlearn;

constexpr int kSteps = 10000;

World paper() { return World::load(std::string(DEVLEARN_WORLDS) + "/paper.json"); }

void report(benchmark::State& state, double contacts) {
  const auto steps = static_cast<double>(state.iterations()) * kSteps;
  state.counters["steps/s"] = benchmark::Counter(steps, benchmark::Counter::kIsRate);
  state.counters["contact share"] = contacts / steps;
}

void closed_loop(benchmark::State& state) {
  const World world = paper();
  std::uint64_t seed = 1;
  double contacts = 0.0;
  for (auto _ : state) {
    Trial trial(world, {}, seed++);
    const Record record = trial.free_learning(kSteps);
    contacts += static_cast<double>(std::count(record.collided.begin(), record.collided.end(), 1));
  }
  report(state, contacts);
}
BENCHMARK(closed_loop)->Unit(benchmark::kMillisecond);

void closed_loop_all_box2d_60hz(benchmark::State& state) {
  constexpr int kSubsteps = 30;  // of 1/60 s
  const World world = paper();
  const Point target = world.def().target;
  const Robot robot(world, {});
  const SituationGrid grid;
  const StateEvaluation evaluation;
  std::uint64_t seed = 1;
  double contacts = 0.0;
  const auto sef = [&](const Pose& pose) {
    const double dx = pose.x - target.x, dy = pose.y - target.y;
    return evaluation(std::sqrt(dx * dx + dy * dy), world.clearance({pose.x, pose.y}));
  };
  for (auto _ : state) {
    Learner learner({}, seed++);
    Pose pose = world.def().start;
    double before = sef(pose);
    for (int i = 0; i < kSteps; ++i) {
      const int motion = learner.choose(grid.situation(pose.x, pose.y, pose.heading)).motion;
      const Robot::Step moved = robot.step_simulated(pose, motion, kSubsteps);
      const double after = sef(moved.pose);
      learner.learn(moved.collided ? std::min(after - before, -1.0) : after - before);
      pose = moved.pose;
      before = after;
      contacts += moved.collided;
    }
  }
  report(state, contacts);
}
BENCHMARK(closed_loop_all_box2d_60hz)->Unit(benchmark::kMillisecond);

// Choices and learning alone, over the situations and outcomes of a recorded free learning.
void learner_alone(benchmark::State& state) {
  const Record record = Trial(paper(), {}, 1).free_learning(kSteps);
  for (auto _ : state) {
    Learner learner({}, 1);
    for (std::size_t i = 0; i < record.steps(); ++i) {
      benchmark::DoNotOptimize(learner.choose(record.situation[i]));
      learner.learn(record.smf_used[i]);
    }
  }
  report(state, 0.0);
}
BENCHMARK(learner_alone)->Unit(benchmark::kMillisecond);

}  // namespace
