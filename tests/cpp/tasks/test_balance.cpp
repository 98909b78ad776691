#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "core/field_laws.hpp"
#include "core/refusal.hpp"
#include "devlearn/balance.hpp"
#include "devlearn/learner_agent.hpp"
#include "devlearn/random_agent.hpp"

using namespace devlearn;

namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

// The lean that looks ahead, by which the robot falls.
double lean(const Balance& task) {
  const BalanceState now = task.state();
  const BalanceConfig& config = task.config();
  return now.angle + config.sef_rate * now.rate + config.sef_wheel_rate * now.wheel_rate;
}

// Against the lean, strongly or a little: what an engineer would do.
int against(const Balance& task) {
  const double u = lean(task);
  return u > 2.0 ? 4 : u > 0.0 ? 3 : u > -2.0 ? 1 : 0;
}

std::vector<Episode> lived(Agent& agent, std::int64_t count, std::uint64_t seed) {
  Balance task;
  std::vector<Episode> episodes;
  run_episodes(task, agent, {count, seed, 0, 10'000, {}}, episodes);
  return episodes;
}

}  // namespace

TEST_CASE("every setting is described, compared and refused beyond its bounds") {
  field_laws::check_fields<BalanceConfig>();
  BalanceConfig config;
  config.rate_edges = {1.0, 1.0};
  check_refused([&] { Balance{config}; }, "BalanceConfig.rate_edges", "1 after 1");
  config = {};
  config.start_angle = 15.0;
  check_refused([&] { Balance{config}; }, "BalanceConfig.start_angle", "15");
  config = {};
  config.sample_time = 1e-9;
  check_refused([&] { Balance{config}; }, "BalanceConfig.duration", "6e+10 times sample_time");
}

TEST_CASE("a robot that pushes against its lean stands for a minute, and has succeeded") {
  Balance task;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    task.begin(seed);
    Outcome outcome;
    int steps = 0;
    double fastest = 0.0;
    while (!outcome.arrived) {
      outcome = task.step(against(task));
      ++steps;
      fastest = std::max(fastest, std::abs(task.state().wheel_rate));
    }
    CHECK(steps == 3000);
    CHECK(task.time() == doctest::Approx(60.0));
    CHECK(task.succeeded());
    CHECK_FALSE(outcome.collided);
    CHECK(outcome.event == kArrivalEvent);
    CHECK(outcome.cost == 0.0);
    CHECK(fastest < 600.0);
  }
}

TEST_CASE("left alone it falls as its growing mode says, and a fall costs, collides and fails") {
  Balance task;
  task.begin_at({1.0, 0.0, 0.0, 0.0});
  Outcome outcome;
  double sum = 0.0, before = 0.0;
  while (!outcome.arrived) {
    before = lean(task);
    outcome = task.step(2);
    sum += outcome.cost;
  }
  CHECK_FALSE(task.succeeded());
  CHECK(outcome.collided);
  CHECK(outcome.event == kTouchEvent);
  CHECK(outcome.smf <= -1.0);
  CHECK(sum == 100.0);
  CHECK(std::abs(task.state().angle) > 15.0);
  // From 1 degree, of which 0.42 * (15 / 9.2) grow at 11.1 1/s: see the eigenvalues below.
  CHECK(task.time() == doctest::Approx(std::log(15.0 / 0.64) / 11.1).epsilon(0.15));
  CHECK(before > 0.0);
}

TEST_CASE("the lean of the default SEF is the part of the state that grows by itself") {
  const TwoWheeledRobot robot;
  const double tiny = 1e-7;
  // The matrix of the linear system, by its columns: rates of angle, rate and wheel rate.
  const TwoWheeledState of_angle = robot.derivative({tiny, 0, 0, 0}, 0.0);
  const TwoWheeledState of_rate = robot.derivative({0, tiny, 0, 0}, 0.0);
  const TwoWheeledState of_wheel = robot.derivative({0, 0, 0, tiny}, 0.0);
  // Its left eigenvector (1, T_1, T_2) of the growing mode, by iteration.
  double u[3] = {1.0, 0.0, 0.0}, growth = 0.0;
  for (int i = 0; i < 2000; ++i) {
    constexpr double kShift = 40.0;  // so that the growing mode is the one of the largest size
    const TwoWheeledState* const columns[3] = {&of_angle, &of_rate, &of_wheel};
    double next[3];
    for (int j = 0; j < 3; ++j) {
      const TwoWheeledState& c = *columns[j];
      next[j] = (u[0] * c.angle + u[1] * c.rate + u[2] * c.wheel_rate) / tiny + kShift * u[j];
    }
    growth = next[0] - kShift;
    for (int j = 0; j < 3; ++j) u[j] = next[j] / next[0];
  }
  CHECK(growth == doctest::Approx(11.1).epsilon(0.01));
  CHECK(u[1] == doctest::Approx(BalanceConfig{}.sef_rate).epsilon(0.02));
  CHECK(u[2] == doctest::Approx(BalanceConfig{}.sef_wheel_rate).epsilon(0.04));
}

