#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/refusal.hpp"
#include "devlearn/environment.hpp"
#include "devlearn/error.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/trial.hpp"

using namespace devlearn;

namespace {

World paper() { return World::load(DEVLEARN_SOURCE_DIR "/python/devlearn/worlds/paper.json"); }

TrialConfig noisy() {
  TrialConfig config;
  config.noise = {2.0, 0.005, 0.05, 0.5, 0.02, 0.02, 2.0, 0.1};
  config.clearance_source = ClearanceSource::kSonar;
  config.walls_count = true;
  return config;
}

bool same(const Environment::State& a, const Environment::State& b) {
  return a.place.pose == b.place.pose && a.place.estimate == b.place.estimate &&
         a.here.situation == b.here.situation && a.true_situation == b.true_situation &&
         a.here.sef == b.here.sef && a.here.clearance == b.here.clearance &&
         a.place.noise.state() == b.place.noise.state();
}

}  // namespace

TEST_CASE("a trial is an environment and whoever chooses") {
  for (const TrialConfig& config : {TrialConfig{}, noisy()}) {
    const auto agent = std::make_shared<RandomAgent>(7);
    Trial trial(paper(), config, 3, agent);
    Environment environment(paper(), config, 3);
    for (int i = 0; i < 2000; ++i) {
      const Step step = trial.step();
      Environment::Transition made = environment.after(step.motion);
      CHECK(made.smf == step.smf);
      CHECK(made.outcome.collided == step.collided);
      CHECK(made.next.place.pose == step.pose);
      environment.enter(std::move(made.next));
    }
  }
}

TEST_CASE("what comes of a motion is a function of state and motion, and moves nothing") {
  Environment environment(paper(), noisy(), 3);
  for (int i = 0; i < 300; ++i) {
    const Environment::State before = environment.state();
    Environment::Transition made = environment.after(i % 5);
    CHECK(same(environment.state(), before));
    CHECK(same(environment.after(i % 5).next, made.next));
    environment.enter(std::move(made.next));
  }
}

TEST_CASE("a twin has a noise of its own, and is what an environment of its seed is") {
  Environment first(paper(), noisy(), 3), alone(paper(), noisy(), 4);
  Environment twin = first.twin(4);
  CHECK(&twin.robot() == &first.robot());
  for (int i = 0; i < 300; ++i) {
    first.enter(first.after(i % 5).next);
    twin.enter(twin.after(i % 5).next);
    alone.enter(alone.after(i % 5).next);
    CHECK(same(twin.state(), alone.state()));
  }
  CHECK_FALSE(first.pose() == twin.pose());
}

TEST_CASE("a place is all that decides what is sensed and what comes of the next motion") {
  Environment environment(paper(), noisy(), 3);
  for (int i = 0; i < 50; ++i) environment.enter(environment.after(i % 5).next);
  Environment other = environment.twin(99);
  other.enter(other.standing(environment.state().place));
  CHECK(same(other.state(), environment.state()));
  CHECK(same(other.after(2).next, environment.after(2).next));
}

TEST_CASE("where a robot is put it knows its pose") {
  Environment environment(paper(), noisy(), 3);
  for (int i = 0; i < 50; ++i) environment.enter(environment.after(2).next);
  CHECK_FALSE(environment.state().place.estimate == environment.pose());
  environment.enter(environment.standing(Pose{2.0, 1.5, 30.0}));
  CHECK(environment.state().place.estimate == Pose{2.0, 1.5, 30.0});
}

TEST_CASE("constant wheel speeds are the robot's, spoiled by noise as motions are") {
  const WheelSpeeds speeds{0.04, 0.1};
  Environment exact(paper());
  const Pose arc_end = exact.robot().drive_wheels(exact.pose(), speeds).pose;
  CHECK(exact.after(speeds).next.place.pose == arc_end);
  CHECK(exact.after(speeds).next.place.steps == 1);

  TrialConfig config;
  config.noise.turn = 2.0;
  config.noise.drive = 0.005;
  double turns = 0.0, squared_turns = 0.0, ways = 0.0, squared_ways = 0.0;
  constexpr int kTimes = 4000;
  for (int i = 0; i < kTimes; ++i) {
    const Environment noisy(paper(), config, static_cast<std::uint64_t>(i));
    const Pose from = noisy.pose(), to = noisy.after(speeds).next.place.pose;
    const double turn = to.heading - arc_end.heading;
    const double way = std::hypot(to.x - from.x, to.y - from.y) -
                       std::hypot(arc_end.x - from.x, arc_end.y - from.y);
    turns += turn / kTimes;
    squared_turns += turn * turn / kTimes;
    ways += way / kTimes;
    squared_ways += way * way / kTimes;
  }
  // Within four standard errors.
  CHECK(std::abs(turns) < 4.0 * 2.0 / std::sqrt(kTimes));
  CHECK(std::abs(ways) < 4.0 * 0.005 / std::sqrt(kTimes));
  CHECK(std::sqrt(squared_turns) == doctest::Approx(2.0).epsilon(0.045));
  CHECK(std::sqrt(squared_ways) == doctest::Approx(0.005).epsilon(0.045));
}

TEST_CASE("where wheels slip, a motion of M is made") {
  TrialConfig config;
  config.noise.slip = 1.0;
  std::vector<int> made(5);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Environment environment(paper(), config, seed);
    const Pose pose = environment.after(WheelSpeeds{0.1, 0.1}).next.place.pose;
    for (int motion = 0; motion < 5; ++motion) {
      made[static_cast<std::size_t>(motion)] +=
          pose == environment.robot().step(environment.pose(), motion).pose;
    }
  }
  CHECK(made[0] + made[1] + made[2] + made[3] + made[4] == 500);
  for (const int count : made) CHECK(count > 60);
}

TEST_CASE("motions outside M and places where the body does not fit are refused by name") {
  const Environment environment(paper());
  check_refused([&] { environment.after(5); }, "motion", "5");
  check_refused([&] { environment.after(-1); }, "motion", "-1");
  check_refused([&] { environment.after(WheelSpeeds{3.0, 3.0}); }, "mean of the wheel speeds", "3");
  CHECK_THROWS_AS(environment.standing(Pose{1.3, 1.4, 0.0}), InvalidValue);
}
