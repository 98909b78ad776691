#pragma once

#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"

namespace devlearn {

/// Lives a while among some situations.
inline void live(Learner& learner, Random& world, int steps) {
  for (int i = 0; i < steps; ++i) {
    const auto situation = static_cast<SituationId>(world.index(40)) * 1000003;
    const int motion = learner.choose(situation).motion;
    learner.learn(world.uniform() * 4.0 - 2.0 + 0.1 * motion);
  }
}

inline Learner experienced(const LearnerConfig& config = {}) {
  Learner learner(config, 7);
  Random world(7, "world");
  live(learner, world, 3000);
  return learner;
}

inline LearnerConfig nine_motions() {
  LearnerConfig config = LearnerConfig::step5();
  config.motion_count = 9;
  config.sigma = 0.123456789012345678;
  return config;
}

}  // namespace devlearn
