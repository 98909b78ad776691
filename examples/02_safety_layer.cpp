// A safety layer that has the last word.
//
// A robot drives about a table top, whose edges are cliffs, to its dock. Where a motion would lead
// over an edge, the safety layer drives the other way; while a hand is over the table, nothing
// moves. The learner is not told of refusals, or told of them afterwards, or told beforehand which
// motions are allowed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"

constexpr double kSide = 1.0, kMargin = 0.05, kCell = 0.1;  // of the table [m]
enum Motion { kEast, kNorth, kWest, kSouth };
constexpr double kDockX = 0.9, kDockY = 0.5;
constexpr int kTicks = 4000;

void require(bool holds, const char* what) {
  if (holds) return;
  std::printf("does not hold: %s\n", what);
  std::exit(1);
}

struct Robot {
  devlearn::Random& random;
  double x = 0.0, y = 0.0;

  explicit Robot(devlearn::Random& source) : random(source) { place_anywhere(); }

  void place_anywhere() {
    x = 0.05 + 0.9 * random.uniform();
    y = 0.05 + 0.9 * random.uniform();
  }

  std::array<double, 2> after(int motion, double step) const {
    return {x + step * ((motion == kEast) - (motion == kWest)),
            y + step * ((motion == kNorth) - (motion == kSouth))};
  }

  void move(int motion) {
    const auto next = after(motion, 0.04 + 0.02 * random.uniform());
    x = next[0];
    y = next[1];
  }

  // The safety layer: the motion, or where that could lead over an edge the opposite one.
  int safe(int motion) const {
    const auto next = after(motion, 0.06);
    const bool on_table = kMargin < next[0] && next[0] < kSide - kMargin &&  //
                          kMargin < next[1] && next[1] < kSide - kMargin;
    return on_table ? motion : (motion + 2) % 4;
  }

  int situation() const { return 10 * static_cast<int>(y / kCell) + static_cast<int>(x / kCell); }

  double distance() const {
    const double dx = kDockX - x, dy = kDockY - y;
    return std::sqrt(dx * dx + dy * dy);
  }
};

enum Told { kNothing, kRefusals, kAllowed };

struct Result {
  int refusals[4] = {};  // in each quarter of the ticks
  int docked = 0;
  std::string explanation;  // of the place before the eastern edge
};

Result run(int seed, Told told) {
  devlearn::Random random(seed, "example");
  Robot robot(random);
  devlearn::LearnerConfig config;
  config.motion_count = 4;
  devlearn::Learner learner(config, seed);
  Result result;
  for (int tick = 0; tick < kTicks; ++tick) {
    const int situation = robot.situation();
    const double before = robot.distance();
    std::array<bool, 4> allowed{true, true, true, true};
    if (told == kAllowed) {
      for (int motion = 0; motion < 4; ++motion) allowed[motion] = robot.safe(motion) == motion;
    }
    const int chosen = learner.choose(situation, allowed).motion;
    if (random.index(20) == 0) {  // a hand
      const auto known = learner.explored_count();
      learner.cancel();  // nothing ran, so nothing is learned
      require(learner.explored_count() == known, "a cancelled choice teaches nothing");
      continue;
    }

    const int ran = robot.safe(chosen);
    robot.move(ran);
    require(0.0 < robot.x && robot.x < kSide && 0.0 < robot.y && robot.y < kSide, "it stays on");
    learner.learn(before - robot.distance(), ran);  // about the motion that really ran
    if (ran != chosen) {
      ++result.refusals[4 * tick / kTicks];
      // The edge will be here next time, too: let that motion count as tried.
      if (told == kRefusals) learner.update(situation, chosen, -1.0);
    }

    if (robot.distance() < 0.06) {
      ++result.docked;
      robot.place_anywhere();
    }
  }
  result.explanation = to_text(learner.explain(59));
  return result;
}

int print_summary(const char* what, std::vector<int> values) {
  std::sort(values.begin(), values.end());
  const int median = values[values.size() / 2];
  std::printf("  %s: %4d (%d ... %d)\n", what, median, values.front(), values.back());
  return median;
}

int main() {
  const char* const names[] = {"nothing of refusals", "of refusals", "what is allowed"};
  int late[3];
  for (const Told told : {kNothing, kRefusals, kAllowed}) {
    std::vector<int> first, last, docked;
    std::string explanation;
    for (int seed = 1; seed <= 11; ++seed) {
      const Result result = run(seed, told);
      first.push_back(result.refusals[0]);
      last.push_back(result.refusals[3]);
      docked.push_back(result.docked);
      explanation = result.explanation;
    }
    std::printf("the learner is told %s\n", names[told]);
    print_summary("refused in ticks    1 ... 1000", first);
    late[told] = print_summary("refused in ticks 3001 ... 4000", last);
    print_summary("times docked                  ", docked);
    std::printf(
        "what the last one makes of the place before the eastern edge, where east is refused:\n"
        "%s\n",
        explanation.c_str());
  }
  require(late[kAllowed] == 0, "what is not allowed is never chosen");
  return 2 * late[kRefusals] < late[kNothing] ? 0 : 1;
}
