#pragma once

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "devlearn/trial.hpp"

namespace devlearn::bench {

/// Registers a benchmark. DEVLEARN_BENCH_ITERATIONS fixes how often it is repeated: instructions
/// are counted as the difference of two numbers, which leaves out whatever is done only once.
template <typename F>
benchmark::internal::Benchmark* add(const char* name, F f) {
  auto* added = benchmark::RegisterBenchmark(name, std::move(f));
  if (const char* n = std::getenv("DEVLEARN_BENCH_ITERATIONS")) added->Iterations(std::atol(n));
  return added;
}

/// Tells the driver how many steps one iteration does; its figures are per step.
inline void per_step(benchmark::State& state, double steps) { state.counters["steps"] = steps; }

/// The world `paper`.
inline World paper() { return World::load(std::string(DEVLEARN_WORLDS) + "/paper.json"); }

inline constexpr int kSeeds = 4, kSteps = 10000;

/// One step of a free learning in the world `paper`, under the paper's preset.
struct PastStep {
  Pose pose;  // before it
  SituationId situation;
  int motion;
  double smf_used;
  bool collided;
};

/// The free learning of a seed.
inline std::vector<PastStep> free_learning(std::uint64_t seed) {
  Record record;
  Trial(paper(), {}, seed).free_learning(record, kSteps);
  std::vector<PastStep> steps;
  steps.reserve(record.steps());
  for (std::size_t i = 0; i < record.steps(); ++i) {
    steps.push_back({{record.x[i], record.y[i], record.heading[i]},
                     record.situation[i],
                     record.motion[i],
                     record.smf_used[i],
                     record.collided[i] != 0});
  }
  return steps;
}

/// That of every seed, 1 ... kSeeds.
inline const std::vector<std::vector<PastStep>>& histories() {
  static const std::vector<std::vector<PastStep>> all = [] {
    std::vector<std::vector<PastStep>> made;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) made.push_back(free_learning(seed));
    return made;
  }();
  return all;
}

/// All steps of them with or without contact.
inline std::vector<PastStep> steps_where(bool collided) {
  std::vector<PastStep> found;
  for (const auto& history : histories()) {
    for (const PastStep& step : history) {
      if (step.collided == collided) found.push_back(step);
    }
  }
  return found;
}

/// xorshift64 (Marsaglia, 2003): the least generator.
class Xorshift {
 public:
  std::uint64_t next() noexcept {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return state_;
  }
  /// A double uniform on [0, 1).
  double uniform() noexcept { return static_cast<double>(next() >> 11) * 0x1p-53; }
  /// A whole number uniform on {0, ..., count - 1}, near enough.
  std::uint64_t index(std::uint64_t count) noexcept { return ((next() >> 32) * count) >> 32; }

 private:
  std::uint64_t state_ = 0x9e3779b97f4a7c15U;
};

}  // namespace devlearn::bench
