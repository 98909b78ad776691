#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/explanation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"

using namespace devlearn;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// Lives a while among some situations, and lets `look` see every choice before its outcome.
template <typename Look>
void live(Learner& learner, int steps, const Look& look) {
  Random world(3, "world");
  for (int i = 0; i < steps; ++i) {
    const auto situation = static_cast<SituationId>(world.index(30));
    const Explanation before = learner.explain(situation);
    const Choice choice = learner.choose(situation);
    look(before, choice);
    learner.learn(world.uniform() * 4.0 - 2.0 + 0.3 * choice.motion);
  }
}

Learner experienced() {
  Learner learner({}, 7);
  live(learner, 3000, [](const Explanation&, const Choice&) {});
  return learner;
}

}  // namespace

TEST_CASE("the shares of exploring, exploiting and neither follow from the lists and sum to 1") {
  Learner learner({}, 1);
  int exhausted = 0;
  live(learner, 5000, [&](const Explanation& why, const Choice& choice) {
    const double n = static_cast<double>(why.memory.effective.size());
    const double n_r = static_cast<double>(why.memory.unexplored.size());
    if (n + n_r == 0.0) {
      ++exhausted;
      REQUIRE(why.exhausted == 1.0);
      REQUIRE(why.explore + why.exploit == 0.0);
    } else {
      REQUIRE(why.explore == n_r / (n + n_r));
      REQUIRE(why.exploit == n / (n + n_r));
      REQUIRE(why.exhausted == 0.0);
    }
    REQUIRE(sum(why.probability) == doctest::Approx(1.0).epsilon(1e-12));
    REQUIRE(why.probability[static_cast<std::size_t>(choice.motion)] > 0.0);
  });
  CHECK(exhausted > 100);
}

TEST_CASE("Eq. 5 and 7: curiosity, op and winner are those worked out from orientation and count") {
  const LearnerConfig config;
  for (const SituationId situation : experienced().situations()) {
    const Explanation why = experienced().explain(situation);
    const std::size_t n = why.memory.effective.size();
    REQUIRE(why.winner.size() == n);
    for (std::size_t k = 0; k < n; ++k) {
      REQUIRE(why.curiosity[k] == curiosity(why.memory.times_learned[k], config.c1, config.c2));
      REQUIRE(why.op_plain[k] == config.sigma * why.memory.orientation[k]);
      REQUIRE(why.op_curious[k] == why.op_plain[k] + (1.0 - config.sigma) * why.curiosity[k]);
      std::vector<double> op = why.op_plain;
      op[k] = why.op_curious[k];
      const auto highest = std::max_element(op.begin(), op.end()) - op.begin();
      REQUIRE(why.winner[k] == why.memory.effective[static_cast<std::size_t>(highest)]);
    }
  }
}

TEST_CASE("a motion is chosen as often as its explanation says; one off by 2 % is found out") {
  const Learner learner = experienced();
  constexpr int kChoices = 400000;
  for (const SituationId situation : {0, 7, 19, 29}) {
    Learner chooser = learner;
    const std::vector<double> expected = chooser.explain(situation).probability;
    std::vector<double> share(expected.size());
    for (int i = 0; i < kChoices; ++i) {
      share[static_cast<std::size_t>(chooser.choose(situation).motion)] += 1.0 / kChoices;
      chooser.cancel();
    }
    for (std::size_t i = 0; i < share.size(); ++i) {
      CHECK(share[i] == doctest::Approx(expected[i]).epsilon(0.02));
    }
  }
}

TEST_CASE("explaining changes nothing, not even for a situation never experienced") {
  const Learner learner = experienced();
  const std::vector<std::byte> before = to_bytes(learner);
  const Explanation fresh = learner.explain(123456789);
  CHECK(fresh.situation == 123456789);
  CHECK(fresh.explore == 1.0);
  CHECK(fresh.probability == std::vector<double>(5, 0.2));
  learner.explain(3);
  CHECK(to_bytes(learner) == before);
  CHECK_THROWS_AS(learner.explain(-1), InvalidValue);
}

TEST_CASE("the trace of a choice tells what was drawn and why that motion won") {
  Learner learner({}, 2);
  CHECK_FALSE(learner.last_choice().has_value());
  int exploited = 0;
  live(learner, 5000, [&](const Explanation& before, const Choice& choice) {
    const ChoiceTrace trace = learner.last_choice().value();
    REQUIRE(trace.choice.motion == choice.motion);
    REQUIRE(trace.choice.kind == choice.kind);
    REQUIRE(trace.explanation.situation == before.situation);
    REQUIRE(trace.explanation.memory.orientation == before.memory.orientation);
    REQUIRE(trace.explanation.probability == before.probability);
    const auto& effective = before.memory.effective;
    REQUIRE((trace.curious >= 0) == (choice.kind == Kind::kExploit));
    REQUIRE(trace.op.size() == (choice.kind == Kind::kExploit ? effective.size() : 0));
    if (choice.kind != Kind::kExploit) return;
    ++exploited;
    const auto place = std::find(effective.begin(), effective.end(), choice.motion);
    const auto highest = std::max_element(trace.op.begin(), trace.op.end());
    REQUIRE(place - effective.begin() == highest - trace.op.begin());
    const auto curious = std::find(effective.begin(), effective.end(), trace.curious);
    REQUIRE(curious != effective.end());
  });
  CHECK(exploited > 1000);
}

TEST_CASE("the trace stays as the choice was made, whatever is learned after it") {
  Learner learner = experienced();
  learner.choose(5);
  const std::string before = to_text(learner.last_choice().value());
  learner.update(5, 0, -3.0);
  learner.learn(-7.0);
  learner.update(5, 1, 2.0);
  CHECK(to_text(learner.last_choice().value()) == before);
  const Learner copy = learner;
  CHECK(to_text(copy.last_choice().value()) == before);
  CHECK(to_text(copy.explain(5)) != to_text(learner.last_choice()->explanation));
}

TEST_CASE("an explanation for people has a line for every motion, and a trace names the winner") {
  Learner learner = experienced();
  const std::string text = to_text(learner.explain(11));
  CHECK(std::count(text.begin(), text.end(), '\n') == 2 + 5);
  CHECK(text.find("situation 11: explore ") == 0);
  const Choice choice = learner.choose(11);
  const std::string trace = to_text(learner.last_choice().value());
  CHECK(trace.find("motion " + std::to_string(choice.motion) + ", ") == 0);
  CHECK(trace.find(text) != std::string::npos);
}

TEST_CASE("memory grows with the situations experienced, to at most 96 bytes each of 5 motions") {
  Learner learner;
  const MemoryUse before = learner.memory_use();
  CHECK(before.used + before.spare < 1000);
  for (SituationId i = 1; i <= 300000; ++i) {
    learner.update(i * 7919, 0, 1.0);
    if (i < 100) continue;
    const MemoryUse use = learner.memory_use();
    REQUIRE(use.used <= 96 * static_cast<std::size_t>(i));
    REQUIRE(use.spare <= use.used);
  }
}
