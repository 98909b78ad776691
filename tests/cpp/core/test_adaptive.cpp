#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/refusal.hpp"
#include "corridor.hpp"
#include "devlearn/adaptive.hpp"
#include "devlearn/error.hpp"
#include "devlearn/snapshot.hpp"

using namespace devlearn;

namespace {

struct Told {
  int motion;
  Kind kind;
  Event event;
  std::int64_t explored, effective;
  double value;
  friend bool operator==(const Told& a, const Told& b) {
    return a.motion == b.motion && a.kind == b.kind && a.event == b.event &&
           a.explored == b.explored && a.effective == b.effective && a.value == b.value;
  }
};

Told go(AdaptiveLearner& learner, Corridor& at, AllowedMotions allowed = {}) {
  const Choice choice = learner.choose(at.situation(), at.estimate(), allowed);
  const Corridor::Came came = at.step(choice.motion);
  const Development d =
      learner.learn(came.cost, at.situation(), at.arrived() ? 0.0 : at.estimate(), came.touched);
  return {choice.motion, choice.kind, d.event, d.explored_count, d.effective_count, *d.value};
}

// Rounds from the start; what each cost.
std::vector<double> rounds(AdaptiveLearner& learner, int count, bool door = true) {
  std::vector<double> costs;
  for (int i = 0; i < count; ++i) {
    Corridor at;
    at.door = door;
    learner.begin_round();
    double cost = 0.0;
    while (!at.arrived()) {
      const Choice choice = learner.choose(at.situation(), at.estimate());
      const Corridor::Came came = at.step(choice.motion);
      cost += came.cost;
      learner.learn(came.cost, at.situation(), at.arrived() ? 0.0 : at.estimate(), came.touched);
    }
    learner.end_round(true);
    costs.push_back(cost);
  }
  return costs;
}

}  // namespace

TEST_CASE("the first meeting sets what motions promise: the goal at w times the estimate") {
  AdaptiveLearner learner(four_motions(), 1);
  learner.choose(7, 50.0);
  const AdaptiveMemory memory = learner.situation(7);
  CHECK(memory.first_estimate == 50.0);
  for (const double loss : memory.losses) CHECK(loss == doctest::Approx(5.0).epsilon(1e-12));
  CHECK(memory.unexplored == std::vector<int>{0, 1, 2, 3});
  CHECK(*learner.expected_loss(7) == memory.losses[0]);
  CHECK_FALSE(learner.expected_loss(8).has_value());
}

TEST_CASE("q is the mean over outcomes of the loss and E from there, E the least q allowed") {
  AdaptiveLearner learner(four_motions(), 1);
  // From 1 (estimate 10) motion 2 led twice to 2 (estimate 8) and once to the goal.
  learner.update(1, 2, 3.0, 2, 8.0, 10.0);
  learner.update(1, 2, 5.0, 2, 8.0, 10.0);
  learner.update(1, 2, 11.0, 0, 0.0, 10.0);
  const double e2 = (1.1 - 1.0) * 8.0;
  const double q = ((3.0 - 2.0) + e2 + (5.0 - 2.0) + e2 + (11.0 - 10.0)) / 3.0;
  CHECK(learner.situation(1).losses[2] == doctest::Approx(q).epsilon(1e-12));
  CHECK(*learner.expected_loss(1) == doctest::Approx(1.0).epsilon(1e-12));  // the untried ones
  CHECK(learner.situation(1).ineffective == std::vector<int>{2});
  CHECK(learner.situation(1).times[2] == 3);
  const bool only[] = {false, false, true, false};
  learner.choose(1, 10.0, only);
  CHECK(*learner.expected_loss(1) == doctest::Approx(q).epsilon(1e-12));
  CHECK(learner.situation(1).effective == std::vector<int>{2});
}

TEST_CASE("what is learned at the goal is told back along the way, the largest change first") {
  AdaptiveConfig config = four_motions();
  config.recollections = 1000;
  AdaptiveLearner learner(config, 1);
  const bool only[] = {true, false, false, false};
  for (int s = 0; s < 10; ++s) {
    learner.choose(s, 10.0 - s, only);
    learner.cancel();
    learner.update(s, 0, 1.0, s + 1, 10.0 - (s + 1.0), 10.0 - s);
  }
  for (int s = 0; s < 10; ++s) CHECK(std::abs(*learner.expected_loss(s)) <= 0.05 * 10);
  learner.update(9, 0, 101.0, 0, 0.0, 1.0);  // the last step is dear: 50 in the mean of two
  for (int s = 0; s < 10; ++s)
    CHECK(*learner.expected_loss(s) == doctest::Approx(50.0).epsilon(0.02));
}

