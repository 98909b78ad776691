// An embedder's program: the learner in a world of its own, a ring of ten places on which it walks
// towards place 0.
#include <cstdio>
#include <cstdlib>

#include "devlearn/learner.hpp"
#include "devlearn/version.hpp"

int main() {
  devlearn::LearnerConfig config;
  config.motion_count = 2;  // one place back, one place on
  devlearn::Learner learner(config, 1);
  const auto distance = [](int place) { return place < 5 ? place : 10 - place; };

  int place = 5;
  int visits = 0;
  for (int step = 0; step < 1000; ++step) {
    const int motion = learner.choose(place).motion;
    const int next = (place + (motion == 0 ? 9 : 1)) % 10;
    learner.learn(distance(place) - distance(next));
    place = next;
    if (place == 0) ++visits;
  }
  std::printf("devlearn %s: %d visits\n", devlearn::version(), visits);
  return visits > 100 && learner.situations_experienced() <= 10 ? EXIT_SUCCESS : EXIT_FAILURE;
}
