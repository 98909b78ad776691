#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "devlearn/detail/fields.hpp"
#include "devlearn/random.hpp"
#include "devlearn/task.hpp"

namespace devlearn {

/// Which of the foraging scenarios. The first four lie in three corridors that join on the left,
/// the others in four rooms round a corner. To stand on a prey and do whatever is to eat it.
enum class ForagingScenario : std::uint8_t {
  kMovingPreys,  ///< a hare, worth 1, is at the end of another corridor once eaten
  kPersistence,  ///< a hare (1) behind a fence that takes one push more each time; a rabbit (0.01)
  kPreySeason,   ///< seasons of hares (1) and of rabbits (0.1; -1 from the tenth of a season on)
  kPoisonedSeason,  ///< a hare is worth -1 and 1 by turns of the season; a rabbit 0.1
  kHungerThirst,    ///< a hare is worth 1 to who is not thirsty; water is elsewhere
  kLairs,           ///< a rabbit (1) in each of two lairs, to be opened and eaten at once
};

/// The settings of Foraging.
struct ForagingConfig {
  ForagingScenario scenario = ForagingScenario::kMovingPreys;
  int season = 5000;
  int most_pushes = 30;

  /// What each of them is, by name: symbol, range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = ForagingConfig;
    return described("ForagingConfig",
                     field("scenario", &C::scenario, "",
                           names("moving_preys", "persistence", "prey_season", "poisoned_season",
                                 "hunger_thirst", "lairs"),
                           "which scenario"),
                     field("season", &C::season, "", whole(1, 1000000000),
                           "steps of a season, where there are some"),
                     field("most_pushes", &C::most_pushes, "", whole(0, 1000000),
                           "pushes that the fence of persistence takes, at most"));
  }
  /// Throws InvalidValue unless every setting lies in its range.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const ForagingConfig& a, const ForagingConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const ForagingConfig& a, const ForagingConfig& b) noexcept {
  return !(a == b);
}

/// The foraging scenarios of Sequeira, Melo & Paiva (2011; 2014), as in their published program: a
/// fox in a small grid world, which sees where it is and what is there, and nothing else. Motions:
/// up, down, left, right, and among lairs eat and open; against a wall or the fence it stays. A
/// situation is 16 times the cell, numbered row by row, walls too, and what is there. The event of
/// a step is 0 if a prey was eaten. An episode has no end of its own.
class Foraging final : public Task {
 public:
  using Config = ForagingConfig;  ///< its settings

  /// Throws InvalidValue.
  explicit Foraging(const Config& config = {});

  int motion_count() const noexcept override;
  SituationId situation_count() const noexcept override;
  void begin(std::uint64_t seed) override;
  Observation observation() const override;
  Outcome step(int motion) override;
  /// Never: no episode ends.
  bool succeeded() const noexcept override { return false; }

  const Config& config() const noexcept { return config_; }  ///< its settings
  /// The grid, a line a row: # a wall, F the fox, h a hare, r a rabbit, w water, = the fence, o a
  /// lair that is closed, O one with its rabbit out, . one that is empty. Throws InvalidValue where
  /// no episode is under way.
  std::string drawn() const;

 private:
  enum class Lair : std::uint8_t { kClosed, kEmpty, kRabbit };
  static constexpr int kNowhere = -1;

  bool wide() const noexcept;
  bool with_seasons() const noexcept;
  int columns() const noexcept { return wide() ? 7 : 5; }
  const char* grid() const noexcept;
  int cell(int x, int y) const noexcept { return y * columns() + x; }
  int after(int from, int motion) const noexcept;
  SituationId situation() const noexcept;
  void require_begun(const char* call) const;

  double feed(int stood, int motion);
  void push(int stood, int motion);
  void turn(bool rabbits);
  void open(Lair& lair, int at, int motion);

  Config config_;
  Random random_{0, "foraging"};
  bool begun_ = false;
  std::int64_t steps_ = 0;
  int fox_ = kNowhere, hare_ = kNowhere, rabbit_ = kNowhere, water_ = kNowhere, fence_ = kNowhere;
  bool fence_open_ = true;
  int pushes_ = 0, pushes_needed_ = 0;     // of the fence
  bool rabbits_ = false, poison_ = false;  // the present season
  int eaten_ = 0;                          // rabbits, in this season
  bool thirsty_ = false;
  std::array<int, 2> lair_at_{kNowhere, kNowhere};
  std::array<Lair, 2> lair_{};
};

}  // namespace devlearn
