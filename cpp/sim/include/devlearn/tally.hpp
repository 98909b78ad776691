#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "devlearn/detail/columns.hpp"
#include "devlearn/detail/situation_index.hpp"
#include "devlearn/record.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// What the steps of a round came to; fields() says what each is.
struct RoundTally {
  std::int32_t round = 0;
  std::int64_t steps = 0;
  bool arrived = false;
  std::int64_t first_arrival = 0;
  std::int64_t touches = 0;
  double cost = 0.0;
  std::uint64_t path = 0;
  std::int64_t explored = 0;
  std::int64_t known_ineffective = 0;
  std::int64_t ineffective = 0;
  std::int64_t updates = 0;
  std::int64_t ineffective_updates = 0;
  std::int64_t mappings = 0;
  std::int64_t explored_count = 0;
  std::int64_t effective_count = 0;

  /// What each of them is.
  static constexpr auto fields() {
    using detail::row_field;
    using R = RoundTally;
    return std::tuple{
        row_field("round", &R::round, "its number in the trial, from 1"),
        row_field("steps", &R::steps, "steps of it"),
        row_field("arrived", &R::arrived,
                  "whether d_g <= goal_radius after one, or before the first in path learning"),
        row_field("first_arrival", &R::first_arrival,
                  "which of the steps, from 1, was the first after which it was so; 0: none"),
        row_field("touches", &R::touches, "steps that collided"),
        row_field("cost", &R::cost, "of all steps; NaN where that of one is not known"),
        row_field("path", &R::path, "fingerprint of the motions: equal motions, equal value"),
        row_field("explored", &R::explored, "steps of kind explore"),
        row_field("known_ineffective", &R::known_ineffective,
                  "steps of a mapping that had smf_used < 0 when first executed, but for that one"),
        row_field("ineffective", &R::ineffective, "steps with smf_used < 0"),
        row_field("updates", &R::updates, "events extension, orientation and abandonment"),
        row_field("ineffective_updates", &R::ineffective_updates, "those with smf_used < 0"),
        row_field("mappings", &R::mappings, "different mappings executed by the end of the round"),
        row_field("explored_count", &R::explored_count, "NUM_RM after the last step by then"),
        row_field("effective_count", &R::effective_count, "NUM_M after the last step by then")};
  }
};

/// What a run came to, counted as its steps pass: an entry a round, and no memory that grows with
/// steps. A mapping is a situation and a motion executed in it.
///
/// RunOptions::tally has the phases of a trial count into it, whatever their record holds. It is of
/// one trial, and one phase at a time counts into it.
class Tally {
 public:
  /// Of the steps of a record: what was counted as they passed. Throws InvalidValue for a record of
  /// rounds only, for motions beyond 65535, and as Record::validate.
  static Tally of(const Record& record);

  /// What each round came to.
  const std::vector<RoundTally>& rounds() const noexcept { return rounds_; }
  /// How many were counted.
  std::int64_t steps() const noexcept;

  /// Begins a round, or goes on with the last one, as Record::begin_round.
  void begin_round(std::int32_t number, const Pose& pose);
  /// Counts a step of the round begun last; its motion is one of at most 65535.
  void count(const Step& step);
  /// Counts that round as arrived, as one that begins at the target is by no step.
  void arrive() noexcept { rounds_.back().arrived = true; }

 private:
  enum class First : std::uint8_t { kNone, kEffective, kIneffective };

  First& first_of(SituationId situation, std::int32_t motion);
  void widen(std::int32_t motion);

  std::vector<RoundTally> rounds_;
  Pose here_;  // the robot's, after the last step
  detail::SituationIndex situations_;
  std::size_t width_ = 1;     // motions for which there is room
  std::vector<First> first_;  // of each mapping: a row of them a situation
  std::int64_t mappings_ = 0;
};

}  // namespace devlearn
