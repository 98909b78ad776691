// A real sonar ring: noise, echoes that fail to come, and a driver that falls silent.
//
// A robot in a round room with pillars drives to a beacon. How close it is to anything, it knows
// from its sonars alone: the least echo plus the robot's radius.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

#include "devlearn/error.hpp"
#include "devlearn/evaluation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/math.hpp"
#include "devlearn/random.hpp"

constexpr double kRadius = 0.1, kStep = 0.05;  // of the robot [m]
// The motions: degrees turned, then kStep ahead.
constexpr double kTurns[] = {-60.0, -30.0, 0.0, 30.0, 60.0};
constexpr int kBeams = 8;                        // of the ring
constexpr double kNearest = 0.02, kRange = 1.5;  // echoes count in [kNearest, kRange] m
struct Circle {
  double x, y, radius;  // [m]
};
constexpr Circle kRoom{2.0, 2.0, 1.9};
constexpr Circle kPillars[] = {{1.3, 1.2, 0.25}, {2.6, 1.4, 0.2}, {1.6, 2.7, 0.3}};
constexpr double kBeaconX = 3.1, kBeaconY = 2.9;
constexpr int kTicks = 3000, kSeeds = 5;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr devlearn::StateEvaluation kSef{};

// Distance along a ray to a circle: to its near side, from inside to its far side.
double ray(double x, double y, devlearn::Direction h, const Circle& circle) {
  const double dx = circle.x - x, dy = circle.y - y;
  const double along = dx * h.x + dy * h.y;
  const double gap = dx * dx + dy * dy - circle.radius * circle.radius;
  const double root = along * along - gap;
  if (root < 0.0) return kInfinity;
  const double distance = gap > 0.0 ? along - std::sqrt(root) : along + std::sqrt(root);
  return distance > 0.0 ? distance : kInfinity;
}

struct Robot {
  using Echoes = std::array<double, 3>;
  struct Bearing {
    double distance, ahead, left;
  };

  devlearn::Random& random;
  std::array<double, kBeams> readings;
  double x = 0.0, y = 0.0, heading = 0.0;

  explicit Robot(devlearn::Random& source) : random(source) {
    readings.fill(kRange);
    place_anywhere();
  }

  void place_anywhere() {
    heading = 360.0 * random.uniform();
    x = y = 0.0;
    while (!free(x, y)) {
      x = 4.0 * random.uniform();
      y = 4.0 * random.uniform();
    }
  }

  static bool free(double x, double y) {
    const auto squared = [&](const Circle& circle) {
      return (x - circle.x) * (x - circle.x) + (y - circle.y) * (y - circle.y);
    };
    if (squared(kRoom) >= (kRoom.radius - kRadius) * (kRoom.radius - kRadius)) return false;
    return std::all_of(std::begin(kPillars), std::end(kPillars), [&](const Circle& pillar) {
      return squared(pillar) > (pillar.radius + kRadius) * (pillar.radius + kRadius);
    });
  }

  // Turns, then drives ahead; true where it bumped into something and stayed.
  bool move(int motion) {
    heading = devlearn::wrapped_heading(heading + kTurns[motion]);
    const devlearn::Direction h = devlearn::direction(heading);
    const double next_x = x + kStep * h.x, next_y = y + kStep * h.y;
    if (!free(next_x, next_y)) return true;
    x = next_x;
    y = next_y;
    return false;
  }

  // What the ring's driver delivers: three echoes of each beam [m from the rim].
  std::array<Echoes, kBeams> driver() {
    std::array<Echoes, kBeams> ring;
    if (random.index(50) == 0) {
      ring.fill({kNan, kNan, kNan});  // the bus timed out
    } else {
      for (int beam = 0; beam < kBeams; ++beam) ring[beam] = pings(heading + 45.0 * beam);
    }
    return ring;
  }

  Echoes pings(double beam_heading) {
    const devlearn::Direction h = devlearn::direction(beam_heading);
    double distance = ray(x, y, h, kRoom);
    for (const Circle& pillar : kPillars) distance = std::min(distance, ray(x, y, h, pillar));
    Echoes echoes;
    for (double& echo : echoes) {
      const double luck = random.uniform(), noise = 0.02 * (random.uniform() - 0.5);
      const bool lost = luck<0.05, foreign = luck> 0.98;  // or another sonar's click
      echo = lost ? kNan : foreign ? 0.0 : distance - kRadius + noise;
    }
    return echoes;
  }

