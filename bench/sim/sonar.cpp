// The sonars, and the bare raycasts of Box2D beside them.

#include <array>
#include <vector>

#include "bench.hpp"
#include "sim/box2d_world.hpp"

namespace devlearn::bench {
namespace {

// Directions come ready-made, so that the raycasts stay bare.
void raycasts(benchmark::State& state, double range) {
  const Box2dWorld world(paper().def(), 0.0);
  struct Rays {
    b2Vec2 from;
    std::array<b2Vec2, 5> to;
  };
  std::vector<Rays> all;
  for (const PastStep& step : steps_where(false)) {
    Rays rays{vector(step.pose.x, step.pose.y), {}};
    for (std::size_t i = 0; i < 5; ++i) {
      const double radians = (step.pose.heading - 90.0 + 45.0 * static_cast<double>(i)) * kRadians;
      rays.to[i] =
          vector(step.pose.x + range * std::cos(radians), step.pose.y + range * std::sin(radians));
    }
    all.push_back(rays);
  }
  for (auto _ : state) {
    for (const Rays& rays : all) {
      for (const b2Vec2& to : rays.to) benchmark::DoNotOptimize(world.ray(rays.from, to));
    }
  }
  per_step(state, static_cast<double>(all.size()));
}

const auto* const bare_3m =
    add("box2d/5_raycasts_3m", [](benchmark::State& state) { raycasts(state, 3.0); });

// As far as the sonars of the preset hear: the body's radius and 2 m.
const auto* const bare_2m =
    add("box2d/5_raycasts_2.1m", [](benchmark::State& state) { raycasts(state, 2.1); });

const auto* const sonar = add("sonar/5", [](benchmark::State& state) {
  const Robot robot(paper(), {});
  const std::vector<PastStep> steps = steps_where(false);
  std::array<double, 5> echoes;
  for (auto _ : state) {
    for (const PastStep& step : steps) {
      robot.sonar(step.pose, echoes.data());
      benchmark::DoNotOptimize(echoes);
    }
  }
  per_step(state, static_cast<double>(steps.size()));
});

}  // namespace
}  // namespace devlearn::bench
