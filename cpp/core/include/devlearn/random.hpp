#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "devlearn/detail/cpp17.hpp"

namespace devlearn {

/// xoshiro256++ (Blackman and Vigna, 2019), seeded by SplitMix64 from a seed and the name of a
/// stream. Integer arithmetic only, so the draws are the same on every machine and compiler.
///
/// Streams of one seed are independent by name: what one draws never shifts another.
class Random {
 public:
  /// Never all zeros.
  using State = std::array<std::uint64_t, 4>;

  /// The stream of that name, from its beginning.
  Random(std::uint64_t seed, std::string_view stream) noexcept;
  /// A stream that goes on from a state.
  explicit Random(const State& state) noexcept : state_(state) {}

  /// 64 random bits.
  std::uint64_t next() noexcept {
    const std::uint64_t result = rotated(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return result;
  }

  /// A double uniform on [0, 1), of 53 random bits.
  double uniform() noexcept { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// A whole number uniform on {0, ..., count - 1}; 1 <= count < 2^32. Exactly uniform: Lemire's
  /// multiplication of the upper 32 bits by count, with rejection.
  std::uint32_t index(std::uint32_t count) noexcept {
    std::uint64_t product = (next() >> 32) * count;
    if (static_cast<std::uint32_t>(product) < count) {
      const std::uint32_t threshold = (0U - count) % count;
      while (static_cast<std::uint32_t>(product) < threshold) product = (next() >> 32) * count;
    }
    return static_cast<std::uint32_t>(product >> 32);
  }

  /// Normal with mean 0 and standard deviation 1, as far as twelve uniform numbers less six are
  /// (Irwin-Hall): never beyond 6, and by additions only, so the same on every machine.
  double normal() noexcept {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

  /// Where the stream is.
  const State& state() const noexcept { return state_; }

 private:
  static std::uint64_t rotated(std::uint64_t bits, int by) noexcept {
    return (bits << by) | (bits >> (64 - by));
  }

  State state_;
};

}  // namespace devlearn
