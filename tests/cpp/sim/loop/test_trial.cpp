#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/golden_text.hpp"
#include "core/refusal.hpp"
#include "devlearn/error.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/trial.hpp"
#include "sim/open_world.hpp"

using namespace devlearn;

namespace {

World shipped(const std::string& name) {
  return World::load(std::string(DEVLEARN_SOURCE_DIR) + "/python/devlearn/worlds/" + name +
                     ".json");
}

TrialConfig sonar_config() {
  TrialConfig config;
  config.clearance_source = ClearanceSource::kSonar;
  config.walls_count = true;
  return config;
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, " %.17g", value);
  return text;
}

// A line a step, and before each round one for the pose that it begins from.
std::vector<std::string> lines_of(const Record& record) {
  std::vector<std::string> lines;
  std::size_t step = 0;
  for (std::size_t i = 0; i < record.rounds.size(); ++i) {
    const Round& round = record.rounds[i];
    const auto pose = [&](std::size_t k) {
      return number(record.x[k]) + number(record.y[k]) + number(record.heading[k]);
    };
    lines.push_back("round " + std::to_string(round.round) + " " + std::to_string(round.steps) +
                    " " + std::to_string(round.arrived) + pose(step + i));
    for (std::int64_t n = 0; n < round.steps; ++n, ++step) {
      std::string line;
      for (const long long whole :
           {static_cast<long long>(record.situation[step]),
            static_cast<long long>(record.motion[step]), static_cast<long long>(record.kind[step]),
            static_cast<long long>(record.event[step]),
            static_cast<long long>(record.reduced[step]),
            static_cast<long long>(record.explored_count[step]),
            static_cast<long long>(record.effective_count[step]),
            static_cast<long long>(record.collided[step]),
            static_cast<long long>(record.arrived[step])}) {
        line += std::to_string(whole) + " ";
      }
      lines.push_back(line + "|" + pose(step + i + 1) + number(record.sef[step]) +
                      number(record.smf[step]) + number(record.smf_used[step]) +
                      number(record.goal_distance[step]) + number(record.clearance[step]));
    }
  }
  return lines;
}

bool same(const Record& a, const Record& b) {
  return lines_of(a) == lines_of(b) && a.echoes == b.echoes && a.round == b.round;
}

// A learning history with rounds of both kinds.
Record whole_history(Trial& trial, std::int64_t steps) {
  Record record;
  trial.free_learning(record, steps);
  trial.free_learning(record, steps / 2);
  trial.path_learning(record, 20, 400);
  return record;
}

std::string golden_path(const std::string& name) {
  return std::string(DEVLEARN_SOURCE_DIR) + "/tests/golden/" + name + ".txt";
}

void check_golden(const std::string& name, const Record& record) {
  const std::string text = golden_text(lines_of(record), 200, 20), path = golden_path(name);
  if (std::getenv("DEVLEARN_UPDATE_GOLDEN") != nullptr) std::ofstream(path) << text;
  std::stringstream golden;
  golden << std::ifstream(path).rdbuf();
  std::string expected, got;
  for (std::stringstream stream(text); std::getline(golden, expected);) {
    std::getline(stream, got);
    REQUIRE(got == expected);
  }
  CHECK(golden.str() == text);
}

void check_golden_without_contacts(const std::string& preset, TrialConfig config) {
  config.evaluation = {20.0, 0.3, 3.0, 0.5, 1.5};  // obstacles are felt from afar
  Trial trial(open_world(), config, 2);
  const Record record = whole_history(trial, 3000);
  REQUIRE(std::count(record.collided.begin(), record.collided.end(), 1) == 0);
  check_golden("trial_" + preset, record);
}

/// Motions by a rule, to steer a trial from a test; counts what it is asked and told.
class Scripted final : public Agent {
 public:
  std::function<Choice(const Observation&)> choosing = [](const Observation&) {
    return Choice{2, Kind::kUnstated};
  };
  std::function<void(const Outcome&)> observing = [](const Outcome&) {};
  Choice choose(const Observation& observation) override {
    ++chosen;
    return choosing(observation);
  }
  Development observe(const Outcome& outcome) override {
    observing(outcome);
    ++observed;
    return {};
  }
  void cancel() override { ++cancelled; }
  int chosen = 0, observed = 0, cancelled = 0;
};

}  // namespace

// --- the same seed, the same history ------------------------------------------------------------

// To write the golden files anew: DEVLEARN_UPDATE_GOLDEN=1 test_sim -tc="the golden trial*"
TEST_CASE("the golden trial of the paper's preset is repeated to the last bit") {
  check_golden_without_contacts("paper", TrialConfig::paper());
}

TEST_CASE("the golden trial of step 5's preset is repeated to the last bit") {
  check_golden_without_contacts("step5", TrialConfig::step5());
}

TEST_CASE("the golden trial of the adaptive preset is repeated to the last bit") {
  TrialConfig config = TrialConfig::adaptive();
  config.robot.safety_margin = 0.05;  // it goes about more than the others
  check_golden_without_contacts("adaptive", config);
}

