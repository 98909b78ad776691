#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/refusal.hpp"
#include "devlearn/agent.hpp"
#include "devlearn/error.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/snapshot.hpp"

using namespace devlearn;

namespace {

// A loop without world or robot: how good a motion is follows from situation and motion.
std::vector<int> lived(Agent& agent, int steps) {
  std::vector<int> motions;
  Observation observation;
  observation.motion_count = 5;
  observation.situation = 0;
  for (int step = 0; step < steps; ++step) {
    const int motion = agent.choose(observation).motion;
    Outcome outcome;
    outcome.situation = (observation.situation * 5 + motion) % 7;
    outcome.smf = static_cast<double>((motion + observation.situation) % 3 - 1);
    agent.observe(outcome);
    observation.situation = outcome.situation;
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace

TEST_CASE("an agent that is made of a state goes on as the one that it was taken of") {
  for (const std::shared_ptr<Agent>& agent : std::vector<std::shared_ptr<Agent>>{
           std::make_shared<LearnerAgent>(std::make_shared<Learner>(LearnerConfig{}, 3)),
           std::make_shared<RandomAgent>(3)}) {
    lived(*agent, 200);
    const std::optional<AgentState> state = agent->state();
    REQUIRE(state.has_value());
    const std::shared_ptr<Agent> again = make_agent(*state);
    REQUIRE(static_cast<bool>(again));
    CHECK(lived(*again, 500) == lived(*agent, 500));
  }
}

TEST_CASE("a learner's state is what its snapshot holds") {
  const auto learner = std::make_shared<Learner>(LearnerConfig{}, 3);
  LearnerAgent agent(learner);
  lived(agent, 200);
  const AgentState state = *agent.state();
  CHECK(state.kind == "learner");
  CHECK(state.text("seed") == "3");
  CHECK(state.values<SituationId>("situation", {learner->situations_experienced()}) ==
        learner->situations());
  const auto again = std::dynamic_pointer_cast<LearnerAgent>(make_agent(state));
  CHECK(to_bytes(*again->learner()) == to_bytes(*learner));
}

TEST_CASE("a state outlives its agent, and does not change with it") {
  auto agent = std::make_shared<LearnerAgent>(std::make_shared<Learner>(LearnerConfig{}, 3));
  lived(*agent, 200);
  const AgentState state = *agent->state();
  const std::vector<int> expected = lived(*agent, 300);
  agent.reset();
  CHECK(lived(*make_agent(state), 300) == expected);
}

TEST_CASE("an agent that says nothing of its state has none") {
  class Still final : public Agent {
    Choice choose(const Observation&) override { return {0, Kind::kUnstated}; }
    Development observe(const Outcome&) override { return {}; }
  };
  CHECK_FALSE(Still().state().has_value());
}

TEST_CASE(
    "a kind that is none of devlearn's makes no agent, and one that does not fit is refused") {
  CHECK_FALSE(static_cast<bool>(make_agent({"q-learning", {}, {}})));
  CHECK_FALSE(static_cast<bool>(make_agent({"none", {}, {}})));
  for (const char* kind : {"learner", "random"}) {
    try {
      make_agent({kind, {}, {}}, "it");
      FAIL("not refused");
    } catch (const FileError& error) {
      CHECK(error.file() == "it");
      CHECK(error.value() == "nothing");
    }
  }
}

TEST_CASE("a state gives values back to the bit, and names what is missing or of another form") {
  AgentState state{"mine", {{"name", "caf\u00e9"}}, {}};
  const std::vector<double> values{0.1, -0.0, 1e-300, 1e300, 5.0, 6.0};
  state.arrays["q"] = array_of(values, {2, 3});
  state.arrays["n"] = array_of(std::vector<std::int64_t>{-7}, {});
  state.arrays["seen"] = array_of(std::vector<std::uint16_t>{1, 65535});
  CHECK(state.text("name") == "caf\u00e9");
  CHECK(state.values<double>("q", {2, 3}) == values);
  CHECK(state.values<std::int64_t>("n", {}) == std::vector<std::int64_t>{-7});
  CHECK(state.values<std::uint16_t>("seen", {2}) == std::vector<std::uint16_t>{1, 65535});
  check_refused([&] { state.text("q"); }, "q", "nothing");
  check_refused([&] { state.values<double>("p", {6}); }, "p", "nothing");
  check_refused([&] { state.values<double>("q", {6}); }, "q", "F64 x 2 x 3");
  check_refused([&] { state.values<std::int64_t>("q", {2, 3}); }, "q", "F64 x 2 x 3");
  check_refused([&] { array_of(values, {7}); }, "array.shape", "6 values");
}
