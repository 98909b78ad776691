// Saving and loading, per experienced situation.

#include "devlearn/snapshot.hpp"

#include <sstream>
#include <string>
#include <vector>

#include "bench.hpp"

namespace devlearn::bench {
namespace {

constexpr SituationId kSituations = 1'000'000;

Learner experienced() {
  Learner learner({}, 1);
  learner.reserve(kSituations);
  Xorshift random;
  for (SituationId i = 0; i < kSituations; ++i) {
    for (int motion = 0; motion < 5; ++motion) learner.update(i, motion, random.uniform() - 0.3);
  }
  return learner;
}

const auto* const saving = add("snapshot/to_bytes_1000000", [](benchmark::State& state) {
  const Learner learner = experienced();
  std::size_t size = 0;
  for (auto _ : state) {
    const std::vector<std::byte> bytes = to_bytes(learner);
    size = bytes.size();
    benchmark::DoNotOptimize(bytes.data());
  }
  per_step(state, kSituations);
  state.counters["bytes_per_situation"] = static_cast<double>(size) / kSituations;
});

const auto* const loading = add("snapshot/from_bytes_1000000", [](benchmark::State& state) {
  const std::vector<std::byte> bytes = to_bytes(experienced());
  for (auto _ : state) benchmark::DoNotOptimize(load_learner(bytes.data(), bytes.size()));
  per_step(state, kSituations);
});

}  // namespace
}  // namespace devlearn::bench