TEST_CASE(
    "a motion is held until the situation changes, it is interrupted, or for hold_limit steps") {
  AdaptiveConfig config = four_motions();
  config.hold_limit = 4;
  AdaptiveLearner learner(config, 3);
  const Choice first = learner.choose(5, 20.0);
  learner.learn(1.0, 5, 19.5);
  CHECK(learner.choose(5, 19.5).kind == Kind::kHeld);
  learner.learn(1.0, 5, 19.0);
  CHECK(learner.choose(5, 19.0).motion == first.motion);
  learner.learn(1.0, 5, 18.5);
  CHECK(learner.outcomes() == 0);
  learner.choose(5, 18.5);
  CHECK(learner.learn(1.0, 5, 18.0).event != Event::kNothing);  // the fourth
  CHECK(learner.outcomes() == 1);
  const Choice second = learner.choose(5, 18.0);
  CHECK(second.kind != Kind::kHeld);
  learner.learn(6.0, 5, 18.0, true);
  CHECK(learner.outcomes() == 2);
  CHECK(learner.choose(5, 18.0).kind != Kind::kHeld);
  learner.learn(1.0, 6, 17.0);
  CHECK(learner.outcomes() == 3);
}

TEST_CASE("the lists are views: tried with q up to E, above it, and not tried") {
  AdaptiveLearner learner(four_motions(), 5);
  rounds(learner, 30);
  std::int64_t explored = 0, effective = 0;
  for (const SituationId situation : learner.situations()) {
    const AdaptiveMemory memory = learner.situation(situation);
    CHECK(memory.effective.size() + memory.ineffective.size() + memory.unexplored.size() == 4);
    double least = std::numeric_limits<double>::infinity();
    for (const double loss : memory.losses) least = std::min(least, loss);
    CHECK(memory.expected_loss == least);
    for (const int m : memory.effective) CHECK(memory.losses[m] <= memory.expected_loss);
    for (const int m : memory.ineffective) CHECK(memory.losses[m] > memory.expected_loss);
    for (const int m : memory.unexplored) CHECK(memory.times[m] == 0);
    explored += static_cast<std::int64_t>(memory.effective.size() + memory.ineffective.size());
    effective += static_cast<std::int64_t>(memory.effective.size());
  }
  CHECK(learner.explored_count() == explored);
  CHECK(learner.effective_count() == effective);
}

TEST_CASE("it finds the shortest way, makes it a habit, and the habit is exact") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    AdaptiveLearner learner(four_motions(), seed);
    const std::vector<double> costs = rounds(learner, 300);
    // Five leaps of six places for one step each: 60 - 5 * 6 + 5.
    CHECK(costs.back() == 35.0);
    CHECK(*learner.habit_cost() == 35.0);
    CHECK(costs[250] == costs.back());
  }
}

TEST_CASE("a round by habit is told so, and where it deviates, too") {
  AdaptiveLearner learner(four_motions(), 2);
  rounds(learner, 300);
  Corridor at;
  learner.begin_round();
  int habits = 0;
  while (!at.arrived()) {
    const Told told = go(learner, at);
    CHECK((told.kind == Kind::kHabit || told.kind == Kind::kHeld));
    habits += told.kind == Kind::kHabit ? 1 : 0;
  }
  learner.end_round(true);
  CHECK(habits > 10);
}

TEST_CASE("where the way is blocked the habit is given up, and another found") {
  AdaptiveLearner learner(four_motions(), 4);
  rounds(learner, 300);
  const std::vector<double> costs = rounds(learner, 60, false);
  CHECK(costs.front() > 35.0);
  CHECK(costs.back() == 60.0);
}

TEST_CASE("curious rounds find what has opened, and without them it is not noticed") {
  int found = 0;
  for (const int every : {10, 0}) {
    AdaptiveConfig config = four_motions();
    config.curious_every = every;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      AdaptiveLearner learner(config, seed);
      rounds(learner, 300, false);
      CHECK(*learner.habit_cost() == 60.0);
      rounds(learner, 200, true);
      if (every > 0) {
        CHECK(*learner.habit_cost() == 35.0);
      } else {
        found += *learner.habit_cost() < 60.0 ? 1 : 0;
      }
    }
  }
  CHECK(found == 0);
}

