#include <box2d/box2d.h>
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "body/contact.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/trial_snapshot.hpp"

// Two trials share nothing, and one robot may be asked by many. The preset `tsan` runs this under
// the thread sanitizer.
using namespace devlearn;

// Box2D's counters, which it declares nowhere.
extern B2_API std::int32_t b2_gjkCalls, b2_toiCalls;

namespace {

World narrow() {
  WorldDef def;
  def.width = def.height = 2.0;
  def.start = {0.4, 0.4, 0.0};
  def.target = {1.6, 1.6};
  def.obstacles = {Rectangle{{1.0, 1.0}, 0.5, 0.5, 30.0}, Circle{{1.5, 0.5}, 0.2}};
  return World(def);
}

// A trial that touches much, with its echoes, saved and loaded.
std::vector<std::byte> life(std::uint64_t seed) {
  Trial trial(narrow(), {}, seed);
  RunOptions options;
  options.echoes = true;
  const Record record = recorded([&](Record& r) { trial.path_learning(r, 20, 100, options); });
  SaveOptions with_record;
  with_record.record = &record;
  const std::vector<std::byte> bytes = to_bytes(trial, with_record);
  return to_bytes(load_trial(bytes.data(), bytes.size()).trial, with_record);
}

template <typename Call>
void in_threads(int count, const Call& call) {
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back([&call, i] { call(i); });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace

// First, while no robot was made yet.
TEST_CASE("trials in threads of their own go on as if each were alone") {
  std::vector<std::vector<std::byte>> together(3);
  in_threads(3, [&](int i) { together[static_cast<std::size_t>(i)] = life(1 + i % 2); });
  CHECK(together[0] == together[2]);
  CHECK(together[0] == life(1));
  CHECK(together[1] == life(2));
}

TEST_CASE("one robot answers several threads as if each were alone") {
  const World world = narrow();
  const auto ask = [](const Robot& robot) {
    std::vector<double> answers;
    Pose pose = robot.world().def().start;
    for (int i = 0; i < 300; ++i) {
      pose = robot.step(pose, i % 3).pose;
      const std::vector<double> echoes = robot.sonar(pose);
      answers.insert(answers.end(), {pose.x, pose.y, pose.heading});
      answers.insert(answers.end(), echoes.begin(), echoes.end());
    }
    return answers;
  };
  const Robot robot(world, {});
  std::vector<std::vector<double>> together(3);
  in_threads(3, [&](int i) { together[static_cast<std::size_t>(i)] = ask(robot); });
  for (const auto& answers : together) CHECK(answers == ask(Robot(world, {})));
}

TEST_CASE("no drive and no echo moves a counter that Box2D keeps for the process") {
  const std::int32_t distances = b2_gjkCalls, impacts = b2_toiCalls;
  const World world = narrow();
  const Robot robot(world, {});
  int touched = 0;
  for (double heading = 0.0; heading < 360.0; heading += 5.0) {
    touched += drive_in_box2d(Scene(world, {}, {0.12, 0.12, heading}, heading, 0.1, {}), 8).touched;
    robot.sonar({0.3, 0.3, heading});
  }
  CHECK(touched > 10);
  CHECK(b2_gjkCalls == distances);
  CHECK(b2_toiCalls == impacts);
}
