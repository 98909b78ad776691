#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "devlearn/detail/fields.hpp"
#include "devlearn/environment.hpp"
#include "devlearn/random.hpp"
#include "devlearn/shortest_path.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/trial_config.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

/// What a step is worth to who learns by rewards.
enum class Reward : std::uint8_t {
  kShaped,  ///< -cost, and by how much the estimate of the cost to go fell
  kCost,    ///< -cost
  kSmf,     ///< SMF as learned from: min(SMF, -1) for a collision
  kSparse,  ///< 1 at the target, 0 elsewhere
};

/// When the next episode of an environment begins, whose last one has ended.
enum class Autoreset : std::uint8_t {
  kNextStep,  ///< by the next step, which makes no motion
  kSameStep,  ///< by the step that ended it
  kDisabled,  ///< by reset alone
};

/// What episodes are.
struct BatchConfig {
  Reward reward = Reward::kShaped;
  std::int64_t step_limit = 10000;
  Autoreset autoreset = Autoreset::kNextStep;
  bool sonars = false;
  bool random_starts = false;

  /// What each of them is, by name: range, meaning.
  static constexpr auto fields() {
    using namespace detail;
    using C = BatchConfig;
    return described(
        "BatchConfig",
        field("reward", &C::reward, "", names("shaped", "cost", "smf", "sparse"),
              "what a step is worth: -cost and by how much the estimate of the cost to go fell; "
              "-cost; SMF as learned from; 1 at the target and 0 elsewhere"),
        field("step_limit", &C::step_limit, "", whole(1, std::int64_t{1} << 40),
              "steps after which an episode is truncated"),
        field("autoreset", &C::autoreset, "", names("next_step", "same_step", "disabled"),
              "when the next episode begins: by the step after the last, which makes no motion, by "
              "the last step itself, or by reset alone"),
        field("sonars", &C::sonars, "", Truth{}, "whether the sonars' echoes are told"),
        field("random_starts", &C::random_starts, "", Truth{},
              "whether an episode begins at a pose drawn among those that may get to the target, "
              "in place of the world's start"));
  }

  /// Throws InvalidValue.
  void validate() const { detail::require_fields(*this); }
};

inline bool operator==(const BatchConfig& a, const BatchConfig& b) noexcept {
  return detail::same_fields(a, b);
}
inline bool operator!=(const BatchConfig& a, const BatchConfig& b) noexcept { return !(a == b); }

/// Several environments of one world and configuration, which one call steps: a row each, in arrays
/// that stay where they are.
///
/// An episode begins at the world's start, or at a pose drawn from the stream "starts" of its
/// environment's seed. It is terminated where the robot arrives, and truncated
/// after step_limit steps without that. What environment i does depends on its own seed and motions
/// alone, so it is the same in a batch of any size. A step allocates nothing of its own.
class Batch {
 public:
  /// What is known where the robots are.
  struct Rows {
    std::vector<double> pose;            ///< x, y, heading in [0, 360): 3 a row [m, m, degrees]
    std::vector<SituationId> situation;  ///< S_i
    std::vector<double> goal_distance;   ///< d_g [m]
    std::vector<double> clearance;       ///< d_o [m]
    std::vector<double> estimate;        ///< cost to go at the least, in steps
    std::vector<double> echoes;          ///< sonar_count a row, or none [m]
    std::vector<std::uint8_t> allowed;   ///< a motion each: 1 where the robot can make it
  };

  /// What came of the last step; zeros where it began an episode.
  struct Outcomes {
    std::vector<double> reward;            ///< as BatchConfig::reward says
    std::vector<double> smf;               ///< as learned from
    std::vector<double> cost;              ///< 1, and touch_cost more where it collided
    std::vector<std::uint8_t> collided;    ///< whether the body touched something
    std::vector<std::uint8_t> terminated;  ///< the target was reached
    std::vector<std::uint8_t> truncated;   ///< the step limit was
    std::vector<std::uint8_t> begun;       ///< the step only began an episode
  };

  /// `count` environments, in 1 ... 2^20, each at the beginning of its first episode; environment i
  /// is seeded with seed + i (modulo 2^64). Throws InvalidValue.
  explicit Batch(const World& world, int count = 1, const TrialConfig& config = {},
                 const BatchConfig& batch = {}, std::uint64_t seed = 0);

  /// What a reset is of; a null stands for what is said of it.
  struct Reset {
    const bool* which = nullptr;           ///< a bool an environment; null: every one
    const std::uint64_t* seeds = nullptr;  ///< one each; null: their draws go on
    const Pose* poses = nullptr;           ///< where each begins; null: as episodes do
  };
  /// Begins an episode in environments. Throws InvalidValue for a pose where the robot does not
  /// fit; then nothing was reset.
  void reset(const Reset& asked);
  /// The same in every one, environment i seeded anew with seed + i (modulo 2^64).
  void reset(std::uint64_t seed);

  /// One step of every environment: motions[i] in environment i. One that the robot's safety layer
  /// would not allow is made, too. Throws InvalidValue for a motion outside M and, where autoreset
  /// is disabled, for an episode that has ended; then nothing was stepped.
  void step(const std::int64_t* motions);
  /// The same at wheel speeds, speeds[i] in environment i (Robot::drive_wheels): forwards or
  /// backwards, each at most RobotDef.speed. Rows tell of motions alone which are allowed.
  void drive_wheels(const WheelSpeeds* speeds);

  /// How many environments.
  int count() const noexcept { return static_cast<int>(environments_.size()); }
  /// Where the robots are.
  const Rows& rows() const noexcept { return rows_; }
  /// Where episodes ended that ended by the last step, if autoreset is same_step: the rows that are
  /// terminated or truncated.
  const Rows& final_rows() const noexcept { return final_rows_; }
  /// What came of the last step.
  const Outcomes& outcomes() const noexcept { return outcomes_; }
  /// Environment i, 0 <= i < count().
  const Environment& environment(int i) const { return environments_[static_cast<std::size_t>(i)]; }
  const BatchConfig& config() const noexcept { return config_; }  ///< as given

 private:
  struct Episode {
    Random starts;  // by which the poses are drawn that episodes begin at
    std::int64_t steps = 0;
    bool over = false;
  };

  Rows empty_rows() const;
  void begin(std::size_t i);
  void begin(std::size_t i, const Pose& pose);
  template <typename Command>
  void step_each(const Command& command);
  template <typename Command>
  void advance(std::size_t i, const Command& command);
  void tell(std::size_t i, Rows& rows);
  double reward_of(const Outcome& outcome, double estimate_before) const noexcept;

  BatchConfig config_;
  std::vector<Environment> environments_;
  std::optional<StartPlaces> places_;  // where starts are drawn
  std::vector<Episode> episodes_;
  Rows rows_, final_rows_;
  Outcomes outcomes_;
};

}  // namespace devlearn
