#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "devlearn/eigen.hpp"
#include "devlearn/error.hpp"
#include "devlearn/explanation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"
#include "refusal.hpp"

// Choices among the motions that are allowed, what is best without a draw, and what is forgotten.
using namespace devlearn;

namespace {

constexpr int kMotions = 5;
using Mask = std::array<bool, kMotions>;
constexpr Mask kEvery{true, true, true, true, true};

Mask some_mask(Random& random) {
  for (;;) {
    Mask mask{};
    for (bool& allowed : mask) allowed = random.index(2) == 0;
    if (std::find(mask.begin(), mask.end(), true) != mask.end()) return mask;
  }
}

std::vector<int> allowed_of(const std::vector<int>& motions, const Mask& mask) {
  std::vector<int> left;
  std::copy_if(motions.begin(), motions.end(), std::back_inserter(left),
               [&](int motion) { return mask[static_cast<std::size_t>(motion)]; });
  return left;
}

// Step 3 as the paper says it, on lists from which all that is not allowed was struck.
Choice as_written(const SituationMemory& memory, const LearnerConfig& config, const Mask& mask,
                  Random& random) {
  const std::vector<int> effective = allowed_of(memory.effective, mask);
  const std::vector<int> unexplored = allowed_of(memory.unexplored, mask);
  const auto draws = static_cast<std::uint32_t>(effective.size() + unexplored.size());
  if (draws == 0) {
    const std::vector<int> any = allowed_of({0, 1, 2, 3, 4}, mask);
    return {any[random.index(static_cast<std::uint32_t>(any.size()))], Kind::kExhausted};
  }
  const std::size_t draw = random.index(draws);
  if (draw < unexplored.size()) return {unexplored[draw], Kind::kExplore};
  const int curious = effective[draw - unexplored.size()];
  int best = -1;
  double highest = 0.0;
  for (const int motion : effective) {
    const auto j = static_cast<std::size_t>(
        std::find(memory.effective.begin(), memory.effective.end(), motion) -
        memory.effective.begin());
    const double c =
        motion == curious ? curiosity(memory.times_learned[j], config.c1, config.c2) : 0.0;
    const double op = config.sigma * memory.orientation[j] + (1.0 - config.sigma) * c;
    if (best < 0 || op > highest) {
      best = motion;
      highest = op;
    }
  }
  return {best, Kind::kExploit};
}

template <typename T, typename = void>
struct Chooses : std::false_type {};
template <typename T>
struct Chooses<T, std::void_t<decltype(std::declval<Learner&>().choose(T{}))>> : std::true_type {};

}  // namespace

TEST_CASE("a choice among the allowed motions is step 3 on lists without the others") {
  std::map<Kind, int> kinds;
  for (const LearnerConfig& config : {LearnerConfig::paper(), LearnerConfig::step5()}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Learner learner(config, seed);
      Random draws(seed, "agent"), random(seed, "masks");
      for (int i = 0; i < 500; ++i) {
        const SituationId id = random.index(4);
        const Mask mask = some_mask(random);
        const Choice expected = as_written(learner.situation(id), config, mask, draws);
        const Choice choice = learner.choose(id, mask);
        REQUIRE(choice.motion == expected.motion);
        REQUIRE(choice.kind == expected.kind);
        REQUIRE(mask[static_cast<std::size_t>(choice.motion)]);
        ++kinds[choice.kind];
        learner.learn(2.0 * random.uniform() - 1.0);
      }
    }
  }
  for (const Kind kind : {Kind::kExplore, Kind::kExploit, Kind::kExhausted})
    CHECK(kinds[kind] > 100);
}

TEST_CASE("with every motion allowed the history is that without a word of it, to the bit") {
  Learner silent({}, 3), told({}, 3);
  Random random(3, "steps");
  for (int i = 0; i < 3000; ++i) {
    const SituationId id = random.index(9);
    silent.choose(id);
    told.choose(id, kEvery);
    const double smf = 4.0 * random.uniform() - 2.0;
    silent.learn(smf);
    told.learn(smf);
  }
  CHECK(to_bytes(silent) == to_bytes(told));
}

TEST_CASE("a motion that is never allowed is never named, nor learned about") {
  Learner learner({}, 1);
  Random random(1, "noise");
  const bool allowed[] = {true, true, false, false, false};
  for (int i = 0; i < 11000; ++i) {
    REQUIRE(learner.choose(7, allowed).motion < 2);
    learner.learn(random.uniform() < 0.2 ? -0.5 : 0.5);
  }
  const SituationMemory memory = learner.situation(7);
  CHECK(memory.unexplored == std::vector<int>{2, 3, 4});
}

