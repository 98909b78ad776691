#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/refusal.hpp"
#include "devlearn/batch.hpp"
#include "devlearn/random.hpp"
#include "sim/world/random_movers.hpp"

using namespace devlearn;

namespace {

// Two steps straight on to the target, or past it.
WorldDef near_def() {
  WorldDef def;
  def.width = def.height = 2.0;
  def.start = {0.5, 0.5, 0.0};
  def.target = {0.6, 0.5};
  def.obstacles = {Circle{{1.2, 1.2}, 0.2}};
  return def;
}

TrialConfig near_config() {
  TrialConfig config;
  config.goal_radius = 0.01;
  return config;
}

constexpr std::int64_t kOn = 2, kLeft = 3;  // of the paper's motions: 0 and 30 degrees

BatchConfig with(Autoreset autoreset, std::int64_t step_limit = 10000) {
  BatchConfig config;
  config.autoreset = autoreset;
  config.step_limit = step_limit;
  return config;
}

std::vector<std::int64_t> all(int count, std::int64_t motion) {
  return std::vector<std::int64_t>(static_cast<std::size_t>(count), motion);
}

// Row i of a column of so many values a row.
template <typename T>
std::vector<T> row(const std::vector<T>& column, std::size_t i, std::size_t width = 1) {
  const auto first = column.begin() + static_cast<std::ptrdiff_t>(i * width);
  return std::vector<T>(first, first + static_cast<std::ptrdiff_t>(width));
}

}  // namespace

TEST_CASE("each row is an environment alone with the same motions, to the bit") {
  const World world =
      World::load(std::string(DEVLEARN_SOURCE_DIR) + "/python/devlearn/worlds/paper.json");
  TrialConfig config;
  config.robot.safety_margin = 0.05;
  BatchConfig episodes = with(Autoreset::kNextStep, 40);
  episodes.sonars = true;
  episodes.reward = Reward::kSmf;
  constexpr int kCount = 5;
  constexpr std::uint64_t kSeed = 7;
  Batch batch(world, kCount, config, episodes, kSeed);
  std::vector<Environment> alone;
  std::vector<int> steps(kCount);
  for (std::uint64_t i = 0; i < kCount; ++i) alone.emplace_back(world, config, kSeed + i);
  Random random(1, "motions");
  int touched = 0;
  for (int step = 0; step < 400; ++step) {
    std::vector<std::int64_t> motions;
    for (int i = 0; i < kCount; ++i) motions.push_back(random.index(5));
    batch.step(motions.data());
    for (std::size_t i = 0; i < kCount; ++i) {
      CAPTURE(step);
      CAPTURE(i);
      Outcome outcome;
      const bool begins = steps[i] == 40;
      if (begins) {
        alone[i].enter(alone[i].standing(world.def().start));
        steps[i] = 0;
      } else {
        const Environment::Transition made = alone[i].after(static_cast<int>(motions[i]));
        outcome = made.outcome;
        alone[i].enter(made.next);
        ++steps[i];
      }
      const Observation& here = alone[i].look();
      const Batch::Rows& rows = batch.rows();
      REQUIRE(row(rows.pose, i, 3) ==
              std::vector<double>{here.pose.x, here.pose.y, here.pose.heading});
      REQUIRE(rows.situation[i] == here.situation);
      REQUIRE(rows.clearance[i] == here.clearance);
      REQUIRE(rows.goal_distance[i] == here.goal_distance);
      REQUIRE(rows.estimate[i] == here.estimate);
      REQUIRE(row(rows.echoes, i, 5) == alone[i].echoes());
      for (int motion = 0; motion < 5; ++motion) {
        REQUIRE(rows.allowed[5 * i + static_cast<std::size_t>(motion)] == here.allowed(motion));
      }
      const Batch::Outcomes& came = batch.outcomes();
      REQUIRE(came.begun[i] == begins);
      REQUIRE(came.reward[i] == (begins ? 0.0 : outcome.smf));
      REQUIRE(came.smf[i] == (begins ? 0.0 : outcome.smf));
      REQUIRE(came.cost[i] == (begins ? 0.0 : outcome.cost));
      REQUIRE(came.collided[i] == (!begins && outcome.collided));
      REQUIRE(came.truncated[i] == (steps[i] == 40));
      touched += came.collided[i];
    }
  }
  CHECK(touched > 10);
}

