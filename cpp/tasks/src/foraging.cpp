#include "devlearn/foraging.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"

namespace devlearn {
namespace {

constexpr const char* kCorridors =
    "#####"
    "#   #"
    "# ###"
    "#   #"
    "# ###"
    "#   #"
    "#####";
constexpr const char* kRooms =
    "#######"
    "#     #"
    "#  #  #"
    "##### #"
    "#     #"
    "#  #  #"
    "#######";
constexpr int kRows = 7;
constexpr int kContents = 16;  // of a cell

enum Motion { kUp, kDown, kLeft, kRight, kEat, kOpen };

constexpr int kMostRabbits = 9;   // of a season, without harm
constexpr double kThirst = 0.2;   // probability of a step to become thirsty
constexpr double kClosing = 0.1;  // of an empty lair to close

}  // namespace

Foraging::Foraging(const Config& config) : config_((config.validate(), config)) {}

int Foraging::motion_count() const noexcept {
  return config_.scenario == ForagingScenario::kLairs ? 6 : 4;
}

bool Foraging::wide() const noexcept {
  return config_.scenario == ForagingScenario::kHungerThirst ||
         config_.scenario == ForagingScenario::kLairs;
}

bool Foraging::with_seasons() const noexcept {
  return config_.scenario == ForagingScenario::kPreySeason ||
         config_.scenario == ForagingScenario::kPoisonedSeason;
}

const char* Foraging::grid() const noexcept { return wide() ? kRooms : kCorridors; }

void Foraging::begin(std::uint64_t seed) {
  *this = Foraging(config_);
  random_ = Random(seed, "foraging");
  begun_ = true;
  const int ends[] = {cell(3, 1), cell(3, 3), cell(3, 5)};
  const int corners[] = {cell(1, 1), cell(1, 5), cell(5, 1), cell(5, 5)};
  const auto two_corners = [&] {
    const std::uint32_t one = random_.index(4), other = (one + 1 + random_.index(3)) % 4;
    return std::pair{corners[one], corners[other]};
  };
  switch (config_.scenario) {
    case ForagingScenario::kMovingPreys:
      fox_ = cell(1, 1);
      hare_ = ends[random_.index(3)];
      break;
    case ForagingScenario::kPersistence:
      fence_ = cell(1, 2);
      [[fallthrough]];
    case ForagingScenario::kPoisonedSeason:
      fox_ = ends[1];
      hare_ = ends[0];
      rabbit_ = ends[2];
      poison_ = config_.scenario == ForagingScenario::kPoisonedSeason;
      break;
    case ForagingScenario::kPreySeason:
      fox_ = ends[1];
      turn(random_.index(2) == 0);
      break;
    case ForagingScenario::kHungerThirst:
      fox_ = cell(5, 3);
      std::tie(hare_, water_) = two_corners();
      break;
    case ForagingScenario::kLairs:
      fox_ = cell(5, 3);
      std::tie(lair_at_[0], lair_at_[1]) = two_corners();
      break;
  }
}

Observation Foraging::observation() const {
  require_begun("observation");
  Observation seen;
  seen.situation = situation();
  seen.motion_count = motion_count();
  return seen;
}

Outcome Foraging::step(int motion) {
  require_begun("step");
  require_count("motion", motion, 0, motion_count() - 1);
  const int stood = fox_;
  fox_ = after(stood, motion);
  if (fence_ != kNowhere) push(stood, motion);
  const double reward = feed(stood, motion);
  if (++steps_ % config_.season == 0 && with_seasons()) {
    poison_ = !poison_;
    if (config_.scenario == ForagingScenario::kPreySeason) turn(!rabbits_);
  }
  Outcome outcome;
  outcome.situation = situation();
  outcome.cost = -reward;
  outcome.event = reward != 0.0 ? 0 : -1;
  return outcome;
}

// --- what a step does ----------------------------------------------------------------------------

int Foraging::after(int from, int motion) const noexcept {
  const int by[] = {-columns(), columns(), -1, 1, 0, 0};
  const int to = from + by[motion];
  return grid()[to] == '#' || (to == fence_ && !fence_open_) ? from : to;
}

// What is eaten where it stood, and what follows from that.
double Foraging::feed(int stood, int motion) {
  const bool hare = stood == hare_, rabbit = stood == rabbit_;
  switch (config_.scenario) {
    case ForagingScenario::kMovingPreys:
      if (hare) {
        const int rows[] = {1, 3, 5};
        const auto row = static_cast<std::uint32_t>(hare_ / columns() / 2);
        hare_ = cell(3, rows[(row + 1 + random_.index(2)) % 3]);
      }
      return hare ? 1.0 : 0.0;
    case ForagingScenario::kHungerThirst:
      thirsty_ = stood != water_ && (thirsty_ || random_.uniform() < kThirst);
      return hare && !thirsty_ ? 1.0 : 0.0;
    case ForagingScenario::kLairs: {
      const bool out = lair_[0] == Lair::kRabbit || lair_[1] == Lair::kRabbit;
      for (std::size_t i = 0; i < 2; ++i) open(lair_[i], lair_at_[i], motion);
      return motion == kEat && out ? 1.0 : 0.0;
    }
    default:
      break;
  }
  if (!hare && !rabbit) return 0.0;
  fox_ = cell(3, 3);
  if (config_.scenario == ForagingScenario::kPersistence) {
    if (hare) pushes_needed_ = std::min(pushes_needed_ + 1, config_.most_pushes);
    return hare ? 1.0 : 0.01;
  }
  if (hare) return poison_ && config_.scenario == ForagingScenario::kPoisonedSeason ? -1.0 : 1.0;
  const bool too_many =
      config_.scenario == ForagingScenario::kPreySeason && ++eaten_ > kMostRabbits;
  return too_many ? -1.0 : 0.1;
}

// The fence stands from below alone, and opens at the last of as many pushes in a row as it needs.
void Foraging::push(int stood, int motion) {
  fence_open_ = fox_ < fence_ / columns() * columns() || pushes_needed_ == 0;
  const bool pushed = motion == kUp && stood - columns() == fence_;
  pushes_ = pushed ? pushes_ + 1 : 0;
  if (pushed && pushes_ >= pushes_needed_) fence_open_ = true;
}

// A season of rabbits, or of hares, begins.
void Foraging::turn(bool rabbits) {
  rabbits_ = rabbits;
  rabbit_ = rabbits ? cell(3, 1) : kNowhere;
  hare_ = rabbits ? kNowhere : cell(3, 5);
  eaten_ = 0;
}

// A rabbit that comes out of its lair is gone after one step.
void Foraging::open(Lair& lair, int at, int motion) {
  if (lair == Lair::kEmpty) {
    if (random_.uniform() < kClosing) lair = Lair::kClosed;
  } else if (lair == Lair::kRabbit) {
    lair = Lair::kEmpty;
  } else if (motion == kOpen && fox_ == at) {
    lair = Lair::kRabbit;
  }
}

// --- what is seen --------------------------------------------------------------------------------

SituationId Foraging::situation_count() const noexcept {
  return SituationId{columns()} * kRows * kContents;
}

SituationId Foraging::situation() const noexcept {
  int there =
      (fox_ == hare_ ? 1 : 0) + (fox_ == rabbit_ || fox_ == water_ ? 2 : 0) + (thirsty_ ? 4 : 0);
  if (config_.scenario == ForagingScenario::kLairs) {
    there = 3 * static_cast<int>(lair_[0]) + static_cast<int>(lair_[1]);
  }
  return SituationId{fox_} * kContents + there;
}

std::string Foraging::drawn() const {
  require_begun("drawn");
  std::string cells(grid(), static_cast<std::size_t>(columns() * kRows));
  const auto put = [&](int at, char what) {
    if (at != kNowhere) cells[static_cast<std::size_t>(at)] = what;
  };
  put(hare_, 'h');
  put(rabbit_, 'r');
  put(water_, 'w');
  put(fence_, '=');
  for (std::size_t i = 0; i < 2; ++i) put(lair_at_[i], "o.O"[static_cast<int>(lair_[i])]);
  put(fox_, 'F');
  const auto width = static_cast<std::size_t>(columns());
  for (std::size_t row = kRows; row > 0; --row) cells.insert(row * width, 1, '\n');
  return cells;
}

void Foraging::require_begun(const char* call) const {
  if (!begun_) throw InvalidValue(call, "called before an episode", "begin first");
}

}  // namespace devlearn
