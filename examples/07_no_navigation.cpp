// A task that is no navigation: a pole that stands on a motor must not fall.
//
// The learner stays as it is. New are the situations (how the pole leans and how fast it falls),
// the motions (how the motor pushes) and the evaluation of states.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "devlearn/learner.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"

constexpr double kPushes[] = {-300.0, 0.0, 300.0};  // the motions [degrees/s^2]
constexpr double kTick = 0.02;                      // [s]
constexpr int kLimit = 1000;                        // ticks: 20 s
constexpr double kLeanBorders[] = {-8.0, -4.0, -1.5, 0.0, 1.5, 4.0, 8.0};       // [degrees]
constexpr double kSpeedBorders[] = {-40.0, -20.0, -8.0, 0.0, 8.0, 20.0, 40.0};  // [degrees/s]

// Half a metre long; its lean is 0 upright and positive to the left.
struct Pole {
  devlearn::Random& random;
  double lean;         // [degrees]
  double speed = 0.0;  // [degrees/s]

  explicit Pole(devlearn::Random& source) : random(source), lean(6.0 * source.uniform() - 3.0) {}

  // One tick of the motor, of gravity and of draughts.
  void push(int motion) {
    const double gravity = 19.6 * 57.3 * devlearn::direction(lean).y;
    const double draught = 200.0 * (random.uniform() - 0.5);
    speed += kTick * (gravity + kPushes[motion] + draught);
    lean += kTick * speed;
  }

  bool fallen() const { return std::abs(lean) > 30.0; }

  int situation() const {
    int lean_bin = 0, speed_bin = 0;
    for (const double border : kLeanBorders) lean_bin += lean > border;
    for (const double border : kSpeedBorders) speed_bin += speed > border;
    return 8 * lean_bin + speed_bin;
  }

  // It is good to stand upright, or to be on the way there: lean + 0.25 s x speed is 0.
  double evaluation() const { return -std::abs(lean + 0.25 * speed); }
};

// Seconds until the pole falls; 20 where it stands to the end.
double balance(Pole pole, devlearn::Learner& learner) {
  for (int tick = 0; tick < kLimit; ++tick) {
    const double before = pole.evaluation();
    const devlearn::Choice choice = learner.choose(pole.situation());
    pole.push(choice.motion);
    learner.learn(pole.evaluation() - before);
    if (pole.fallen()) return kTick * tick;
  }
  return kTick * kLimit;
}

// The same with pushes at random.
double let_fall(Pole pole, devlearn::Random& random) {
  for (int tick = 0; tick < kLimit; ++tick) {
    pole.push(static_cast<int>(random.index(3)));
    if (pole.fallen()) return kTick * tick;
  }
  return kTick * kLimit;
}

void print_sorted(const char* what, std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  std::printf("  %-18s %6.2f s (%.2f ... %.2f)\n", what, values[values.size() / 2], values.front(),
              values.back());
}

int main() {
  std::vector<double> first, last, aimless;
  devlearn::LearnerConfig config;
  config.motion_count = 3;
  for (int seed = 1; seed <= 11; ++seed) {
    devlearn::Random random(seed, "example");
    devlearn::Learner learner(config, seed);
    for (int attempt = 1; attempt <= 20; ++attempt) {
      const double seconds = balance(Pole(random), learner);
      if (attempt == 1) first.push_back(seconds);
      if (attempt == 20) last.push_back(seconds);
    }
    aimless.push_back(let_fall(Pole(random), random));
  }

  std::printf("how long the pole stands, of 20 s: median of 11 seeds (least ... most)\n");
  print_sorted("first attempt", first);
  print_sorted("20th attempt", last);
  print_sorted("pushes at random", aimless);
  return last[5] > 4 * aimless.back() ? 0 : 1;
}