TEST_CASE("each row of a world that moves is an environment alone, to the bit, at its own time") {
  Random random(12, "moving worlds");
  int near_movers = 0;
  for (int worlds = 0; worlds < 4; ++worlds) {
    const World world = random_moving_world(random, 3, 3, 3.0);
    TrialConfig config;
    config.walls_count = true;
    config.robot.safety_margin = 0.02;
    BatchConfig episodes = with(Autoreset::kNextStep, 50);
    episodes.sonars = true;
    episodes.random_starts = worlds % 2 == 0;
    constexpr std::size_t kCount = 3;
    Batch batch(world, kCount, config, episodes, 8);
    std::vector<Environment> alone;
    std::vector<int> steps(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      alone.emplace_back(world, config, 8 + i);
      const double* const pose = &batch.rows().pose[3 * i];
      alone[i].enter(alone[i].standing(Pose{pose[0], pose[1], pose[2]}));
    }
    for (int step = 0; step < 300; ++step) {
      std::vector<std::int64_t> motions;
      for (std::size_t i = 0; i < kCount; ++i) motions.push_back(random.index(5));
      batch.step(motions.data());
      for (std::size_t i = 0; i < kCount; ++i) {
        CAPTURE(step);
        CAPTURE(i);
        if (batch.outcomes().begun[i] != 0) {
          const double* const pose = &batch.rows().pose[3 * i];
          alone[i].enter(alone[i].standing(Pose{pose[0], pose[1], pose[2]}));
          steps[i] = 0;
        } else {
          const Environment::Transition made = alone[i].after(static_cast<int>(motions[i]));
          alone[i].enter(made.next);
          REQUIRE(batch.outcomes().smf[i] == made.outcome.smf);
          REQUIRE(batch.outcomes().collided[i] == made.outcome.collided);
          REQUIRE(batch.outcomes().terminated[i] == made.outcome.arrived);
          REQUIRE(batch.outcomes().truncated[i] == (++steps[i] == 50 && !made.outcome.arrived));
        }
        const Observation& here = alone[i].look();
        const Batch::Rows& rows = batch.rows();
        REQUIRE(row(rows.pose, i, 3) ==
                std::vector<double>{here.pose.x, here.pose.y, here.pose.heading});
        REQUIRE(rows.clearance[i] == here.clearance);
        REQUIRE(rows.situation[i] == here.situation);
        REQUIRE(row(rows.echoes, i, 5) == alone[i].echoes());
        for (int motion = 0; motion < 5; ++motion) {
          REQUIRE(rows.allowed[5 * i + static_cast<std::size_t>(motion)] == here.allowed(motion));
        }
        const double standing = world.standing().clearance({here.pose.x, here.pose.y}, true);
        near_movers += here.clearance < standing;
      }
    }
  }
  CHECK(near_movers > 100);
}

TEST_CASE("each row at wheel speeds is an environment alone at the same ones, to the bit") {
  TrialConfig config = near_config();
  config.noise.turn = 5.0;
  constexpr std::size_t kCount = 3;
  Batch batch(World(near_def()), kCount, config, {}, 5);
  std::vector<Environment> alone;
  for (std::size_t i = 0; i < kCount; ++i) alone.emplace_back(World(near_def()), config, 5 + i);
  Random random(2, "speeds");
  int touched = 0;
  for (int step = 0; step < 300; ++step) {
    std::vector<WheelSpeeds> speeds;
    for (std::size_t i = 0; i < kCount; ++i) {
      speeds.push_back({0.1 - 0.15 * random.uniform(), 0.1 - 0.15 * random.uniform()});
    }
    batch.drive_wheels(speeds.data());
    for (std::size_t i = 0; i < kCount; ++i) {
      const bool begins = alone[i].arrived();
      Environment::State next = alone[i].standing(near_def().start);
      if (!begins) {
        const Environment::Transition made = alone[i].after(speeds[i]);
        next = made.next;
        REQUIRE(batch.outcomes().smf[i] == made.outcome.smf);
        touched += made.outcome.collided;
      }
      REQUIRE(batch.outcomes().begun[i] == begins);
      alone[i].enter(next);
      const Pose& pose = alone[i].pose();
      REQUIRE(row(batch.rows().pose, i, 3) == std::vector<double>{pose.x, pose.y, pose.heading});
    }
  }
  CHECK(touched > 10);
}

