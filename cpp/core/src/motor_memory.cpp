#include "devlearn/motor_memory.hpp"

#include <algorithm>

#include "arrays.hpp"

namespace devlearn {
namespace {

// Added in order: a vectorised sum would depend on the machine.
double sum_of(const Array& values) noexcept {
  double sum = 0.0;
  for (int j = 0; j < values.size(); ++j) sum += values(j);
  return sum;
}

}  // namespace

std::size_t MotorMemory::bytes(int motion_count) noexcept {
  const std::size_t used =
      kSizesBytes + static_cast<std::size_t>(motion_count) *
                        (sizeof(double) + sizeof(std::uint32_t) + sizeof(std::uint16_t));
  return (used + 7) / 8 * 8;
}

void MotorMemory::clear() noexcept {
  sizes_[0] = 0;
  sizes_[1] = 0;
  for (int motion = 0; motion < motion_count_; ++motion) {
    motions_[motion] = static_cast<std::uint16_t>(motion);
  }
}

void MotorMemory::extend(int place) noexcept {
  const int n = effective_count();
  Array o(orientation_, n + 1);
  if (list(place) == List::kIneffective) --sizes_[1];
  // Eq. 10: M_i = [M_i, m].
  move(motions_, place, n);
  // Eq. 11
  o.head(n) *= n / (n + 1.0);
  o(n) = 1.0 / (n + 1.0);
  // Eq. 12: curiosity follows from the count.
  times_learned_[n] = 1;
  // Eq. 13
  ++sizes_[0];
}

void MotorMemory::orient(int k, double d) noexcept {
  if (effective_count() == 1) return;
  Array o(orientation_, effective_count());
  // The 1 of Eq. 9 is the sum of the orientations; taking the sum itself keeps rounding errors
  // from piling up, for D < 0 multiplies them.
  const double one = sum_of(o);
  const double change = o(k) * d;
  // Eq. 9
  o(k) += change;
  o /= one + change;
}

int MotorMemory::reduce() noexcept {
  const int before = effective_count();
  const double threshold = 1.0 / (3.0 * before);
  for (int j = 0; j < effective_count();) {
    if (orientation_[j] < threshold) {
      remove_effective(j);
    } else {
      ++j;
    }
  }
  const int reduced = before - effective_count();
  if (reduced > 0) normalise();
  return reduced;
}

void MotorMemory::abandon(int k) noexcept {
  remove_effective(k);
  normalise();
}

// Eq. 15-17: motion k leaves M_i for the end of M-bar_i; the motions after it move up, each with
// its own orientation and count.
void MotorMemory::remove_effective(int k) noexcept {
  const int last = effective_count() - 1;
  move(motions_, k, tried_count() - 1);
  move(orientation_, k, last);
  move(times_learned_, k, last);
  --sizes_[0];
  ++sizes_[1];
}

// Eq. 14, whose 1 - o_ib is the sum of what remains.
void MotorMemory::normalise() noexcept {
  Array o(orientation_, effective_count());
  o /= sum_of(o);
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
  sizes_[0] = static_cast<std::uint16_t>(effective_count);
  sizes_[1] = static_cast<std::uint16_t>(ineffective_count);
}

void MotorMemory::append_to(std::vector<std::uint16_t>& motions, std::vector<double>& orientation,
                            std::vector<std::uint32_t>& times_learned) const {
  const int n = effective_count();
  motions.insert(motions.end(), motions_, motions_ + motion_count_);
  orientation.insert(orientation.end(), orientation_, orientation_ + n);
  times_learned.insert(times_learned.end(), times_learned_, times_learned_ + n);
}

}  // namespace devlearn
