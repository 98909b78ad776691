#include <doctest/doctest.h>

#include <cstdint>
#include <thread>
#include <vector>

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

}  // namespace

TEST_CASE("learners in threads of their own live as if each were alone") {
  struct Case {
    LearnerConfig config;
    std::uint64_t seed;
  };
  const std::vector<Case> cases{
      {LearnerConfig::paper(), 1}, {LearnerConfig::step5(), 1}, {LearnerConfig::paper(), 2}};
  std::vector<std::vector<std::byte>> together(cases.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    threads.emplace_back([&, i] { together[i] = life(cases[i].config, cases[i].seed); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CHECK(together[i] == life(cases[i].config, cases[i].seed));
  }
  CHECK(together[0] != together[2]);
}
