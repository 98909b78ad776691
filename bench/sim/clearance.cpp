// d_o of Eq. 6, and whether a way is free, where a free learning led.

#include <vector>

#include "bench.hpp"
#include "body/kinematics.hpp"
#include "sim/grown_worlds.hpp"

namespace devlearn::bench {
namespace {

template <typename F>
void over_steps(benchmark::State& state, const World& world, F f) {
  const Robot robot(world, {});
  const std::vector<PastStep> steps = steps_where(false);
  for (auto _ : state) {
    for (const PastStep& step : steps) benchmark::DoNotOptimize(f(robot, step));
  }
  per_step(state, static_cast<double>(steps.size()));
}

const auto* const clearance = add("clearance/geometric", [](benchmark::State& state) {
  over_steps(state, paper(), [](const Robot& robot, const PastStep& step) {
    return robot.world().clearance({step.pose.x, step.pose.y});
  });
});

const auto* const among_few = add("clearance/free_step", [](benchmark::State& state) {
  over_steps(state, paper(), [](const Robot& robot, const PastStep& step) {
    return free_step(robot.world(), robot.def(), step.pose, step.motion);
  });
});

const auto* const among_many = add("clearance/free_step_8000", [](benchmark::State& state) {
  over_steps(state, shattered(), [](const Robot& robot, const PastStep& step) {
    return free_step(robot.world(), robot.def(), step.pose, step.motion);
  });
});

}  // namespace
}  // namespace devlearn::bench
