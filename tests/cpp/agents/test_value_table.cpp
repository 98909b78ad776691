// Laws of every agent that learns values, or probabilities, of motions in a table.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agents/grid_world.hpp"
#include "core/field_laws.hpp"
#include "core/refusal.hpp"
#include "devlearn/appraisal.hpp"
#include "devlearn/detail/value_table.hpp"
#include "devlearn/dyna_q.hpp"
#include "devlearn/error.hpp"
#include "devlearn/expected_sarsa.hpp"
#include "devlearn/lrta_star.hpp"
#include "devlearn/operant_conditioning.hpp"
#include "devlearn/prioritized_sweeping.hpp"
#include "devlearn/q_learning.hpp"
#include "devlearn/r_max.hpp"
#include "devlearn/sarsa_lambda.hpp"

using namespace devlearn;

#define VALUE_AGENTS                                                                 \
  QLearning, ExpectedSarsa, SarsaLambda, DynaQ, PrioritizedSweeping, LrtaStar, RMax, \
      OperantConditioning, Appraisal

namespace {

// What was learned of a motion.
template <class A>
std::optional<double> value_of(const A& agent, SituationId situation, int motion) {
  return agent.value(situation, motion);
}
std::optional<double> value_of(const OperantConditioning& agent, SituationId situation,
                               int motion) {
  return agent.probability(situation, motion);
}

// A life in a small maze, with motions ruled out now and then, and rounds broken off.
class Life {
 public:
  explicit Life(std::uint64_t seed) : random_(seed, "life"), cell_(world_.start) {}

  // The first half of a step; the motion.
  int choose(Agent& agent) {
    if (random_.uniform() < 0.02) {
      agent.end_round(false);
      agent.begin_round();
      cell_ = world_.start;
    }
    for (bool& one : allowed_) one = random_.uniform() < 0.8;
    allowed_[random_.index(4)] = true;
    Observation seen = world_.observation(cell_);
    if (random_.uniform() < 0.5) seen.allowed = allowed_;
    motion_ = agent.choose(seen).motion;
    REQUIRE(seen.allowed(motion_));
    return motion_;
  }
  // The other half.
  void observe(Agent& agent) {
    const Outcome outcome = world_.outcome(cell_, motion_);
    agent.observe(outcome);
    cell_ = outcome.arrived ? world_.start : static_cast<int>(outcome.situation);
  }
  std::vector<int> run(Agent& agent, int steps) {
    std::vector<int> motions;
    for (int i = 0; i < steps; ++i) {
      motions.push_back(choose(agent));
      observe(agent);
    }
    return motions;
  }

 private:
  GridWorld world_{{"S....", ".###.", "...#.", ".#..G"}};
  Random random_;
  int cell_, motion_ = -1;
  bool allowed_[4] = {};
};

bool equal(const StateArray& a, const StateArray& b) {
  return a.dtype == b.dtype && a.shape == b.shape && a.bytes == b.bytes &&
         (a.bytes == 0 || std::memcmp(a.data.get(), b.data.get(), a.bytes) == 0);
}

bool equal(const AgentState& a, const AgentState& b) {
  return a.kind == b.kind && a.texts == b.texts && a.arrays.size() == b.arrays.size() &&
         std::all_of(a.arrays.begin(), a.arrays.end(), [&](const auto& entry) {
           const auto found = b.arrays.find(entry.first);
           return found != b.arrays.end() && equal(entry.second, found->second);
         });
}

StateArray filled(const StateArray& array, unsigned char byte) {
  const auto bytes = std::make_shared<std::vector<std::byte>>(array.bytes, std::byte{byte});
  return {array.dtype, array.shape, std::shared_ptr<const std::byte>(bytes, bytes->data()),
          array.bytes};
}

void check_no_agent_is_made(const AgentState& state) {
  try {
    make_agent(state, "it");
    FAIL_CHECK("made");
  } catch (const FileError& error) {
    CHECK(error.file() == "it");
  }
}

}  // namespace

TEST_CASE_TEMPLATE("every setting is described, compared, refused beyond its bounds, and saved", A,
                   VALUE_AGENTS) {
  using Config = typename A::Config;
  field_laws::check_fields<Config>();
  const Config config = field_laws::with_every_field_changed<Config>();
  CHECK(dynamic_cast<const A&>(*make_agent(*A(config, 3).state())).config() == config);
  detail::each_field<Config>([](const auto& field) {
    Config changed;
    auto& value = changed.*field.member;
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      value = std::numeric_limits<double>::quiet_NaN();
      CHECK_THROWS_AS(A(changed, 3), InvalidValue);
    }
  });
}