TEST_CASE("what was once in the way is forgotten in curious rounds only, not after their arrival") {
  AdaptiveConfig config = four_motions();
  config.curious_every = 1;
  config.stale_after = 1;
  AdaptiveLearner learner(config, 4);
  rounds(learner, 60, false);
  Corridor at;
  at.door = false;
  learner.begin_round();
  const auto until = [&](auto found) {
    while (!at.arrived() && !found()) go(learner, at);
  };
  go(learner, at);
  while (!learner.state().round.curious) {
    until([] { return false; });
    learner.end_round(true);
    at.place = 0;
    learner.begin_round();
    go(learner, at);
  }
  until([] { return false; });
  // On from the goal, without an end, by a motion that was once in vain.
  const AdaptiveState state = learner.state();
  std::size_t stale = 0;
  while (state.arrays.interrupted[stale] == 0 || state.arrays.interrupted[stale] == state.rounds) {
    ++stale;
  }
  const SituationId situation = state.arrays.situation[stale / 4];
  const auto motion = static_cast<int>(stale % 4);
  const std::uint32_t times = learner.situation(situation).times[motion];
  bool only[4]{};
  only[motion] = true;
  learner.choose(situation, 9.0, only);
  learner.learn(1.0, situation + 1, 8.0);
  CHECK(learner.situation(situation).times[motion] == times + 1);
}

TEST_CASE("a look for what has opened ends with the habit that it was for") {
  AdaptiveConfig config = four_motions();
  config.curious_every = 1;
  config.sweep_limit = 1;
  AdaptiveLearner learner(config, 4);
  for (int i = 0; i < 300 && !learner.state().habit.looking; ++i) rounds(learner, 1, false);
  REQUIRE(learner.state().habit.looking);
  REQUIRE(learner.forget(10));
  CHECK_FALSE(learner.state().habit.looking);
  // And where a better one takes its place.
  config.recollections = 1;
  config.patience = 0;
  int replaced = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    AdaptiveLearner other(config, seed);
    for (int i = 0; i < 100; ++i) {
      const AdaptiveHabit before = other.state().habit;
      rounds(other, 1);
      const AdaptiveHabit after = other.state().habit;
      if (!other.state().hope.under_way() || after.cost >= before.cost) continue;
      ++replaced;
      CHECK_FALSE(after.looking);
    }
  }
  CHECK(replaced > 0);
}

TEST_CASE("what was learned elsewhere, or in free steps, leaves the habit alone") {
  AdaptiveLearner learner(four_motions(), 6);
  rounds(learner, 300);
  const AdaptiveHabit before = learner.state().habit;
  learner.begin_round();
  Corridor at;
  at.place = 20;
  while (!at.arrived()) go(learner, at);
  learner.end_round(true);
  CHECK(learner.state().habit.cost == before.cost);
  CHECK(learner.state().habit.since == before.since);
  // On from the goal, without an end.
  learner.begin_round();
  Corridor free;
  while (!free.arrived()) go(learner, free);
  free = {};
  for (int i = 0; i < 500; ++i) {
    go(learner, free);
    if (free.arrived()) free = {};
  }
  learner.end_round(false);
  CHECK(learner.state().habit.cost == before.cost);
  CHECK(learner.state().habit.since == before.since);
}

TEST_CASE("without rounds there is no habit, and the way is learned as well") {
  AdaptiveLearner learner(four_motions(), 7);
  for (int i = 0; i < 100; ++i) {
    Corridor at;
    while (!at.arrived()) go(learner, at);
  }
  CHECK_FALSE(learner.habit_cost().has_value());
  Corridor at;
  double steps = 0.0;
  while (!at.arrived()) {
    go(learner, at);
    ++steps;
  }
  CHECK(steps <= 45.0);
}

TEST_CASE("a masked motion is never chosen, and a held one that is masked ends as interrupted") {
  AdaptiveLearner learner(four_motions(), 8);
  const bool no_wall[] = {true, true, false, false};
  for (int i = 0; i < 20; ++i) {
    Corridor at;
    learner.begin_round();
    while (!at.arrived()) CHECK(go(learner, at, no_wall).motion < 2);
    learner.end_round(true);
  }
  const bool forward[] = {true, false, false, false}, back[] = {false, true, false, false};
  learner.choose(100, 9.0, forward);
  learner.learn(1.0, 100, 8.5);
  CHECK(learner.choose(100, 8.5, back).motion == 1);
  CHECK(learner.situation(100).times[0] == 1);
}

