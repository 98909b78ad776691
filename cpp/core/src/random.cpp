#include "devlearn/random.hpp"

namespace devlearn {
namespace {

// SplitMix64 (Steele, Lea and Flood, 2014).
std::uint64_t split_mix(std::uint64_t& state) noexcept {
  std::uint64_t bits = (state += 0x9e3779b97f4a7c15U);
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebU;
  return bits ^ (bits >> 31);
}

// FNV-1a.
std::uint64_t hash(std::string_view text) noexcept {
  std::uint64_t bits = 0xcbf29ce484222325U;
  for (const char letter : text) {
    bits = (bits ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  }
  return bits;
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view stream) noexcept : state_{} {
  // The seed is scrambled before the name is mixed in, so that near seeds of one stream and equal
  // seeds of two streams are equally far apart.
  std::uint64_t mixed = split_mix(seed) ^ hash(stream);
  for (std::uint64_t& word : state_) word = split_mix(mixed);
}

}  // namespace devlearn
