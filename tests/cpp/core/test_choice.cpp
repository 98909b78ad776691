#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/motor_memory.hpp"
#include "devlearn/random.hpp"

using namespace devlearn;

namespace {

// Sizes of the three lists.
struct Lists {
  int effective, ineffective, unexplored;
  int motion_count() const { return effective + ineffective + unexplored; }
};

// A situation where the first `effective` motions are in M_i and the last `unexplored` in RM_i.
struct Situation {
  explicit Situation(const Lists& lists)
      : storage(MotorMemory::bytes(lists.motion_count()) / 8),
        memory(storage.data(), lists.motion_count()) {
    memory.clear();
    for (int i = 0; i < lists.effective; ++i) memory.extend(memory.tried_count());
    for (int i = 0; i < lists.ineffective; ++i) memory.reject(memory.tried_count());
  }

  std::vector<std::uint64_t> storage;
  MotorMemory memory;
};

// Draws, and says what that means.
class Chooser {
 public:
  explicit Chooser(const LearnerConfig& config)
      : sigma_(config.sigma), curiosity_(config.c1, config.c2) {}

  Choice operator()(const MotorMemory& memory, Random& random) const {
    const Candidates left = candidates(memory);
    const auto count = static_cast<std::uint32_t>(left.count());
    const auto draw = static_cast<int>(random.index(count));
    return choice_at(memory, choose_motion(memory, left, draw, sigma_, curiosity_));
  }

 private:
  double sigma_;
  Curiosity curiosity_;
};

// --- frequencies ---

constexpr int kChoices = 1000000;
// Upper 1e-3 quantiles of chi-square with 1, 2, ... degrees of freedom.
constexpr double kCritical[] = {10.828, 13.816, 16.266, 18.467, 20.515, 22.458, 24.322, 26.124};

// Pearson's test at level alpha = 1e-3: whether these counts are refused as coming from these
// probabilities.
bool rejected(const std::vector<int>& counts, const std::vector<double>& probabilities) {
  double total = 0.0, chi_square = 0.0;
  for (const int count : counts) total += count;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = total * probabilities[i];
    chi_square += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  return chi_square > kCritical[counts.size() - 2];
}

// Counts of kChoices draws from these probabilities, by another generator.
std::vector<int> simulated(const std::vector<double>& probabilities, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::vector<int> counts(probabilities.size());
  for (int i = 0; i < kChoices; ++i) {
    double u = static_cast<double>(generator() >> 11) * 0x1p-53;
    std::size_t draw = 0;
    while (draw + 1 < counts.size() && u >= probabilities[draw]) u -= probabilities[draw++];
    ++counts[draw];
  }
  return counts;
}

// Checks that the counts pass, and that at this sample size a mutant whose first probability is
// 2 % too high or too low, the others making up for it, does not.
void check_frequencies(const std::vector<int>& counts, const std::vector<double>& probabilities) {
  CHECK_FALSE(rejected(counts, probabilities));
  CHECK_FALSE(rejected(simulated(probabilities, 1), probabilities));
  for (const double factor : {0.98, 1.02}) {
    std::vector<double> mutant = probabilities;
    mutant[0] *= factor;
    for (std::size_t i = 1; i < mutant.size(); ++i) {
      mutant[i] *= (1.0 - mutant[0]) / (1.0 - probabilities[0]);
    }
    CHECK(rejected(simulated(mutant, 2), probabilities));
  }
}

void check_uniform(const std::vector<int>& counts) {
  const double share = 1.0 / static_cast<double>(counts.size());
  check_frequencies(counts, std::vector<double>(counts.size(), share));
}

}  // namespace

TEST_CASE("Eq. 5: curiosity has the values worked out by hand") {
  CHECK(curiosity(1, 0.5, 1.0) == 0.5);
  CHECK(curiosity(2, 0.5, 1.0) == doctest::Approx(0.37754066879814544).epsilon(1e-15));
  CHECK(curiosity(3, 0.5, 1.0) == doctest::Approx(0.26894142136999512).epsilon(1e-15));
  CHECK(curiosity(9, 0.5, 1.0) == doctest::Approx(0.01798620996209156).epsilon(1e-15));
  CHECK(curiosity(1, 0.5, 3.0) == doctest::Approx(0.73105857863000488).epsilon(1e-15));
  CHECK(curiosity(4, 2.0, 3.0) == doctest::Approx(0.11920292202211756).epsilon(1e-15));
  CHECK(curiosity(4, 0.0, 3.0) == 0.5);
}

