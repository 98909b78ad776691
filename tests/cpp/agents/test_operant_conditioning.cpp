// What learning automata are known to do: Narendra & Thathachar 1974, "Learning automata - a
// survey", and Norman 1968 for the bounds of absorption.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/refusal.hpp"
#include "devlearn/operant_conditioning.hpp"
#include "devlearn/random.hpp"

using namespace devlearn;

namespace {

// A stationary random environment: each motion is penalised with a probability of its own.
struct Environment {
  std::vector<double> penalty;

  Observation observation(SituationId situation = 0) const {
    Observation seen;
    seen.situation = situation;
    seen.motion_count = static_cast<int>(penalty.size());
    return seen;
  }
  // One step; whether it was reinforced.
  bool step(OperantConditioning& agent, Random& random) const {
    const int motion = agent.choose(observation()).motion;
    const bool penalised = random.uniform() < penalty[static_cast<std::size_t>(motion)];
    Outcome outcome;
    outcome.situation = 0;
    outcome.smf = penalised ? -1.0 : 1.0;
    agent.observe(outcome);
    return !penalised;
  }
};

OperantConditioningConfig scheme(double reward_step, double penalty_step) {
  OperantConditioningConfig config;
  config.reward_step = reward_step;
  config.penalty_step = penalty_step;
  return config;
}

// Situation 0 is met; whatever was chosen is neither reinforced nor extinguished.
void meet(OperantConditioning& agent, int motions) {
  Observation seen;
  seen.situation = 0;
  seen.motion_count = motions;
  agent.choose(seen);
  agent.cancel();
}

// What becomes of a motion's probability in situation 0 where this came of one: of the motion that
// was made for a negative `of`, else of another one.
double told(OperantConditioning agent, int motions, double smf, int of) {
  Observation seen;
  seen.situation = 0;
  seen.motion_count = motions;
  const int motion = agent.choose(seen).motion;
  Outcome outcome;
  outcome.situation = 0;
  outcome.smf = smf;
  agent.observe(outcome);
  return *agent.probability(0, of < 0 ? motion : of == motion ? (of + 1) % motions : of);
}

double v(double u) { return std::expm1(u) / u; }

// Where the increasing function v takes this value.
double inverse_v(double value) {
  double low = -60.0, high = 60.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (v(middle == 0.0 ? 1e-12 : middle) < value ? low : high) = middle;
  }
  return low;
}

}  // namespace

TEST_CASE("a motion is reinforced and extinguished as the equations say") {
  OperantConditioning agent(scheme(0.2, 0.05), 1);
  meet(agent, 4);
  CHECK(told(agent, 4, 3.0, -1) == doctest::Approx(0.25 + 0.2 * 0.75));
  CHECK(told(agent, 4, 3.0, 0) == doctest::Approx(0.8 * 0.25));
  CHECK(told(agent, 4, -3.0, -1) == doctest::Approx(0.95 * 0.25));
  CHECK(told(agent, 4, -3.0, 0) == doctest::Approx(0.05 / 3.0 + 0.95 * 0.25));
  CHECK(told(agent, 4, 0.0, -1) == 0.25);
  CHECK(told(agent, 4, 0.0, 0) == 0.25);
}

TEST_CASE("the mean probability under L_R-P follows its closed form to c2 / (c1 + c2)") {
  const Environment environment{{0.2, 0.6}};
  const double a = 0.1, limit = 0.6 / 0.8, rate = 1.0 - a * 0.8;
  constexpr int kAutomata = 4000;
  Random random(1, "environment");
  std::vector<OperantConditioning> automata;
  for (int i = 0; i < kAutomata; ++i) automata.emplace_back(scheme(a, a), i);
  double expected = 0.5;
  for (int step = 1; step <= 60; ++step) {
    double sum = 0.0, squares = 0.0;
    for (OperantConditioning& agent : automata) {
      environment.step(agent, random);
      const double p = *agent.probability(0, 0);
      sum += p;
      squares += p * p;
    }
    expected = limit + rate * (expected - limit);
    const double mean = sum / kAutomata;
    const double error = std::sqrt((squares / kAutomata - mean * mean) / kAutomata);
    CHECK(std::abs(mean - expected) < 4.0 * error);
  }
  CHECK(expected == doctest::Approx(limit).epsilon(0.01));
}

