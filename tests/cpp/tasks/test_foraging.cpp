#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/field_laws.hpp"
#include "core/refusal.hpp"
#include "devlearn/appraisal.hpp"
#include "devlearn/foraging.hpp"
#include "devlearn/random_agent.hpp"

using namespace devlearn;

namespace {

enum Motion { kUp, kDown, kLeft, kRight, kEat, kOpen };
using Scenario = ForagingScenario;

Foraging begun(Scenario scenario, std::uint64_t seed = 1, int season = 5000) {
  ForagingConfig config;
  config.scenario = scenario;
  config.season = season;
  Foraging task(config);
  task.begin(seed);
  return task;
}

// The rewards of motions, written as u, d, l, r, e, o.
std::vector<double> rewards(Foraging& task, const std::string& motions) {
  std::vector<double> rewards;
  for (const char motion : motions) {
    rewards.push_back(task.step(static_cast<int>(std::string("udlreo").find(motion))).reward());
  }
  return rewards;
}

double sum(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

double mean_reward(Scenario scenario, const AppraisalConfig& config, int runs, int steps) {
  double total = 0.0;
  for (int run = 0; run < runs; ++run) {
    ForagingConfig settings;
    settings.scenario = scenario;
    Foraging task(settings);
    Appraisal agent(config, static_cast<std::uint64_t>(run));
    EpisodesOptions options;
    options.seed = static_cast<std::uint64_t>(run);
    options.step_limit = steps;
    std::vector<Episode> episodes;
    run_episodes(task, agent, options, episodes);
    total += episodes[0].reward;
  }
  return total / runs;
}

}  // namespace

TEST_CASE("every setting of foraging is described, compared, and refused beyond its bounds") {
  field_laws::check_fields<ForagingConfig>();
}

TEST_CASE("a hare that is eaten is at the end of another corridor, each as likely") {
  Foraging task = begun(Scenario::kMovingPreys);
  RandomAgent agent(3);
  std::map<std::string, int> moved;
  std::string before = task.drawn();
  int eaten = 0;
  for (int i = 0; i < 100000; ++i) {
    const Outcome outcome = task.step(agent.choose(task.observation()).motion);
    agent.observe(outcome);
    if (outcome.event != 0) continue;
    ++eaten;
    CHECK(outcome.reward() == 1.0);
    const auto row_of = [](const std::string& drawn) {
      return static_cast<int>(drawn.find('h') / 6);
    };
    const int now = row_of(task.drawn());
    static int was = -1;
    if (was >= 0) ++moved[std::to_string(was) + std::to_string(now)];
    was = now;
  }
  CHECK(eaten > 300);
  CHECK(moved.size() == 6);
  for (const auto& [change, count] : moved) {
    CHECK(change[0] != change[1]);
    CHECK(std::abs(count - eaten / 6) < 5 * std::sqrt(eaten / 6.0));
  }
}

TEST_CASE("prey far from the start is eaten after six moves by whatever follows") {
  Foraging task = begun(Scenario::kPersistence);
  CHECK(task.drawn() == "#####\n#  h#\n#=###\n#  F#\n# ###\n#  r#\n#####\n");
  CHECK(sum(rewards(task, "llddrr")) == 0.0);
  CHECK(task.step(kLeft).reward() == 0.01);
  CHECK(task.drawn().find('F') == 3 * 6 + 3);  // from the start again
  CHECK(sum(rewards(task, "lluurr")) == 0.0);
  CHECK(task.step(kUp).reward() == 1.0);
}

TEST_CASE("the fence takes one push more after each hare, in a row, up to thirty") {
  Foraging task = begun(Scenario::kPersistence);
  for (int hares = 0; hares < 34; ++hares) {
    const int needed = std::min(hares, 30);
    rewards(task, "ll");
    if (needed > 1) {
      rewards(task, std::string(static_cast<std::size_t>(needed - 1), 'u'));
      rewards(task, "l");  // a break: all begins anew
    }
    for (int push = 0; push < needed; ++push) {
      const SituationId before = task.observation().situation;
      CHECK(task.step(kUp).situation == before);
    }
    CHECK(sum(rewards(task, "uurru")) == 1.0);
  }
}

TEST_CASE("from above the fence is open") {
  Foraging task = begun(Scenario::kPersistence);
  rewards(task, "lluurrl");  // a hare; one push is needed now
  rewards(task, "lluuu");
  CHECK(task.drawn().find('F') == 6 + 1);
  CHECK(task.step(kDown).situation == (2 * 5 + 1) * 16);
  CHECK(task.step(kDown).situation == (3 * 5 + 1) * 16);
}

TEST_CASE("in a season of rabbits nine are food, and each that follows does harm") {
  std::set<bool> first;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Foraging task = begun(Scenario::kPreySeason, seed, 140);
    bool rabbits = task.drawn().find('r') != std::string::npos;
    first.insert(rabbits);
    for (int season = 0; season < 4; ++season, rabbits = !rabbits) {
      CHECK((task.drawn().find('h') != std::string::npos) == !rabbits);
      for (int prey = 0; prey < 20; ++prey) {
        const double reward = sum(rewards(task, rabbits ? "lluurru" : "llddrrd"));
        CHECK(reward == (!rabbits ? 1.0 : prey < 9 ? 0.1 : -1.0));
      }
    }
  }
  CHECK(first.size() == 2);
}

