#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/q_learning.hpp"
#include "devlearn/random.hpp"
#include "devlearn/random_agent.hpp"
#include "devlearn/task.hpp"

namespace {

using namespace devlearn;

// The random walk of Sutton & Barto, example 6.2, with a place to begin that is drawn: places 1 to
// 5, ends at 0 and 6, well at 6.
class Walk final : public Task {
 public:
  int motion_count() const noexcept override { return 2; }
  SituationId situation_count() const noexcept override { return 7; }
  void begin(std::uint64_t seed) override {
    begun.push_back(seed);
    place_ = 1 + static_cast<int>(Random(seed, "walk").index(5));
  }
  Observation observation() const override {
    Observation observation;
    observation.situation = place_;
    observation.motion_count = 2;
    return observation;
  }
  Outcome step(int motion) override {
    if (breaks && --breaks_in < 0) throw std::runtime_error("it broke");
    place_ += motion == 0 ? -1 : 1;
    Outcome outcome;
    outcome.situation = place_;
    outcome.arrived = place_ == 0 || place_ == 6;
    return outcome;
  }
  bool succeeded() const noexcept override { return place_ == 6; }

  std::vector<std::uint64_t> begun;
  bool breaks = false;
  int breaks_in = 0;

 private:
  int place_ = 0;
};

// Goes right, and keeps what it is told.
class Told final : public Agent {
 public:
  void begin_round() override { calls += "["; }
  Choice choose(const Observation&) override {
    calls += "c";
    return {motion, Kind::kUnstated};
  }
  Development observe(const Outcome&) override {
    calls += "o";
    return {};
  }
  void cancel() override { calls += "x"; }
  void end_round(bool arrived) override { calls += arrived ? "]" : ")"; }

  int motion = 1;
  std::string calls;
};

EpisodesOptions these(std::int64_t count, std::uint64_t seed = 0, std::int64_t first = 0,
                      std::int64_t step_limit = 10'000) {
  return {count, seed, first, step_limit, {}};
}

std::vector<Episode> run(Task& task, Agent& agent, const EpisodesOptions& options) {
  std::vector<Episode> episodes;
  run_episodes(task, agent, options, episodes);
  return episodes;
}

bool same(const std::vector<Episode>& a, const std::vector<Episode>& b) {
  bool equal = a.size() == b.size();
  for (std::size_t i = 0; equal && i < a.size(); ++i) {
    equal = a[i].reward == b[i].reward && a[i].steps == b[i].steps && a[i].ended == b[i].ended &&
            a[i].succeeded == b[i].succeeded;
  }
  return equal;
}

TEST_CASE("an episode is a round, and is told as it ended") {
  Walk walk;
  Told right, left;
  left.motion = 0;
  const Episode well = run(walk, right, these(1))[0];
  CHECK(well.ended);
  CHECK(well.succeeded);
  CHECK(well.reward == -static_cast<double>(well.steps));
  CHECK(right.calls.front() == '[');
  CHECK(right.calls.back() == ']');
  CHECK(right.calls.size() == 2 + 2 * static_cast<std::size_t>(well.steps));
  const Episode badly = run(walk, left, these(1))[0];
  CHECK(badly.ended);
  CHECK_FALSE(badly.succeeded);
  CHECK(left.calls.back() == ')');
  CHECK(well.steps + badly.steps == 6);  // from the same place, of the same seed
}

TEST_CASE("runs in pieces equal one in one call") {
  Walk whole, pieces;
  QLearning one({}, 7), other({}, 7);
  const std::vector<Episode> all = run(whole, one, these(20, 3));
  std::vector<Episode> parts = run(pieces, other, these(8, 3));
  const std::vector<Episode> rest = run(pieces, other, these(12, 3, 8));
  parts.insert(parts.end(), rest.begin(), rest.end());
  CHECK(same(all, parts));
  CHECK(whole.begun == pieces.begun);
  CHECK(one.value(3, 1) == other.value(3, 1));
}

TEST_CASE("an episode that reaches the limit is cut off, and has not ended") {
  Walk walk;
  Told right;
  const std::vector<Episode> cut = run(walk, right, these(50, 0, 0, 1));
  int ended = 0;
  for (const Episode& episode : cut) {
    CHECK(episode.steps == 1);
    ended += episode.ended ? 1 : 0;
  }
  CHECK(ended > 0);
  CHECK(ended < 50);
}

TEST_CASE("the random walk ends well as often as is known, in as many steps") {
  Walk walk;
  RandomAgent agent(5);
  const std::vector<Episode> episodes = run(walk, agent, these(20000));
  double well = 0, steps = 0;
  for (const Episode& episode : episodes) {
    well += episode.succeeded ? 1.0 : 0.0;
    steps += static_cast<double>(episode.steps);
  }
  // From place i with probability i/6, in i (6 - i) steps: means over i = 1 ... 5. Within 5
  // standard deviations: of a share 0.0035, of steps 6.2 at the most in one episode.
  CHECK(well / 20000 == doctest::Approx(0.5).epsilon(0.036));
  CHECK(steps / 20000 == doctest::Approx(7.0).epsilon(0.032));
}

TEST_CASE("what was finished is kept where a step throws, and the agent's choice is taken back") {
  Walk walk;
  Told right;
  std::vector<Episode> episodes;
  walk.breaks = true;
  walk.breaks_in = 10;
  CHECK_THROWS_AS(run_episodes(walk, right, these(1000), episodes), std::runtime_error);
  CHECK_FALSE(episodes.empty());
  CHECK(right.calls.back() == 'x');
}

TEST_CASE("an episode that is interrupted is not counted") {
  Walk walk;
  Told right;
  int asked = 0;
  EpisodesOptions options = these(1000);
  options.interrupt = [&] { return ++asked > 10; };
  const std::vector<Episode> episodes = run(walk, right, options);
  std::int64_t steps = 0;
  for (const Episode& episode : episodes) steps += episode.steps;
  CHECK(steps <= 10);
  CHECK(episodes.size() < walk.begun.size());
  CHECK(right.calls.back() == ')');
}

TEST_CASE("options outside their range are refused, and nothing has begun") {
  Walk walk;
  Told right;
  CHECK_THROWS_AS(run(walk, right, these(-1)), InvalidValue);
  CHECK_THROWS_AS(run(walk, right, these(1, 0, -1)), InvalidValue);
  CHECK_THROWS_AS(run(walk, right, these(2, 0, INT64_MAX - 1)), InvalidValue);
  CHECK_THROWS_AS(run(walk, right, these(1, 0, 0, 0)), InvalidValue);
  CHECK(walk.begun.empty());
  CHECK(right.calls.empty());
}

}  // namespace
