// A trial with an evaluation and situations of one's own.
//
// The paper's situations are cells of a map, and its SEF is Eq. 6. Here both are made of what a
// robot sees from where it is: in which eighth of the circle the target lies, and whether it faces
// it. What is learned in one place holds in all of them, so eight situations are enough in an open
// room.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "devlearn/math.hpp"
#include "devlearn/trial.hpp"
#include "devlearn/trial_snapshot.hpp"

constexpr devlearn::Point kTarget{2.4, 2.4};

// Where the target is: how far ahead, how far to the left [m].
struct Seen {
  double ahead, left;
};
Seen seen(const devlearn::Senses& senses) {
  const devlearn::Direction h = devlearn::direction(senses.pose.heading);
  const double dx = kTarget.x - senses.pose.x, dy = kTarget.y - senses.pose.y;
  return {dx * h.x + dy * h.y, dy * h.x - dx * h.y};
}

// In which eighth of the circle the target lies: 0 ... 7.
devlearn::SituationId eighth(const devlearn::Senses& senses) {
  const Seen target = seen(senses);
  const bool wide = std::abs(target.left) > std::abs(target.ahead);
  return 4 * (target.ahead > 0.0) + 2 * (target.left > 0.0) + wide;
}

// It is good to be near the target, and to face it.
double facing(const devlearn::Senses& senses) {
  const double distance = std::max(senses.goal_distance, 0.01);
  return 0.4 * seen(senses).ahead / distance - distance;
}

std::vector<std::int64_t> steps_of_rounds(devlearn::Trial& trial, int rounds) {
  devlearn::Record record;
  trial.path_learning(record, rounds, 5000);
  std::vector<std::int64_t> steps;
  for (const devlearn::Round& round : record.rounds) steps.push_back(round.steps);
  return steps;
}

// Of the steps of 20 rounds, the first ones.
int median_of_rounds(devlearn::Trial& trial) {
  std::vector<std::int64_t> steps = steps_of_rounds(trial, 20);
  std::sort(steps.begin(), steps.end());
  return static_cast<int>(steps[10]);
}

void print_summary(const char* what, std::vector<int> values) {
  std::sort(values.begin(), values.end());
  std::printf("  %-31s %5d (%d ... %d)\n", what, values[values.size() / 2], values.front(),
              values.back());
}

int main() {
  devlearn::WorldDef def;
  def.width = def.height = 3.0;
  def.start = {0.5, 0.5, 180.0};
  def.target = kTarget;
  const devlearn::World world(def);
  devlearn::TrialParts own;
  own.evaluation = {"facing", facing};
  own.situations = {"eighth", eighth};

  std::vector<int> plain, ours;
  bool same = false;
  for (int seed = 1; seed <= 7; ++seed) {
    devlearn::Trial by_map(world, {}, seed), trial(world, {}, seed, own);
    plain.push_back(median_of_rounds(by_map));
    ours.push_back(median_of_rounds(trial));
    if (seed < 7) continue;
    // A file names the functions. Whoever loads it gives them again.
    const std::vector<std::byte> bytes = to_bytes(trial);
    devlearn::LoadOptions options;
    options.parts = own;
    devlearn::Trial again = devlearn::load_trial(bytes.data(), bytes.size(), options).trial;
    same = steps_of_rounds(again, 5) == steps_of_rounds(trial, 5);
  }

  std::printf(
      "steps to the target, median of the first 20 rounds: median of 7 seeds (least ... most)\n");
  print_summary("the map's cells, Eq. 6", plain);
  print_summary("seen from the robot, facing it", ours);
  std::printf("goes on alike from a snapshot: %s\n", same ? "yes" : "no");
  const bool sooner =
      *std::max_element(ours.begin(), ours.end()) < *std::min_element(plain.begin(), plain.end());
  return same && sooner ? 0 : 1;
}