// What is touched is Box2D's: a history of its own for each version and architecture.
TEST_CASE("the golden trial with contacts is repeated to the last bit where one is kept") {
  Trial trial(shipped("paper"), {}, 2);
  const Record record = whole_history(trial, 3000);
  CHECK(std::count(record.collided.begin(), record.collided.end(), 1) > 300);
  for (std::size_t i = 0; i < record.x.size(); ++i) {
    REQUIRE(trial.world().clearance({record.x[i], record.y[i]}, true) >= 0.095);
  }
  const std::string name = std::string("contacts_") + DEVLEARN_CONTACTS;
  if (std::getenv("DEVLEARN_UPDATE_GOLDEN") == nullptr && !std::ifstream(golden_path(name))) {
    MESSAGE("none is kept for " << DEVLEARN_CONTACTS << ": only laws were checked");
    return;
  }
  check_golden(name, record);
}

// tests/python/test_trial.py asks for this history, which has contacts, and compares it with its
// own: both then come from the same Box2D.
TEST_CASE("the history of the paper's world is written to DEVLEARN_WRITE_HISTORY") {
  Trial trial(shipped("paper"), {}, 7);
  const Record record = whole_history(trial, 3000);
  CHECK(std::count(record.collided.begin(), record.collided.end(), 1) > 10);
  if (const char* path = std::getenv("DEVLEARN_WRITE_HISTORY")) {
    std::ofstream file(path);
    for (const std::string& line : lines_of(record)) file << line << "\n";
  }
}

TEST_CASE("the same seed gives the same history, another seed another one") {
  Trial first(shipped("paper"), {}, 7), second(shipped("paper"), {}, 7),
      third(shipped("paper"), {}, 8);
  const Record record = whole_history(first, 2000);
  CHECK(same(record, whole_history(second, 2000)));
  CHECK_FALSE(same(record, whole_history(third, 2000)));
}

TEST_CASE("one call, pieces, and step by step give the same history") {
  const World world = shipped("paper");
  Trial whole(world, {}, 3), pieces(world, {}, 3), steps(world, {}, 3);
  const Record record = recorded([&](Record& r) { whole.free_learning(r, 1000); });

  Record joined = recorded([&](Record& r) { pieces.free_learning(r, 1); });
  for (const int count : {0, 7, 300, 692}) {
    const Record piece = recorded([&](Record& r) { pieces.run(r, count); });
    REQUIRE(piece.steps() == static_cast<std::size_t>(count));
    CHECK(piece.x.front() == joined.x.back());
    for (std::size_t i = 0; i < piece.steps(); ++i) {
      joined.situation.push_back(piece.situation[i]);
      joined.motion.push_back(piece.motion[i]);
      joined.sef.push_back(piece.sef[i]);
      joined.x.push_back(piece.x[i + 1]);
    }
  }
  CHECK(joined.situation == record.situation);
  CHECK(joined.motion == record.motion);
  CHECK(joined.sef == record.sef);
  CHECK(joined.x == record.x);

  Record stepped;
  stepped.begin_round(1, steps.pose());
  for (int i = 0; i < 1000; ++i) stepped.append(steps.step());
  CHECK(same(stepped, record));
}

TEST_CASE("asking for echoes or for interrupts does not change the history") {
  const World world = shipped("clutter");
  Trial plain(world, {}, 5), watched(world, {}, 5);
  RunOptions options;
  options.echoes = true;
  options.interrupt = [] { return false; };
  const Record record = recorded([&](Record& r) { plain.free_learning(r, 800); });
  Record heard = recorded([&](Record& r) { watched.free_learning(r, 800, options); });
  CHECK(heard.sonar_count == 5);
  CHECK(heard.echoes.size() == 4000);
  heard.echoes.clear();
  CHECK(same(record, heard));
}

TEST_CASE("a run that keeps only rounds has the same history, and keeps the same rounds") {
  const World world = shipped("paper");
  Trial plain(world, {}, 5), brief(world, {}, 5);
  RunOptions options;
  options.rounds_only = true;
  Record kept, rounds;
  plain.free_learning(kept, 2000);
  plain.path_learning(kept, 20, 300);
  brief.free_learning(rounds, 2000, options);
  brief.path_learning(rounds, 20, 300, options);
  REQUIRE(rounds.rounds.size() == kept.rounds.size());
  for (std::size_t i = 0; i < kept.rounds.size(); ++i) {
    CHECK(rounds.rounds[i].round == kept.rounds[i].round);
    CHECK(rounds.rounds[i].steps == kept.rounds[i].steps);
    CHECK(rounds.rounds[i].arrived == kept.rounds[i].arrived);
  }
  CHECK(rounds.steps() == 0);
  CHECK(rounds.x.empty());
  CHECK(rounds.rounds_only());
  CHECK_FALSE(kept.rounds_only());
  CHECK_NOTHROW(rounds.validate());
  CHECK(same(recorded([&](Record& r) { plain.run(r, 500); }),
             recorded([&](Record& r) { brief.run(r, 500); })));

  CHECK_THROWS_AS(plain.run(kept, 1, options), InvalidValue);
  CHECK_THROWS_AS(plain.run(rounds, 1), InvalidValue);
  options.echoes = true;
  Record none;
  CHECK_THROWS_AS(plain.run(none, 1, options), InvalidValue);
}

TEST_CASE("trials that take turns do not disturb each other") {
  Trial alone(shipped("paper"), {}, 11), one(shipped("paper"), {}, 11),
      other(shipped("clutter"), {}, 12);
  const Record record = recorded([&](Record& r) { alone.free_learning(r, 300); });
  Record turns;
  turns.begin_round(1, one.pose());
  for (int i = 0; i < 300; ++i) {
    other.step();
    turns.append(one.step());
  }
  CHECK(same(turns, record));
}

