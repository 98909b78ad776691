#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <vector>

#include "agents/grid_world.hpp"
#include "core/refusal.hpp"
#include "devlearn/appraisal.hpp"
#include "devlearn/detail/transition_counts.hpp"
#include "devlearn/random.hpp"

using namespace devlearn;

namespace {

// One step, told by hand.
void step(Appraisal& agent, SituationId from, SituationId to, double reward, bool arrived = false,
          int motions = 1) {
  Observation seen;
  seen.situation = from;
  seen.motion_count = motions;
  agent.choose(seen);
  Outcome outcome;
  outcome.situation = to;
  outcome.cost = -reward;
  outcome.arrived = arrived;
  agent.observe(outcome);
}

// From place to place, the last of which is the goal and rewards with 1.
void walk(Appraisal& agent, int places) {
  for (int place = 0; place < places; ++place) {
    const bool last = place == places - 1;
    step(agent, place, place + 1, last ? 1.0 : 0.0, last);
  }
}

AppraisalConfig of_weights(double novelty, double motivation, double control, double valence,
                           double external) {
  AppraisalConfig config;
  config.novelty = novelty;
  config.motivation = motivation;
  config.control = control;
  config.valence = valence;
  config.external = external;
  return config;
}

}  // namespace

TEST_CASE("novelty falls with the visits of the situation and of the motion, by 1.001 each") {
  Appraisal agent;
  Random random(1, "motions");
  std::map<int, int> visits;
  for (int i = 0; i < 500; ++i) {
    Observation seen;
    seen.situation = 0;
    seen.motion_count = 3;
    ++visits[agent.choose(seen).motion];
    Outcome back;
    back.situation = 0;
    agent.observe(back);
  }
  const auto why = *agent.explain(0);
  for (int motion = 0; motion < 3; ++motion) {
    const auto at = static_cast<std::size_t>(motion);
    CHECK(why.visits[at] == visits[motion]);
    const double expected =
        0.5 * std::pow(1.001, -500.0) + 0.5 * std::pow(1.001, -double(visits[motion]));
    CHECK(why.novelty[at] == doctest::Approx(expected).epsilon(1e-12));
  }
}

TEST_CASE("motivation is 1 / (1 + d), d the motions to the best situation by what was seen") {
  Appraisal agent;
  walk(agent, 6);
  for (SituationId place = 0; place < 6; ++place) {
    const auto why = *agent.explain(place);
    CHECK(why.goal == 5);
    CHECK(why.goal_distance == 5 - place);
    CHECK(why.motivation == 1.0 / (6.0 - static_cast<double>(place)));
  }
  step(agent, 1, 5, 0.0);  // a short cut
  CHECK(agent.explain(0)->goal_distance == 2);
  CHECK(agent.explain(1)->goal_distance == 1);
  step(agent, 9, 8, 0.0);  // from where no way is known
  CHECK(agent.explain(9)->goal_distance == -1);
  CHECK(agent.explain(9)->motivation == 0.0);
  for (int i = 0; i < 20; ++i) step(agent, 9, 8, 3.0, true);  // better
  CHECK(agent.explain(9)->goal == 9);
  CHECK(agent.explain(9)->motivation == 1.0);
  CHECK(agent.explain(0)->motivation == 0.0);
}

TEST_CASE("there is no goal while nothing was rewarded") {
  Appraisal agent;
  for (SituationId place = 0; place < 6; ++place) step(agent, place, place + 1, 0.0);
  CHECK(agent.explain(3)->goal == -1);
  CHECK(agent.explain(3)->motivation == 0.0);
  CHECK(agent.explain(3)->valence[0] == 0.0);
}

TEST_CASE("control is 1 less the mean change of the external value") {
  Appraisal agent;
  double q = 0.0, changes = 0.0;
  for (int n = 1; n <= 20; ++n) {
    step(agent, 0, 1, 1.0, true);
    const double change = 0.3 * (1.0 - q);
    if (change > 0.3 * 1e-4) changes += change;
    q += change;
    CHECK(agent.explain(0)->external_value[0] == doctest::Approx(1.0 - std::pow(0.7, n)));
    CHECK(agent.explain(0)->control[0] == doctest::Approx(1.0 - changes / n));
  }
}

TEST_CASE("valence compares a motion with the best one here, and here with elsewhere") {
  Appraisal agent(of_weights(0, 0, 0, 0, 1));
  Random random(3, "motions");
  // Motion 0 of place 0 rewards with 1, motion 1 with 0.5; place 1 rewards with -1.
  for (int i = 0; i < 3000; ++i) {
    Observation seen;
    seen.situation = i % 2;
    seen.motion_count = 2;
    const int motion = agent.choose(seen).motion;
    Outcome outcome;
    outcome.situation = 0;
    outcome.cost = seen.situation == 1 ? 1.0 : motion == 0 ? -1.0 : -0.5;
    outcome.arrived = true;
    agent.observe(outcome);
  }
  const auto here = *agent.explain(0), there = *agent.explain(1);
  CHECK(here.valence[0] == doctest::Approx(0.5 * 1.0 + 0.5 * 1.0).epsilon(1e-3));
  CHECK(here.valence[1] == doctest::Approx(0.5 * 0.5 + 0.5 * 1.0).epsilon(1e-3));
  CHECK(there.valence[0] == doctest::Approx(0.5 * 1.0 + 0.5 * 0.0).epsilon(1e-3));
}

