#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace devlearn {

/// What one situation holds, as a copy: three disjoint lists of motion indices that together are
/// always M (Eq. 3-4), and for each effective motion its orientation and count.
struct SituationMemory {
  std::vector<int> effective;       ///< M_i: found effective, in the order they entered
  std::vector<int> ineffective;     ///< M-bar_i: found ineffective or no longer good enough
  std::vector<int> unexplored;      ///< RM_i: not tried yet, ascending
  std::vector<double> orientation;  ///< o_ij of each effective motion; they sum to 1
  std::vector<std::uint32_t> times_learned;  ///< n_ij of each effective motion; stops at 2^32 - 1
};

/// One situation's motor memory where it lies: the lists and orientations, and the laws by which
/// they develop. A view of storage that someone else owns (the learner's); it allocates nothing.
///
/// The motions stand in one array, M_i first, then M-bar_i, then RM_i, so that the three lists
/// partition M by construction.
class MotorMemory {
 public:
  /// Bytes that one situation needs, a multiple of 8.
  static std::size_t bytes(int motion_count) noexcept;

  /// Views `storage`, which is aligned to 8 bytes.
  MotorMemory(void* storage, int motion_count) noexcept;

  /// Makes the storage a situation never experienced: every motion unexplored.
  void clear() noexcept;

  int motion_count() const noexcept { return motion_count_; }
  int effective_count() const noexcept { return *effective_count_; }      ///< n_i
  int ineffective_count() const noexcept { return *ineffective_count_; }  ///< n-bar_i
  int unexplored_count() const noexcept {                                 ///< n_R
    return motion_count_ - effective_count() - ineffective_count();
  }

  int effective(int j) const noexcept { return motions_[j]; }
  int ineffective(int j) const noexcept { return motions_[effective_count() + j]; }
  int unexplored(int j) const noexcept {
    return motions_[effective_count() + ineffective_count() + j];
  }
  double orientation(int j) const noexcept { return orientation_[j]; }
  std::uint32_t times_learned(int j) const noexcept { return times_learned_[j]; }

  /// Where a motion stands in its list.
  enum class List { kEffective, kIneffective, kUnexplored };
  struct Position {
    List list;
    int index;
  };
  Position find(int motion) const noexcept;

  /// Extension development, Eq. 10-13: the motion at `from` (unexplored, or ineffective when it is
  /// retried) becomes the last of M_i with orientation 1/(n+1); the others shrink by n/(n+1).
  void extend(Position from) noexcept;

  /// An explored motion proved ineffective: from RM_i to the end of M-bar_i.
  void reject(int unexplored_index) noexcept;

  /// Counts one more learning of effective motion k (n_ik).
  void count_learning(int k) noexcept;

  /// Eq. 9 for effective motion k with D = 1 - exp(-eta SMF), -1 <= D < 1. A sole motion keeps its
  /// orientation 1 (at D = -1 the formula would be 0/0).
  void orient(int k, double d) noexcept;

  /// Reduction development, Eq. 14-17: every motion whose orientation lies below 1/(3 n_i) moves
  /// to M-bar_i, the rest is renormalised and keeps its order. Returns how many moved.
  int reduce() noexcept;

  /// Effective motion k moves to M-bar_i whatever its orientation; the rest is renormalised as in
  /// Eq. 14.
  void abandon(int k) noexcept;

  SituationMemory copy() const;

  /// Takes over lists and what belongs to them: motion_count motions, M_i first, then M-bar_i; and
  /// effective_count orientations and counts. They are not checked.
  void assign(const std::uint16_t* motions, int effective_count, int ineffective_count,
              const double* orientation, const std::uint32_t* times_learned) noexcept;
  /// The reverse: appends all motions, and the effective ones' orientations and counts.
  void append_to(std::vector<std::uint16_t>& motions, std::vector<double>& orientation,
                 std::vector<std::uint32_t>& times_learned) const;

 private:
  void remove_effective(int k) noexcept;
  void renormalise() noexcept;

  double* orientation_;
  std::uint32_t* times_learned_;
  std::uint16_t* motions_;
  std::uint16_t* effective_count_;
  std::uint16_t* ineffective_count_;
  int motion_count_;
};

}  // namespace devlearn
