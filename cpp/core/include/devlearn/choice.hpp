#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "devlearn/motor_memory.hpp"

namespace devlearn {

/// Why a motion was chosen.
enum class Kind : std::uint8_t {
  kExplore = 0,    ///< drawn from RM_i, the motions not yet tried here
  kExploit = 1,    ///< winner of orientation and curiosity among M_i, the effective motions
  kExhausted = 2,  ///< all that are allowed were tried and none is effective: drawn from these
  kUnstated = 3,   ///< chosen by an agent that gives no reason
  kHabit = 4,      ///< as in the best round so far
  kDeviation = 5,  ///< another than the habit's, tried for what it promises
  kHeld = 6,       ///< the motion of before, for the situation has not changed
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

/// Which motions may be chosen: bools that someone else owns, one a motion of M. A view: it copies
/// nothing, and is valid as long as they are.
class AllowedMotions {
 public:
  /// Every motion.
  AllowedMotions() = default;
  /// allowed: count of them.
  AllowedMotions(const bool* allowed, std::size_t count) noexcept
      : allowed_(allowed), count_(count) {}
  ///@{
  /// Those of an array.
  template <std::size_t N>
  AllowedMotions(const bool (&allowed)[N]) noexcept : AllowedMotions(allowed, N) {}
  template <std::size_t N>
  AllowedMotions(const std::array<bool, N>& allowed) noexcept : AllowedMotions(allowed.data(), N) {}
  ///@}

  /// Whether it was made of no bools, and so allows whatever there is.
  bool every() const noexcept { return allowed_ == nullptr; }
  /// Whether this motion is allowed.
  bool operator()(int motion) const noexcept { return every() || allowed_[motion]; }
  /// The bools, or null for every motion.
  const bool* data() const noexcept { return allowed_; }
  /// How many bools there are.
  std::size_t size() const noexcept { return count_; }

  /// Throws InvalidValue unless there is a bool for each of M's motions and one of them is true.
  void validate(int motion_count) const {
    if (!every()) require(motion_count);
  }

 private:
  void require(int motion_count) const;

  const bool* allowed_ = nullptr;
  std::size_t count_ = 0;
};

/// How many of the motions at the places first ... last - 1 are allowed.
inline int count_allowed(const MotorMemory& memory, int first, int last,
                         AllowedMotions allowed) noexcept {
  if (allowed.every()) return last - first;
  int count = 0;
  for (int place = first; place < last; ++place) count += allowed(memory.motion(place)) ? 1 : 0;
  return count;
}

/// The place of the n-th allowed motion, counted from 0 and from place `first`; it must exist.
inline int nth_allowed(const MotorMemory& memory, int first, int n,
                       AllowedMotions allowed) noexcept {
  if (allowed.every()) return first + n;
  for (int place = first;; ++place) {
    if (allowed(memory.motion(place)) && n-- == 0) return place;
  }
}

/// The allowed motions that a choice is drawn from.
struct Candidates {
  int effective = 0;   ///< n_i of them, or fewer
  int unexplored = 0;  ///< n_R of them, or fewer
  int any = 0;         ///< where there are neither: all that are allowed

  /// How many values a draw has.
  int count() const noexcept { return effective + unexplored + any; }
};

/// Step 3 of the method (Eq. 5, 7): one uniform draw settles everything. It comes from
/// 0 ... count() - 1, each as likely: the n_i + n_R motions not known as ineffective or, with
/// nothing left of these, all of M; of each, those that are allowed.
inline Candidates candidates(const MotorMemory& memory, AllowedMotions allowed = {}) noexcept {
  Candidates left;
  left.effective = count_allowed(memory, 0, memory.effective_count(), allowed);
  left.unexplored = count_allowed(memory, memory.tried_count(), memory.motion_count(), allowed);
  if (left.count() == 0) left.any = count_allowed(memory, 0, memory.motion_count(), allowed);
  return left;
}

/// The place of the allowed effective motion with the largest op (Eq. 7), the first in M_i among
/// equals, where only the curiosity of effective motion `curious`, an allowed one, is active.
int winner(const MotorMemory& memory, int curious, double sigma, const Curiosity& curiosity,
           AllowedMotions allowed = {}) noexcept;

/// The place of the n-th allowed motion in M's own order.
int place_in_order(const MotorMemory& memory, int n, AllowedMotions allowed) noexcept;

/// What each draw, 0 <= draw < left.count(), means: the place of the motion to execute. The first
/// ones name an unexplored motion, and that one is explored: probability n_R / (n_i + n_R), uniform
/// within RM_i. Each other one names an effective motion, whose curiosity is active, and the winner
/// is exploited. With nothing left to draw from, it is any motion. So the list that the place
/// belongs to says why.
inline int choose_motion(const MotorMemory& memory, const Candidates& left, int draw, double sigma,
                         const Curiosity& curiosity, AllowedMotions allowed = {}) noexcept {
  if (draw < left.unexplored) return nth_allowed(memory, memory.tried_count(), draw, allowed);
  if (left.any > 0) return place_in_order(memory, draw, allowed);
  const int curious = nth_allowed(memory, 0, draw - left.unexplored, allowed);
  return winner(memory, curious, sigma, curiosity, allowed);
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