TEST_CASE("cancel before the first step undoes the choice, later it ends the decision") {
  AdaptiveLearner learner(four_motions(), 9);
  learner.begin_round();
  learner.choose(3, 9.0);
  learner.cancel();
  CHECK(learner.outcomes() == 0);
  CHECK_FALSE(learner.pending().has_value());
  learner.choose(3, 9.0);
  learner.learn(1.0, 3, 8.5);
  learner.choose(3, 8.5);
  learner.cancel();
  CHECK(learner.outcomes() == 1);
  CHECK(learner.choose(3, 8.5).kind != Kind::kHeld);
}

TEST_CASE("a round without a step counts for nothing, and makes no habit") {
  AdaptiveLearner learner(four_motions(), 9);
  learner.begin_round();
  learner.choose(3, 9.0);
  learner.end_round(true);
  learner.begin_round();
  learner.choose(3, 9.0);
  learner.cancel();
  learner.end_round(true);
  CHECK_FALSE(learner.habit_cost().has_value());
  CHECK(learner.state().habit.since == 0);
  CHECK(to_bytes(AdaptiveLearner(learner.state())) == to_bytes(learner));
}

TEST_CASE("a round begins where its first step is made, and its habit, too") {
  AdaptiveConfig config = four_motions();
  config.patience = 0;
  AdaptiveLearner learner(config, 9);
  const auto go_from = [&learner](SituationId cancelled) {
    learner.begin_round();
    learner.choose(cancelled, 9.0);
    learner.cancel();
    learner.choose(4, 5.0);
    const bool by_habit = learner.state().round.by_habit;
    learner.learn(5.0, 0, 0.0);
    learner.end_round(true);
    CHECK(to_bytes(AdaptiveLearner(learner.state())) == to_bytes(learner));
    return by_habit;
  };
  CHECK_FALSE(go_from(3));
  CHECK(learner.habit_cost() == 5.0);
  CHECK(learner.state().arrays.habit.situation == std::vector<std::uint32_t>{1});  // that is 4
  CHECK(go_from(3));
  CHECK(go_from(4));
}

TEST_CASE("what is forgotten is as at the first meeting, and a habit through it is dropped") {
  AdaptiveLearner learner(four_motions(), 10);
  rounds(learner, 100);
  REQUIRE(learner.habit_cost().has_value());
  const std::size_t outcomes = learner.outcomes();
  CHECK(learner.forget(10));
  CHECK_FALSE(learner.forget(1000));
  CHECK(learner.outcomes() < outcomes);
  CHECK(learner.situation(10).unexplored == std::vector<int>{0, 1, 2, 3});
  CHECK_FALSE(learner.habit_cost().has_value());
  CHECK(rounds(learner, 300).back() == 35.0);
}

TEST_CASE("best is the tried motion of least loss, and changes nothing") {
  AdaptiveLearner learner(four_motions(), 11);
  rounds(learner, 100);
  const std::vector<std::byte> before = to_bytes(learner);
  for (const SituationId situation : learner.situations()) {
    const AdaptiveMemory memory = learner.situation(situation);
    const std::optional<int> best = learner.best(situation);
    for (int m = 0; best && m < 4; ++m) {
      if (memory.times[m] > 0) CHECK(memory.losses[*best] <= memory.losses[m]);
    }
  }
  CHECK_FALSE(learner.best(12345).has_value());
  learner.explain(3);
  learner.explain(999);
  CHECK(to_bytes(learner) == before);
}

TEST_CASE("an explanation says what choose then does") {
  AdaptiveConfig config = four_motions();
  config.recollections = 1;  // so that much is left to deviations
  AdaptiveLearner learner(config, 12);
  int held = 0, habit = 0, deviation = 0, valued = 0, unstated = 0;
  for (int round = 0; round < 200; ++round) {
    Corridor at;
    learner.begin_round();
    while (!at.arrived()) {
      const AdaptiveExplanation why = learner.explain(at.situation());
      const Choice choice = learner.choose(at.situation(), at.estimate());
      // At a round's first decision it is yet to be told whether it goes by habit.
      if (at.place > 0 && why.motion >= 0) CHECK(choice.motion == why.motion);
      if (at.place > 0 && why.kind != Kind::kUnstated) CHECK(choice.kind == why.kind);
      unstated += why.kind == Kind::kUnstated ? 1 : 0;
      held += why.held >= 0 ? 1 : 0;
      habit += why.kind == Kind::kHabit ? 1 : 0;
      deviation += choice.kind == Kind::kDeviation ? 1 : 0;
      valued += why.motion < 0 ? 1 : 0;
      if (choice.kind != Kind::kHeld) {
        const auto last = learner.last_choice();
        REQUIRE(last.has_value());
        CHECK(last->motion == choice.motion);
        CHECK(last->kind == choice.kind);
        CHECK(last->situation == at.situation());
        CHECK(to_text(*last).find("situation " + std::to_string(at.situation())) == 0);
      }
      const Corridor::Came came = at.step(choice.motion);
      learner.learn(came.cost, at.situation(), at.arrived() ? 0.0 : at.estimate(), came.touched);
    }
    learner.end_round(true);
  }
  CHECK(held > 0);
  CHECK(habit > 0);
  CHECK(deviation > 0);
  CHECK(valued > 0);
  CHECK(unstated < valued);
}

