// One step of the body, where a free learning touched something and where it did not; and plain
// stepping of the former: the same rule, with all of the world in Box2D.

#include <vector>

#include "bench.hpp"
#include "sim/box2d_world.hpp"

namespace devlearn::bench {
namespace {

template <typename F>
void over_steps(benchmark::State& state, const std::vector<PastStep>& steps, F f) {
  const Robot robot(paper(), {});
  for (auto _ : state) {
    for (const PastStep& step : steps) benchmark::DoNotOptimize(f(robot, step));
  }
  per_step(state, static_cast<double>(steps.size()));
}

Robot::Move moved(const Robot& robot, const PastStep& step) {
  return robot.step(step.pose, step.motion);
}

const auto* const touching = add(
    "contact/step", [](benchmark::State& state) { over_steps(state, steps_where(true), moved); });

const auto* const free = add("contact/free_step", [](benchmark::State& state) {
  over_steps(state, steps_where(false), moved);
});

// A world of Box2D made afresh, as the rule asks, of everything there is, and stepped 15 times.
const auto* const plain = add("contact/plain", [](benchmark::State& state) {
  constexpr int kSubsteps = 15;
  over_steps(state, steps_where(true), [](const Robot& robot, const PastStep& step) {
    const double turn = robot.def().steering_angles[static_cast<std::size_t>(step.motion)];
    Box2dWorld world(robot.world().def());
    return world.drive(step.pose, step.pose.heading + turn, kSubsteps);
  });
});

}  // namespace
}  // namespace devlearn::bench
