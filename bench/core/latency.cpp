// How long one choose + learn takes, at worst: 10^7 steps in situations that were reserved, each
// timed by itself. The clock's own cost is measured in the same way and reported beside.
//
//     latency [STEPS]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "bench.hpp"
#include "devlearn/adaptive.hpp"
#include "devlearn/agent.hpp"
#include "devlearn/trial.hpp"

namespace {

using namespace devlearn;
using Clock = std::chrono::steady_clock;

void print(const char* what, std::vector<std::uint32_t>& taken) {
  std::sort(taken.begin(), taken.end());
  const auto quantile = [&](double q) {
    return taken[static_cast<std::size_t>(q * static_cast<double>(taken.size() - 1))];
  };
  std::printf("{\"what\": \"%s\", \"steps\": %zu, \"median\": %u, \"p99.9\": %u, \"worst\": %u}\n",
              what, taken.size(), quantile(0.5), quantile(0.999), taken.back());
}

// An adaptive learner whose calls are timed, a step's together.
class Timed final : public Agent {
 public:
  Timed(AdaptiveLearner& learner, std::vector<std::uint32_t>& taken, std::size_t& step)
      : learner_(learner), taken_(taken), step_(step) {}

  void begin_round() override {
    timed([&] { learner_.begin_round(); });
  }
  Choice choose(const Observation& seen) override {
    Choice choice;
    timed([&] { choice = learner_.choose(seen.situation, seen.estimate, seen.allowed); });
    return choice;
  }
  Development observe(const Outcome& came) override {
    Development development;
    timed([&] {
      development = learner_.learn(came.cost, came.situation, came.estimate, came.collided);
    });
    if (step_ < taken_.size()) taken_[step_++] = static_cast<std::uint32_t>(ns_);
    ns_ = 0;
    return development;
  }
  void end_round(bool arrived) override {
    timed([&] { learner_.end_round(arrived); });
  }

 private:
  template <typename F>
  void timed(const F& f) {
    const Clock::time_point began = Clock::now();
    f();
    ns_ += std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - began).count();
  }

  AdaptiveLearner& learner_;
  std::vector<std::uint32_t>& taken_;
  std::size_t& step_;
  std::int64_t ns_ = 0;
};

// Experiments of 600 rounds in the world `paper`, one after the other, each from nothing.
void measure_adaptive(const char* what, std::vector<std::uint32_t>& taken, int sweep_limit) {
  const World world = bench::paper();
  AdaptiveConfig config;
  config.sweep_limit = sweep_limit;
  std::size_t step = 0;
  for (std::uint64_t seed = 1; step < taken.size(); ++seed) {
    AdaptiveLearner learner(config, seed);
    learner.reserve(4800, 60'000);
    Trial trial(world, TrialConfig::adaptive(), seed,
                std::make_shared<Timed>(learner, taken, step));
    Record record;
    RunOptions options;
    options.rounds_only = true;
    trial.path_learning(record, 600, 10'000, options);
  }
  print(what, taken);
}

template <typename F>
void measure(const char* what, std::vector<std::uint32_t>& taken, F f) {
  for (std::uint32_t& ns : taken) {
    const Clock::time_point began = Clock::now();
    f();
    ns = static_cast<std::uint32_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - began).count());
  }
  print(what, taken);
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

  measure_adaptive("adaptive_step_paper", taken, 0);
  measure_adaptive("adaptive_step_paper_sweep_limit_500", taken, 500);
}
