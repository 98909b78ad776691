#pragma once

#include <cstdint>

// One of those of 0, 1 ... that `candidate` takes.
namespace devlearn {

/// How many there are below `count`.
template <typename Candidate>
std::uint32_t count_candidates(int count, const Candidate& candidate) {
  std::uint32_t candidates = 0;
  for (int each = 0; each < count; ++each) candidates += candidate(each) ? 1 : 0;
  return candidates;
}

/// The one that has so many before it. There must be one.
template <typename Candidate>
int nth_candidate(std::uint32_t before, const Candidate& candidate) {
  int each = 0;
  while (!candidate(each) || before-- > 0) ++each;
  return each;
}

}  // namespace devlearn
