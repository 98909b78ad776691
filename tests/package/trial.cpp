// A program on the simulation: the whole loop in a world built in code. It prints its history to
// the last bit.
#include "devlearn/trial.hpp"

#include <cstdio>
#include <cstdlib>

int main() {
  devlearn::WorldDef def;
  def.obstacles.push_back(devlearn::Circle{{2.5, 2.5}, 0.5});
  devlearn::Trial trial(devlearn::World(def), devlearn::TrialConfig::paper(), 1);
  devlearn::Record record;
  trial.free_learning(record, 2000);
  int collisions = 0;
  for (std::size_t step = 0; step < record.steps(); ++step) {
    std::printf("%d %a %a %a %a\n", int(record.motion[step]), record.smf[step], record.x[step + 1],
                record.y[step + 1], record.heading[step + 1]);
    collisions += int(record.collided[step]);
  }
  return record.steps() == 2000 && collisions > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