TEST_CASE_TEMPLATE("the same seed gives the same history, another one another", A, VALUE_AGENTS) {
  A first({}, 3), second({}, 3), third({}, 4);
  const std::vector<int> motions = Life(1).run(first, 500);
  CHECK(Life(1).run(second, 500) == motions);
  CHECK(equal(*first.state(), *second.state()));
  CHECK(Life(1).run(third, 500) != motions);
}

TEST_CASE_TEMPLATE("a history and what was learned are the same to the bit on every machine", A,
                   VALUE_AGENTS) {
  A agent({}, 3);
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  const auto add = [&](std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3U;
    }
  };
  for (const int motion : Life(1).run(agent, 2000)) add(static_cast<std::uint64_t>(motion));
  for (int cell = 0; cell < 20; ++cell) {
    for (int motion = 0; motion < 4; ++motion) {
      const double value = value_of(agent, cell, motion).value_or(0.0);
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      add(bits);
    }
  }
  const std::map<std::string, std::uint64_t> expected{
      {QLearning::kKind, 0x566c98bec38fad15U},
      {ExpectedSarsa::kKind, 0x3e2fc5041f4c60e2U},
      {SarsaLambda::kKind, 0xb45edf4ff45f5f81U},
      {DynaQ::kKind, 0x9156ea7652749624U},
      {PrioritizedSweeping::kKind, 0x1768064541a4a3a5U},
      {LrtaStar::kKind, 0x4345f55d48e0a6f9U},
      {RMax::kKind, 0xec3ea2d76c0e6311U},
      {OperantConditioning::kKind, 0xb8d0982609846746U},

      {Appraisal::kKind, 0xa3eb2490299fb516U}};
  CHECK(hash == expected.at(A::kKind));
}

TEST_CASE_TEMPLATE("what is made of a state goes on equal to the bit, within a step, too", A,
                   VALUE_AGENTS) {
  for (const int steps : {0, 1, 2, 17, 60, 61, 62, 63, 64, 300}) {
    CAPTURE(steps);
    A agent({}, 7);
    Life life(2);
    life.run(agent, steps);
    const auto between = make_agent(*agent.state());
    REQUIRE(dynamic_cast<const A*>(between.get()) != nullptr);
    CHECK(equal(*between->state(), *agent.state()));
    Life twin = life;
    life.choose(agent);
    twin.choose(*between);
    const auto within = make_agent(*agent.state());
    CHECK(equal(*within->state(), *agent.state()));
    Life third = life;
    life.observe(agent);
    twin.observe(*between);
    third.observe(*within);
    const std::vector<int> motions = life.run(agent, 200);
    CHECK(twin.run(*between, 200) == motions);
    CHECK(third.run(*within, 200) == motions);
    CHECK(equal(*between->state(), *agent.state()));
    CHECK(equal(*within->state(), *agent.state()));
  }
}

TEST_CASE_TEMPLATE("a call that is refused changes nothing", A, VALUE_AGENTS) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  A agent({}, 7);
  Life life(2);
  life.run(agent, 60);
  AgentState before = *agent.state();
  const auto refused = [&](const auto& call, const char* quantity, const char* value) {
    check_refused(call, quantity, value);
    CHECK(equal(*agent.state(), before));
  };
  Observation seen;
  seen.situation = 0;
  seen.motion_count = 4;
  const auto choosing = [&](const auto& spoil) {
    return [&, spoil] {
      Observation spoilt = seen;
      spoil(spoilt);
      agent.choose(spoilt);
    };
  };
  refused([&] { agent.observe({}); }, "observe", "called where no choice waits");
  refused([&] { agent.cancel(); }, "cancel", "called where no choice waits");
  refused(choosing([](Observation& o) { o.situation = -1; }), "situation", "-1");
  refused(choosing([](Observation& o) { o.motion_count = 0; }), "motion_count", "0");
  refused(choosing([](Observation& o) { o.motion_count = 5; }), "motion_count", "5");
  refused(choosing([](Observation& o) { o.estimate = -1.0; }), "estimate", "-1");
  refused(choosing([](Observation& o) { o.estimate = kNan; }), "estimate", "nan");
  refused(choosing([](Observation& o) { o.sef = kInfinite; }), "sef", "inf");
  const bool none[4] = {}, three[3] = {true, true, true};
  refused(choosing([&](Observation& o) { o.allowed = none; }), "allowed", "no motion");
  refused(choosing([&](Observation& o) { o.allowed = three; }), "allowed", "3 values");

  agent.choose(seen);
  before = *agent.state();
  const auto observing = [&](const auto& spoil) {
    return [&, spoil] {
      Outcome spoilt;
      spoilt.situation = 1;
      spoil(spoilt);
      agent.observe(spoilt);
    };
  };
  refused(choosing([](Observation&) {}), "choose", "called while a choice waits for its outcome");
  refused(observing([](Outcome& o) { o.situation = -1; }), "situation", "-1");
  refused(observing([](Outcome& o) { o.cost = kNan; }), "cost", "nan");
  refused(observing([](Outcome& o) { o.cost = kInfinite; }), "cost", "inf");
  refused(observing([](Outcome& o) { o.sef = kNan; }), "sef", "nan");
  refused(observing([](Outcome& o) { o.estimate = kInfinite; }), "estimate", "inf");
  refused([&] { value_of(agent, -1, 0); }, "situation", "-1");
  refused([&] { value_of(agent, 0, 4); }, "motion", "4");
  refused([&] { value_of(agent, 0, -1); }, "motion", "-1");
}