TEST_CASE("the reward is the weighted sum of the appraisals and the reward from outside") {
  const AppraisalConfig config = of_weights(-0.1, 0.2, 0.1, 0.3, -0.3);
  Appraisal agent(config, 2);
  GridWorld world = rewarding_arrival({"S..", ".#.", "..G"});
  for (int i = 0; i < 20; ++i) run_round(agent, world);
  for (SituationId cell : {0, 1, 2, 3, 5, 6, 7}) {
    const auto why = *agent.explain(cell);
    for (std::size_t motion = 0; motion < 4; ++motion) {
      CHECK(why.reward[motion] ==
            doctest::Approx(-0.1 * why.novelty[motion] + 0.2 * why.motivation +
                            0.1 * why.control[motion] + 0.3 * why.valence[motion] -
                            0.3 * why.external[motion]));
      for (const double one :
           {why.novelty[motion], why.motivation, why.control[motion], why.valence[motion]}) {
        CHECK((one >= 0.0 && one <= 1.0));
      }
    }
  }
}

TEST_CASE("a first step is learned from with its appraisals, before it counts as a visit") {
  // Nothing is known: novelty is 1, motivation and valence 0.
  Appraisal agent(of_weights(0.5, 0.1, 0.2, 0.1, 0.1), 2);
  step(agent, 0, 1, 0.0);
  CHECK(*agent.value(0, 0) == doctest::Approx(0.3 * (0.5 * 1.0 + 0.2 * 1.0)));
}

TEST_CASE("by external reward alone it learns what is optimal in a deterministic world") {
  const GridWorld maze = dyna_maze();
  Appraisal agent(of_weights(0, 0, 0, 0, 1), 4);
  while (agent.epsilon() > 0.2) run_round(agent, maze);
  const auto path = greedy_path(agent, maze);
  REQUIRE(path);
  CHECK(static_cast<int>(path->size()) - 1 == maze.shortest(maze.start));
  for (const int cell : *path) {
    if (cell == maze.goal) break;
    double best = 0.0;
    for (int motion = 0; motion < 4; ++motion) best = std::max(best, *agent.value(cell, motion));
    CHECK(best == doctest::Approx(std::pow(0.9, maze.shortest(cell) - 1)).epsilon(0.01));
    CHECK(agent.explain(cell)->value == agent.explain(cell)->external_value);
  }
}

TEST_CASE("without any weight all motions are as good for ever") {
  Appraisal agent(of_weights(0, 0, 0, 0, 0), 4);
  const GridWorld maze = dyna_maze();
  for (int i = 0; i < 5; ++i) run_round(agent, maze);
  for (int cell = 0; cell < maze.cells(); ++cell) {
    CHECK(agent.value(cell, 0).value_or(0.0) == 0.0);
  }
}

TEST_CASE("epsilon is divided by 1.0001 after each step") {
  Appraisal agent;
  for (int i = 0; i < 10000; ++i) step(agent, 0, 0, 0.0);
  CHECK(agent.epsilon() == doctest::Approx(std::pow(1.0001, -10000.0)).epsilon(1e-9));
}

TEST_CASE("a model draws where a motion leads as often as it led there") {
  detail::ValueTable table({}, 5);
  Observation seen;
  seen.motion_count = 1;
  for (seen.situation = 0; seen.situation < 3; ++seen.situation) table.meet(seen);
  detail::TransitionCounts model;
  model.fit(table);
  CHECK(model.learn(0, 2));
  CHECK(model.learn(0, 1));
  CHECK_FALSE(model.learn(0, 2));
  CHECK(model.learn(0, detail::kNoRow));
  CHECK(model.visits(0) == 4);
  CHECK(model.leading(2) == std::vector<std::size_t>{0});
  Random random(1, "model");
  std::map<detail::Row, int> count;
  for (int i = 0; i < 8000; ++i) ++count[model.draw(0, random)];
  CHECK(std::abs(count[2] - 4000) < 225);  // five standard deviations
  CHECK(std::abs(count[1] - 2000) < 195);
  CHECK(std::abs(count[detail::kNoRow] - 2000) < 195);
}

TEST_CASE("an explanation draws and changes nothing, and is told as a table") {
  Appraisal agent(of_weights(0.1, 0.1, -0.1, 0.1, 0.6), 2), twin(agent);
  CHECK_FALSE(agent.explain(0).has_value());
  check_refused([&] { agent.explain(-1); }, "situation", "-1");
  GridWorld world = rewarding_arrival({"S..", ".#.", "..G"});
  for (int i = 0; i < 20; ++i) {
    run_round(agent, world);
    run_round(twin, world);
    for (SituationId cell : {0, 1, 2, 3}) agent.explain(cell);
  }
  CHECK(agent.explain(0)->value == twin.explain(0)->value);
  CHECK(agent.epsilon() == twin.epsilon());
  CHECK_FALSE(agent.explain(77).has_value());
  const SituationId goal = agent.explain(0)->goal;
  const std::string text = to_text(*agent.explain(goal)), name = std::to_string(goal);
  CHECK(text.find("situation " + name + ": epsilon") == 0);
  CHECK(text.find("goal " + name + ", 0 motions away") != std::string::npos);
}
