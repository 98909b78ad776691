#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/trial_snapshot.hpp"
#include "sim/open_world.hpp"

using namespace devlearn;

namespace {

World paper() {
  return World::load(std::string(DEVLEARN_SOURCE_DIR) + "/python/devlearn/worlds/paper.json");
}

// The paper's world with one that patrols, one that wanders and one that comes to rest.
World moving() {
  WorldDef def = paper().def();
  using Then = MoverPath::Then;
  def.movers = {{Circle{{}, 0.15}, MoverPath{{{0.9, 0.2}, {0.9, 1.2}}, 0.06, Then::kBack}},
                {Circle{{}, 0.2}, MoverPath{{{1.0, 3.6}, {3.4, 1.2}}, 0.08, Then::kBack}},
                {Rectangle{{}, 0.3, 0.2, 20.0}, MoverWalk{4, {1.2, 1.2}, {4.6, 4.6}, 15.0}},
                {Circle{{}, 0.15}, MoverPath{{{4.5, 1.0}, {4.5, 3.0}}, 0.3, Then::kStop}}};
  return World(def);
}

using Bytes = std::vector<std::byte>;

// All that there is of a trial and its record, to the bit.
Bytes all_of(const Trial& trial, const Record& record) {
  return to_bytes(trial, {&record, true, ""});
}

void live(Trial& trial, Record& record) {
  trial.free_learning(record, 1200);
  trial.path_learning(record, 4, 500);
  trial.run(record, 100);
}

long collisions(const Record& record) {
  return std::count(record.collided.begin(), record.collided.end(), 1);
}

}  // namespace

TEST_CASE("a trial's time is its steps so far times the sample time, over all rounds") {
  TrialConfig config;
  config.robot.sample_time = 0.25;
  Trial trial(moving(), config, 1);
  Record record;
  CHECK(trial.time() == 0.0);
  trial.run(record, 10);
  CHECK(trial.time() == 2.5);
  trial.begin_round();
  CHECK(trial.time() == 2.5);
  trial.path_learning(record, 2, 30);
  trial.step();
  CHECK(trial.time() == 2.5 + 0.25 * 61);
  REQUIRE(record.rounds.size() == 3);
  CHECK(record.rounds[0].began == 0);
  CHECK(record.rounds[1].began == 10);
  CHECK(record.rounds[2].began == 40);
}

TEST_CASE("what is sensed in a moving world is sensed at the trial's time") {
  Trial trial(moving(), {}, 2);
  Record record;
  trial.free_learning(record, 400, {true, {}});
  long elsewhere = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const double time = 0.5 * static_cast<double>(i + 1);
    const Pose pose{record.x[i + 1], record.y[i + 1], record.heading[i + 1]};
    REQUIRE(record.clearance[i] == trial.world().clearance({pose.x, pose.y}, false, time));
    elsewhere += record.clearance[i] != trial.world().clearance({pose.x, pose.y}, false, 0.0);
    const std::vector<double> echoes = trial.robot().sonar(pose, time);
    REQUIRE(std::equal(echoes.begin(), echoes.end(),
                       record.echoes.begin() + static_cast<std::ptrdiff_t>(5 * i)));
    const Pose before{record.x[i], record.y[i], record.heading[i]};
    const Robot::Move move =
        trial.robot().step(before, record.motion[i], 0.5 * static_cast<double>(i));
    REQUIRE(move.pose == pose);
    REQUIRE(move.collided == (record.collided[i] == 1));
  }
  CHECK(elsewhere > 50);
}

TEST_CASE("one call, pieces and step by step give the same history among movers") {
  for (const TrialConfig& config : {TrialConfig::paper(), TrialConfig::adaptive()}) {
    Trial whole(moving(), config, 3), pieces(moving(), config, 3), steps(moving(), config, 3);
    Record record, joined, stepped;
    whole.free_learning(record, 1500);
    CHECK(collisions(record) > 20);
    pieces.free_learning(joined, 1);
    for (const int count : {0, 7, 400, 1092}) pieces.run(joined, count);
    CHECK(all_of(pieces, joined) == all_of(whole, record));
    steps.begin_round();
    stepped.begin_round(1, steps.pose(), 0);
    for (int i = 0; i < 1500; ++i) stepped.append(steps.step());
    CHECK(all_of(steps, stepped) == all_of(whole, record));
  }
}

TEST_CASE("a trial among movers that is loaded goes on equal to the bit, in the midst of a round") {
  for (const TrialConfig& config : {TrialConfig::paper(), TrialConfig::adaptive()}) {
    for (const int steps : {0, 1, 137, 900}) {
      Trial trial(moving(), config, 4);
      Record past;
      trial.free_learning(past, steps);
      const Bytes bytes = to_bytes(trial);
      Trial loaded = load_trial(bytes.data(), bytes.size()).trial;
      CHECK(loaded.time() == trial.time());
      Record record, again;
      trial.run(record, 300);
      loaded.run(again, 300);
      live(trial, record);
      live(loaded, again);
      REQUIRE(all_of(loaded, again) == all_of(trial, record));
    }
  }
}

