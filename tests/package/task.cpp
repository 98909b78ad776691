// A program in which an agent of devlearn's learns a task, without simulation of worlds. It prints
// its history.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "devlearn/balance.hpp"
#include "devlearn/operant_conditioning.hpp"

int main() {
  devlearn::Balance task;
  devlearn::OperantConditioning agent({}, 1);
  std::vector<devlearn::Episode> episodes;
  devlearn::EpisodesOptions options;
  options.count = 100;
  devlearn::run_episodes(task, agent, options, episodes);
  long long first = 0, last = 0;
  for (int i = 0; i < 100; ++i) {
    const long long steps = episodes[static_cast<std::size_t>(i)].steps;
    std::printf("%lld\n", steps);
    (i < 20 ? first : last) += i < 20 || i >= 80 ? steps : 0;
  }
  task.begin(1);
  for (int step = 0; step < task.motion_count(); ++step) task.step(step);
  for (const double sensed : task.observation().senses) std::printf("%a\n", sensed);
  return last > first ? EXIT_SUCCESS : EXIT_FAILURE;
}