TEST_CASE("an episode is terminated at the target, and the next step begins another") {
  Batch batch(World(near_def()), 1, near_config());
  batch.step(&kOn);
  CHECK(batch.outcomes().terminated[0] == 0);
  batch.step(&kOn);
  CHECK(batch.outcomes().terminated[0] == 1);
  CHECK(batch.outcomes().truncated[0] == 0);
  CHECK(batch.rows().pose[0] == doctest::Approx(0.6));
  batch.step(&kLeft);
  CHECK(batch.rows().pose == std::vector<double>{0.5, 0.5, 0.0});
  CHECK(batch.outcomes().begun[0] == 1);
  CHECK(batch.outcomes().terminated[0] == 0);
  CHECK(batch.outcomes().reward[0] == 0.0);
  batch.step(&kOn);
  CHECK(batch.outcomes().begun[0] == 0);
  CHECK(batch.rows().pose[0] == doctest::Approx(0.55));
}

TEST_CASE("an episode is truncated by its last step, unless that arrives") {
  Batch batch(World(near_def()), 2, near_config(), with(Autoreset::kNextStep, 2));
  const std::vector<std::int64_t> motions{kOn, kLeft};
  batch.step(motions.data());
  CHECK(batch.outcomes().truncated == std::vector<std::uint8_t>{0, 0});
  batch.step(motions.data());
  CHECK(batch.outcomes().terminated == std::vector<std::uint8_t>{1, 0});
  CHECK(batch.outcomes().truncated == std::vector<std::uint8_t>{0, 1});
}

TEST_CASE("where the same step begins the next episode, the final row is where the last ended") {
  Batch batch(World(near_def()), 2, near_config(), with(Autoreset::kSameStep));
  Batch later(World(near_def()), 2, near_config(), with(Autoreset::kNextStep));
  const std::vector<std::int64_t> motions{kOn, kLeft};
  for (int step = 0; step < 2; ++step) {
    batch.step(motions.data());
    later.step(motions.data());
  }
  CHECK(batch.outcomes().terminated == std::vector<std::uint8_t>{1, 0});
  CHECK(batch.outcomes().reward == later.outcomes().reward);
  CHECK(batch.outcomes().begun == std::vector<std::uint8_t>{0, 0});
  CHECK(row(batch.rows().pose, 0, 3) == std::vector<double>{0.5, 0.5, 0.0});
  CHECK(row(batch.rows().pose, 1, 3) == row(later.rows().pose, 1, 3));
  CHECK(row(batch.final_rows().pose, 0, 3) == row(later.rows().pose, 0, 3));
  CHECK(batch.final_rows().estimate[0] == 0.0);
}

TEST_CASE("without autoreset what has ended is refused until it is reset, and nothing is stepped") {
  Batch batch(World(near_def()), 2, near_config(), with(Autoreset::kDisabled));
  const std::vector<std::int64_t> motions{kOn, kLeft};
  batch.step(motions.data());
  batch.step(motions.data());
  const std::vector<double> before = batch.rows().pose;
  check_refused([&] { batch.step(motions.data()); }, "episode[0]", "one that has ended");
  CHECK(batch.rows().pose == before);
  const bool first[] = {true, false};
  Batch::Reset asked;
  asked.which = first;
  batch.reset(asked);
  CHECK(row(batch.rows().pose, 0, 3) == std::vector<double>{0.5, 0.5, 0.0});
  CHECK(row(batch.rows().pose, 1, 3) == row(before, 1, 3));
  batch.step(motions.data());
}

TEST_CASE("the shaped rewards of an episode add up to its costs and the estimate at its start") {
  Batch shaped(World(near_def()), 1, near_config());
  BatchConfig episodes;
  episodes.reward = Reward::kCost;
  Batch plain(World(near_def()), 1, near_config(), episodes);
  const double at_start = shaped.rows().estimate[0];
  CHECK(at_start == doctest::Approx(2.0));
  double sum_shaped = 0.0, sum_plain = 0.0;
  // Round in a circle and on to the target.
  std::vector<std::int64_t> motions = all(12, kLeft);
  motions.insert(motions.end(), {kOn, kOn});
  for (const std::int64_t motion : motions) {
    shaped.step(&motion);
    plain.step(&motion);
    sum_shaped += shaped.outcomes().reward[0];
    sum_plain += plain.outcomes().reward[0];
  }
  CHECK(plain.outcomes().terminated[0] == 1);
  CHECK(sum_plain == -14.0);
  CHECK(sum_shaped == doctest::Approx(sum_plain + at_start));
}