TEST_CASE("a trial saved where a mover pins the robot loads, and goes on") {
  WorldDef def;
  def.start = {2.5, 0.5, 270.0};
  def.movers = {
      {Circle{{}, 0.5}, MoverPath{{{2.5, 3.0}, {2.5, 1.2}}, 0.1, MoverPath::Then::kStop}}};
  def.start = {4.0, 0.5, 180.0};
  Trial trial(World(def), {}, 5);
  // It is put below while the mover is far, and stands there when that comes.
  trial.place({2.5, 0.65, 270.0});
  Record record;
  trial.run(record, 60);
  const Bytes bytes = to_bytes(trial);
  Trial loaded = load_trial(bytes.data(), bytes.size()).trial;
  Record a, b;
  trial.run(a, 200);
  loaded.run(b, 200);
  CHECK(all_of(loaded, b) == all_of(trial, a));
}

TEST_CASE("a robot is not put where a mover is, and the trial stays as it was") {
  Trial trial(moving(), {}, 6);
  Record record;
  CHECK_THROWS_AS(trial.place({1.0, 3.6, 0.0}), InvalidValue);
  CHECK(trial.round() == 0);
  trial.run(record, 40);  // 20 s: the mover is gone
  CHECK_NOTHROW(trial.place({1.0, 3.6, 0.0}));
}

TEST_CASE("a trial refuses a world in which a mover's course leaves no room at the start") {
  WorldDef def;
  def.movers = {{Circle{{}, 0.2}, MoverPath{{{0.78, 0.3}, {0.78, 4.0}}, 0.1}}};
  const World world(def);  // room for a point
  try {
    Trial trial(world, {}, 1);
    FAIL_CHECK("accepted");
  } catch (const InvalidValue& error) {
    CHECK(error.quantity() == "movers[0]");
  }
}

TEST_CASE("in a changed world the agent goes on with all that it learned, at the same time") {
  Trial trial(paper(), TrialConfig::adaptive(), 7);
  Record before, after;
  trial.path_learning(before, 20, 2000);
  const std::int64_t steps = before.rounds.back().began + before.rounds.back().steps;
  const auto learner = trial.adaptive_learner();
  const std::size_t known = learner->situations().size();
  trial.change_world(moving());
  CHECK(trial.adaptive_learner().get() == learner.get());
  CHECK(learner->situations().size() == known);
  CHECK(trial.round() == 20);
  CHECK(trial.time() == 0.5 * static_cast<double>(steps));
  CHECK(trial.pose() == moving().def().start);
  CHECK(trial.world().to_json() == moving().to_json());
  REQUIRE(trial.earlier_worlds().size() == 1);
  CHECK(trial.earlier_worlds()[0].world.to_json() == paper().to_json());
  CHECK(trial.earlier_worlds()[0].steps == steps);
  trial.path_learning(after, 3, 2000);
  CHECK(after.rounds.front().round == 21);
  CHECK(after.rounds.front().began == steps);

  // As the same agent would in a trial of that world that is as old.
  const Bytes bytes = to_bytes(trial);
  Trial loaded = load_trial(bytes.data(), bytes.size()).trial;
  REQUIRE(loaded.earlier_worlds().size() == 1);
  CHECK(loaded.earlier_worlds()[0].world.to_json() == paper().to_json());
  CHECK(to_bytes(loaded) == bytes);
}

TEST_CASE("changing the world ends the round that is open, and tells the agent") {
  struct Listening final : Agent {
    Choice choose(const Observation&) override { return {2, Kind::kUnstated}; }
    Development observe(const Outcome&) override { return {}; }
    void begin_round() override { ++begun; }
    void end_round(bool arrived) override { ended += arrived ? 100 : 1; }
    int begun = 0, ended = 0;
  };
  const auto agent = std::make_shared<Listening>();
  Trial trial(paper(), {}, 8, agent);
  Record record;
  trial.free_learning(record, 10);
  CHECK(agent->begun == 1);
  trial.change_world(moving());
  CHECK(agent->ended == 1);
  CHECK_FALSE(trial.round_open());
  trial.change_world(paper());
  CHECK(agent->ended == 1);
  trial.free_learning(record, 10);
  CHECK(agent->begun == 2);
  CHECK(trial.earlier_worlds().size() == 2);
}

TEST_CASE(
    "a world with another arena, or without room at its start, is refused and changes nothing") {
  Trial trial(paper(), {}, 9);
  Record record;
  trial.free_learning(record, 50);
  const Bytes before = to_bytes(trial);
  WorldDef wider;
  wider.width = 6.0;
  WorldDef shifted;
  shifted.origin = {0.1, 0.0};
  WorldDef tight;
  tight.obstacles = {Circle{{0.5, 0.8}, 0.25}};
  for (const WorldDef& def : {wider, shifted, tight}) {
    CHECK_THROWS_AS(trial.change_world(World(def)), InvalidValue);
  }
  CHECK(to_bytes(trial) == before);
}