TEST_CASE(
    "Eq. 5: curiosity wanes with learning and is 0, not NaN, where the exponential overflows") {
  for (int n = 1; n < 1400; ++n) REQUIRE(curiosity(n + 1, 0.5, 1.0) < curiosity(n, 0.5, 1.0));
  CHECK(curiosity(1500, 0.5, 1.0) == 0.0);
  CHECK(curiosity(4294967295.0, 0.5, 1.0) == 0.0);
  CHECK(curiosity(4294967295.0, 1e6, -1e6) == 0.0);
  CHECK(curiosity(1, 1e6, 1e6) == 1.0);
}

TEST_CASE("Eq. 7: orientation and the one active curiosity add up as worked out by hand") {
  LearnerConfig config;
  Random random(20, "agent");
  // Orientations 0.6 and 0.4.
  Situation situation({2, 3, 0});
  MotorMemory& memory = situation.memory;
  memory.orient(0, 0.5);
  const auto learn = [&memory](int k, std::uint32_t times) {
    while (memory.times_learned(k) < times) memory.count_learning(k);
  };
  const auto winners = [&](double sigma) {
    config.sigma = sigma;
    const Chooser chosen(config);
    Random twin = random;
    // The winner by the motion whose curiosity is drawn, as often as not.
    std::vector<int> winner(2, -1);
    for (int i = 0; i < 50; ++i) {
      const std::uint32_t curious = twin.index(2);
      const Choice choice = chosen(memory, random);
      REQUIRE(choice.kind == Kind::kExploit);
      if (winner[curious] >= 0) REQUIRE(winner[curious] == choice.motion);
      winner[curious] = choice.motion;
    }
    return winner;
  };

  // Both learned once: 0.3 * 0.4 + 0.7 / 2 = 0.47 against 0.3 * 0.6 = 0.18.
  CHECK(winners(0.3) == std::vector<int>{0, 1});
  // sigma = 0.72: 0.288 + 0.14 = 0.428 against 0.432. sigma = 0.71: 0.284 + 0.145 = 0.429 against
  // 0.426.
  CHECK(winners(0.72) == std::vector<int>{0, 0});
  CHECK(winners(0.71) == std::vector<int>{0, 1});
  // The second learned six times: c = 1/(1 + e^2.5) = 0.0759, 0.12 + 0.0531 = 0.1731 against 0.18;
  // five times: c = 1/(1 + e^2) = 0.1192, 0.12 + 0.0834 = 0.2034.
  learn(1, 5);
  CHECK(winners(0.3) == std::vector<int>{0, 1});
  learn(1, 6);
  CHECK(winners(0.3) == std::vector<int>{0, 0});
}

TEST_CASE("Eq. 7: the first in M_i wins among equals") {
  LearnerConfig config;
  config.c1 = 1e6;  // no curiosity is left after the second learning
  const Chooser chosen(config);
  Random random(21, "agent");
  std::vector<std::uint64_t> storage(MotorMemory::bytes(5) / 8);
  MotorMemory memory(storage.data(), 5);
  memory.clear();
  for (const int motion : {3, 1, 4, 0}) memory.extend(memory.place_of(motion));
  for (int k = 0; k < 4; ++k) memory.count_learning(k);
  memory.reject(memory.tried_count());
  for (int i = 0; i < 1000; ++i) REQUIRE(chosen(memory, random).motion == 3);
}

TEST_CASE("Eq. 7: a choice takes one draw among the unexplored, then the effective motions") {
  const Chooser chosen{LearnerConfig{}};
  Random random(22, "agent"), twin = random;
  const Situation situation({2, 1, 3});
  for (int i = 0; i < 10000; ++i) {
    const Choice choice = chosen(situation.memory, random);
    const int drawn = static_cast<int>(twin.index(5));
    // Unexplored are 3, 4, 5; both effective motions are learned once, so that curiosity wins.
    REQUIRE(choice.kind == (drawn < 3 ? Kind::kExplore : Kind::kExploit));
    REQUIRE(choice.motion == (drawn < 3 ? 3 + drawn : drawn - 3));
  }
  const Situation exhausted({0, 5, 0});
  for (int i = 0; i < 10000; ++i) {
    const Choice choice = chosen(exhausted.memory, random);
    REQUIRE(choice.kind == Kind::kExhausted);
    REQUIRE(choice.motion == static_cast<int>(twin.index(5)));
  }
}

