#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "corridor.hpp"
#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"
#include "experienced.hpp"
#include "kept_snapshots.hpp"

// Snapshots by path, which need POSIX.
using namespace devlearn;

TEST_CASE("a file holds the snapshot that memory holds") {
  const Learner learner = experienced();
  const std::vector<std::byte> bytes = to_bytes(learner);
  const std::string path = std::string(DEVLEARN_BINARY_DIR) + "/learner.safetensors";
  save(learner, path);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream read;
  read << file.rdbuf();
  CHECK(read.str() == std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  CHECK(to_bytes(load_learner(path)) == bytes);
  std::remove(path.c_str());
}

TEST_CASE("learners that earlier versions saved have the future that they had then") {
  const auto future = [](Learner learner) {
    Random world(99, "world");
    std::string text;
    for (int i = 0; i < 300; ++i) {
      const auto situation = static_cast<SituationId>(world.index(40)) * 1000003;
      const Choice choice = learner.choose(situation);
      const Development development = learner.learn(world.uniform() * 4.0 - 2.0);
      for (const long long number :
           {static_cast<long long>(situation), static_cast<long long>(choice.motion),
            static_cast<long long>(choice.kind), static_cast<long long>(development.event),
            static_cast<long long>(learner.explored_count()),
            static_cast<long long>(learner.effective_count())}) {
        text += std::to_string(number) + " ";
      }
      text.back() = '\n';
    }
    return text;
  };
  check_kept_snapshots(
      "learner", [](const std::string& path) { save(experienced(nine_motions()), path); },
      [&](const std::string& path) { return future(load_learner(path)); });
}

namespace {

void go_on(AdaptiveLearner& learner, Corridor& at) {
  const Choice choice = learner.choose(at.situation(), at.estimate());
  const Corridor::Came came = at.step(choice.motion);
  learner.learn(came.cost, at.situation(), at.arrived() ? 0.0 : at.estimate(), came.touched);
}

// One in the middle of a decision, in a curious round: beside the habit, on the look for what has
// opened.
AdaptiveLearner curious_learner() {
  AdaptiveConfig config = four_motions();
  config.curious_every = 4;
  config.stale_after = 10;
  AdaptiveLearner learner(config, 7);
  for (;;) {
    Corridor at;
    at.door = false;
    learner.begin_round();
    for (int step = 0; !at.arrived(); ++step) {
      go_on(learner, at);
      if (learner.state().round.curious && at.place == 2) return learner;
    }
    learner.end_round(true);
  }
}

std::string line_of(std::initializer_list<double> numbers) {
  std::string line;
  for (const double number : numbers) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g ", number);
    line += text;
  }
  line.back() = '\n';
  return line;
}

// What it remembers, and then 12 rounds more, the first one from where it was.
std::string past_and_future(AdaptiveLearner learner) {
  std::string text;
  for (const SituationId id : learner.situations()) {
    const AdaptiveMemory memory = learner.situation(id);
    text += line_of({static_cast<double>(id), memory.first_estimate, memory.expected_loss});
    for (int m = 0; m < 4; ++m) text += line_of({memory.losses[m], double(memory.times[m])});
  }
  text += line_of({learner.habit_cost().value_or(-1.0), learner.optimism()});
  Corridor at;
  at.place = 2;
  for (int round = 0; round < 12; ++round) {
    while (!at.arrived()) {
      const Choice choice = learner.choose(at.situation(), at.estimate());
      const Corridor::Came came = at.step(choice.motion);
      const Development d = learner.learn(came.cost, at.situation(),
                                          at.arrived() ? 0.0 : at.estimate(), came.touched);
      text += line_of({double(choice.motion), double(choice.kind), double(d.event),
                       double(d.explored_count), double(d.effective_count), *d.value});
    }
    learner.end_round(true);
    at.place = 0;
    learner.begin_round();
  }
  return text;
}

}  // namespace

TEST_CASE("adaptive learners that earlier versions saved have the past and future of then") {
  const AdaptiveState state = curious_learner().state();
  CHECK(state.round.by_habit);
  CHECK(state.decision.steps > 0);
  check_kept_snapshots(
      "adaptive", [](const std::string& path) { save(curious_learner(), path); },
      [](const std::string& path) { return past_and_future(load_adaptive_learner(path)); });
}

TEST_CASE("a file that a kill left on the side is written anew, and gone after the next save") {
  const std::string path = std::string(DEVLEARN_BINARY_DIR) + "/killed.safetensors";
  const std::string side = path + ".devlearn-tmp";
  std::ofstream(side) << std::string(1000000, 'x');
  const Learner learner = experienced();
  save(learner, path);
  CHECK_FALSE(std::ifstream(side).good());
  CHECK(to_bytes(load_learner(path)) == to_bytes(learner));
  std::remove(path.c_str());
}

TEST_CASE("several savers to one path at once leave one whole file and nothing on the side") {
  const std::string path = std::string(DEVLEARN_BINARY_DIR) + "/shared.safetensors";
  std::vector<std::thread> savers;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    savers.emplace_back([&path, seed] {
      Learner learner(LearnerConfig{}, seed);
      Random world(seed, "world");
      for (int i = 0; i < 25; ++i) {
        live(learner, world, 10);
        save(learner, path);
        if (load_learner(path).seed() > 3) std::abort();  // throws for a file that is not whole
      }
    });
  }
  for (std::thread& saver : savers) saver.join();
  CHECK(load_learner(path).situations_experienced() > 0);
  CHECK_FALSE(std::ifstream(path + ".devlearn-tmp").good());
  std::remove(path.c_str());
}

TEST_CASE("a snapshot that cannot be written leaves the previous one whole") {
  const std::string folder = std::string(DEVLEARN_BINARY_DIR) + "/no such folder";
  CHECK_THROWS_AS(save(experienced(), folder + "/learner"), FileError);
  CHECK_THROWS_AS(save(experienced(), "/dev/full"), FileError);
  CHECK_THROWS_AS(load_learner(folder), FileError);
  CHECK_THROWS_AS(load_learner(std::string(DEVLEARN_BINARY_DIR)), FileError);
  CHECK_THROWS_AS(load_learner("/dev/zero"), FileError);
}
