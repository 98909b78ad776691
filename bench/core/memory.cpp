// Bytes that the allocator handed out for a learner's experienced situations, of five motions each.
//
// Where exactly so many were reserved there is no spare capacity but what the index must keep
// empty. Where nothing was reserved, growth leaves spare capacity, reported apart.

#include <malloc.h>

#include <cstdio>

#include "devlearn/adaptive.hpp"
#include "devlearn/learner.hpp"

namespace {

using namespace devlearn;

double in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

double bytes_per_situation(SituationId situations, bool reserved) {
  const double before = in_use();
  Learner learner;
  if (reserved) learner.reserve(static_cast<std::size_t>(situations));
  for (SituationId i = 0; i < situations; ++i) {
    for (int motion = 0; motion < 5; ++motion) learner.update(i * 7919, motion, 1.0);
  }
  return (in_use() - before) / static_cast<double>(situations);
}

// So many situations and, between neighbours, outcomes.
double adaptive_bytes(SituationId situations, int outcomes) {
  const double before = in_use();
  AdaptiveLearner learner;
  learner.reserve(static_cast<std::size_t>(situations),
                  static_cast<std::size_t>(situations) * static_cast<std::size_t>(outcomes));
  for (SituationId i = 0; i < situations; ++i)
    learner.update(i, 0, 1.0, (i + 1) % situations, 1.0, 1.0);
  return in_use() - before;
}

}  // namespace

int main() {
  // From one doubling to the next, in eighths; the mean over them is what a size at random takes.
  constexpr int kSizes = 8;
  double least = 1e300, most = 0.0, mean = 0.0, mean_grown = 0.0;
  for (int i = 0; i < kSizes; ++i) {
    const SituationId situations = (SituationId{1} << 20) * (kSizes + i) / kSizes;
    const double reserved = bytes_per_situation(situations, true);
    least = reserved < least ? reserved : least;
    most = reserved > most ? reserved : most;
    mean += reserved / kSizes;
    mean_grown += bytes_per_situation(situations, false) / kSizes;
  }
  constexpr SituationId kAdaptive = SituationId{1} << 20;
  const double one = adaptive_bytes(kAdaptive, 1), two = adaptive_bytes(kAdaptive, 2);
  const double outcome = (two - one) / kAdaptive, situation = one / kAdaptive - outcome;
  std::printf(
      "{\"reserved_least\": %.2f, \"reserved_mean\": %.2f, \"reserved_most\": %.2f, "
      "\"grown_mean\": %.2f, \"adaptive_situation\": %.2f, \"adaptive_outcome\": %.2f}\n",
      least, mean, most, mean_grown, situation, outcome);
}
