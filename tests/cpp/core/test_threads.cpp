#include <doctest/doctest.h>

#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "corridor.hpp"
#include "devlearn/adaptive.hpp"
#include "devlearn/error.hpp"
#include "devlearn/evaluation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/snapshot.hpp"

// Two learners share nothing. The preset `tsan` runs this under the thread sanitizer.
using namespace devlearn;

namespace {

// A life in a world of its own: sensing, choosing, learning, being copied, saved and loaded.
std::vector<std::byte> life(const LearnerConfig& config, std::uint64_t seed) {
  const SituationGrid grid(5.0, 5.0, 20, 20, 12);
  const StateEvaluation evaluation;
  Learner learner(config, seed);
  Random world(seed, "world");
  for (int i = 0; i < 3000; ++i) {
    const double x = 5.0 * world.uniform(), y = 5.0 * world.uniform();
    const Choice choice = learner.choose(grid.situation(x, y, 360.0 * world.uniform()));
    if (i % 7 == 0) {
      learner.cancel();
    } else {
      learner.learn(evaluation(5.0 * world.uniform(), world.uniform()) - choice.motion);
    }
    if (i % 500 == 0) {
      const std::vector<std::byte> bytes = to_bytes(learner);
      learner = load_learner(bytes.data(), bytes.size());
    }
    try {
      learner.update(-1, 0, 0.0);
    } catch (const InvalidValue&) {
    }
  }
  return to_bytes(learner);
}

// Rounds through a corridor whose door opens, being copied, saved and loaded.
std::vector<std::byte> life(const AdaptiveConfig& config, std::uint64_t seed) {
  AdaptiveLearner learner(config, seed);
  for (int round = 0; round < 120; ++round) {
    Corridor at;
    at.door = round >= 60;
    learner.begin_round();
    while (!at.arrived()) {
      const Choice choice = learner.choose(at.situation(), at.estimate());
      const Corridor::Came came = at.step(choice.motion);
      learner.learn(came.cost, at.situation(), at.arrived() ? 0.0 : at.estimate(), came.touched);
    }
    learner.end_round(true);
    if (round % 20 == 0) {
      const std::vector<std::byte> bytes = to_bytes(learner);
      learner = load_adaptive_learner(bytes.data(), bytes.size());
    }
    try {
      learner.update(-1, 0, 0.0, 0, 0.0);
    } catch (const InvalidValue&) {
    }
  }
  return to_bytes(learner);
}

// Each life in a thread of its own, and then alone.
template <typename Config>
void check_alone_and_together(const std::vector<std::pair<Config, std::uint64_t>>& cases) {
  std::vector<std::vector<std::byte>> together(cases.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    threads.emplace_back([&, i] { together[i] = life(cases[i].first, cases[i].second); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CHECK(together[i] == life(cases[i].first, cases[i].second));
  }
  CHECK(together.front() != together.back());
}

}  // namespace

TEST_CASE("learners in threads of their own live as if each were alone") {
  check_alone_and_together<LearnerConfig>(
      {{LearnerConfig::paper(), 1}, {LearnerConfig::step5(), 1}, {LearnerConfig::paper(), 2}});
}

TEST_CASE("adaptive learners in threads of their own live as if each were alone") {
  AdaptiveConfig curious = four_motions();
  curious.curious_every = 5;
  curious.stale_after = 20;
  curious.sweep_limit = 30;
  check_alone_and_together<AdaptiveConfig>(
      {{four_motions(), 1}, {curious, 1}, {four_motions(), 2}});
}