  // The door: keeps what can be believed; false where the ring said nothing at all.
  bool listen() {
    bool heard = false;
    std::array<double, kBeams> next;
    const auto ring = driver();
    for (int beam = 0; beam < kBeams; ++beam) {
      std::vector<double> believable;
      for (const double echo : ring[beam]) {
        heard = heard || !std::isnan(echo);
        if (kNearest <= echo && echo <= kRange) believable.push_back(echo);  // never NaN
      }
      std::sort(believable.begin(), believable.end());
      next[beam] = believable.empty() ? kRange : believable[believable.size() / 2];
    }
    if (heard) readings = next;
    return heard;
  }

  // How far the beacon is, how far ahead and how far to the left.
  Bearing beacon() const {
    const devlearn::Direction h = devlearn::direction(heading);
    const double dx = kBeaconX - x, dy = kBeaconY - y;
    return {std::sqrt(dx * dx + dy * dy), dx * h.x + dy * h.y, dy * h.x - dx * h.y};
  }

  // In which eighth of the circle the beacon lies, and which front beams hear something.
  int situation() const {
    const Bearing b = beacon();
    const int eighth =
        4 * (b.ahead > 0.0) + 2 * (b.left > 0.0) + (std::abs(b.left) > std::abs(b.ahead));
    const bool right = readings[7] < 0.2, front = readings[0] < 0.2, left = readings[1] < 0.2;
    return 8 * eighth + 4 * right + 2 * front + left;
  }

  // Eq. 6, with the clearance that a real robot has: least echo + radius.
  double evaluation() const {
    return kSef(beacon().distance, *std::min_element(readings.begin(), readings.end()) + kRadius);
  }
};

struct Result {
  int bumps = 0, found = 0;  // in the last 1000 of kTicks
};

Result run(int seed, bool learns) {
  devlearn::Random random(seed, "example");
  Robot robot(random);
  devlearn::LearnerConfig config;
  config.motion_count = 5;
  devlearn::Learner learner(config, seed);
  std::optional<double> before;  // SEF, where it is known
  Result result;
  for (int tick = 0; tick < kTicks; ++tick) {
    const int chosen = learner.choose(robot.situation()).motion;
    const bool bumped = robot.move(learns ? chosen : static_cast<int>(random.index(5)));
    std::optional<double> after;
    if (robot.listen()) after = robot.evaluation();
    if (!before || !after) {
      learner.cancel();  // nobody knows how good that motion was
    } else {
      const double smf = *after - *before;
      learner.learn(bumped ? std::min(smf, -1.0) : smf);  // a bump is never good
    }
    before = after;

    const bool late = tick >= kTicks - 1000;
    result.bumps += late && bumped;
    if (robot.beacon().distance < 0.15) {
      result.found += late;
      robot.place_anywhere();
      before.reset();  // it was carried there
    }
  }
  return result;
}

int print_summary(const char* what, std::vector<int> values) {
  std::sort(values.begin(), values.end());
  const int median = values[values.size() / 2];
  std::printf("  %s: %4d (%d ... %d)\n", what, median, values.front(), values.back());
  return median;
}

Result print_runs(bool learns) {
  std::vector<int> bumps, found;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Result result = run(seed, learns);
    bumps.push_back(result.bumps);
    found.push_back(result.found);
  }
  std::printf("motions %s\n", learns ? "as learned" : "at random");
  return {print_summary("bumps in the last 1000 ticks", bumps),
          print_summary("beacons found in them       ", found)};
}

int main() {
  try {
    kSef(1.0, kNan);
  } catch (const devlearn::InvalidValue& error) {
    std::printf("devlearn's own door: %s\n", error.what());
  }
  const Result learned = print_runs(true), random = print_runs(false);
  return 3 * learned.bumps < random.bumps && learned.found > 3 * random.found ? 0 : 1;
}
