// One run of very many steps of which only summaries are kept: how much more memory is resident at
// any of a hundred samples than at the first. What may still come are situations not met before.
//
//     endurance STEPS

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "bench.hpp"

namespace {

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  constexpr int kSamples = 100;
  const long long steps = std::atoll(arguments[1]);
  devlearn::Trial trial(devlearn::bench::paper(), {}, 1);
  devlearn::RunOptions options;
  options.rounds_only = true;
  devlearn::Record summaries;
  double first = 0.0, most = 0.0;
  for (int sample = 0; sample < kSamples; ++sample) {
    trial.run(summaries, steps / kSamples, options);
    most = std::max(most, resident_bytes());
    if (sample == 0) first = most;
  }
  std::printf("{\"steps\": %lld, \"resident_mb\": %.3f, \"growth_mb\": %.3f}\n", steps, most / 1e6,
              (most - first) / 1e6);
}
