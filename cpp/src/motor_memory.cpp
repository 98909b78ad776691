#include "devlearn/motor_memory.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>

namespace devlearn {
namespace {

// The orientations O_i of the first n motions.
Eigen::Map<Eigen::ArrayXd> vector(double* orientation, int n) {
  return Eigen::Map<Eigen::ArrayXd>(orientation, n);
}

}  // namespace

// One situation's storage: N orientations, N counts, N motions, then the sizes of two lists.
std::size_t MotorMemory::bytes(int motion_count) noexcept {
  const auto motions = static_cast<std::size_t>(motion_count);
  const std::size_t used =
      motions * (sizeof(double) + sizeof(std::uint32_t) + sizeof(std::uint16_t)) +
      2 * sizeof(std::uint16_t);
  return (used + 7) / 8 * 8;
}

MotorMemory::MotorMemory(void* storage, int motion_count) noexcept
    : orientation_(static_cast<double*>(storage)),
      times_learned_(reinterpret_cast<std::uint32_t*>(orientation_ + motion_count)),
      motions_(reinterpret_cast<std::uint16_t*>(times_learned_ + motion_count)),
      effective_count_(motions_ + motion_count),
      ineffective_count_(effective_count_ + 1),
      motion_count_(motion_count) {}

void MotorMemory::clear() noexcept {
  *effective_count_ = 0;
  *ineffective_count_ = 0;
  for (int motion = 0; motion < motion_count_; ++motion) {
    motions_[motion] = static_cast<std::uint16_t>(motion);
  }
}

MotorMemory::Position MotorMemory::find(int motion) const noexcept {
  int place = 0;
  while (motions_[place] != motion) ++place;
  if (place < effective_count()) return {List::kEffective, place};
  place -= effective_count();
  if (place < ineffective_count()) return {List::kIneffective, place};
  return {List::kUnexplored, place - ineffective_count()};
}

void MotorMemory::extend(Position from) noexcept {
  const int n = effective_count();
  int place = n + from.index;
  if (from.list == List::kUnexplored) {
    place += ineffective_count();
  } else {
    --*ineffective_count_;
  }
  // Eq. 10: M_i = [M_i, m]; what stood between moves up by one.
  std::rotate(motions_ + n, motions_ + place, motions_ + place + 1);
  // Eq. 11
  vector(orientation_, n) *= static_cast<double>(n) / (n + 1);
  orientation_[n] = 1.0 / (n + 1);
  // Eq. 12: curiosity follows from the count.
  times_learned_[n] = 1;
  // Eq. 13
  ++*effective_count_;
}

void MotorMemory::reject(int unexplored_index) noexcept {
  std::uint16_t* const first = motions_ + effective_count() + ineffective_count();
  std::rotate(first, first + unexplored_index, first + unexplored_index + 1);
  ++*ineffective_count_;
}

void MotorMemory::count_learning(int k) noexcept {
  if (times_learned_[k] < std::numeric_limits<std::uint32_t>::max()) ++times_learned_[k];
}

void MotorMemory::orient(int k, double d) noexcept {
  const int n = effective_count();
  if (n == 1) return;
  // Eq. 9. Its 1 is the sum of the orientations; taking the sum itself keeps rounding errors from
  // piling up, for D < 0 multiplies them. Added in order, as in renormalise().
  double sum = 0.0;
  for (int j = 0; j < n; ++j) sum += orientation_[j];
  const double chosen = orientation_[k];
  const double change = chosen * d;
  vector(orientation_, n) /= sum + change;
  orientation_[k] = (chosen + change) / (sum + change);
}

int MotorMemory::reduce() noexcept {
  const int n = effective_count();
  const double threshold = 1.0 / (3.0 * n);
  int reduced = 0;
  for (int j = 0; j < effective_count();) {
    if (orientation_[j] < threshold) {
      remove_effective(j);
      ++reduced;
    } else {
      ++j;
    }
  }
  if (reduced > 0) renormalise();
  return reduced;
}

void MotorMemory::abandon(int k) noexcept {
  remove_effective(k);
  renormalise();
}

// Eq. 15-17: motion k leaves M_i for the end of M-bar_i; the motions after it move up, each with
// its own orientation and count.
void MotorMemory::remove_effective(int k) noexcept {
  const int n = effective_count();
  std::rotate(motions_ + k, motions_ + k + 1, motions_ + n + ineffective_count());
  std::copy(orientation_ + k + 1, orientation_ + n, orientation_ + k);
  std::copy(times_learned_ + k + 1, times_learned_ + n, times_learned_ + k);
  --*effective_count_;
  ++*ineffective_count_;
}

// Eq. 14. The sum of what remains is the 1 - o_ib of the equation; dividing by the sum itself keeps
// rounding errors from piling up. Added in order: a vectorised sum would depend on the machine.
void MotorMemory::renormalise() noexcept {
  double sum = 0.0;
  for (int j = 0; j < effective_count(); ++j) sum += orientation_[j];
  vector(orientation_, effective_count()) /= sum;
}

SituationMemory MotorMemory::copy() const {
  const int n = effective_count(), tried = n + ineffective_count();
  return {{motions_, motions_ + n},
          {motions_ + n, motions_ + tried},
          {motions_ + tried, motions_ + motion_count_},
          {orientation_, orientation_ + n},
          {times_learned_, times_learned_ + n}};
}

void MotorMemory::assign(const std::uint16_t* motions, int effective_count, int ineffective_count,
                         const double* orientation, const std::uint32_t* times_learned) noexcept {
  std::copy(motions, motions + motion_count_, motions_);
  std::copy(orientation, orientation + effective_count, orientation_);
  std::copy(times_learned, times_learned + effective_count, times_learned_);
  *effective_count_ = static_cast<std::uint16_t>(effective_count);
  *ineffective_count_ = static_cast<std::uint16_t>(ineffective_count);
}

void MotorMemory::append_to(std::vector<std::uint16_t>& motions, std::vector<double>& orientation,
                            std::vector<std::uint32_t>& times_learned) const {
  const int n = effective_count();
  motions.insert(motions.end(), motions_, motions_ + motion_count_);
  orientation.insert(orientation.end(), orientation_, orientation_ + n);
  times_learned.insert(times_learned.end(), times_learned_, times_learned_ + n);
}

}  // namespace devlearn
