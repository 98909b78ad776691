#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "agents/grid_world.hpp"
#include "devlearn/error.hpp"
#include "devlearn/q_learning.hpp"
#include "devlearn/salient_events.hpp"

using namespace devlearn;

namespace {

Observation seen(SituationId situation, int motions) {
  Observation seen;
  seen.situation = situation;
  seen.motion_count = motions;
  return seen;
}

Outcome outcome(SituationId situation, double cost, int event = -1) {
  Outcome outcome;
  outcome.situation = situation;
  outcome.cost = cost;
  outcome.event = event;
  return outcome;
}

// Wanders on a grid without cost, for so many steps; event k comes where one enters cells[k], and
// then one is put to any cell.
void wander(SalientEvents& agent, const GridWorld& world, const std::vector<int>& cells, int steps,
            Random& random) {
  int cell = world.start;
  for (int step = 0; step < steps; ++step) {
    const int motion = agent.choose(world.observation(cell)).motion;
    const int next = world.after(cell, motion);
    const auto event = std::find(cells.begin(), cells.end(), next);
    const bool salient = next != cell && event != cells.end();
    agent.observe(outcome(next, 0.0, salient ? static_cast<int>(event - cells.begin()) : -1));
    cell = next;
    if (!salient) continue;
    do {
      cell = static_cast<int>(random.index(static_cast<std::uint32_t>(world.cells())));
    } while (world.at(cell) == '#');
  }
}

}  // namespace

TEST_CASE("without salient events it is Q-learning, to the bit") {
  SalientEventsConfig config;
  QLearningConfig same;
  same.alpha = config.alpha;
  same.gamma = config.gamma;
  same.epsilon = config.epsilon;
  SalientEvents agent(config, 7);
  QLearning q(same, 7);
  const GridWorld world = random_world(2, 6);
  for (int i = 0; i < 30; ++i) CHECK(run_round(agent, world).steps == run_round(q, world).steps);
  for (int i = 0; i < 4 * world.cells(); ++i)
    CHECK(agent.value(i / 4, i % 4) == q.value(i / 4, i % 4));
  CHECK(agent.events().empty());
}

TEST_CASE("an event that comes ever again the same way is rewarded less by (1 - alpha) each time") {
  SalientEventsConfig config;
  config.alpha = 0.25;
  config.tau = 2.0;
  config.epsilon = 0.0;
  SalientEvents agent(config);
  double expected = config.tau, value = 0.0;
  for (int time = 0; time < 20; ++time) {
    agent.choose(seen(3, 1));
    Outcome event = outcome(9, 0.5, 40);
    event.arrived = true;
    agent.observe(event);
    CHECK(agent.intrinsic_reward() == doctest::Approx(expected));
    value += config.alpha * (expected - 0.5 - value);  // nothing follows
    CHECK(*agent.value(3, 0) == doctest::Approx(value));
    if (time > 0) expected *= 1.0 - config.alpha;  // the option is made the first time
    agent.begin_round();
  }
  CHECK(agent.events() == std::vector<int>{40});
  agent.choose(seen(3, 1));
  agent.observe(outcome(3, 0.5));
  CHECK(agent.intrinsic_reward() == 0.0);
}

TEST_CASE("options foresee their events by gamma^steps, and take the shortest way") {
  const GridWorld world({"S......", ".####..", "......G", "..##...", "......."});
  SalientEventsConfig config;
  config.alpha = 0.2;
  config.epsilon = 1.0;  // learned off the policy that is learned about
  SalientEvents agent(config, 1);
  Random random(1, "places");
  wander(agent, world, {world.goal}, 60000, random);
  const auto steps_to = [&](int cell) { return world.shortest(cell); };
  for (int cell = 0; cell < world.cells(); ++cell) {
    if (world.at(cell) == '#' || cell == world.goal) continue;
    CAPTURE(cell);
    const auto why = agent.explain(cell);
    REQUIRE(why.has_value());
    const OptionView& view = why->options.at(0);
    CHECK(view.available);
    CHECK(view.probability ==
          doctest::Approx(std::pow(config.gamma, steps_to(cell))).epsilon(0.01));
    CHECK(steps_to(world.after(cell, view.motion)) == steps_to(cell) - 1);
  }
}

TEST_CASE("an option is worth what it costs, and what comes after it by its model") {
  // 0 -> 1 -> 2 by the one motion, at a cost of 1 each; event 5 comes with the second step.
  SalientEventsConfig config;
  config.alpha = 0.5;
  config.gamma = 0.5;
  config.epsilon = 0.0;
  config.tau = 0.0;
  SalientEvents agent(config);
  for (int time = 0; time < 60; ++time) {
    for (int here = 0; here < 3; ++here) {
      agent.choose(seen(here, 1));
      Outcome next = outcome(here + 1, here < 2 ? 1.0 : -8.0, here == 1 ? 5 : -1);
      next.arrived = here == 2;
      agent.observe(next);
    }
    agent.begin_round();
  }
  const auto why = agent.explain(0);
  CHECK(why->options.at(0).probability == doctest::Approx(0.25));
  // R = -1 - 1/2; after it the reward of 8, a quarter of it
  CHECK(why->options.at(0).value == doctest::Approx(-1.5 + 0.25 * 8.0));
  CHECK(why->value.at(0) == doctest::Approx(-1.5 + 0.25 * 8.0));
}

