#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "devlearn/detail/cpp17.hpp"

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

/// Memory in bytes.
struct MemoryUse {
  std::size_t used = 0;   ///< by the situations experienced, their index included
  std::size_t spare = 0;  ///< held for more of them: reserved, or left over by growth
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

  /// Views `storage`, which is aligned to 8 bytes: the sizes of two lists, N orientations, N
  /// counts, N motions.
  MotorMemory(void* storage, int motion_count) noexcept
      : sizes_(static_cast<std::uint16_t*>(storage)),
        orientation_(reinterpret_cast<double*>(static_cast<std::byte*>(storage) + kSizesBytes)),
        times_learned_(reinterpret_cast<std::uint32_t*>(orientation_ + motion_count)),
        motions_(reinterpret_cast<std::uint16_t*>(times_learned_ + motion_count)),
        motion_count_(motion_count) {}

  /// Makes the storage a situation never experienced: every motion unexplored.
  void clear() noexcept;

  int motion_count() const noexcept { return motion_count_; }                      ///< N_M
  int effective_count() const noexcept { return sizes_[0]; }                       ///< n_i
  int ineffective_count() const noexcept { return sizes_[1]; }                     ///< n-bar_i
  int tried_count() const noexcept { return sizes_[0] + sizes_[1]; }               ///< of both
  int unexplored_count() const noexcept { return motion_count_ - tried_count(); }  ///< n_R

  /// The motion at a place of the array, 0 <= place < N_M.
  int motion(int place) const noexcept { return motions_[place]; }
  /// o_ij of effective motion j, the one at place j.
  double orientation(int j) const noexcept { return orientation_[j]; }
  /// o_ij of all of them, n_i values.
  const double* orientations() const noexcept { return orientation_; }
  /// n_ij of effective motion j.
  std::uint32_t times_learned(int j) const noexcept { return times_learned_[j]; }

  /// The three lists.
  enum class List {
    kEffective,    ///< M_i
    kIneffective,  ///< M-bar_i
    kUnexplored,   ///< RM_i
  };
  /// The list that a place belongs to.
  List list(int place) const noexcept {
    if (place < effective_count()) return List::kEffective;
    return place < tried_count() ? List::kIneffective : List::kUnexplored;
  }
  /// Where a motion of M stands.
  int place_of(int motion) const noexcept {
    int place = 0;
    for (int i = 1; i < motion_count_; ++i) place = motions_[i] == motion ? i : place;
    return place;
  }

  /// Extension development, Eq. 10-13: the motion at `place` (unexplored, or ineffective when it is
  /// retried) becomes the last of M_i with orientation 1/(n+1); the others shrink by n/(n+1).
  void extend(int place) noexcept;

  /// The unexplored motion at `place` proved ineffective: to the end of M-bar_i.
  void reject(int place) noexcept {
    move(motions_, place, tried_count());
    ++sizes_[1];
  }

  /// Counts one more learning of effective motion k (n_ik).
  void count_learning(int k) noexcept {
    if (times_learned_[k] < std::numeric_limits<std::uint32_t>::max()) ++times_learned_[k];
  }

  /// Eq. 9 for effective motion k with D = 1 - exp(-eta SMF), -1 <= D < 1. A sole motion keeps its
  /// orientation 1 (at D = -1 the formula would be 0/0).
  void orient(int k, double d) noexcept;

  /// Reduction development, Eq. 14-17: every motion whose orientation lies below 1/(3 n_i) moves
  /// to M-bar_i, the rest is renormalised and keeps its order. Returns how many moved.
  int reduce() noexcept;

  /// Effective motion k moves to M-bar_i whatever its orientation; the rest is renormalised as in
  /// Eq. 14, whose 1 - o_ib is the sum of what remains.
  void abandon(int k) noexcept;

  /// All of it.
  SituationMemory copy() const;

  /// Takes over lists and what belongs to them: motion_count motions, M_i first, then M-bar_i; and
  /// effective_count orientations and counts. They are not checked.
  void assign(const std::uint16_t* motions, int effective_count, int ineffective_count,
              const double* orientation, const std::uint32_t* times_learned) noexcept;
  /// The reverse: appends all motions, and the effective ones' orientations and counts.
  void append_to(std::vector<std::uint16_t>& motions, std::vector<double>& orientation,
                 std::vector<std::uint32_t>& times_learned) const;

 private:
  static constexpr std::size_t kSizesBytes = 8;  // two of 2 bytes, and room that aligns the rest

  // What stands between moves up or down by one. Lists are short: calls of memmove would cost more.
  template <typename T>
  static void move(T* values, int from, int to) noexcept {
    T carried = values[from];
    for (int i = to; i < from; ++i) std::swap(carried, values[i]);
    for (int i = to; i > from; --i) std::swap(carried, values[i]);
    values[from] = carried;
  }

  void remove_effective(int k) noexcept;
  void normalise() noexcept;

  std::uint16_t* sizes_;
  double* orientation_;
  std::uint32_t* times_learned_;
  std::uint16_t* motions_;
  int motion_count_;
};

}  // namespace devlearn
