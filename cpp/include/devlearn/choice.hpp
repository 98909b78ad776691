#pragma once

#include <cstdint>

#include "devlearn/random.hpp"

namespace devlearn {

class MotorMemory;
struct LearnerConfig;

/// Why a motion was chosen.
enum class Kind : std::uint8_t {
  kExplore = 0,    ///< drawn from RM_i, the motions not yet tried here
  kExploit = 1,    ///< winner of orientation and curiosity among M_i, the effective motions
  kExhausted = 2,  ///< every motion was tried here and none is effective: drawn from all of M
  kUnstated = 3,   ///< chosen by an agent that gives no reason
};

/// A motion to execute: its index in M, and why.
struct Choice {
  int motion = -1;
  Kind kind = Kind::kUnstated;
};

/// Eq. 5: the curiosity 1/(1 + exp(c1 (n - c2))) about a motion learned n times; 0 where the
/// exponential overflows.
double curiosity(double times_learned, double c1, double c2) noexcept;

/// Step 3 of the method (Eq. 5, 7): chooses a motion for one situation.
///
/// One uniform draw among the n_i + n_R motions not known as ineffective settles everything. Where
/// it names an unexplored motion, that one is explored: probability n_R / (n_i + n_R), uniform
/// within RM_i. Where it names an effective one, that one's curiosity is active, and the largest
///   op = sigma O + (1 - sigma) C'
/// wins, the first in M_i among equals. With nothing left to draw from, any motion is drawn.
Choice choose_motion(const MotorMemory& memory, const LearnerConfig& config,
                     Random& random) noexcept;

}  // namespace devlearn