TEST_CASE("an option that was begun runs until its event comes") {
  const GridWorld world({"S.........", "..........", ".........G"});
  SalientEvents agent({}, 3);
  Random random(3, "places");
  wander(agent, world, {world.goal, 9}, 20000, random);
  int cell = world.start, within = 0;
  std::vector<int> before;
  for (int step = 0; step < 4000; ++step) {
    const int motion = agent.choose(world.observation(cell)).motion;
    const std::vector<int> runs = agent.explain(cell)->running;
    if (!before.empty()) {
      ++within;
      REQUIRE(runs.size() >= before.size());
      CHECK(std::equal(before.begin(), before.end(), runs.begin()));
    }
    const int next = world.after(cell, motion);
    const int event = next == cell ? -1 : next == world.goal ? 0 : next == 9 ? 1 : -1;
    agent.observe(outcome(next, 0.0, event));
    cell = next;
    before = agent.explain(cell)->running;
    CHECK((event < 0 || std::count(before.begin(), before.end(), event) == 0));
  }
  CHECK(within > 100);
  agent.begin_round();
  CHECK(agent.explain(cell)->running.empty());
}

TEST_CASE("neither it nor its options make a motion that is not allowed") {
  const GridWorld world({"S....", ".....", "....G"});
  SalientEvents agent({}, 5);
  Random random(5, "masks");
  int cell = world.start;
  for (int step = 0; step < 5000; ++step) {
    bool allowed[4];
    do {
      for (bool& one : allowed) one = random.uniform() < 0.5;
    } while (!std::count(allowed, allowed + 4, true));
    Observation masked = world.observation(cell);
    masked.allowed = allowed;
    const int motion = agent.choose(masked).motion;
    REQUIRE(allowed[motion]);
    const auto why = agent.explain(cell);
    for (const OptionView& view : why->options) {
      CHECK((!view.available || allowed[view.motion]));
    }
    const int next = world.after(cell, motion);
    agent.observe(outcome(next, 0.0, next == world.goal && next != cell ? 0 : -1));
    cell = next;
  }
}

TEST_CASE("of where an option ends no more is kept than is asked for") {
  SalientEventsConfig config;
  config.endings = 2;
  config.epsilon = 0.0;
  SalientEvents agent(config);
  const std::vector<int> ends = {1, 2, 3, 1, 2, 1, 1, 1, 1, 2};
  for (const int end : ends) {
    agent.choose(seen(0, 1));
    agent.observe(outcome(end, 0.0, 0));
  }
  CHECK(agent.state()->texts.at("ending_count") == "2");
  CHECK(agent.explain(0)->options.at(0).probability < config.gamma);
}

TEST_CASE("an event beyond 63 is refused, and the choice still waits") {
  SalientEvents agent;
  agent.choose(seen(0, 2));
  CHECK_THROWS_WITH_AS(agent.observe(outcome(1, 1.0, 64)), doctest::Contains("event"),
                       InvalidValue);
  CHECK_THROWS_AS(agent.observe(outcome(1, 1.0, -2)), InvalidValue);
  CHECK_NOTHROW(agent.observe(outcome(1, 1.0, 63)));
  CHECK(agent.events() == std::vector<int>{63});
}

TEST_CASE(
    "what is read of a situation draws and changes nothing, and is nothing where none was met") {
  const GridWorld world({"S...G"});
  SalientEvents one({}, 4), other({}, 4);
  CHECK(!one.explain(3).has_value());
  CHECK_THROWS_AS(one.explain(-1), InvalidValue);
  Random places(4, "places"), same(4, "places");
  wander(one, world, {world.goal}, 500, places);
  wander(other, world, {world.goal}, 500, same);
  for (int i = 0; i < 10; ++i)
    CHECK(to_text(*one.explain(0)).find("option for event") != std::string::npos);
  wander(one, world, {world.goal}, 100, places);
  wander(other, world, {world.goal}, 100, same);
  for (int motion = 0; motion < 4; ++motion) CHECK(one.value(1, motion) == other.value(1, motion));
}

TEST_CASE("one that goes on from a state does as the other, also amid an option") {
  const GridWorld world({"S.........", ".####.....", ".........G"});
  Random random(6, "places");
  SalientEvents agent({}, 6);
  wander(agent, world, {world.goal, 9, 12}, 5000, random);
  int cell = world.start;
  while (agent.explain(world.start)->running.empty()) {
    const int motion = agent.choose(world.observation(cell)).motion;
    cell = world.after(cell, motion);
    agent.observe(outcome(cell, 0.0));
  }
  const std::shared_ptr<Agent> again = make_agent(*agent.state());
  for (int step = 0; step < 2000; ++step) {
    const int motion = agent.choose(world.observation(cell)).motion;
    REQUIRE(again->choose(world.observation(cell)).motion == motion);
    const int next = world.after(cell, motion);
    const Outcome told = outcome(next, 0.5, next != cell && next == world.goal ? 0 : -1);
    agent.observe(told);
    again->observe(told);
    cell = next;
  }
}
