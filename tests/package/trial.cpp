// A program on the simulation: the whole loop in a world built in code.
#include "devlearn/trial.hpp"

#include <cstdio>
#include <cstdlib>

int main() {
  devlearn::WorldDef def;
  def.obstacles.push_back(devlearn::Circle{{2.5, 2.5}, 0.5});
  devlearn::Trial trial(devlearn::World(def), devlearn::TrialConfig::paper(), 1);
  const devlearn::Record record = trial.free_learning(200);
  std::printf("%zu steps, at (%.3f, %.3f)\n", record.steps(), trial.pose().x, trial.pose().y);
  return record.steps() == 200 && record.x.size() == 201 ? EXIT_SUCCESS : EXIT_FAILURE;
}
