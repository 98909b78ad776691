#pragma once

#include <array>
#include <cstdint>

#include "devlearn/motor_memory.hpp"

namespace devlearn {

/// Why a motion was chosen.
enum class Kind : std::uint8_t {
  kExplore = 0,    ///< drawn from RM_i, the motions not yet tried here
  kExploit = 1,    ///< winner of orientation and curiosity among M_i, the effective motions
  kExhausted = 2,  ///< every motion was tried here and none is effective: drawn from all of M
  kUnstated = 3,   ///< chosen by an agent that gives no reason
};

/// A motion to execute: its index in M, and why.
struct Choice {
  int motion = -1;              ///< its index in M
  Kind kind = Kind::kUnstated;  ///< why
};

/// Eq. 5: the curiosity 1/(1 + exp(c1 (n - c2))) about a motion learned n times; 0 where the
/// exponential overflows.
double curiosity(double times_learned, double c1, double c2) noexcept;

/// The same for whole counts under one c1 and c2, its first values computed once.
class Curiosity {
 public:
  /// Those of LearnerConfig.
  Curiosity(double c1, double c2) noexcept;

  /// About a motion learned so many times.
  double operator()(std::uint32_t times_learned) const noexcept {
    return times_learned < first_.size() ? first_[times_learned]
                                         : curiosity(times_learned, c1_, c2_);
  }

 private:
  double c1_, c2_;
  std::array<double, 256> first_;
};

/// Step 3 of the method (Eq. 5, 7): one uniform draw settles everything. It comes from
/// 0 ... draw_count - 1, each as likely: the n_i + n_R motions not known as ineffective or, with
/// nothing left of these, all of M.
inline int draw_count(const MotorMemory& memory) noexcept {
  const int left = memory.effective_count() + memory.unexplored_count();
  return left > 0 ? left : memory.motion_count();
}

/// The place of the effective motion with the largest op (Eq. 7), the first in M_i among equals,
/// where only the curiosity of effective motion `curious` is active.
int winner(const MotorMemory& memory, int curious, double sigma,
           const Curiosity& curiosity) noexcept;

/// What each draw, 0 <= draw < draw_count, means: the place of the motion to execute. The first n_R
/// name an unexplored motion, and that one is explored: probability n_R / (n_i + n_R), uniform
/// within RM_i. Each other one names an effective motion, whose curiosity is active, and the winner
/// is exploited. With nothing left to draw from, it is any motion, all of them ineffective. So the
/// list that the place belongs to says why.
inline int choose_motion(const MotorMemory& memory, int draw, double sigma,
                         const Curiosity& curiosity) noexcept {
  const int n = memory.effective_count(), unexplored = memory.unexplored_count();
  if (draw < unexplored) return memory.tried_count() + draw;
  if (n == 0) return memory.place_of(draw);
  return winner(memory, draw - unexplored, sigma, curiosity);
}

/// The motion at a place, and why it was chosen.
inline Choice choice_at(const MotorMemory& memory, int place) noexcept {
  const int motion = memory.motion(place);
  switch (memory.list(place)) {
    case MotorMemory::List::kEffective:
      return {motion, Kind::kExploit};
    case MotorMemory::List::kUnexplored:
      return {motion, Kind::kExplore};
    default:
      return {motion, Kind::kExhausted};
  }
}

}  // namespace devlearn
