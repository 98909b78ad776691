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

/// Eq. 7: op = sigma O + (1 - sigma) C', where C' is 0 for a motion whose curiosity is not active.
inline double op(double orientation, double curiosity, double sigma) noexcept {
  return sigma * orientation + (1.0 - sigma) * curiosity;
}

/// What each outcome, 0 <= outcome < outcome_count, means: the place of the motion to execute. The
/// first n_R name an unexplored motion, and that one is explored: probability n_R / (n_i + n_R),
/// uniform within RM_i. Each other one names an effective motion, whose curiosity is active, and
/// the largest op (Eq. 7) wins, the first in M_i among equals. With nothing left to draw from, it
/// is any motion, all of them ineffective. So the list that the place belongs to says why.
inline int choose_motion(const MotorMemory& memory, int outcome, double sigma,
                         const Curiosity& curiosity) noexcept {
  const int n = memory.effective_count(), unexplored = memory.unexplored_count();
  if (outcome < unexplored) return memory.tried_count() + outcome;
  if (n == 0) return memory.place_of(outcome);

  const int curious = outcome - unexplored;
  const double active = curiosity(memory.times_learned(curious));
  int winner = 0;
  double highest = -1.0;
  for (int j = 0; j < n; ++j) {
    const double value = op(memory.orientation(j), j == curious ? active : 0.0, sigma);
    if (value > highest) {
      highest = value;
      winner = j;
    }
  }
  return winner;
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
