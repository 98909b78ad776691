// One phase in C++, for counting instructions beside the same phase called from Python.
//
//     phase STEPS

#include <cstdio>
#include <cstdlib>

#include "bench.hpp"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  devlearn::Trial trial(devlearn::bench::paper(), {}, 1);
  devlearn::Record record;
  trial.free_learning(record, std::atoll(arguments[1]));
  std::printf("%zu\n", record.steps());
}