TEST_CASE("a poisoned hare does harm in its season, and rabbits are food in all") {
  Foraging task = begun(Scenario::kPoisonedSeason, 1, 140);
  for (int season = 0; season < 4; ++season) {
    for (int i = 0; i < 10; ++i) {
      CHECK(sum(rewards(task, "lluurru")) == (season % 2 == 0 ? -1.0 : 1.0));
      CHECK(sum(rewards(task, "llddrrd")) == 0.1);
    }
  }
}

TEST_CASE("who is thirsty finds nothing in a hare, and gets thirsty in one of five steps") {
  std::set<std::size_t> corners;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    corners.insert(begun(Scenario::kHungerThirst, seed).drawn().find('h'));
  }
  CHECK(corners == std::set<std::size_t>{8 + 1, 8 + 5, 5 * 8 + 1, 5 * 8 + 5});

  Foraging task = begun(Scenario::kHungerThirst, 5);
  RandomAgent agent(3);
  int quenched = 0, became_thirsty = 0;
  for (int i = 0; i < 200000; ++i) {
    const SituationId before = task.observation().situation;
    const bool was_thirsty = before % 16 >= 4, hare = before % 4 == 1, water = before % 4 == 2;
    const Outcome outcome = task.step(agent.choose(task.observation()).motion);
    agent.observe(outcome);
    const bool thirsty = outcome.situation % 16 >= 4;
    CHECK(outcome.reward() == (hare && !thirsty ? 1.0 : 0.0));
    if (water) CHECK_FALSE(thirsty);
    if (was_thirsty && !water) CHECK(thirsty);
    if (was_thirsty || water) continue;
    ++quenched;
    became_thirsty += thirsty ? 1 : 0;
  }
  const double expected = 0.2 * quenched;
  CHECK(std::abs(became_thirsty - expected) < 5 * std::sqrt(0.8 * expected));
}

TEST_CASE("a rabbit comes out of a closed lair, and is gone after one step unless eaten") {
  Foraging task = begun(Scenario::kLairs, 1);
  CHECK(task.motion_count() == 6);
  RandomAgent agent(3);
  int fed = 0, empty = 0, closed = 0;
  for (int i = 0; i < 300000; ++i) {
    const std::string before = task.drawn();
    const int lairs = static_cast<int>(task.observation().situation % 16);
    const int motion = agent.choose(task.observation()).motion;
    const Outcome outcome = task.step(motion);
    agent.observe(outcome);
    const int after = static_cast<int>(outcome.situation % 16);
    const bool out = lairs / 3 == 2 || lairs % 3 == 2;
    CHECK(outcome.reward() == (motion == kEat && out ? 1.0 : 0.0));
    fed += outcome.reward() > 0.0 ? 1 : 0;
    for (const auto& [was, is] :
         {std::pair{lairs / 3, after / 3}, std::pair{lairs % 3, after % 3}}) {
      if (was == 2) CHECK(is == 1);
      if (was == 0 && is != 0) CHECK((is == 2 && motion == kOpen));
      if (was == 1) ++empty, closed += is == 0 ? 1 : 0;
    }
  }
  CHECK(fed > 50);
  CHECK(std::abs(closed - 0.1 * empty) < 5 * std::sqrt(0.09 * empty));
}

TEST_CASE("all chance in an episode follows from its seed") {
  for (const Scenario scenario :
       {Scenario::kMovingPreys, Scenario::kPreySeason, Scenario::kHungerThirst, Scenario::kLairs}) {
    const auto history = [&](std::uint64_t seed) {
      Foraging task = begun(scenario, seed + 100, 50);
      task.step(kUp);
      task.begin(seed);
      Random random(2, "motions");
      std::vector<SituationId> met;
      for (int i = 0; i < 2000; ++i) {
        met.push_back(task.step(static_cast<int>(random.index(task.motion_count()))).situation);
      }
      return met;
    };
    CHECK(history(3) == history(3));
    CHECK((history(3) != history(4) || history(3) != history(5)));
  }
}

TEST_CASE("a call that is refused changes nothing") {
  Foraging task;
  check_refused([&] { task.observation(); }, "observation", "called before an episode");
  check_refused([&] { task.step(0); }, "step", "called before an episode");
  check_refused([&] { task.drawn(); }, "drawn", "called before an episode");
  task.begin(1);
  const std::string drawn = task.drawn();
  check_refused([&] { task.step(4); }, "motion", "4");
  check_refused([&] { task.step(-1); }, "motion", "-1");
  CHECK(task.drawn() == drawn);
  CHECK_FALSE(task.succeeded());
}

// The margins were written down before the runs: docs/who_is_who/appraisal.md.
TEST_CASE("the published weights forage better than external reward alone, as published") {
  AppraisalConfig curious, persistent, plain;
  plain.control = 0.0;
  plain.external = 1.0;
  curious.novelty = 0.4;
  curious.control = -0.1;
  curious.valence = 0.2;
  curious.external = -0.3;
  persistent.novelty = -0.1;
  persistent.motivation = 0.1;
  persistent.control = -0.1;
  persistent.valence = 0.1;
  persistent.external = 0.6;
  const auto moving = [](const AppraisalConfig& config) {
    return mean_reward(Scenario::kMovingPreys, config, 4, 30000);
  };
  const auto fenced = [](const AppraisalConfig& config) {
    return mean_reward(Scenario::kPersistence, config, 4, 30000);
  };
  CHECK(moving(curious) > 2.0 * moving(plain));
  CHECK(fenced(persistent) > 2.0 * fenced(plain));
}