TEST_CASE("SEF is the lean's negative square, and SMF its growth over a step") {
  Balance task;
  CHECK(task.sef_of({15.0, 0.0, 7.0, 0.0}) == doctest::Approx(-20.0));
  CHECK(task.sef_of({0.0, 15.0 / 0.07, 0.0, 0.0}) == doctest::Approx(-20.0));
  CHECK(task.sef_of({3.0, 0.0, 0.0, -150.0}) == doctest::Approx(0.0));
  RandomAgent agent(1);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    task.begin(seed);
    Outcome outcome;
    while (!outcome.arrived) {
      const Observation seen = task.observation();
      CHECK(seen.sef == task.sef_of(task.state()));
      outcome = task.step(agent.choose(seen).motion);
      CHECK(outcome.sef == task.sef_of(task.state()));
      CHECK(outcome.estimate == (outcome.arrived ? 0.0 : seen.estimate));
      if (!outcome.arrived) {
        CHECK(outcome.smf == outcome.sef - seen.sef);
        CHECK(outcome.situation == task.observation().situation);
      }
    }
  }
}

TEST_CASE("situations are all intervals, an edge belonging to the one above it") {
  BalanceConfig config;
  config.angle_edges = {-1.0, 1.0};
  config.rate_edges = {0.0};
  config.wheel_rate_edges = {};
  const Balance task(config);
  CHECK(task.situation_count() == 6);
  std::set<SituationId> met;
  for (const double angle : {-5.0, 0.0, 5.0}) {
    for (const double rate : {-1.0, 1.0}) met.insert(task.situation_of({angle, rate, 3.0, -9.0}));
  }
  CHECK(met == std::set<SituationId>{0, 1, 2, 3, 4, 5});
  CHECK(task.situation_of({-1.0, 0.0, 0.0, 0.0}) == task.situation_of({0.9, 1.0, 0.0, 0.0}));
  CHECK(task.situation_of({1.0, -1.0, 0.0, 0.0}) == task.situation_of({5.0, -0.1, 0.0, 0.0}));
  CHECK(Balance().situation_count() == 7 * 7 * 5);
}

TEST_CASE("senses are the state's four numbers") {
  Balance task;
  task.begin_at({1.0, 2.0, 3.0, 4.0});
  task.step(4);
  const BalanceState now = task.state();
  const Observation seen = task.observation();
  REQUIRE(seen.senses.size() == 4);
  CHECK(seen.senses[0] == now.angle);
  CHECK(seen.senses[1] == now.rate);
  CHECK(seen.senses[2] == now.wheel);
  CHECK(seen.senses[3] == now.wheel_rate);
  CHECK(seen.motion_count == 5);
  const TwoWheeledState exact = TwoWheeledRobot().after(
      {1.0 / kDegrees, 2.0 / kDegrees, 3.0 / kDegrees, 4.0 / kDegrees}, 0.04, 0.02, 200);
  CHECK(std::abs(now.angle - exact.angle * kDegrees) < 1e-3);
  CHECK(std::abs(now.wheel_rate - exact.wheel_rate * kDegrees) < 0.02);
}

TEST_CASE("an episode begins at rest, at an angle that its seed draws evenly") {
  Balance task;
  double least = 0.0, most = 0.0, sum = 0.0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    task.begin(seed);
    const BalanceState now = task.state();
    CHECK(now.rate == 0.0);
    CHECK(now.wheel == 0.0);
    CHECK(now.wheel_rate == 0.0);
    least = std::min(least, now.angle);
    most = std::max(most, now.angle);
    sum += now.angle;
    task.begin(seed);
    CHECK(task.state().angle == now.angle);
  }
  CHECK(least < -1.99);
  CHECK(least >= -2.0);
  CHECK(most > 1.99);
  CHECK(std::abs(sum / 2000) < 0.1);
}

TEST_CASE("a call that is refused changes nothing") {
  Balance task;
  check_refused([&] { task.observation(); }, "observation",
                "asked for where no episode is under way");
  check_refused([&] { task.step(0); }, "step", "called where no episode is under way");
  task.begin(1);
  const double angle = task.state().angle;
  check_refused([&] { task.step(5); }, "motion", "5");
  check_refused([&] { task.step(-1); }, "motion", "-1");
  check_refused([&] { task.begin_at({15.1, 0, 0, 0}); }, "angle", "15.1");
  check_refused([&] { task.begin_at({0, std::nan(""), 0, 0}); }, "rate", "nan");
  CHECK(task.state().angle == angle);
  CHECK(task.time() == 0.0);
  while (!task.step(0).arrived) {
  }
  check_refused([&] { task.step(0); }, "step", "called where no episode is under way");
  check_refused([&] { task.observation(); }, "observation",
                "asked for where no episode is under way");
  CHECK_FALSE(task.succeeded());
}

TEST_CASE("random torques fall within a second; the same seeds give the same episodes") {
  RandomAgent first(3), second(3);
  const std::vector<Episode> episodes = lived(first, 100, 7), again = lived(second, 100, 7);
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    CHECK(episodes[i].steps == again[i].steps);
    CHECK(episodes[i].steps < 50);
    CHECK(episodes[i].ended);
    CHECK_FALSE(episodes[i].succeeded);
    CHECK(episodes[i].reward == -100.0);
  }
}

TEST_CASE("the paper's learner stands longer with what it learned") {
  LearnerAgent agent(std::make_shared<Learner>(LearnerConfig{}, 1));
  const std::vector<Episode> episodes = lived(agent, 150, 1);
  const auto mean = [&](std::size_t from) {
    double sum = 0.0;
    for (std::size_t i = from; i < from + 20; ++i) sum += static_cast<double>(episodes[i].steps);
    return sum / 20.0;
  };
  CHECK(mean(130) > 5.0 * mean(0));
}