TEST_CASE("an explanation states no kind that a draw is to decide") {
  AdaptiveLearner learner(four_motions(), 12);
  learner.update(1, 0, 1.0, 0, 0.0, 10.0);  // better than what was not tried
  learner.update(1, 1, 1.0, 0, 0.0, 10.0);
  const AdaptiveExplanation tried = learner.explain(1);
  CHECK(tried.motion == -1);
  CHECK(tried.kind == Kind::kExploit);
  CHECK(learner.explain(2).kind == Kind::kExplore);
  learner.update(3, 0, 11.0, 0, 0.0, 10.0);  // as good as what was not tried
  CHECK(learner.explain(3).kind == Kind::kUnstated);
}

TEST_CASE("the recollections of a decision are told, each with what it changed") {
  AdaptiveLearner learner(four_motions(), 13);
  learner.update(1, 0, 4.0, 2, 9.0, 10.0);
  const std::vector<Recollection> told = learner.explain(1).recollections;
  REQUIRE(told.size() == 1);
  CHECK(told[0].situation == 1);
  CHECK(told[0].motion == 0);
  CHECK(told[0].loss_before == doctest::Approx(1.0));
  CHECK(told[0].loss == doctest::Approx(3.0 + 0.9));
}

// --- resumed equal to the bit
// ----------------------------------------------------------------------

TEST_CASE("a learner resumes equal to the bit wherever it is cut off") {
  for (const int every : {0, 3}) {
    for (const int limit : {0, 7}) {
      AdaptiveConfig config = four_motions();
      config.curious_every = every;
      config.stale_after = 20;
      config.sweep_limit = limit;
      AdaptiveLearner learner(config, 21);
      int cut = 0;
      for (int round = 0; round < 120; ++round) {
        Corridor at;
        at.door = round > 60;
        learner.begin_round();
        while (!at.arrived()) {
          const bool now = cut++ % 17 == 0;
          std::vector<std::byte> bytes = now ? to_bytes(learner) : std::vector<std::byte>();
          const Choice choice = learner.choose(at.situation(), at.estimate());
          if (now) {
            AdaptiveLearner again = load_adaptive_learner(bytes.data(), bytes.size());
            const Choice same = again.choose(at.situation(), at.estimate());
            REQUIRE(same.motion == choice.motion);
            REQUIRE(same.kind == choice.kind);
            REQUIRE(to_bytes(again) == to_bytes(learner));
            learner = again;
            bytes = to_bytes(learner);  // in the middle of a decision
            learner = load_adaptive_learner(bytes.data(), bytes.size());
          }
          const Corridor::Came came = at.step(choice.motion);
          learner.learn(came.cost, at.situation(), at.arrived() ? 0.0 : at.estimate(),
                        came.touched);
        }
        learner.end_round(true);
      }
      // And as one that was never cut off.
      AdaptiveLearner whole(config, 21);
      for (int round = 0; round < 120; ++round) rounds(whole, 1, round > 60);
      CHECK(to_bytes(whole) == to_bytes(learner));
    }
  }
}

TEST_CASE("copies go on alike, and apart") {
  AdaptiveLearner learner(four_motions(), 22);
  rounds(learner, 20);
  AdaptiveLearner copy = learner;
  CHECK(rounds(copy, 50) == rounds(learner, 50));
  rounds(copy, 1, false);
  CHECK(to_bytes(copy) != to_bytes(learner));
}

TEST_CASE("a copy tells of its recollections, too") {
  const AdaptiveLearner fresh(four_motions(), 22);
  AdaptiveLearner copy = fresh;
  copy.update(1, 0, 4.0, 2, 9.0, 10.0);
  CHECK(copy.explain(1).recollections.size() == 1);
}

