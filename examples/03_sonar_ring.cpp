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

#include "devlearn/eigen.hpp"
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
  Eigen::Vector2d centre;  // [m]
  double radius;           // [m]
};
const Circle kRoom{{2.0, 2.0}, 1.9};
const Circle kPillars[] = {{{1.3, 1.2}, 0.25}, {{2.6, 1.4}, 0.2}, {{1.6, 2.7}, 0.3}};
const Eigen::Vector2d kBeacon(3.1, 2.9);
constexpr int kTicks = 3000, kSeeds = 5;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr devlearn::StateEvaluation kSef{};

// Distance along a ray to a circle: to its near side, from inside to its far side.
double ray(const Eigen::Vector2d& from, const Eigen::Vector2d& ahead, const Circle& circle) {
  const Eigen::Vector2d there = circle.centre - from;
  const double along = there.dot(ahead);
  const double gap = there.squaredNorm() - circle.radius * circle.radius;
  const double root = along * along - gap;
  if (root < 0.0) return kInfinity;
  const double distance = gap > 0.0 ? along - std::sqrt(root) : along + std::sqrt(root);
  return distance > 0.0 ? distance : kInfinity;
}

struct Robot {
  using Echoes = std::array<double, 3>;

  devlearn::Random& random;
  Eigen::ArrayXd readings = Eigen::ArrayXd::Constant(kBeams, kRange);
  Eigen::Vector2d place;
  double heading = 0.0;

  explicit Robot(devlearn::Random& source) : random(source) { place_anywhere(); }

  void place_anywhere() {
    heading = 360.0 * random.uniform();
    place.setZero();
    while (!free(place)) {
      place.x() = 4.0 * random.uniform();
      place.y() = 4.0 * random.uniform();
    }
  }

  // The transform from the robot's frame, x ahead and y to the left, into the room's.
  Eigen::Isometry2d frame() const { return devlearn::to_isometry({place.x(), place.y(), heading}); }

  static bool free(const Eigen::Vector2d& place) {
    const auto squared = [&](const Circle& circle) {
      return (place - circle.centre).squaredNorm();
    };
    if (squared(kRoom) >= (kRoom.radius - kRadius) * (kRoom.radius - kRadius)) return false;
    return std::all_of(std::begin(kPillars), std::end(kPillars), [&](const Circle& pillar) {
      return squared(pillar) > (pillar.radius + kRadius) * (pillar.radius + kRadius);
    });
  }

  // Turns, then drives ahead; true where it bumped into something and stayed.
  bool move(int motion) {
    heading = devlearn::wrapped_heading(heading + kTurns[motion]);
    const Eigen::Vector2d next = place + kStep * frame().linear().col(0);
    if (!free(next)) return true;
    place = next;
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
    const devlearn::Direction beam = devlearn::direction(beam_heading);
    const Eigen::Vector2d ahead(beam.x, beam.y);
    double distance = ray(place, ahead, kRoom);
    for (const Circle& pillar : kPillars) distance = std::min(distance, ray(place, ahead, pillar));
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
    Eigen::ArrayXd next(kBeams);
    const auto ring = driver();
    for (int beam = 0; beam < kBeams; ++beam) {
      std::vector<double> believable;
      for (const double echo : ring[beam]) {
        heard = heard || !std::isnan(echo);
        if (kNearest <= echo && echo <= kRange) believable.push_back(echo);  // never NaN
      }
      std::sort(believable.begin(), believable.end());
      next(beam) = believable.empty() ? kRange : believable[believable.size() / 2];
    }
    if (heard) readings = next;
    return heard;
  }

  double beacon_distance() const { return (kBeacon - place).norm(); }

  // The beacon in the robot's frame: how far ahead, how far to the left.
  Eigen::Vector2d beacon() const { return frame().linear().transpose() * (kBeacon - place); }

  // In which eighth of the circle the beacon lies, and which front beams hear something.
  int situation() const {
    const Eigen::Vector2d b = beacon();
    const int eighth = 4 * (b.x() > 0.0) + 2 * (b.y() > 0.0) + (std::abs(b.y()) > std::abs(b.x()));
    const bool right = readings(7) < 0.2, front = readings(0) < 0.2, left = readings(1) < 0.2;
    return 8 * eighth + 4 * right + 2 * front + left;
  }

  // Eq. 6, with the clearance that a real robot has: least echo + radius.
  double evaluation() const { return kSef(beacon_distance(), readings.minCoeff() + kRadius); }
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
    if (robot.beacon_distance() < 0.15) {
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