TEST_CASE("probabilities, winners and the trace are of the allowed motions") {
  Random random(5, "masks");
  for (int i = 0; i < 200; ++i) {
    Learner learner({}, static_cast<std::uint64_t>(i));
    for (int k = 0; k < i % 30; ++k) {
      learner.choose(1);
      learner.learn(random.uniform() - 0.4);
    }
    const Mask mask = some_mask(random);
    const Explanation why = learner.explain(1, mask);
    CHECK(why.allowed == std::vector<bool>(mask.begin(), mask.end()));
    std::array<double, kMotions> share{};
    constexpr int kDraws = 4000;
    for (int k = 0; k < kDraws; ++k) {
      ++share[static_cast<std::size_t>(learner.choose(1, mask).motion)];
      learner.cancel();
    }
    double sum = 0.0;
    for (std::size_t motion = 0; motion < kMotions; ++motion) {
      CHECK(share[motion] / kDraws == doctest::Approx(why.probability[motion]).epsilon(0.2));
      if (!mask[motion]) CHECK(why.probability[motion] == 0.0);
      sum += why.probability[motion];
    }
    CHECK(sum == doctest::Approx(1.0));
    CHECK(why.explore + why.exploit + why.exhausted == doctest::Approx(1.0));
    for (std::size_t j = 0; j < why.winner.size(); ++j) {
      const bool drawn = mask[static_cast<std::size_t>(why.memory.effective[j])];
      CHECK((why.winner[j] >= 0) == drawn);
      if (drawn) CHECK(mask[static_cast<std::size_t>(why.winner[j])]);
    }

    const Choice choice = learner.choose(1, mask);
    const std::optional<ChoiceTrace> trace = learner.last_choice();
    REQUIRE(trace);
    CHECK(trace->choice.motion == choice.motion);
    CHECK(trace->choice.kind == choice.kind);
    CHECK(trace->explanation.allowed == why.allowed);
    CHECK(trace->explanation.probability == why.probability);
    const std::string text = to_text(*trace);
    const bool all = std::find(mask.begin(), mask.end(), false) == mask.end();
    CHECK((text.find("(not allowed)") == std::string::npos) == all);
    learner.cancel();
    learner.choose(1);
    CHECK(learner.last_choice()->explanation.allowed == std::vector<bool>(kMotions, true));
  }
}

TEST_CASE("what allows nothing, or is not of M, is refused, and nothing has changed") {
  Learner learner({}, 2);
  learner.choose(1);
  learner.learn(1.0);
  const std::vector<std::byte> before = to_bytes(learner);
  const bool none[kMotions] = {}, few[] = {true, true}, many[kMotions + 1] = {true};
  check_refused([&] { learner.choose(2, none); }, "allowed", "no motion");
  check_refused([&] { learner.choose(2, few); }, "allowed", "2 values");
  check_refused([&] { learner.choose(2, many); }, "allowed", "6 values");
  check_refused([&] { learner.explain(2, none); }, "allowed", "no motion");
  CHECK(to_bytes(learner) == before);
}

TEST_CASE("arrays of Eigen say what is allowed as well") {
  Learner one({}, 4), other({}, 4);
  const Mask mask{false, true, false, true, true};
  Eigen::Array<bool, kMotions, 1> array;
  array << false, true, false, true, true;
  for (int i = 0; i < 50; ++i) {
    CHECK(one.choose(1, mask).motion == other.choose(1, allowed_motions(array)).motion);
    one.learn(0.3);
    other.learn(0.3);
  }
}

TEST_CASE("a choice among few motions that waits is resumed equal to the bit") {
  Learner learner({}, 6);
  const Mask mask{false, true, true, false, true};
  for (int i = 0; i < 40; ++i) {
    learner.choose(i % 3, mask);
    const std::vector<std::byte> bytes = to_bytes(learner);
    Learner resumed = load_learner(bytes.data(), bytes.size());
    learner.learn(0.1 * (i % 7) - 0.2);
    resumed.learn(0.1 * (i % 7) - 0.2);
    CHECK(to_bytes(learner) == to_bytes(resumed));
  }
}

TEST_CASE("situations that are fractions or NaN do not compile") {
  CHECK(Chooses<int>::value);
  CHECK(Chooses<std::size_t>::value);
  CHECK(Chooses<SituationId>::value);
  CHECK_FALSE(Chooses<double>::value);
  CHECK_FALSE(Chooses<float>::value);
}

// --- best ---

TEST_CASE("the best motion is the effective one of highest orientation, and asking draws nothing") {
  static_assert(noexcept(std::declval<const Learner&>().best(1)));
  Learner learner({}, 7);
  CHECK(learner.best(1) == std::nullopt);
  CHECK(learner.best(-1) == std::nullopt);
  CHECK(learner.situations_experienced() == 0);
  Random random(7, "steps");
  for (int i = 0; i < 2000; ++i) {
    const SituationId id = random.index(5);
    const std::vector<std::byte> before = to_bytes(learner);
    const std::optional<int> best = learner.best(id);
    CHECK(to_bytes(learner) == before);
    const SituationMemory memory = learner.situation(id);
    if (memory.effective.empty()) {
      CHECK_FALSE(best);
    } else {
      const auto highest = std::max_element(memory.orientation.begin(), memory.orientation.end());
      CHECK(best ==
            memory.effective[static_cast<std::size_t>(highest - memory.orientation.begin())]);
    }
    learner.choose(id);
    learner.learn(3.0 * random.uniform() - 1.0);
  }
  learner.update(99, 4, 1.0);
  learner.update(99, 2, 1.0);  // as high
  CHECK(learner.best(99) == 4);
}

