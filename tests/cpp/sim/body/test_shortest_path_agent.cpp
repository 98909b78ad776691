#include <doctest/doctest.h>

#include <memory>
#include <set>
#include <string>

#include "core/refusal.hpp"
#include "devlearn/error.hpp"
#include "devlearn/record.hpp"
#include "devlearn/shortest_path.hpp"
#include "devlearn/shortest_path_agent.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/trial_snapshot.hpp"

using namespace devlearn;

namespace {

World shipped(const std::string& name) {
  return World::load(DEVLEARN_SOURCE_DIR "/python/devlearn/worlds/" + name + ".json");
}

std::shared_ptr<ShortestPathAgent> planner(const World& world) {
  return std::make_shared<ShortestPathAgent>(Robot(world, {}));
}

}  // namespace

TEST_CASE("it takes as many steps as the shortest path, in every round, and touches nothing") {
  for (const char* name : {"paper", "empty", "u_trap"}) {
    CAPTURE(name);
    const World world = shipped(name);
    Trial trial(world, {}, 0, planner(world));
    Record record;
    trial.path_learning(record, 3, 1000);
    const ShortestPath path = shortest_path(Robot(world, {}), world.def().start);
    REQUIRE(path.exact());
    REQUIRE(record.rounds.size() == 3);
    for (const devlearn::Round& round : record.rounds) {
      CHECK(round.arrived);
      CHECK(round.steps == path.steps());
    }
    for (const std::uint8_t collided : record.collided) CHECK(collided == 0);
  }
}

TEST_CASE("put elsewhere, or driven on from the target, it plans anew") {
  const World world = shipped("paper");
  Trial trial(world, {}, 0, planner(world));
  Record record;
  trial.path_learning(record, 1, 30);
  CHECK_FALSE(record.rounds[0].arrived);
  const Pose elsewhere{4.0, 2.5, 77.0};
  trial.place(elsewhere);
  Record rest;
  trial.finish_round(rest, 1000);
  CHECK(rest.rounds[0].arrived);
  CHECK(rest.rounds[0].steps == shortest_path(Robot(world, {}), elsewhere).steps());
  Record on;
  trial.run(on, 200);
  int there = 0;
  for (const std::uint8_t arrived : on.arrived) there += arrived;
  CHECK(there > 10);  // it comes back again and again
}

TEST_CASE("a trial with it is loaded by its maker, and goes on along the same way") {
  const World world = shipped("u_trap");
  Trial trial(world, {}, 0, planner(world));
  Record before;
  trial.run(before, 40);
  const auto bytes = to_bytes(trial);
  TrialSnapshot again = load_trial(bytes.data(), bytes.size(), {nullptr, ShortestPathAgent::maker});
  CHECK(to_bytes(again.trial) == bytes);
  Record on, twin;
  trial.finish_round(on, 1000);
  again.trial.finish_round(twin, 1000);
  CHECK(on.rounds[0].arrived);
  CHECK(on.motion == twin.motion);
  CHECK(to_bytes(again.trial) == to_bytes(trial));
}

TEST_CASE("where there is no way it says so, and the trial stays as it was") {
  WorldDef def;
  def.target = {4.5, 4.5};
  def.obstacles = {Rectangle{{2.5, 2.5}, 0.1, 5.0, 0.0}};
  const World world(def);
  Trial trial(world, {}, 0, planner(world));
  const Pose pose = trial.pose();
  CHECK_THROWS_AS(trial.step(), InvalidValue);
  CHECK(trial.pose() == pose);
}

TEST_CASE("what it cannot plan for is refused") {
  const World world = shipped("empty");
  RobotDef cautious;
  cautious.safety_margin = 0.05;
  check_refused([&] { ShortestPathAgent(Robot(world, cautious)); }, "RobotDef.safety_margin",
                "0.05");
  check_refused([&] { ShortestPathAgent(Robot(world, {}), 0.0); }, "goal_radius", "0");

  ShortestPathAgent agent(Robot(world, {}));
  Observation seen;
  seen.pose = world.def().start;
  seen.motion_count = 4;
  check_refused([&] { agent.choose(seen); }, "motion_count", "4");
  seen.motion_count = 5;
  const int way = agent.choose(seen).motion;
  bool allowed[5] = {true, true, true, true, true};
  allowed[way] = false;
  seen.allowed = allowed;
  check_refused([&] { agent.choose(seen); }, "allowed", "not motion " + std::to_string(way));
}

TEST_CASE("a state that is none of its own, or whose way no motions make, makes no such agent") {
  const World world = shipped("empty");
  ShortestPathAgent agent(Robot(world, {}));
  Observation seen;
  seen.pose = world.def().start;
  seen.motion_count = 5;
  agent.choose(seen);
  const AgentState good = *agent.state();
  REQUIRE(static_cast<bool>(ShortestPathAgent::maker(good)));
  CHECK_FALSE(static_cast<bool>(ShortestPathAgent::maker({"random", {}, {}})));
  const auto refused = [&](const auto& spoil) {
    AgentState spoilt = good;
    spoil(spoilt);
    CHECK_THROWS_AS(ShortestPathAgent(spoilt, "it"), FileError);
  };
  refused([](AgentState& s) { s.kind = "random"; });
  std::set<std::string> may_lack;
  detail::each_field<RobotDef>([&](const auto& field) {
    if (field.may_lack) may_lack.insert(std::string("robot.") + field.name);
  });
  for (const auto& entry : good.texts) {
    const std::string& name = entry.first;
    CAPTURE(name);
    if (name == "robot.track" || name == "robot.safety_margin") continue;  // may be none
    if (may_lack.count(name) == 0) refused([&](AgentState& s) { s.texts.erase(name); });
    refused([&](AgentState& s) { s.texts[name] = "x"; });
  }
  for (const auto& entry : good.arrays) {
    refused([&](AgentState& s) { s.arrays.erase(entry.first); });
  }
  refused([](AgentState& s) { s.texts["goal_radius"] = "-1"; });
  refused([](AgentState& s) { s.texts["robot.safety_margin"] = "0.1"; });
  refused([](AgentState& s) {
    s.texts["way_poses"] = "2";
    s.arrays["way"] = array_of(std::vector<double>{1.0, 1.0, 0.0, 3.0, 3.0, 0.0}, {2, 3});
  });
}
