#include "devlearn/motor_memory.hpp"

#include <algorithm>

namespace devlearn {

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