TEST_CASE("exploring has probability n_R/(n + n_R); a mutant off by 2 % is found out") {
  const Chooser chosen{LearnerConfig{}};
  std::uint64_t seed = 30;
  for (const Lists& lists :
       std::vector<Lists>{{1, 0, 4}, {2, 0, 3}, {3, 0, 2}, {4, 0, 1}, {1, 3, 1}, {2, 4, 3}}) {
    CAPTURE(lists.effective);
    CAPTURE(lists.unexplored);
    const Situation situation(lists);
    Random random(seed++, "agent");
    std::vector<int> counts(2);
    for (int i = 0; i < kChoices; ++i) {
      ++counts[chosen(situation.memory, random).kind == Kind::kExplore ? 0 : 1];
    }
    const double share =
        static_cast<double>(lists.unexplored) / (lists.effective + lists.unexplored);
    check_frequencies(counts, {share, 1.0 - share});
  }
}

TEST_CASE("a situation with nothing effective explores, one with nothing unexplored exploits") {
  const Chooser chosen{LearnerConfig{}};
  Random random(40, "agent");
  const Situation fresh({0, 0, 5}), half({0, 3, 2}), known({3, 2, 0});
  for (int i = 0; i < 10000; ++i) {
    REQUIRE(chosen(fresh.memory, random).kind == Kind::kExplore);
    REQUIRE(chosen(half.memory, random).kind == Kind::kExplore);
    REQUIRE(chosen(known.memory, random).kind == Kind::kExploit);
  }
}

TEST_CASE("the motion explored is uniform within RM_i; a mutant off by 2 % is found out") {
  const Chooser chosen{LearnerConfig{}};
  std::uint64_t seed = 50;
  for (const Lists& lists :
       std::vector<Lists>{{0, 0, 5}, {0, 2, 3}, {2, 1, 2}, {1, 1, 4}, {0, 0, 9}}) {
    CAPTURE(lists.effective);
    CAPTURE(lists.unexplored);
    const Situation situation(lists);
    Random random(seed++, "agent");
    std::vector<int> counts(lists.unexplored);
    for (int explored = 0; explored < kChoices;) {
      const Choice choice = chosen(situation.memory, random);
      if (choice.kind != Kind::kExplore) continue;
      ++counts[choice.motion - lists.effective - lists.ineffective];
      ++explored;
    }
    check_uniform(counts);
  }
}

TEST_CASE("the motion whose curiosity is drawn is uniform; a mutant off by 2 % is found out") {
  // Every motion is learned once, so that an active curiosity adds 0.7/2, more than the 0.3 that
  // orientations can differ by: the winner is the one that was drawn.
  const Chooser chosen{LearnerConfig{}};
  std::uint64_t seed = 60;
  for (const Lists& lists :
       std::vector<Lists>{{2, 3, 0}, {5, 0, 0}, {3, 1, 1}, {2, 0, 3}, {9, 0, 0}}) {
    CAPTURE(lists.effective);
    CAPTURE(lists.unexplored);
    Situation situation(lists);
    situation.memory.orient(1, 0.9);
    Random random(seed++, "agent");
    std::vector<int> counts(lists.effective);
    for (int exploited = 0; exploited < kChoices;) {
      const Choice choice = chosen(situation.memory, random);
      if (choice.kind != Kind::kExploit) continue;
      ++counts[choice.motion];
      ++exploited;
    }
    check_uniform(counts);
  }
}

TEST_CASE(
    "the motion of an exhausted situation is uniform in M; a mutant off by 2 % is found out") {
  const Chooser chosen{LearnerConfig{}};
  const Situation situation({0, 5, 0});
  Random random(70, "agent");
  std::vector<int> counts(5);
  for (int i = 0; i < kChoices; ++i) {
    ++counts[chosen(situation.memory, random).motion];
  }
  check_uniform(counts);
}