TEST_CASE("an interrupted run goes on as if nothing had been") {
  const World world = shipped("paper");
  Trial whole(world, {}, 9), stopped(world, {}, 9);
  const Record record = recorded([&](Record& r) { whole.free_learning(r, 2000); });
  RunOptions options;
  int asked = 0;
  options.interrupt = [&] { return ++asked == 20; };
  const Record first = recorded([&](Record& r) { stopped.free_learning(r, 2000, options); });
  CHECK(first.steps() > 0);
  CHECK(first.steps() < 2000);
  const Record rest =
      recorded([&](Record& r) { stopped.run(r, 2000 - static_cast<std::int64_t>(first.steps())); });
  std::vector<int> motions(first.motion.begin(), first.motion.end());
  motions.insert(motions.end(), rest.motion.begin(), rest.motion.end());
  CHECK(std::equal(motions.begin(), motions.end(), record.motion.begin(), record.motion.end()));
  CHECK(rest.x.back() == record.x.back());
  CHECK(rest.round.back() == 1);
}

TEST_CASE("rounds without a step can be interrupted, too") {
  WorldDef def;
  def.target = {def.start.x, def.start.y};
  Trial trial(World(def), {}, 1);
  RunOptions options;
  int asked = 0;
  options.interrupt = [&] { return ++asked == 20; };
  CHECK(recorded([&](Record& r) { trial.path_learning(r, 1 << 30, 10, options); }).rounds.size() ==
        20);
}

// --- what a record says --------------------------------------------------------------------------

