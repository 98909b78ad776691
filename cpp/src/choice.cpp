#include "devlearn/choice.hpp"

#include "devlearn/learner.hpp"
#include "devlearn/math.hpp"
#include "devlearn/motor_memory.hpp"

namespace devlearn {

double curiosity(double times_learned, double c1, double c2) noexcept {
  return 1.0 / (1.0 + exponential(c1 * (times_learned - c2)));
}

Choice choose_motion(const MotorMemory& memory, const LearnerConfig& config,
                     Random& random) noexcept {
  const int n = memory.effective_count();
  const int unexplored = memory.unexplored_count();
  if (n + unexplored == 0) {
    const auto motions = static_cast<std::uint32_t>(memory.motion_count());
    return {static_cast<int>(random.index(motions)), Kind::kExhausted};
  }

  const int drawn = static_cast<int>(random.index(static_cast<std::uint32_t>(n + unexplored)));
  if (drawn < unexplored) return {memory.unexplored(drawn), Kind::kExplore};

  const int curious = drawn - unexplored;
  int winner = 0;
  double highest = -1.0;
  for (int j = 0; j < n; ++j) {
    double op = config.sigma * memory.orientation(j);
    if (j == curious) {
      op += (1.0 - config.sigma) * curiosity(memory.times_learned(j), config.c1, config.c2);
    }
    if (op > highest) {
      highest = op;
      winner = j;
    }
  }
  return {memory.effective(winner), Kind::kExploit};
}

}  // namespace devlearn