// --- forgetting, and the room there is ---

TEST_CASE("what is forgotten is as if never experienced, and the rest stays as it is") {
  LearnerConfig config;
  config.motion_count = 3;
  Learner learner(config, 8);
  std::map<SituationId, SituationMemory> model;
  std::vector<SituationId> order;
  Random random(8, "steps");
  std::int64_t forgotten = 0;
  for (int i = 0; i < 60000; ++i) {
    // Few at first, many, then few again; some with equal low bits.
    const std::uint32_t range = i < 20000 ? 40 : i < 40000 ? 3000 : 40;
    const SituationId id = SituationId{random.index(range)} << (random.index(2) * 40);
    if (random.index(3) == 0) {
      const auto place = std::find(order.begin(), order.end(), id);
      CHECK(learner.forget(id) == (place != order.end()));
      if (place == order.end()) continue;
      *place = order.back();
      order.pop_back();
      model.erase(id);
      ++forgotten;
    } else {
      learner.update(id, static_cast<int>(random.index(3)), random.uniform() - 0.5);
      if (model.count(id) == 0) order.push_back(id);
      model[id] = learner.situation(id);
    }
    if (i % 5000 == 0) {
      const std::vector<std::byte> bytes = to_bytes(learner);
      learner = load_learner(bytes.data(), bytes.size());
    }
    if (i % 97 != 0) continue;
    REQUIRE(learner.situations() == order);
    std::int64_t effective = 0, explored = 0, wrong = 0;
    for (const auto& [known, memory] : model) {
      effective += static_cast<std::int64_t>(memory.effective.size());
      explored += 3 - static_cast<std::int64_t>(memory.unexplored.size());
      const SituationMemory now = learner.situation(known);
      wrong += now.effective != memory.effective || now.ineffective != memory.ineffective ||
               now.orientation != memory.orientation;
    }
    REQUIRE(wrong == 0);
    REQUIRE(learner.effective_count() == effective);
    REQUIRE(learner.explored_count() == explored);
  }
  CHECK(forgotten > 5000);
}

TEST_CASE("a situation in which a choice waits is not forgotten, any other one is") {
  Learner learner({}, 9);
  for (SituationId id = 0; id < 6; ++id) learner.update(id, 1, 1.0);
  learner.choose(5);  // the last one, which takes the place of what is forgotten
  const Choice waiting = *learner.pending();
  CHECK(learner.forget(2));
  CHECK_FALSE(learner.forget(2));
  CHECK(learner.pending()->motion == waiting.motion);
  check_refused([&] { learner.forget(5); }, "Learner.forget",
                "the situation in which a choice waits for its outcome");
  check_refused([&] { learner.forget(-1); }, "situation", "-1");
  CHECK(learner.learn(1.0).situation == 5);
  CHECK(learner.situations() == std::vector<SituationId>{0, 1, 5, 3, 4});
  CHECK(learner.forget(5));
}

TEST_CASE("where growth is refused a situation too many is refused by name, the rest goes on") {
  Learner learner({}, 10);
  learner.reserve(100, Pages::kTouched);
  learner.refuse_growth();
  const std::size_t room = learner.room();
  CHECK(room >= 100);
  for (std::size_t id = 0; id < room; ++id) learner.update(static_cast<SituationId>(id), 0, 1.0);
  const std::vector<std::byte> full = to_bytes(learner);
  const std::string beyond = std::to_string(room + 1);
  check_refused([&] { learner.choose(1000); }, "situations", beyond);
  check_refused([&] { learner.update(1000, 0, 1.0); }, "situations", beyond);
  CHECK(to_bytes(learner) == full);
  CHECK(learner.best(7) == 0);
  learner.choose(7);
  learner.learn(1.0);
  CHECK(learner.forget(3));
  learner.choose(1000);
  learner.learn(1.0);
  learner.refuse_growth(false);
  learner.update(1001, 0, 1.0);
  CHECK(learner.situations_experienced() == room + 1);
}

TEST_CASE("a copy into a learner with more room or less goes on alike") {
  Learner learner({}, 11);
  Random random(11, "steps");
  for (int i = 0; i < 2000; ++i) {
    learner.choose(random.index(300));
    learner.learn(random.uniform() - 0.5);
  }
  learner.choose(4);
  for (const std::size_t room : {0U, 100U, 300U, 5000U}) {
    Learner into(LearnerConfig::step5(), 1);
    into.reserve(room);
    into.update(12345, 1, 1.0);
    into = learner;
    CHECK(to_bytes(into) == to_bytes(learner));
    CHECK(into.room() >= std::max(room, learner.situations_experienced()));
    Learner twin = learner;
    for (int i = 0; i < 500; ++i) {
      if (into.pending()) CHECK(into.learn(0.2).motion == twin.learn(0.2).motion);
      into.choose(i);
      twin.choose(i);
    }
    Learner& self = into;
    into = self;
  }
}