TEST_CASE_TEMPLATE("of a choice that is cancelled nothing is learned", A, VALUE_AGENTS) {
  A agent({}, 7);
  Life life(2);
  life.run(agent, 60);
  const GridWorld world = cliff_world();
  std::vector<std::optional<double>> before, after;
  const auto values = [&](auto& into) {
    for (int cell = 0; cell < 20; ++cell) {
      for (int motion = 0; motion < 4; ++motion) into.push_back(value_of(agent, cell, motion));
    }
  };
  values(before);
  agent.choose(world.observation(0));
  agent.cancel();
  values(after);
  CHECK(before == after);
  CHECK_NOTHROW(agent.choose(world.observation(0)));
}

TEST_CASE_TEMPLATE("what diverges stays finite, and can be saved", A, VALUE_AGENTS) {
  A agent({}, 7);
  Observation seen;
  seen.motion_count = 2;
  seen.situation = 0;
  for (int i = 0; i < 200; ++i) {
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = (seen.situation + 1) % 3;
    outcome.cost = 1e308;
    outcome.estimate = outcome.sef = 1e308;
    agent.observe(outcome);
    seen.situation = outcome.situation;
    seen.estimate = 1e308;
    seen.sef = -1e308;
  }
  CHECK(std::isfinite(*value_of(agent, 0, 0)));
  CHECK(equal(*make_agent(*agent.state())->state(), *agent.state()));
}

TEST_CASE_TEMPLATE("a state that breaks a law makes no agent", A, VALUE_AGENTS) {
  A agent({}, 7);
  Life life(2);
  life.run(agent, 60);
  life.choose(agent);
  const AgentState good = *agent.state();
  REQUIRE_NOTHROW(make_agent(good));
  for (const auto& [name, text] : good.texts) {
    CAPTURE(name);
    for (const char* bad : {"", "x", "nan", "-1e300", "1e300"}) {
      AgentState spoilt = good;
      spoilt.texts[name] = bad;
      check_no_agent_is_made(spoilt);
    }
    if (name == "waiting_row" || name == "last_row") continue;  // then no choice waits
    AgentState spoilt = good;
    spoilt.texts.erase(name);
    check_no_agent_is_made(spoilt);
  }
  for (const auto& [name, array] : good.arrays) {
    CAPTURE(name);
    AgentState spoilt = good;
    spoilt.arrays.erase(name);
    check_no_agent_is_made(spoilt);
    spoilt.arrays[name] = array_of(std::vector<std::uint16_t>{1});
    check_no_agent_is_made(spoilt);
    if (name == "random") continue;  // any words but zeros
    spoilt.arrays[name] = filled(array, 0xfd);
    check_no_agent_is_made(spoilt);
  }
  AgentState spoilt = good;
  spoilt.arrays["random"] = filled(good.arrays.at("random"), 0);
  check_no_agent_is_made(spoilt);
  spoilt = good;
  spoilt.arrays["situation"] = filled(good.arrays.at("situation"), 0);  // one twice
  check_no_agent_is_made(spoilt);
  spoilt = good;
  spoilt.arrays["allowed"] = filled(good.arrays.at("allowed"), 0);  // nothing allowed
  check_no_agent_is_made(spoilt);
  spoilt = good;
  spoilt.kind = "random";
  CHECK_THROWS_AS(A(spoilt, "it"), FileError);
}