TEST_CASE("under L_R-P the probabilities of many motions are as the inverse of their penalties") {
  const Environment environment{{0.2, 0.4, 0.8}};
  OperantConditioning agent(scheme(0.002, 0.002), 1);
  Random random(1, "environment");
  std::vector<double> sum(3);
  for (int step = 0; step < 5000; ++step) environment.step(agent, random);
  constexpr int kSteps = 300000;
  for (int step = 0; step < kSteps; ++step) {
    environment.step(agent, random);
    for (int motion = 0; motion < 3; ++motion) {
      sum[static_cast<std::size_t>(motion)] += *agent.probability(0, motion);
    }
  }
  const double inverse = 1.0 / 0.2 + 1.0 / 0.4 + 1.0 / 0.8;
  for (std::size_t motion = 0; motion < 3; ++motion) {
    const double expected = 1.0 / environment.penalty[motion] / inverse;
    CHECK(sum[motion] / kSteps == doctest::Approx(expected).epsilon(0.03));
  }
}

// With d = 1 - c and V(u) = (e^u - 1) / u: for V(x) = d1 / d2 the function
// (1 - e^(-x p / a)) / (1 - e^(-x / a)) never falls on average from step to step, for V(-z) =
// d2 / d1 with z in place of x it never rises; so they bound the probability from both sides.
TEST_CASE(
    "L_R-I settles on the better motion as often as Norman's bounds say, more with a small a") {
  const Environment environment{{0.2, 0.6}};
  const double x = inverse_v(0.8 / 0.4), z = -inverse_v(0.4 / 0.8);
  double before = 0.0;
  for (const double a : {0.6, 0.4, 0.2, 0.05}) {
    CAPTURE(a);
    const auto bound = [&](double by) { return std::expm1(-by * 0.5 / a) / std::expm1(-by / a); };
    REQUIRE(bound(x) < bound(z));
    constexpr int kAutomata = 4000;
    Random random(2, "environment");
    int better = 0;
    for (int i = 0; i < kAutomata; ++i) {
      OperantConditioning agent(scheme(a, 0.0), static_cast<std::uint64_t>(i));
      double p = 0.5;
      while (p > 1e-5 && p < 1.0 - 1e-5) {
        environment.step(agent, random);
        p = *agent.probability(0, 0);
      }
      better += p > 0.5 ? 1 : 0;
    }
    const double share = static_cast<double>(better) / kAutomata;
    const auto error = [](double p) { return std::sqrt(p * (1.0 - p) / kAutomata) + 1e-4; };
    CHECK(share > bound(x) - 3.0 * error(bound(x)));
    CHECK(share < bound(z) + 3.0 * error(bound(z)));
    CHECK(share > before);
    before = share;
  }
  CHECK(before > 0.998);
}

// Where the expected change a p (1 - p) (d1 - d2) + b (c2 (1 - p)^2 - c1 p^2) is 0.
TEST_CASE("L_R-eP stays near the better motion, nearer with a smaller b, and never settles") {
  const Environment environment{{0.2, 0.6}};
  double before = 0.75;  // of L_R-P
  for (const double b : {0.002, 0.0005}) {
    const double a = 0.01;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 100; ++i) {
      const double p = 0.5 * (low + high), q = 1.0 - p;
      (a * p * q * 0.4 + b * (0.6 * q * q - 0.2 * p * p) > 0.0 ? low : high) = p;
    }
    OperantConditioning agent(scheme(a, b), 1);
    Random random(3, "environment");
    double sum = 0.0, highest = 0.0;
    for (int step = 0; step < 5000; ++step) environment.step(agent, random);
    constexpr int kSteps = 300000;
    for (int step = 0; step < kSteps; ++step) {
      environment.step(agent, random);
      sum += *agent.probability(0, 0);
      highest = std::max(highest, *agent.probability(0, 0));
    }
    CHECK(sum / kSteps == doctest::Approx(low).epsilon(0.01));
    CHECK(low > before);
    CHECK(highest < 1.0);
    before = low;
  }
}