TEST_CASE("room that was reserved changes nothing") {
  AdaptiveLearner learner(four_motions(), 23), roomy(four_motions(), 23);
  roomy.reserve(1000, 5000);
  CHECK(rounds(roomy, 100) == rounds(learner, 100));
  CHECK(to_bytes(roomy) == to_bytes(learner));
  CHECK(roomy.memory_use().spare > learner.memory_use().spare);
}

// --- refusals
// --------------------------------------------------------------------------------------

TEST_CASE("what is out of range is refused, by name, and nothing has changed") {
  AdaptiveLearner learner(four_motions(), 24);
  rounds(learner, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  std::vector<std::byte> before = to_bytes(learner);
  check_refused([&] { learner.choose(-1, 1.0); }, "situation", "-1");
  check_refused([&] { learner.choose(1, -0.5); }, "estimate", "-0.5");
  check_refused([&] { learner.choose(1, nan); }, "estimate", "nan");
  check_refused([&] { learner.choose(1, infinite); }, "estimate", "inf");
  const bool none[] = {false, false, false, false};
  check_refused([&] { learner.choose(1, 1.0, none); }, "allowed", "no motion");
  check_refused([&] { learner.learn(1.0, 1, 1.0); }, "AdaptiveLearner.learn",
                "no choice that waits for its step");
  check_refused([&] { learner.cancel(); }, "AdaptiveLearner.cancel",
                "no choice that waits for its step");
  check_refused([&] { learner.end_round(true); }, "AdaptiveLearner.end_round", "no round");
  check_refused([&] { learner.update(1, 4, 1.0, 2, 1.0); }, "motion", "4");
  check_refused([&] { learner.update(777, 1, 1.0, 2, 1.0); }, "estimate",
                "none for a situation never met");
  check_refused([&] { learner.update(1, 1, -1.0, 2, 1.0); }, "cost", "-1");
  check_refused([&] { learner.forget(-3); }, "situation", "-3");
  check_refused([&] { learner.explain(-3); }, "situation", "-3");
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  check_refused([&] { learner.reserve(kMost, 0); }, "situations", std::to_string(kMost));
  CHECK(to_bytes(learner) == before);
  learner.choose(1, 57.0);
  before = to_bytes(learner);
  check_refused([&] { learner.choose(1, 57.0); }, "AdaptiveLearner.choose",
                "a second choice before the first met its step");
  check_refused([&] { learner.learn(-0.5, 1, 1.0); }, "cost", "-0.5");
  check_refused([&] { learner.learn(nan, 1, 1.0); }, "cost", "nan");
  check_refused([&] { learner.learn(1.0, -1, 1.0); }, "situation", "-1");
  check_refused([&] { learner.learn(1.0, 1, -1.0); }, "next_estimate", "-1");
  check_refused([&] { learner.learn(1.0, 1, nan); }, "next_estimate", "nan");
  check_refused([&] { learner.forget(1); }, "AdaptiveLearner.forget",
                "the situation in which a decision is open");
  CHECK(to_bytes(learner) == before);
}

TEST_CASE("a setting outside its range is refused by name") {
  const auto refused = [](const char* name, const char* value, auto set) {
    AdaptiveConfig config;
    set(config);
    check_refused([&] { AdaptiveLearner{config}; }, "AdaptiveConfig." + std::string(name), value);
  };
  refused("motion_count", "0", [](auto& c) { c.motion_count = 0; });
  refused("optimism", "0.9", [](auto& c) { c.optimism = 0.9; });
  refused("hold_limit", "0", [](auto& c) { c.hold_limit = 0; });
  refused("recollections", "-1", [](auto& c) { c.recollections = -1; });
  refused("patience", "-1", [](auto& c) { c.patience = -1; });
  refused("gain", "-1", [](auto& c) { c.gain = -1.0; });
  refused("tolerance", "nan", [](auto& c) { c.tolerance = std::nan(""); });
  refused("detour", "-1", [](auto& c) { c.detour = -1.0; });
  refused("enough", "0.5", [](auto& c) { c.enough = 0.5; });
  refused("curious_every", "-1", [](auto& c) { c.curious_every = -1; });
  refused("stale_after", "0", [](auto& c) { c.stale_after = 0; });
  refused("sweep_limit", "-1", [](auto& c) { c.sweep_limit = -1; });
}
