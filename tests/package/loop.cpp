// An embedder's program: the learner in a world of its own, a ring of ten places on which it walks
// towards place 0. It prints its history to the last bit.
#include <cstdio>
#include <cstdlib>

#include "devlearn/error.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/snapshot.hpp"

double instances();  // of its own, in instances.cpp

namespace {

// Errors cross from the library into the program as what they are.
bool refuses_as_documented() {
  try {
    devlearn::LearnerConfig config;
    config.eta = 2.0;
    devlearn::Learner learner(config);
    return false;
  } catch (const devlearn::InvalidValue& error) {
    if (error.quantity().find("eta") == std::string::npos) return false;
  }
  try {
    devlearn::load_learner("/nowhere/learner.safetensors");
    return false;
  } catch (const devlearn::FileError& error) {
    return error.file() == "/nowhere/learner.safetensors";
  }
}

}  // namespace

int main() {
  devlearn::LearnerConfig config = devlearn::LearnerConfig::step5();
  config.motion_count = 4;
  const int moves[] = {8, 9, 11, 12};  // two places back ... two places on, round the ring
  devlearn::Learner learner(config, 1);
  const auto distance = [](int place) { return place < 5 ? place : 10 - place; };

  int place = 5;
  int visits = 0;
  for (int step = 0; step < 1000; ++step) {
    const int motion = learner.choose(place).motion;
    const int next = (place + moves[motion]) % 10;
    learner.learn((distance(place) - distance(next)) / (1.0 + step % 97));
    std::printf("%d %d:", place, motion);
    for (const double orientation : learner.situation(place).orientation) {
      std::printf(" %a", orientation);
    }
    std::printf("\n");
    place = next;
    if (place == 0) ++visits;
  }
  return visits > 100 && instances() > 0.0 && refuses_as_documented() ? EXIT_SUCCESS : EXIT_FAILURE;
}