TEST_CASE("what is reinforced no more is unlearned under L_R-P, and never under L_R-I") {
  const auto learned = [](double penalty_step) {
    OperantConditioning agent(scheme(0.1, penalty_step), 1);
    Random random(1, "environment");
    for (int i = 0; i < 2000; ++i) Environment{{0.0, 1.0}}.step(agent, random);
    CHECK(*agent.probability(0, 0) > 0.999);
    for (int i = 0; i < 2000; ++i) Environment{{1.0, 0.0}}.step(agent, random);
    return *agent.probability(0, 0);
  };
  CHECK(learned(0.1) < 0.001);
  CHECK(learned(0.0) > 0.999);
}

TEST_CASE("of allowed motions each has its share, and nothing is learned of the others") {
  OperantConditioning agent(scheme(0.3, 0.2), 5);
  Random random(1, "environment");
  const Environment environment{{0.1, 0.5, 0.5, 0.9}};
  for (int i = 0; i < 20; ++i) environment.step(agent, random);
  const bool allowed[4] = {false, true, true, false};
  std::vector<double> before;
  for (int motion = 0; motion < 4; ++motion) before.push_back(*agent.probability(0, motion));
  const double sum = before[1] + before[2];

  const auto why = agent.explain(0, allowed);
  REQUIRE(why.has_value());
  CHECK(why->probability[0] == 0.0);
  CHECK(why->probability[1] == doctest::Approx(before[1] / sum));
  CHECK(why->probability[1] + why->probability[2] == doctest::Approx(1.0));
  int ones = 0;
  constexpr int kDraws = 20000;
  Observation seen = environment.observation();
  seen.allowed = allowed;
  for (int i = 0; i < kDraws; ++i) {
    const int motion = agent.choose(seen).motion;
    REQUIRE(allowed[motion]);
    ones += motion == 1 ? 1 : 0;
    agent.cancel();
  }
  CHECK(ones / double{kDraws} == doctest::Approx(before[1] / sum).epsilon(0.05));

  for (int i = 0; i < 50; ++i) {
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = 0;
    outcome.smf = i % 2 == 0 ? 1.0 : -1.0;
    agent.observe(outcome);
  }
  CHECK(*agent.probability(0, 0) == before[0]);
  CHECK(*agent.probability(0, 3) == before[3]);
  CHECK(*agent.probability(0, 1) != before[1]);
  CHECK(*agent.probability(0, 1) + *agent.probability(0, 2) == doctest::Approx(sum));
}

TEST_CASE("motions of which none is likely at all are each as likely") {
  OperantConditioning agent(scheme(0.9, 0.0), 5);
  Random random(1, "environment");
  const Environment environment{{0.0, 1.0, 1.0}};
  for (int i = 0; i < 2000; ++i) environment.step(agent, random);
  REQUIRE(*agent.probability(0, 1) == 0.0);
  const bool allowed[3] = {false, true, true};
  CHECK(agent.explain(0, allowed)->probability[2] == 0.5);
  Observation seen = environment.observation();
  seen.allowed = allowed;
  int ones = 0;
  for (int i = 0; i < 2000; ++i) {
    const int motion = agent.choose(seen).motion;
    REQUIRE(motion != 0);
    ones += motion == 1 ? 1 : 0;
    agent.cancel();
  }
  CHECK(std::abs(ones - 1000) < 150);
}