TEST_CASE("every column follows from the poses, the world and the learner's laws") {
  for (const bool sonar : {false, true}) {
    CAPTURE(sonar);
    const World world = shipped("paper");
    const TrialConfig config = sonar ? sonar_config() : TrialConfig{};
    Trial trial(world, config, 4);
    RunOptions options;
    options.echoes = true;
    const Record record = recorded([&](Record& r) { trial.free_learning(r, 2000, options); });
    const Robot robot(world, config.robot);
    std::int64_t wrong = 0, explored = 0, effective = 0;
    double sef_before = 0.0;
    const auto state = [&](std::size_t pose, double& distance, double& clearance) {
      distance =
          std::hypot(record.x[pose] - world.def().target.x, record.y[pose] - world.def().target.y);
      clearance = world.clearance({record.x[pose], record.y[pose]});
      if (sonar) {
        const auto echoes = robot.sonar({record.x[pose], record.y[pose], record.heading[pose]});
        clearance = *std::min_element(echoes.begin(), echoes.end()) + config.robot.radius;
      }
      return config.evaluation(distance, clearance);
    };
    double distance = 0.0, clearance = 0.0;
    sef_before = state(0, distance, clearance);
    for (std::size_t i = 0; i < record.steps(); ++i) {
      const Pose before{record.x[i], record.y[i], record.heading[i]};
      const Pose after{record.x[i + 1], record.y[i + 1], record.heading[i + 1]};
      const Robot::Move step = robot.step(before, record.motion[i]);
      wrong += step.pose != after || step.collided != static_cast<bool>(record.collided[i]);
      wrong += record.situation[i] != trial.grid().situation(before.x, before.y, before.heading);
      const double sef = state(i + 1, distance, clearance);
      wrong += std::abs(record.goal_distance[i] - distance) > 1e-12;
      wrong += record.clearance[i] != clearance;
      wrong += std::abs(record.sef[i] - sef) > 1e-12;
      wrong += record.smf[i] != record.sef[i] - sef_before;
      wrong +=
          record.smf_used[i] != (step.collided ? std::min(record.smf[i], -1.0) : record.smf[i]);
      wrong += record.arrived[i] != (record.goal_distance[i] <= config.goal_radius);
      const auto event = static_cast<Event>(record.event[i]);
      const auto kind = static_cast<Kind>(record.kind[i]);
      explored += kind == Kind::kExplore;
      effective += event == Event::kExtension;
      effective -= record.reduced[i] + (event == Event::kAbandonment);
      wrong += record.explored_count[i] != explored || record.effective_count[i] != effective;
      const std::vector<double> echoes = robot.sonar(after);
      wrong += !std::equal(echoes.begin(), echoes.end(), record.echoes.begin() + 5 * i);
      sef_before = record.sef[i];
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("free rounds are numbered 1 and 2, path learning's from 3") {
  Trial trial(shipped("paper"), {}, 2);
  CHECK(trial.round() == 0);
  const Record record = whole_history(trial, 200);
  REQUIRE(record.rounds.size() == 22);
  for (std::size_t i = 0; i < 22; ++i) CHECK(record.rounds[i].round == static_cast<int>(i) + 1);
  CHECK(trial.round() == 22);
  CHECK(recorded([&](Record& r) { trial.run(r, 5); }).rounds.front().round == 22);
  trial.place({2.0, 1.5, 90.0});
  CHECK(trial.round() == 23);
}

TEST_CASE("a round of path learning begins at the start and ends where it arrives, or fails") {
  const World world = shipped("empty");
  Trial trial(world, {}, 2);
  recorded([&](Record& r) { trial.free_learning(r, 3000); });
  const Record record = recorded([&](Record& r) { trial.path_learning(r, 60, 300); });
  REQUIRE(record.rounds.size() == 60);
  std::size_t step = 0;
  int arrived = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    const Round& round = record.rounds[i];
    const Pose start = world.def().start;
    CHECK(Pose{record.x[step + i], record.y[step + i], record.heading[step + i]} == start);
    for (std::int64_t n = 0; n < round.steps; ++n, ++step) {
      const bool last = n + 1 == round.steps;
      CHECK(static_cast<bool>(record.arrived[step]) == (last && round.arrived));
    }
    if (!round.arrived) CHECK(round.steps == 300);
    arrived += round.arrived;
  }
  CHECK(arrived > 0);
  CHECK(arrived < 60);
}

TEST_CASE("a round of path learning that begins at the target has no step and has arrived") {
  WorldDef def;
  def.target = {def.start.x, def.start.y};
  Trial trial(World(def), {}, 1);
  CHECK(trial.arrived());
  const Record record = recorded([&](Record& r) { trial.path_learning(r, 3); });
  CHECK(record.steps() == 0);
  REQUIRE(record.rounds.size() == 3);
  for (const Round& round : record.rounds) {
    CHECK(round.steps == 0);
    CHECK(round.arrived);
  }
  CHECK(record.x == std::vector<double>(3, def.start.x));
  CHECK(recorded([&](Record& r) { trial.free_learning(r, 10); }).steps() ==
        10);  // where reaching the target ends nothing
}

// --- agents --------------------------------------------------------------------------------------

TEST_CASE("a shared learner goes on from trial to trial") {
  const auto learner = std::make_shared<Learner>(LearnerConfig{}, 6);
  const auto agent = std::make_shared<LearnerAgent>(learner);
  Trial first(shipped("paper"), {}, 0, agent), second(shipped("paper"), {}, 0, agent);
  recorded([&](Record& r) { first.free_learning(r, 500); });
  const auto explored = learner->explored_count();
  CHECK(explored > 0);
  const Record record = recorded([&](Record& r) { second.free_learning(r, 500); });
  CHECK(record.explored_count.front() >= explored);
  CHECK(second.learner() == learner);
  // The trial's seed draws nothing where the agent is given.
  Trial own(shipped("paper"), {}, 6);
  Trial given(shipped("paper"), {}, 99,
              std::make_shared<LearnerAgent>(std::make_shared<Learner>(LearnerConfig{}, 6)));
  CHECK(same(recorded([&](Record& r) { own.free_learning(r, 500); }),
             recorded([&](Record& r) { given.free_learning(r, 500); })));
}

TEST_CASE("an agent is told before each choice and after each motion what the record says") {
  const auto agent = std::make_shared<Scripted>();
  std::vector<Observation> asked;
  std::vector<Outcome> told;
  agent->choosing = [&](const Observation& observation) {
    asked.push_back(observation);
    return Choice{static_cast<int>(asked.size() * 7 % 5), Kind::kExploit};
  };
  agent->observing = [&](const Outcome& outcome) { told.push_back(outcome); };
  Trial trial(shipped("paper"), {}, 0, agent);
  const Record record = recorded([&](Record& r) { trial.free_learning(r, 400); });
  for (std::size_t i = 0; i < 400; ++i) {
    CHECK(asked[i].situation == record.situation[i]);
    CHECK(asked[i].pose == Pose{record.x[i], record.y[i], record.heading[i]});
    CHECK(asked[i].motion_count == 5);
    CHECK(asked[i].estimate == asked[i].goal_distance / (0.1 * 0.5));
    if (i > 0) CHECK(asked[i].sef == record.sef[i - 1]);
    if (i > 0) CHECK(asked[i].clearance == record.clearance[i - 1]);
    if (i > 0) CHECK(asked[i].goal_distance == record.goal_distance[i - 1]);
    if (i + 1 < 400) CHECK(told[i].situation == record.situation[i + 1]);
    CHECK(told[i].sef == record.sef[i]);
    CHECK(told[i].smf == record.smf_used[i]);
    CHECK(told[i].collided == static_cast<bool>(record.collided[i]));
    CHECK(told[i].arrived == static_cast<bool>(record.arrived[i]));
    if (i + 1 < 400) CHECK(told[i].estimate == asked[i + 1].estimate);
    CHECK(told[i].cost == (told[i].collided ? 6.0 : 1.0));
    CHECK(told[i].reward() == -told[i].cost);
    CHECK(record.cost[i] == told[i].cost);
    CHECK(std::isnan(record.value[i]));
    CHECK(record.kind[i] == static_cast<int>(Kind::kExploit));
    CHECK(record.explored_count[i] == 0);
  }
  CHECK(trial.learner() == nullptr);
}

// --- what an agent is told of rounds -------------------------------------------------------------

namespace {

/// Drives straight on, and keeps a letter of each call: (b)egun, (s)tep chosen and observed,
/// (T)rue or (F)alse at a round's end. It throws at a call of its choice, once.
class Diary final : public Agent {
 public:
  void begin_round() override { write("b"); }
  Choice choose(const Observation&) override {
    write("");
    return {2, Kind::kUnstated};
  }
  Development observe(const Outcome&) override {
    write("s");
    return {};
  }
  void end_round(bool arrived) override { write(arrived ? "T" : "F"); }

  std::string text;
  int throws_at = -1;

 private:
  void write(const char* letter) {
    if (calls_++ == throws_at) throw std::runtime_error("at this call");
    text += letter;
  }
  int calls_ = 0;
};

// The target is eight steps straight ahead.
World straight_on(double target = 1.475) {
  WorldDef def;
  def.start = {1.0, 1.0, 0.0};
  def.target = {target, 1.0};
  return World(def);
}

}  // namespace

TEST_CASE(
    "a round begins before its first choice, and ends at the target or when the next begins") {
  const auto diary = std::make_shared<Diary>();
  Trial trial(straight_on(), {}, 0, diary);
  Record record;
  const auto told = [&](const char* expected) {
    CHECK(diary->text == expected);
    diary->text.clear();
  };
  CHECK_FALSE(trial.round_open());
  trial.step();
  trial.run(record, 0);
  trial.run(record, 2);
  told("bsss");
  CHECK(trial.round_open());
  trial.free_learning(record, 10);  // over the target
  told("Fbssssssssss");
  trial.free_learning(record, 0);
  told("Fb");
  trial.path_learning(record, 2);
  told("FbssssssssTbssssssssT");
  CHECK_FALSE(trial.round_open());
  trial.finish_round(record, 5);  // it is finished
  told("");
  trial.path_learning(record, 2, 3);  // both fail
  told("bsssFbsss");
  trial.finish_round(record, 4);
  told("ssss");
  trial.finish_round(record, 4);
  told("sT");
  trial.run(record, 2);  // where the last ended
  told("bss");
  trial.begin_round();
  trial.place({3.0, 3.0, 90.0});
  told("FbFb");
  trial.step();
  told("s");
}

TEST_CASE("a round of path learning that begins at the target begins and ends without a step") {
  const auto diary = std::make_shared<Diary>();
  Trial trial(straight_on(1.05), {}, 0, diary);
  Record record;
  trial.path_learning(record, 3);
  CHECK(diary->text == "bTbTbT");
}

TEST_CASE("an agent is told the same of rounds however often path learning is interrupted") {
  constexpr std::int64_t kRounds = 3;
  for (const std::int64_t limit : {5, 8, 100}) {
    const auto unbroken = std::make_shared<Diary>();
    Record whole;
    Trial(straight_on(), {}, 0, unbroken).path_learning(whole, kRounds, limit);
    for (int every = 1; every < 9; ++every) {
      const auto diary = std::make_shared<Diary>();
      Trial trial(straight_on(), {}, 0, diary);
      Record record;
      int looks = 0;
      RunOptions options;
      options.interrupt = [&] { return ++looks % (every + 1) == 0; };
      trial.path_learning(record, kRounds, limit, options);
      for (int i = 0; i < 1000; ++i) {
        const Round& last = record.rounds.back();
        const bool finished = last.arrived || last.steps == limit;
        if (finished && record.rounds.size() == kRounds) break;
        if (finished) {
          trial.path_learning(record, kRounds - static_cast<std::int64_t>(record.rounds.size()),
                              limit, options);
        } else {
          trial.finish_round(record, limit - last.steps, options);
        }
      }
      CHECK(diary->text == unbroken->text);
      CHECK(same(record, whole));
    }
  }
}

TEST_CASE("where an agent throws at any of its calls, going on makes up for it") {
  const auto unbroken = std::make_shared<Diary>();
  Record whole;
  Trial(straight_on(), {}, 0, unbroken).path_learning(whole, 3);
  for (int call = 0;; ++call) {
    const auto diary = std::make_shared<Diary>();
    diary->throws_at = call;
    Trial trial(straight_on(), {}, 0, diary);
    Record record;
    bool thrown = false;
    try {
      trial.path_learning(record, 3);
    } catch (const std::runtime_error&) {
      thrown = true;
      const std::string told = diary->text;
      CHECK(trial.round_open() == (!told.empty() && told.back() != 'T'));
      CHECK(trial.round() == static_cast<std::int32_t>(record.rounds.size()));
      if (!record.rounds.empty()) trial.finish_round(record, 100);
      trial.path_learning(record, 3 - static_cast<std::int64_t>(record.rounds.size()));
    }
    CHECK(diary->text == unbroken->text);
    CHECK(same(record, whole));
    if (!thrown) break;
    REQUIRE(call < 100);
  }
}

TEST_CASE("where an agent throws, the trial is left as it was and what is finished is kept") {
  for (const bool in_choice : {true, false}) {
    const auto agent = std::make_shared<Scripted>();
    const auto fail = [&](int done) {
      if (done == 7) throw std::runtime_error("no more");
    };
    agent->choosing = [&](const Observation&) {
      if (in_choice) fail(agent->observed);
      return Choice{3, Kind::kUnstated};
    };
    agent->observing = [&](const Outcome&) {
      if (!in_choice) fail(agent->observed);
    };
    Trial trial(shipped("paper"), {}, 0, agent);
    Record record;
    CHECK_THROWS_AS(trial.run(record, 100), std::runtime_error);
    CHECK(record.steps() == 7);
    CHECK(record.x.size() == 8);
    CHECK(trial.pose() == Pose{record.x.back(), record.y.back(), record.heading.back()});
    CHECK_THROWS_AS(trial.step(), std::runtime_error);
    CHECK(trial.pose() == Pose{record.x.back(), record.y.back(), record.heading.back()});
    CHECK(trial.round() == 1);
    agent->observed = 8;
    CHECK(trial.step().round == 1);
  }
  const auto agent = std::make_shared<Scripted>();
  agent->choosing = [](const Observation&) -> Choice { throw std::runtime_error("never"); };
  Trial trial(shipped("paper"), {}, 0, agent);
  CHECK_THROWS_AS(trial.step(), std::runtime_error);
  CHECK(trial.round() == 0);
}

TEST_CASE("a motion outside M is refused by name, and its agent told that it was not executed") {
  for (const int motion : {-1, 5, 1 << 30}) {
    const auto agent = std::make_shared<Scripted>();
    agent->choosing = [&](const Observation&) { return Choice{motion, Kind::kUnstated}; };
    Trial trial(shipped("paper"), {}, 0, agent);
    check_refused([&] { trial.step(); }, "agent's motion", std::to_string(motion));
    CHECK(agent->cancelled == 1);
    CHECK(agent->observed == 0);
    CHECK(trial.pose() == trial.world().def().start);
    CHECK(trial.round() == 0);
  }
}

TEST_CASE("an agent that moves its own trial is refused, whatever it calls") {
  const auto agent = std::make_shared<Scripted>();
  Trial trial(shipped("paper"), {}, 0, agent);
  Record record;
  for (const std::function<void()>& call : std::vector<std::function<void()>>{
           [&] { trial.step(); }, [&] { trial.run(record, 1); },
           [&] { trial.free_learning(record, 1); }, [&] { trial.path_learning(record, 1); },
           [&] { trial.finish_round(record, 1); }, [&] { trial.begin_round(); },
           [&] {
             trial.place({2.0, 1.5, 0.0});
           }}) {
    agent->observing = [&](const Outcome&) { call(); };
    check_refused([&] { trial.step(); }, "Trial", "a call while another is under way");
    check_refused([&] { trial.free_learning(record, 5); }, "Trial",
                  "a call while another is under way");
    CHECK(trial.pose() == trial.world().def().start);
  }
  agent->observing = [](const Outcome&) {};
  CHECK(recorded([&](Record& r) { trial.run(r, 3); }).steps() == 3);
}

TEST_CASE("random motions are uniform, seeded, and learn nothing") {
  const auto history = [](std::uint64_t seed) {
    return recorded([&](Record& r) {
      Trial(shipped("paper"), {}, 0, std::make_shared<RandomAgent>(seed)).free_learning(r, 5000);
    });
  };
  const Record record = history(1);
  CHECK(record.motion == history(1).motion);
  CHECK(record.motion != history(2).motion);
  double chi_square = 0.0;
  for (int motion = 0; motion < 5; ++motion) {
    const auto count =
        static_cast<double>(std::count(record.motion.begin(), record.motion.end(), motion));
    chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  }
  CHECK(chi_square < 18.47);  // 99.9 % of four degrees of freedom
  CHECK(record.explored_count.back() == 0);
  CHECK(record.kind.back() == static_cast<int>(Kind::kUnstated));
}

// --- refusals ------------------------------------------------------------------------------------

TEST_CASE("a configuration out of range is refused by the name of its field") {
  const auto refused = [](auto change, const char* quantity, const char* value) {
    TrialConfig config;
    change(config);
    check_refused([&] { config.validate(); }, quantity, value);
    check_refused([&] { Trial(World{}, config); }, quantity, value);
  };
  refused([](TrialConfig& c) { c.goal_radius = 0.0; }, "TrialConfig.goal_radius", "0");
  refused([](TrialConfig& c) { c.goal_radius = 101.0; }, "TrialConfig.goal_radius", "101");
  refused([](TrialConfig& c) { c.goal_radius = std::nan(""); }, "TrialConfig.goal_radius", "nan");
  refused([](TrialConfig& c) { c.cell_size = 0.0005; }, "TrialConfig.cell_size", "5e-04");
  refused([](TrialConfig& c) { c.cell_size = 1001.0; }, "TrialConfig.cell_size", "1001");
  refused([](TrialConfig& c) { c.heading_bins = 0; }, "TrialConfig.heading_bins", "0");
  refused([](TrialConfig& c) { c.heading_bins = 3601; }, "TrialConfig.heading_bins", "3601");
  refused([](TrialConfig& c) { std::get<LearnerConfig>(c.learner).eta = 1.0; }, "LearnerConfig.eta",
          "1");
  refused([](TrialConfig& c) { c.evaluation.a2 = -1.0; }, "StateEvaluation.a2", "-1");
  refused([](TrialConfig& c) { std::get<LearnerConfig>(c.learner).motion_count = 4; },
          "TrialConfig.learner.motion_count", "4");
  refused([](TrialConfig& c) { c.clearance_source = ClearanceSource::kSonar; },
          "TrialConfig.walls_count", "false with clearance_source sonar");
  refused(
      [](TrialConfig& c) {
        c = sonar_config();
        c.robot.sonar_count = 0;
      },
      "TrialConfig.robot.sonar_count with clearance_source sonar", "0");
}

TEST_CASE("configurations are equal when every field is") {
  const TrialConfig config;
  CHECK(config == TrialConfig::paper());
  CHECK(config != TrialConfig::step5());
  CHECK(std::get<LearnerConfig>(TrialConfig::step5().learner) == LearnerConfig::step5());
  const auto differs = [&](auto change) {
    TrialConfig other;
    change(other);
    CHECK(other != config);
  };
  differs([](TrialConfig& c) { std::get<LearnerConfig>(c.learner).eta = 0.1; });
  differs([](TrialConfig& c) { c.evaluation.a1 = 1.0; });
  differs([](TrialConfig& c) { c.robot.speed = 0.2; });
  differs([](TrialConfig& c) { c.clearance_source = ClearanceSource::kSonar; });
  differs([](TrialConfig& c) { c.walls_count = true; });
  differs([](TrialConfig& c) { c.goal_radius = 0.2; });
  differs([](TrialConfig& c) { c.cell_size = 0.2; });
  differs([](TrialConfig& c) { c.heading_bins = 6; });
}

TEST_CASE("a trial refuses what it cannot begin with") {
  check_refused([] { Trial(World{}, {}, 0, nullptr); }, "Trial.agent", "null");
  check_refused([] { LearnerAgent(nullptr); }, "LearnerAgent.learner", "null");
  LearnerConfig four;
  four.motion_count = 4;
  check_refused(
      [&] {
        Trial(World{}, {}, 0, std::make_shared<LearnerAgent>(std::make_shared<Learner>(four)));
      },
      "Trial.agent.config.motion_count", "4");
  WorldDef tight;  // a start that is a place, but not one for the body
  tight.start = {0.05, 0.5, 0.0};
  check_refused([&] { Trial{World(tight)}; }, "start", "a place 0.05 m from the nearest surface");
}

TEST_CASE("a trial refuses lengths out of range and places that do not fit, and stays as it was") {
  Trial trial(shipped("paper"), {}, 1);
  recorded([&](Record& r) { trial.run(r, 50); });
  const Pose pose = trial.pose();
  Record record;
  check_refused([&] { trial.run(record, -1); }, "steps", "-1");
  check_refused([&] { trial.free_learning(record, (std::int64_t{1} << 40) + 1); }, "steps",
                "1099511627777");
  check_refused([&] { trial.path_learning(record, -1, 10); }, "rounds", "-1");
  check_refused([&] { trial.path_learning(record, (1 << 30) + 1, 10); }, "rounds", "1073741825");
  check_refused([&] { trial.path_learning(record, 1, 0); }, "step_limit", "0");
  check_refused(
      [&] {
        trial.place({1.3, 1.4, 0.0});
      },
      "pose", "a place 0 m from the nearest surface");
  check_refused([&] { trial.place({-1.0, 1.4, 0.0}); }, "pose.x", "-1");
  check_refused([&] { trial.place({2.0, 1.5, std::nan("")}); }, "pose.heading", "nan");
  CHECK(record.steps() == 0);
  CHECK(record.rounds.empty());
  CHECK(trial.pose() == pose);
  CHECK(trial.round() == 1);
}

TEST_CASE("a record goes on with as many echoes a step as it began with") {
  TrialConfig config;
  Trial trial(World(), config, 3);
  RunOptions heard;
  heard.echoes = true;
  Record with = recorded([&](Record&r) { trial.free_learning(r, 4, heard); }),
         without = recorded([&](Record&r) { trial.free_learning(r, 4); });
  const Pose pose = trial.pose();
  for (const auto& [record, options] : {std::pair{&with, RunOptions{}}, {&without, heard}}) {
    const std::string value = std::to_string(record->sonar_count);
    check_refused([&] { trial.run(*record, 1, options); }, "record.sonar_count", value);
    check_refused([&] { trial.free_learning(*record, 1, options); }, "record.sonar_count", value);
    check_refused([&] { trial.path_learning(*record, 1, 9, options); }, "record.sonar_count",
                  value);
    check_refused([&] { trial.finish_round(*record, 1, options); }, "record.sonar_count", value);
  }
  CHECK(trial.pose() == pose);
  trial.run(with, 3, heard);
  trial.run(without, 3);
  with.validate();
  without.validate();
}

TEST_CASE("the grid covers the arena with cells of the size asked for, whatever its sides") {
  for (const double side : {0.5, 1.1, 4.9999, 5.0, 5.0001, 12.3}) {
    for (const double cell : {0.25, 0.1, 0.3, 7.0}) {
      WorldDef def;
      def.width = def.height = side;
      def.start = {side / 2, side / 2, 0.0};
      def.target = def.start.x < 1.0 ? Point{0.2, 0.2} : Point{1.0, 1.0};
      TrialConfig config;
      config.cell_size = cell;
      const Trial trial(World(def), config);
      const SituationGrid& grid = trial.grid();
      CHECK(grid.width() >= side);
      CHECK(grid.width() < side + cell + 1e-9);
      if (cell < side) CHECK(grid.width() / grid.columns() == doctest::Approx(cell).epsilon(1e-4));
      CHECK(grid.situation(side, side, 0.0) >= 0);
    }
  }
}

// --- an evaluation and situations of one's own
// -----------------------------------------------------

namespace {

NamedFunction<double> eq6() {
  return {"eq6", [](const Senses& senses) {
            return StateEvaluation{}(senses.goal_distance, senses.clearance);
          }};
}
NamedFunction<SituationId> cells(const SituationGrid& grid) {
  return {"cells", [grid](const Senses& senses) { return grid.situation(senses.pose); }};
}

}  // namespace

TEST_CASE("Eq. 6 and the grid, given as functions of one's own, make the same history") {
  for (const TrialConfig& config : {TrialConfig::paper(), TrialConfig::adaptive()}) {
    Trial plain(shipped("paper"), config, 4);
    Trial own(shipped("paper"), config, 4, TrialParts{eq6(), {}, cells(plain.grid())});
    REQUIRE(same(whole_history(plain, 2000), whole_history(own, 2000)));
  }
}

TEST_CASE("a table of SEFs is looked up by the grid's situation") {
  const SituationGrid grid = Trial(shipped("paper")).grid();
  TrialParts parts;
  for (SituationId id = 0; id < grid.count(); ++id)
    parts.sef_table.push_back(0.5 * static_cast<double>(id));
  Trial trial(shipped("paper"), {}, 4, parts);
  const Record record = recorded([&](Record& r) { trial.free_learning(r, 200); });
  for (std::size_t i = 0; i < 200; ++i) {
    const SituationId there =
        grid.situation(record.x[i + 1], record.y[i + 1], record.heading[i + 1]);
    REQUIRE(record.sef[i] == 0.5 * static_cast<double>(there));
  }
}

TEST_CASE("functions of one's own are told the pose, the distance to go and the clearance") {
  Senses last;
  TrialParts parts;
  parts.evaluation = {"look", [&](const Senses& senses) {
                        last = senses;
                        return 0.0;
                      }};
  parts.situations = {"one", [](const Senses&) { return SituationId{7}; }};
  Trial trial(open_world(), {}, 1, parts);
  const Step step = trial.step();
  CHECK(last.pose == step.pose);
  CHECK(last.goal_distance == step.goal_distance);
  CHECK(last.clearance == step.clearance);
  CHECK(step.situation == 7);
  CHECK(trial.learner()->situations() == std::vector<SituationId>{7});
}

TEST_CASE("what a function of one's own may not give is refused, and the step was not made") {
  double sef = 0.0;
  SituationId id = 0;
  TrialParts parts;
  parts.evaluation = {"mine", [&](const Senses&) { return sef; }};
  parts.situations = {"ours", [&](const Senses&) { return id; }};
  const auto agent = std::make_shared<Scripted>();
  Trial trial(open_world(), {}, 1, agent, parts);
  trial.step();
  const Pose pose = trial.pose();
  const double huge = 2e300, nan = std::nan(""), infinite = HUGE_VAL;
  for (const auto& [value, text] :
       {std::pair(huge, "2e+300"), std::pair(nan, "nan"), std::pair(infinite, "inf")}) {
    sef = value;
    check_refused([&] { trial.step(); }, "SEF by mine", text);
  }
  sef = 0.0;
  id = -1;
  check_refused([&] { trial.step(); }, "situation by ours", "-1");
  check_refused([&] { trial.begin_round(); }, "situation by ours", "-1");
  CHECK(trial.pose() == pose);
  CHECK(trial.round() == 1);
  CHECK(agent->cancelled == 4);
  CHECK(agent->observed == 1);
  id = 0;
  trial.step();
  CHECK(agent->observed == 2);
}

TEST_CASE("a function of one's own that throws or moves its trial leaves it as it was") {
  std::function<void()> act = [] {};
  TrialParts parts;
  parts.evaluation = {"mine", [&](const Senses& senses) {
                        act();
                        return -senses.goal_distance;
                      }};
  Trial trial(open_world(), {}, 1, parts), undisturbed(open_world(), {}, 1, parts);
  Record record;
  trial.run(record, 10);
  act = [] { throw std::runtime_error("no reading"); };
  CHECK_THROWS_WITH(trial.run(record, 5), "no reading");
  act = [&] { trial.begin_round(); };
  check_refused([&] { trial.step(); }, "Trial", "a call while another is under way");
  act = [] {};
  CHECK(trial.pose() == Pose{record.x.back(), record.y.back(), record.heading.back()});
  CHECK_FALSE(trial.learner()->pending());
  CHECK(trial.learner()->explored_count() == record.explored_count.back());
  trial.run(record, 5);
  CHECK(record.steps() == 15);
}

TEST_CASE("parts of one's own that make no sense are refused") {
  const auto made = [](TrialParts parts) {
    return [parts = std::move(parts)] { Trial(open_world(), {}, 1, parts); };
  };
  TrialParts nameless{eq6(), {}, {}};
  nameless.evaluation.name.clear();
  check_refused(made(nameless), "TrialParts.evaluation.name", "''");
  check_refused(made({{}, {}, {"cells", nullptr}}), "TrialParts.situations.function", "null");
  check_refused(made({eq6(), {0.0}, {}}), "TrialParts.sef_table", "given, and an evaluation too");
  const SituationGrid grid = Trial(open_world()).grid();
  check_refused(made({{}, {0.0}, cells(grid)}), "TrialParts.sef_table",
                "given, and situations of one's own too");
  check_refused(made({{}, {0.0, 1.0}, {}}), "TrialParts.sef_table", "2 values");
  std::vector<double> table(static_cast<std::size_t>(grid.count()), 0.0);
  table[5] = -HUGE_VAL;
  check_refused(made({{}, table, {}}), "TrialParts.sef_table[5]", "-inf");
}
