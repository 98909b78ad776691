#include <doctest/doctest.h>

#include "devlearn/record.hpp"

using devlearn::Event;
using devlearn::Kind;
using devlearn::Pose;
using devlearn::Record;
using devlearn::Step;

namespace {

Step step_at(double x, bool arrived = false) {
  Step step;
  step.round = 3;
  step.situation = 41;
  step.motion = 2;
  step.kind = Kind::kExhausted;
  step.sef = 1.5;
  step.smf = 0.5;
  step.smf_used = -1.0;
  step.collided = true;
  step.arrived = arrived;
  step.goal_distance = 2.5;
  step.clearance = 3.5;
  step.event = Event::kAbandonment;
  step.reduced = 4;
  step.explored_count = 5;
  step.effective_count = 6;
  step.pose = {x, 7.0, 330.0};
  return step;
}

}  // namespace

TEST_CASE("A new record holds nothing") {
  const Record record;
  CHECK(record.steps() == 0);
  CHECK(record.rounds.empty());
  CHECK(record.x.empty());
  CHECK(record.sonar_count == 0);
}

TEST_CASE("Every field of a step stands in its column") {
  Record record;
  record.begin_round(3, {0.25, 0.5, 30.0});
  record.append(step_at(9.0));
  CHECK(record.steps() == 1);
  CHECK(record.round == std::vector<std::int32_t>{3});
  CHECK(record.situation == std::vector<devlearn::SituationId>{41});
  CHECK(record.motion == std::vector<std::int32_t>{2});
  CHECK(record.kind == std::vector<std::uint8_t>{2});
  CHECK(record.sef == std::vector<double>{1.5});
  CHECK(record.smf == std::vector<double>{0.5});
  CHECK(record.smf_used == std::vector<double>{-1.0});
  CHECK(record.collided == std::vector<std::uint8_t>{1});
  CHECK(record.arrived == std::vector<std::uint8_t>{0});
  CHECK(record.goal_distance == std::vector<double>{2.5});
  CHECK(record.clearance == std::vector<double>{3.5});
  CHECK(record.event == std::vector<std::uint8_t>{4});
  CHECK(record.reduced == std::vector<std::int32_t>{4});
  CHECK(record.explored_count == std::vector<std::int64_t>{5});
  CHECK(record.effective_count == std::vector<std::int64_t>{6});
  CHECK(record.x == std::vector<double>{0.25, 9.0});
  CHECK(record.y == std::vector<double>{0.5, 7.0});
  CHECK(record.heading == std::vector<double>{30.0, 330.0});
}

TEST_CASE("A round of n steps has n + 1 poses, one of no step has one") {
  Record record;
  for (int round = 0; round < 100; ++round) {
    record.begin_round(round + 1, {round + 0.5, 0.0, 0.0});
    for (int step = 0; step < round % 4; ++step) record.append(step_at(100.0 * round + step));
  }
  REQUIRE(record.rounds.size() == 100);
  CHECK(record.steps() == 150);
  std::size_t first = 0;
  for (std::size_t i = 0; i < record.rounds.size(); ++i) {
    const auto steps = static_cast<std::size_t>(record.rounds[i].steps);
    CHECK(record.rounds[i].round == static_cast<std::int32_t>(i + 1));
    CHECK(steps == i % 4);
    CHECK(record.x[first + i] == static_cast<double>(i) + 0.5);
    for (std::size_t step = 0; step < steps; ++step) {
      CHECK(record.x[first + i + 1 + step] == static_cast<double>(100 * i + step));
    }
    first += steps;
  }
  CHECK(record.x.size() == record.steps() + record.rounds.size());
}

TEST_CASE("A round has arrived where any of its steps has") {
  Record record;
  record.begin_round(1, Pose{});
  record.append(step_at(1.0));
  CHECK_FALSE(record.rounds.back().arrived);
  record.append(step_at(2.0, true));
  record.append(step_at(3.0));
  CHECK(record.rounds.back().arrived);
  record.begin_round(2, Pose{});
  record.append(step_at(4.0));
  CHECK_FALSE(record.rounds.back().arrived);
}
