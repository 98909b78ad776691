// How long one choose + learn takes, at worst: 10^7 steps in situations that were reserved, each
// timed by itself. The clock's own cost is measured in the same way and reported beside.
//
//     latency [STEPS]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bench.hpp"

namespace {

using namespace devlearn;
using Clock = std::chrono::steady_clock;

template <typename F>
void measure(const char* what, std::vector<std::uint32_t>& taken, F f) {
  for (std::uint32_t& ns : taken) {
    const Clock::time_point began = Clock::now();
    f();
    ns = static_cast<std::uint32_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - began).count());
  }
  std::sort(taken.begin(), taken.end());
  const auto quantile = [&](double q) {
    return taken[static_cast<std::size_t>(q * static_cast<double>(taken.size() - 1))];
  };
  std::printf("{\"what\": \"%s\", \"steps\": %zu, \"median\": %u, \"p99.9\": %u, \"worst\": %u}\n",
              what, taken.size(), quantile(0.5), quantile(0.999), taken.back());
}

}  // namespace

int main(int count, char** arguments) {
  const std::size_t steps = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 10'000'000;
  std::vector<std::uint32_t> taken(steps);  // its pages are in hand before anything is timed
  measure("clock", taken, [] {});

  constexpr SituationId kSituations = 100'000;
  bench::Xorshift random;
  Learner learner({}, 1);
  learner.reserve(kSituations);
  measure("choose_learn_100000", taken, [&] {
    const auto situation = static_cast<SituationId>(random.index(kSituations));
    const double smf = 2.0 * random.uniform() - 1.0;
    benchmark::DoNotOptimize(learner.choose(situation));
    benchmark::DoNotOptimize(learner.learn(smf));
  });

  // The situations of one robot's free learning, over and over.
  const std::vector<bench::PastStep> history = bench::free_learning(1);
  Learner paper({}, 1);
  paper.reserve(4800);
  std::size_t i = 0;
  measure("choose_learn_paper", taken, [&] {
    const bench::PastStep& step = history[i++ % history.size()];
    benchmark::DoNotOptimize(paper.choose(step.situation));
    benchmark::DoNotOptimize(paper.learn(step.smf_used));
  });
}
