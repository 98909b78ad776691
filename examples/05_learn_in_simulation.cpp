// Learning in simulation, for a robot that has yet to be built.
//
// The whole loop of the paper, in devlearn's simulator; at the end what was learned goes into a
// file. 06_go_on_elsewhere takes it from there, in C++ or Python, whichever wrote it.
//
//     05_learn_in_simulation FILE
#include <algorithm>
#include <cstdio>
#include <vector>

#include "devlearn/snapshot.hpp"
#include "devlearn/trial.hpp"

std::vector<int> steps_of_rounds(devlearn::Trial& trial, int rounds) {
  devlearn::Record record;
  trial.path_learning(record, rounds, 5000);
  std::vector<int> steps;
  for (const devlearn::Round& round : record.rounds) {
    steps.push_back(static_cast<int>(round.steps));
  }
  return steps;
}

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: 05_learn_in_simulation FILE\n");
    return 1;
  }
  devlearn::WorldDef def;
  def.width = def.height = 3.0;
  def.start = {0.5, 0.5, 0.0};
  def.target = {2.4, 2.4};
  const devlearn::World world(def);

  int learned = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    devlearn::Trial trial(world, devlearn::TrialConfig::paper(), seed);
    const int first = steps_of_rounds(trial, 1)[0];
    devlearn::Record free;
    trial.free_learning(free, 5000);
    std::vector<int> rounds = steps_of_rounds(trial, 60);
    std::sort(rounds.begin() + 40, rounds.end());
    const int late = rounds[50];
    std::printf("seed %d: first round %d steps, rounds 41 to 60 a median of %d steps\n", seed,
                first, late);
    learned += late < first;
    if (seed == 1) {
      const devlearn::Learner& memory = *trial.learner();
      devlearn::save(memory, argv[1]);
      std::printf("  saved: %zu situations, %lld motions\n", memory.situations_experienced(),
                  static_cast<long long>(memory.effective_count()));
    }
  }
  return learned >= 4 ? 0 : 1;
}
