// Going on elsewhere: what 05_learn_in_simulation saved, on a robot whose wheels slip.
//
// The same motions, the same grid of situations and the same SEF as in simulation, in a program
// that needs no simulator. It saves as it goes, and a power cut costs it nothing.
//
//     06_go_on_elsewhere FILE
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <vector>

#include "devlearn/evaluation.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/snapshot.hpp"

constexpr double kTurns[] = {-60.0, -30.0, 0.0, 30.0, 60.0};
constexpr int kLimit = 5000;  // ticks a round
constexpr double kNoObstacle = std::numeric_limits<double>::infinity();
const devlearn::SituationGrid kGrid(3.0, 3.0, 12, 12, 12);
constexpr devlearn::StateEvaluation kEvaluation{};

// From (0.5, 0.5) to (2.4, 2.4) [m] in a room of 3 m x 3 m.
struct Robot {
  devlearn::Random random;
  double x = 0.5, y = 0.5, heading = 0.0;

  // Turns, then drives, both inexactly; true where it ran into a wall.
  bool move(int motion) {
    const double slip = 10.0 * random.uniform() - 5.0;
    heading = devlearn::wrapped_heading(heading + kTurns[motion] + slip);
    const devlearn::Direction h = devlearn::direction(heading);
    const double step = 0.04 + 0.01 * random.uniform();
    const double to_x = x + step * h.x, to_y = y + step * h.y;
    x = std::clamp(to_x, 0.1, 2.9);
    y = std::clamp(to_y, 0.1, 2.9);
    return x != to_x || y != to_y;
  }

  double target_distance() const {
    const double dx = 2.4 - x, dy = 2.4 - y;
    return std::sqrt(dx * dx + dy * dy);
  }
};

// Ticks from start to target; kLimit where it did not arrive.
int round_of(devlearn::Learner& learner, int seed) {
  Robot robot{devlearn::Random(seed, "slip")};
  double before = kEvaluation(robot.target_distance(), kNoObstacle);
  for (int tick = 0; tick < kLimit; ++tick) {
    if (robot.target_distance() <= 0.1) return tick;
    const int motion = learner.choose(kGrid.situation(robot.x, robot.y, robot.heading)).motion;
    const bool bumped = robot.move(motion);
    const double after = kEvaluation(robot.target_distance(), kNoObstacle);
    learner.learn(bumped ? std::min(after - before, -1.0) : after - before);
    before = after;
  }
  return kLimit;
}

int print_summary(const char* what, std::vector<int> values) {
  std::sort(values.begin(), values.end());
  const int median = values[values.size() / 2];
  std::printf("%s: %5d (%d ... %d)\n", what, median, values.front(), values.back());
  return median;
}

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: 06_go_on_elsewhere FILE\n");
    return 1;
  }

  // How much of it carries over: first rounds on the robot, with and without what simulation
  // taught.
  std::vector<int> experienced, from_nothing;
  for (int seed = 1; seed <= 11; ++seed) {
    devlearn::Learner loaded = devlearn::load_learner(argv[1]);
    experienced.push_back(round_of(loaded, seed));
    devlearn::Learner untaught({}, seed);
    from_nothing.push_back(round_of(untaught, seed));
  }
  std::printf("ticks of a first round: median of 11 seeds (least ... most)\n");
  const int with = print_summary("  with what simulation taught", experienced);
  const int without = print_summary("  from nothing               ", from_nothing);

  // A working life of 30 rounds; the power fails after the 25th, and the last snapshot is of the
  // 20th.
  devlearn::Learner learner = devlearn::load_learner(argv[1]);
  std::vector<int> ticks;
  std::vector<std::byte> snapshot;
  for (int number = 1; number <= 30; ++number) {
    ticks.push_back(round_of(learner, 100 + number));
    // Here, between two rounds; written out by whoever has time.
    if (number == 10 || number == 20) snapshot = devlearn::to_bytes(learner);
  }
  devlearn::Learner restarted = devlearn::load_learner(snapshot.data(), snapshot.size());
  bool same = true;
  for (int number = 21; number <= 30; ++number) {
    same = round_of(restarted, 100 + number) == ticks[number - 1] && same;
  }
  same = same && devlearn::to_bytes(restarted) == devlearn::to_bytes(learner);
  print_summary("30 rounds on the robot       ", ticks);
  std::printf("  then %lld motions in %zu situations\n",
              static_cast<long long>(learner.effective_count()), learner.situations_experienced());
  std::printf("restarted from the snapshot, it went the same way: %s\n", same ? "yes" : "no");
  return same && 2 * with < without ? 0 : 1;
}
