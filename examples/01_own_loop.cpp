// The learner in a control loop of one's own.
//
// A robot on two wheels learns to find its charger, wherever it stands. The robot, its clock and
// what it senses are modelled here; the learner knows none of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "devlearn/learner.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"

// The motions: degrees turned in a tick, then kStep metres ahead.
constexpr double kTurns[] = {20.0, 0.0, -20.0};
const char* const kNames[] = {"left", "ahead", "right"};
constexpr double kStep = 0.05;
constexpr int kLimit = 300;  // ticks a round

// The charger is at the origin; x, y [m], heading [degrees].
struct Robot {
  double x, y, heading;
  // Where the charger is, as its beacon tells: how far, how far ahead, how far to the left.
  double distance, ahead, left;

  explicit Robot(devlearn::Random& random) {
    x = 4.0 * random.uniform() - 2.0;
    y = 4.0 * random.uniform() - 2.0;
    heading = 360.0 * random.uniform();
    look();
  }

  void move(int motion) {
    heading = devlearn::wrapped_heading(heading + kTurns[motion]);
    const devlearn::Direction h = devlearn::direction(heading);
    x += kStep * h.x;
    y += kStep * h.y;
    look();
  }

  void look() {
    const devlearn::Direction h = devlearn::direction(heading);
    distance = std::sqrt(x * x + y * y);
    ahead = -(x * h.x + y * h.y);
    left = -(y * h.x - x * h.y);
  }

  // In which eighth of the circle the charger lies: 0 ... 7.
  int situation() const {
    const bool wide = std::abs(left) > std::abs(ahead);
    return 4 * (ahead > 0.0) + 2 * (left > 0.0) + wide;
  }

  // It is good to be near the charger, and to face it.
  double evaluation() const { return 0.4 * ahead / distance - distance; }
};

// How many ticks the robot takes to the charger; kLimit where it does not arrive.
int learned_round(Robot robot, devlearn::Learner& learner) {
  double before = robot.evaluation();
  for (int tick = 0; tick < kLimit; ++tick) {
    if (robot.distance < 0.15) return tick;
    const devlearn::Choice choice = learner.choose(robot.situation());
    robot.move(choice.motion);
    const double after = robot.evaluation();
    learner.learn(after - before);  // > 0: things became better
    before = after;
  }
  return kLimit;
}

// The same with motions at random.
int aimless_round(Robot robot, devlearn::Random& random) {
  for (int tick = 0; tick < kLimit; ++tick) {
    if (robot.distance < 0.15) return tick;
    robot.move(static_cast<int>(random.index(3)));
  }
  return kLimit;
}

void print_summary(const char* what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::printf("  %-19s %6.1f (%.1f ... %.1f)\n", what, values[values.size() / 2], values.front(),
              values.back());
}

int main() {
  std::vector<double> early, late, aimless;
  devlearn::LearnerConfig config;
  config.motion_count = 3;
  devlearn::Learner learner(config);
  for (int seed = 1; seed <= 21; ++seed) {
    devlearn::Random random(seed, "example");
    learner = devlearn::Learner(config, seed);
    int sum = 0;
    for (int i = 0; i < 40; ++i) {
      const int ticks = learned_round(Robot(random), learner);
      if (i == 0) early.push_back(ticks);
      if (i >= 20) sum += ticks;
    }
    late.push_back(sum / 20.0);
    aimless.push_back(aimless_round(Robot(random), random));
  }

  std::printf("ticks to the charger: median of 21 seeds (least ... most)\n");
  print_summary("first round", early);
  print_summary("rounds 21 to 40", late);
  print_summary("motions at random", aimless);
  std::printf("what the last one learned: where the charger lies, and the motions that help\n");
  for (int situation = 0; situation < 8; ++situation) {
    const devlearn::SituationMemory memory = learner.situation(situation);
    std::printf("  eighth %d: ", situation);
    for (std::size_t j = 0; j < memory.effective.size(); ++j) {
      std::printf("%s%s %.2f", j == 0 ? "" : ", ", kNames[memory.effective[j]],
                  memory.orientation[j]);
    }
    std::printf("%s\n", memory.effective.empty() ? "none at present, so any may be tried" : "");
  }
  return *std::max_element(late.begin(), late.end()) < 60 ? 0 : 1;
}
