// The learner, and the least tabular Q-learning loop beside it.

#include <algorithm>
#include <vector>

#include "bench.hpp"

namespace devlearn::bench {
namespace {

constexpr int kMotions = 5;
constexpr SituationId kSituations = 4800;
constexpr SituationId kManySituations = 4'800'000;
constexpr std::size_t kRandomSteps = 1'000'000;

// What is left of tabular Q-learning where nothing can go: a table of doubles, epsilon-greedy
// choice, one update a step.
class LeastQLearning {
 public:
  explicit LeastQLearning(SituationId situations) : values_(situations * kMotions) {}

  int choose(SituationId situation) {
    constexpr double kEpsilon = 0.1;
    if (random_.uniform() < kEpsilon) return static_cast<int>(random_.index(kMotions));
    const double* const row = &values_[situation * kMotions];
    int best = 0;
    for (int i = 1; i < kMotions; ++i) best = row[i] > row[best] ? i : best;
    return best;
  }

  void learn(SituationId situation, int motion, double reward, SituationId next) {
    constexpr double kRate = 0.1, kDiscount = 0.9;
    const double* const row = &values_[next * kMotions];
    double most = row[0];
    for (int i = 1; i < kMotions; ++i) most = row[i] > most ? row[i] : most;
    double& value = values_[situation * kMotions + motion];
    value += kRate * (reward + kDiscount * most - value);
  }

 private:
  std::vector<double> values_;
  Xorshift random_;
};

struct Met {
  SituationId situation;
  double smf;
};

std::vector<Met> recorded() {
  std::vector<Met> met;
  for (const auto& history : histories()) {
    for (const PastStep& step : history) met.push_back({step.situation, step.smf_used});
  }
  return met;
}

std::vector<Met> random_steps() {
  Xorshift random;
  std::vector<Met> met(kRandomSteps);
  for (Met& one : met) {
    one.situation = static_cast<SituationId>(random.index(kManySituations));
    one.smf = 2.0 * random.uniform() - 1.0;
  }
  return met;
}

void q_learn(benchmark::State& state, const std::vector<Met>& met, LeastQLearning& table) {
  for (auto _ : state) {
    for (std::size_t i = 0; i + 1 < met.size(); ++i) {
      const int motion = table.choose(met[i].situation);
      table.learn(met[i].situation, motion, met[i].smf, met[i + 1].situation);
    }
  }
  per_step(state, static_cast<double>(met.size() - 1));
}

void step(Learner& learner, const Met& met) {
  benchmark::DoNotOptimize(learner.choose(met.situation));
  benchmark::DoNotOptimize(learner.learn(met.smf));
}

const auto* const q_small = add("q_learning/4800", [](benchmark::State& state) {
  LeastQLearning table(kSituations);
  q_learn(state, recorded(), table);
});

const auto* const q_large = add("q_learning/4800000", [](benchmark::State& state) {
  LeastQLearning table(kManySituations);
  q_learn(state, random_steps(), table);
});

std::vector<std::vector<Met>> met_by_seed() {
  std::vector<std::vector<Met>> met;
  for (const auto& history : histories()) {
    met.emplace_back();
    for (const PastStep& one : history) met.back().push_back({one.situation, one.smf_used});
  }
  return met;
}

// As it was recorded. The learner, like the table beside it, is made before, with room for all.
const auto* const replay = add("learner/replay", [](benchmark::State& state) {
  const auto met = met_by_seed();
  std::vector<Learner> fresh;
  for (std::uint64_t seed = 1; seed <= met.size(); ++seed) {
    fresh.emplace_back(LearnerConfig{}, seed);
    fresh.back().reserve(kSituations);
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < met.size(); ++i) {
      state.PauseTiming();
      Learner learner = fresh[i];  // its pages are in hand before anything is timed
      state.ResumeTiming();
      for (const Met& one : met[i]) step(learner, one);
    }
  }
  per_step(state, kSeeds * kSteps);
});

// The same with memory that the learner asks for as it goes, and the system's first touch of it.
const auto* const from_nothing = add("learner/replay_from_nothing", [](benchmark::State& state) {
  const auto met = met_by_seed();
  for (auto _ : state) {
    for (std::size_t i = 0; i < met.size(); ++i) {
      Learner learner({}, i + 1);
      for (const Met& one : met[i]) step(learner, one);
    }
  }
  per_step(state, kSeeds * kSteps);
});

// Every situation was experienced before.
const auto* const random = add("learner/random_4800000", [](benchmark::State& state) {
  Learner learner({}, 1);
  learner.reserve(kManySituations);
  for (SituationId i = 0; i < kManySituations; ++i) {
    learner.update(i, static_cast<int>(i % kMotions), 1.0);
  }
  const std::vector<Met> met = random_steps();
  for (auto _ : state) {
    for (const Met& one : met) step(learner, one);
  }
  per_step(state, kRandomSteps);
});

}  // namespace
}  // namespace devlearn::bench