TEST_CASE("ties are broken evenly, and motions at random are even among those allowed") {
  detail::ValueTable table({}, 5);
  const bool allowed[4] = {true, false, true, true};
  Observation seen;
  seen.situation = 3;
  seen.motion_count = 4;
  seen.allowed = allowed;
  for (const double epsilon : {0.0, 1.0}) {
    CAPTURE(epsilon);
    const detail::Row row = table.meet(seen);
    table.set(table.pair(row, 1), 9.0);  // the highest, but not allowed
    table.set(table.pair(row, 3), epsilon == 0.0 ? -1.0 : 1.0);
    int count[4] = {};
    for (int i = 0; i < 6000; ++i) {
      ++count[table.choose(seen, epsilon).motion];
      table.cancel();
    }
    CHECK(count[1] == 0);
    const int each = epsilon == 0.0 ? 3000 : 2000;
    CHECK(std::abs(count[0] - each) < 200);  // five standard deviations
    CHECK(std::abs(count[2] - each) < 200);
    CHECK(std::abs(count[3] - (epsilon == 0.0 ? 0 : 2000)) < 200);
  }
}

TEST_CASE("a maximum and a mean are over the motions allowed at the last choice there") {
  detail::ValueTable table({}, 5);
  Observation seen;
  seen.situation = 3;
  seen.motion_count = 3;
  const detail::Row row = table.meet(seen);
  table.set(table.pair(row, 0), -1.0);
  table.set(table.pair(row, 1), -2.0);
  table.set(table.pair(row, 2), -6.0);
  CHECK(table.max(row) == -1.0);
  CHECK(table.expected(row, 0.3) == doctest::Approx(0.7 * -1.0 + 0.3 * -3.0));
  const bool allowed[3] = {false, true, true};
  seen.allowed = allowed;
  table.meet(seen);
  CHECK(table.max(row) == -2.0);
  CHECK(table.expected(row, 0.5) == doctest::Approx(0.5 * -2.0 + 0.5 * -4.0));
  CHECK(table.max(detail::kNoRow) == 0.0);
  CHECK(table.expected(detail::kNoRow, 0.5) == 0.0);
}

TEST_CASE("first values are a constant, or less the estimate where a situation is first met") {
  for (const bool by_estimate : {false, true}) {
    detail::ValueTable::Rules rules;
    rules.initial_value = -3.0;
    rules.first_value = by_estimate ? FirstValue::kEstimate : FirstValue::kConstant;
    detail::ValueTable table(rules, 5);
    CHECK_FALSE(table.value(3, 0).has_value());
    Observation seen;
    seen.situation = 3;
    seen.motion_count = 2;
    seen.estimate = 7.0;
    table.choose(seen, 0.0);
    Outcome outcome;
    outcome.situation = 4;
    outcome.estimate = 6.0;
    table.observe(outcome);
    seen.estimate = 9.0;  // met before
    table.choose(seen, 0.0);
    CHECK(*table.value(3, 0) == (by_estimate ? -7.0 : -3.0));
    CHECK(*table.value(4, 1) == (by_estimate ? -6.0 : -3.0));
  }
}

TEST_CASE("a shaped reward is R + gamma Phi(S') - Phi(S), and an arrival's potential is 0") {
  struct Case {
    Shaping shaping;
    bool arrived;
    double reward;
  };
  for (const Case& one : {Case{Shaping::kNone, false, -2.0}, Case{Shaping::kNone, true, -2.0},
                          Case{Shaping::kSef, false, -2.0 + 0.5 * 12.0 - 10.0},
                          Case{Shaping::kSef, true, -2.0 - 10.0},
                          Case{Shaping::kEstimate, false, -2.0 - 0.5 * 6.0 + 7.0},
                          Case{Shaping::kEstimate, true, -2.0 + 7.0}}) {
    detail::ValueTable::Rules rules;
    rules.gamma = 0.5;
    rules.shaping = one.shaping;
    detail::ValueTable table(rules, 5);
    Observation seen;
    seen.situation = 3;
    seen.motion_count = 2;
    seen.sef = 10.0;
    seen.estimate = 7.0;
    table.choose(seen, 0.0);
    Outcome outcome;
    outcome.situation = 4;
    outcome.sef = 12.0;
    outcome.estimate = 6.0;
    outcome.cost = 2.0;
    outcome.arrived = one.arrived;
    const detail::Transition transition = table.observe(outcome);
    CHECK(transition.reward == one.reward);
    CHECK((transition.next == detail::kNoRow) == one.arrived);
  }
}
