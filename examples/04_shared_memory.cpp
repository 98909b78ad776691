// Several robots that share one memory, and outcomes that come late.
//
// Carriers in a hall bring parcels to a hatch. A computer in the office chooses for all of them;
// what a motion led to, each radios back some ticks later. Whatever one carrier learns, all know.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "devlearn/snapshot.hpp"

constexpr int kSize = 16;  // the hall's cells a side; the hatch is in the corner (0, 0)
constexpr int kMoves[][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
constexpr int kTicks = 600;

struct Carrier {
  devlearn::Random& random;
  int x = 0, y = 0;

  explicit Carrier(devlearn::Random& source) : random(source) { fetch_parcel(); }

  void fetch_parcel() {
    x = static_cast<int>(random.index(kSize));
    y = static_cast<int>(random.index(kSize));
  }

  int situation() const { return kSize * y + x; }

  // The SMF: cells nearer to the hatch; -1 where a wall was in the way.
  int move(int motion) {
    const int next_x = x + kMoves[motion][0], next_y = y + kMoves[motion][1];
    if (next_x < 0 || next_x >= kSize || next_y < 0 || next_y >= kSize) return -1;
    const int smf = x + y - (next_x + next_y);
    x = next_x;
    y = next_y;
    return smf;
  }
};

struct Report {
  int arrives;  // tick
  int situation, motion, smf;
};

devlearn::Learner new_learner(int seed) {
  devlearn::LearnerConfig config;
  config.motion_count = 4;
  return devlearn::Learner(config, seed);
}

// Parcels that each carrier brought, on average.
double run(int seed, int team) {
  devlearn::Random random(seed, "example");
  devlearn::Learner learner = new_learner(seed);
  std::vector<Carrier> carriers;
  for (int i = 0; i < team; ++i) carriers.emplace_back(random);
  std::vector<Report> on_the_air;
  int parcels = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    for (Carrier& carrier : carriers) {
      const int situation = carrier.situation();
      const int motion = learner.choose(situation).motion;
      learner.cancel();  // the outcome will come by update, so that others can choose meanwhile
      const int smf = carrier.move(motion);
      on_the_air.push_back({tick + static_cast<int>(random.index(6)), situation, motion, smf});
      if (carrier.situation() == 0) {
        ++parcels;
        carrier.fetch_parcel();
      }
    }

    std::vector<Report> still_on_the_air;
    for (const Report& report : on_the_air) {
      if (report.arrives <= tick) {
        learner.update(report.situation, report.motion, report.smf);
      } else {
        still_on_the_air.push_back(report);
      }
    }
    on_the_air = still_on_the_air;
  }
  return static_cast<double>(parcels) / team;
}

// For one robot and outcomes at once, choose-cancel-update is choose-learn, to the bit.
bool same_as_learn(int seed) {
  devlearn::Learner one = new_learner(seed), other = new_learner(seed);
  devlearn::Random random(seed, "example");
  Carrier carrier(random);
  for (int tick = 0; tick < kTicks; ++tick) {
    const int situation = carrier.situation();
    const int motion = one.choose(situation).motion;
    if (other.choose(situation).motion != motion) return false;
    other.cancel();
    const int smf = carrier.move(motion);
    one.learn(smf);
    other.update(situation, motion, smf);
  }
  return devlearn::to_bytes(one) == devlearn::to_bytes(other);
}

int main() {
  std::printf("parcels a carrier in %d ticks: median of 11 seeds (least ... most)\n", kTicks);
  std::vector<double> medians;
  for (const int team : {1, 3, 9}) {
    std::vector<double> parcels;
    for (int seed = 1; seed <= 11; ++seed) parcels.push_back(run(seed, team));
    std::sort(parcels.begin(), parcels.end());
    std::printf("  %d with one memory: %6.2f (%.2f ... %.2f)\n", team, parcels[5], parcels.front(),
                parcels.back());
    medians.push_back(parcels[5]);
  }
  bool same = true;
  for (int seed = 1; seed <= 11; ++seed) same = same && same_as_learn(seed);
  std::printf("choose, cancel, update is choose, learn: %s\n", same ? "yes" : "no");
  return same && medians[2] > 1.5 * medians[0] ? 0 : 1;
}