TEST_CASE("a reward counts against the mean of those before it in the situation") {
  OperantConditioningConfig config;
  config.reinforced_by = ReinforcedBy::kReward;
  OperantConditioning agent(config, 1);
  const auto reinforcement = [&](double reward) {
    Observation seen;
    seen.situation = 7;
    seen.motion_count = 2;
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = 8;
    outcome.cost = -reward;
    outcome.smf = -1.0;  // counts for nothing
    agent.observe(outcome);
    return agent.explain(7)->last_reinforcement;
  };
  CHECK(reinforcement(-4.0) == 0);  // nothing to compare with
  CHECK(reinforcement(-4.0) == 0);
  CHECK(reinforcement(-1.0) == 1);   // mean -4
  CHECK(reinforcement(-2.0) == 1);   // mean -3
  CHECK(reinforcement(-3.0) == -1);  // mean -2.75
  CHECK(agent.explain(7)->mean_reward == doctest::Approx(-14.0 / 5.0));
  CHECK(agent.explain(8)->mean_reward == 0.0);
}

TEST_CASE(
    "entropy is log2 N where nothing was learned, falls as L_R-I settles, and its mean is over "
    "situations") {
  OperantConditioning agent(scheme(0.1, 0.0), 1);
  CHECK_FALSE(agent.mean_entropy().has_value());
  CHECK_FALSE(agent.entropy(0).has_value());
  meet(agent, 8);
  CHECK(*agent.entropy(0) == doctest::Approx(3.0));
  Observation seen;
  seen.motion_count = 8;
  for (int i = 0; i < 500; ++i) {
    seen.situation = 0;
    agent.choose(seen);
    Outcome outcome;
    outcome.situation = 1;
    outcome.smf = 1.0;
    agent.observe(outcome);
  }
  CHECK(*agent.entropy(0) < 1e-6);
  CHECK(*agent.entropy(1) == doctest::Approx(3.0));
  CHECK(*agent.mean_entropy() == doctest::Approx(1.5));
  check_refused([&] { agent.entropy(-1); }, "situation", "-1");
}

TEST_CASE("an explanation counts what came of each motion, and is text for people") {
  OperantConditioning agent(scheme(0.2, 0.1), 3);
  CHECK_FALSE(agent.explain(0).has_value());
  const Environment environment{{0.3, 0.6}};
  Random random(1, "environment");
  std::uint64_t reinforced = 0;
  for (int i = 0; i < 100; ++i) reinforced += environment.step(agent, random) ? 1 : 0;
  const auto why = agent.explain(0);
  REQUIRE(why.has_value());
  CHECK(why->tried[0] + why->tried[1] == 100);
  CHECK(why->reinforced[0] + why->reinforced[1] == reinforced);
  CHECK(why->extinguished[0] + why->extinguished[1] == 100 - reinforced);
  CHECK(why->probability[0] == *agent.probability(0, 0));  // all are allowed
  CHECK(why->entropy == *agent.entropy(0));
  const std::string text = to_text(*why);
  CHECK(text.find("situation 0: entropy ") == 0);
  CHECK(text.find("motion  probability  tried  reinforced  extinguished\n") != std::string::npos);
  const bool three[3] = {true, true, true};
  check_refused([&] { agent.explain(0, three); }, "allowed", "3 values");
}

TEST_CASE("an SMF that is not finite is refused, and the choice goes on waiting") {
  OperantConditioning agent;
  meet(agent, 2);
  agent.choose(Environment{{0.5, 0.5}}.observation());
  Outcome outcome;
  outcome.situation = 0;
  outcome.smf = std::nan("");
  check_refused([&] { agent.observe(outcome); }, "smf", "nan");
  outcome.smf = 1.0;
  CHECK_NOTHROW(agent.observe(outcome));
}

TEST_CASE("a state whose probabilities are none is refused") {
  OperantConditioning agent;
  meet(agent, 2);
  const AgentState good = *agent.state();
  for (const std::vector<double>& q :
       {std::vector<double>{0.5, 0.6}, {1.5, -0.5}, {0.0, 0.0}, {0.5, std::nan("")}}) {
    AgentState spoilt = good;
    spoilt.arrays["q"] = array_of(q, {1, 2});
    CHECK_THROWS_AS(OperantConditioning(spoilt, "it"), FileError);
  }
  AgentState spoilt = good;
  spoilt.arrays["reinforced"] = array_of(std::vector<std::uint64_t>{1, 0}, {1, 2});
  CHECK_THROWS_AS(OperantConditioning(spoilt, "it"), FileError);
}
