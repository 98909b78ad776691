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

/// Step 3 of the method (Eq. 5, 7): one uniform draw settles everything. This is how many equally
/// likely outcomes it has in a situation: the n_i + n_R motions not known as ineffective or, with
/// nothing left of these, all of M.
inline int outcome_count(const MotorMemory& memory) noexcept {
  const int left = memory.effective_count() + memory.unexplored_count();
  return left > 0 ? left : memory.motion_count();
}

/// Eq. 7 for effective motion j, its own curiosity active or not.
inline double op(const MotorMemory& memory, int j, bool curious, double sigma,
                 const Curiosity& curiosity) noexcept {
  const double value = sigma * memory.orientation(j);
  return curious ? value + (1.0 - sigma) * curiosity(memory.times_learned(j)) : value;
}

/// What each outcome, 0 <= outcome < outcome_count, means. The first n_R name an unexplored motion,
/// and that one is explored: probability n_R / (n_i + n_R), uniform within RM_i. Each other one
/// names an effective motion, whose curiosity is active, and the largest
///   op = sigma O + (1 - sigma) C'
/// wins, the first in M_i among equals. With nothing left to draw from, it is any motion, all of
/// them ineffective. So the list that the motion stands in says why it was chosen.
inline MotorMemory::Position choose_motion(const MotorMemory& memory, int outcome, double sigma,
                                           const Curiosity& curiosity) noexcept {
  const int n = memory.effective_count(), unexplored = memory.unexplored_count();
  if (outcome < unexplored) return {MotorMemory::List::kUnexplored, outcome};
  if (n == 0) return memory.find(outcome);

  const int curious = outcome - unexplored;
  int winner = 0;
  double highest = -1.0;
  for (int j = 0; j < n; ++j) {
    const double value = op(memory, j, j == curious, sigma, curiosity);
    if (value > highest) {
      highest = value;
      winner = j;
    }
  }
  return {MotorMemory::List::kEffective, winner};
}

/// The motion that stands there, and why it was chosen.
inline Choice choice_at(const MotorMemory& memory, MotorMemory::Position position) noexcept {
  switch (position.list) {
    case MotorMemory::List::kEffective:
      return {memory.effective(position.index), Kind::kExploit};
    case MotorMemory::List::kUnexplored:
      return {memory.unexplored(position.index), Kind::kExplore};
    default:
      return {memory.ineffective(position.index), Kind::kExhausted};
  }
}

}  // namespace devlearn