TEST_CASE("a sparse reward is 1 at the target and 0 elsewhere") {
  BatchConfig episodes;
  episodes.reward = Reward::kSparse;
  Batch batch(World(near_def()), 1, near_config(), episodes);
  batch.step(&kOn);
  CHECK(batch.outcomes().reward[0] == 0.0);
  batch.step(&kOn);
  CHECK(batch.outcomes().reward[0] == 1.0);
}

TEST_CASE("a reset puts robots where they are asked to be, or nothing is reset") {
  Batch batch(World(near_def()), 2);
  batch.step(all(2, kOn).data());
  const std::vector<double> before = batch.rows().pose;
  std::vector<Pose> poses{{0.3, 0.3, 90.0}, {1.2, 1.2, 0.0}};
  Batch::Reset asked;
  asked.poses = poses.data();
  CHECK_THROWS_AS(batch.reset(asked), InvalidValue);  // in the obstacle
  CHECK(batch.rows().pose == before);
  poses[1] = {0.3, 1.5, 45.0};
  batch.reset(asked);
  CHECK(batch.rows().pose == std::vector<double>{0.3, 0.3, 90.0, 0.3, 1.5, 45.0});
}

TEST_CASE("where a mover is no robot is put, and nothing is reset") {
  WorldDef def = near_def();
  MoverPath path;
  path.points = {{1.7, 0.3}, {1.7, 1.7}};
  path.speed = 0.1;
  def.movers = {Mover{Circle{{}, 0.15}, path}};
  Batch batch(World(def), 2, near_config());
  for (int step = 0; step < 20; ++step) batch.step(all(2, kLeft).data());  // 10 s
  const std::vector<double> before = batch.rows().pose;
  const std::vector<Pose> poses{{0.3, 0.3, 90.0}, {1.7, 1.3, 0.0}};
  const std::vector<std::uint64_t> seeds{1, 2};
  Batch::Reset asked;
  asked.poses = poses.data();
  CHECK_THROWS_AS(batch.reset(asked), InvalidValue);
  CHECK(batch.rows().pose == before);
  asked.seeds = seeds.data();  // anew: at 0 s
  batch.reset(asked);
  CHECK(row(batch.rows().pose, 1, 3) == std::vector<double>{1.7, 1.3, 0.0});
}

TEST_CASE("a start is drawn by the environment's seed, and episodes go on drawing") {
  BatchConfig episodes = with(Autoreset::kNextStep, 1);
  episodes.random_starts = true;
  Batch batch(World(near_def()), 2, near_config(), episodes, 5);
  const StartPlaces places(batch.environment(0).robot(), 0.01);
  std::vector<Random> streams{Random(5, "starts"), Random(6, "starts")};
  for (int episode = 0; episode < 50; ++episode) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Pose start = places.draw(streams[i]);
      REQUIRE(row(batch.rows().pose, i, 3) == std::vector<double>{start.x, start.y, start.heading});
      REQUIRE(may_reach_target(batch.environment(0).robot(), start, 0.01));
    }
    batch.step(all(2, kOn).data());
    batch.step(all(2, kOn).data());
  }
  batch.reset(5);
  Random again(5, "starts");
  CHECK(batch.rows().pose[0] == places.draw(again).x);
}

TEST_CASE("what a batch cannot be made of is refused") {
  const World world(near_def());
  check_refused([&] { Batch(world, 0); }, "Batch.count", "0");
  check_refused([&] { Batch(world, (1 << 20) + 1); }, "Batch.count", "1048577");
  check_refused([&] { Batch(world, 1, {}, with(Autoreset::kNextStep, 0)); },
                "BatchConfig.step_limit", "0");
  TrialConfig deaf;
  deaf.robot.sonar_count = 0;
  BatchConfig episodes;
  episodes.sonars = true;
  check_refused([&] { Batch(world, 1, deaf, episodes); }, "BatchConfig.sonars",
                "true for a robot that has none");
  Batch batch(world, 2);
  const std::vector<double> before = batch.rows().pose;
  const std::vector<std::int64_t> motions{2, 5};
  check_refused([&] { batch.step(motions.data()); }, "motion[1]", "5");
  const std::vector<WheelSpeeds> speeds{{0.1, -0.1}, {0.1, 0.11}};
  check_refused([&] { batch.drive_wheels(speeds.data()); }, "wheel_speeds.right[1]", "0.11");
  CHECK(batch.rows().pose == before);
}
