// The closed loop: choose, move, sense, evaluate, learn, record.

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench.hpp"
#include "sim/box2d_world.hpp"
#include "sim/grown_worlds.hpp"

namespace devlearn::bench {
namespace {

void free_learnings(benchmark::State& state, const World& world, bool echoes = false) {
  std::int64_t contacts = 0;
  RunOptions options;
  options.echoes = echoes;
  for (auto _ : state) {
    contacts = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      state.PauseTiming();  // a trial is made once, however long it runs
      Trial trial(world, {}, seed);
      state.ResumeTiming();
      Record record;
      trial.free_learning(record, kSteps, options);
      contacts += std::count(record.collided.begin(), record.collided.end(), 1);
    }
  }
  per_step(state, kSeeds * kSteps);
  state.counters["contact_share"] = static_cast<double>(contacts) / (kSeeds * kSteps);
}

const auto* const closed_loop =
    add("trial/closed_loop", [](benchmark::State& state) { free_learnings(state, paper()); });

const auto* const echoing = add("trial/closed_loop_echoes", [](benchmark::State& state) {
  free_learnings(state, paper(), true);
});

// Free learnings of which the rounds alone are recorded; with a tally the steps are counted, too.
void rounds_alone(benchmark::State& state, bool with_tally) {
  const World world = paper();
  for (auto _ : state) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      state.PauseTiming();
      Trial trial(world, {}, seed);
      state.ResumeTiming();
      Record record;
      Tally tally;
      RunOptions options;
      options.rounds_only = true;
      if (with_tally) options.tally = &tally;
      trial.free_learning(record, kSteps, options);
    }
  }
  per_step(state, kSeeds * kSteps);
}

const auto* const rounds_only =
    add("trial/rounds_only", [](benchmark::State& state) { rounds_alone(state, false); });

const auto* const rounds_only_tally =
    add("trial/rounds_only_tally", [](benchmark::State& state) { rounds_alone(state, true); });

// The steps of a free learning that touched nothing, with Box2D driving at 60 Hz in a world that
// persists. The rest of the loop is devlearn's.
const auto* const box2d = add("box2d/closed_loop_60hz", [](benchmark::State& state) {
  constexpr int kSubsteps = 30;
  constexpr std::size_t kReplayed = 2000;
  const World world = paper();
  const Point target = world.def().target;
  const RobotDef robot;
  const SituationGrid grid;
  const StateEvaluation evaluation;
  std::vector<PastStep> steps = steps_where(false);
  steps.resize(kReplayed);
  Box2dWorld physics(world.def());
  for (auto _ : state) {
    Learner learner({}, 1);
    Record record;
    record.begin_round(1, steps.front().pose);
    double before = 0.0;
    for (const PastStep& step : steps) {
      Step now;
      now.situation = grid.situation(step.pose.x, step.pose.y, step.pose.heading);
      now.motion = learner.choose(now.situation).motion;
      const double turn = robot.steering_angles[static_cast<std::size_t>(step.motion)];
      now.pose = physics.drive(step.pose, step.pose.heading + turn, kSubsteps);
      const double dx = now.pose.x - target.x, dy = now.pose.y - target.y;
      now.goal_distance = std::sqrt(dx * dx + dy * dy);
      now.clearance = world.clearance({now.pose.x, now.pose.y});
      now.sef = evaluation(now.goal_distance, now.clearance);
      now.smf = now.smf_used = now.sef - before;
      learner.learn(step.smf_used);
      before = now.sef;
      record.append(now);
    }
    benchmark::DoNotOptimize(record);
  }
  per_step(state, kReplayed);
});

// Two rounds of free learning and 400 of path learning: one experiment of the paper.
const auto* const experiment = add("trial/experiment", [](benchmark::State& state) {
  const World world = paper();
  double steps = 0.0;
  for (auto _ : state) {
    Trial trial(world, {}, 1);
    Record record;
    trial.free_learning(record, kSteps);
    trial.free_learning(record, kSteps);
    trial.path_learning(record, 400);
    steps = static_cast<double>(record.steps());
  }
  per_step(state, steps);
});

// 600 rounds of path learning under either preset, four seeds.
void rounds(benchmark::State& state, const TrialConfig& config) {
  const World world = paper();
  double steps = 0.0;
  for (auto _ : state) {
    steps = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      Trial trial(world, config, seed);
      Record record;
      trial.path_learning(record, 600);
      steps += static_cast<double>(record.steps());
    }
  }
  per_step(state, steps);
}

const auto* const paper_rounds =
    add("trial/600_rounds", [](benchmark::State& state) { rounds(state, TrialConfig::paper()); });

const auto* const adaptive_rounds = add("trial/600_rounds_adaptive", [](benchmark::State& state) {
  rounds(state, TrialConfig::adaptive());
});

// --- growth ------------------------------------------------------------------------------------

const auto* const arena_grown =
    add("trial/8192_obstacles_arena_grown",
        [](benchmark::State& state) { free_learnings(state, grown()); });

const auto* const arena_kept = add("trial/8000_obstacles_arena_kept", [](benchmark::State& state) {
  free_learnings(state, shattered());
});

}  // namespace
}  // namespace devlearn::bench
