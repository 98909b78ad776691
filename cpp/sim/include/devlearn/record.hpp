#pragma once

#include <cstdint>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// Everything about one step of a trial.
struct StepRecord {
  std::int32_t round = 0;            ///< from 1; the round the step belongs to
  SituationId situation = -1;        ///< before the step: S_i, in which the motion was chosen
  std::int32_t motion = -1;          ///< index in M
  Kind kind = Kind::kUnstated;       ///< why it was chosen
  double sef = 0.0;                  ///< after the step: SEF(t+1)
  double smf = 0.0;                  ///< SEF(t+1) - SEF(t), Eq. 8
  double smf_used = 0.0;             ///< what was learned from: min(smf, -1) for a collision
  bool collided = false;             ///< the body touched something during the step
  bool arrived = false;              ///< after the step: d_g <= goal_radius
  double goal_distance = 0.0;        ///< after the step: d_g [m]
  double clearance = 0.0;            ///< after the step: d_o [m]
  Event event = Event::kNothing;     ///< what the outcome changed
  std::int32_t reduced = 0;          ///< motions that reduction development removed
  std::int64_t explored_count = 0;   ///< after the step: NUM_RM
  std::int64_t effective_count = 0;  ///< after the step: NUM_M
  Pose pose;                         ///< after the step
};

/// What a round came to.
struct Round {
  std::int32_t round = 0;  ///< its number in the trial, from 1
  std::int64_t steps = 0;  ///< steps of it in this record
  bool arrived = false;    ///< whether d_g <= goal_radius after any of them
};

/// What happened, as columns of one value a step. The poses are one more a round: round i's are
/// rows [first step + i, last step + i + 1], from where it began to where it ended. A record of
/// rounds only (RunOptions::rounds_only) has no rows and no poses.
struct Record {
  ///@{
  /// Of each step, as StepRecord says.
  std::vector<std::int32_t> round;
  std::vector<SituationId> situation;
  std::vector<std::int32_t> motion;
  std::vector<std::uint8_t> kind;
  std::vector<double> sef, smf, smf_used;
  std::vector<std::uint8_t> collided, arrived;
  std::vector<double> goal_distance, clearance;
  std::vector<std::uint8_t> event;
  std::vector<std::int32_t> reduced;
  std::vector<std::int64_t> explored_count, effective_count;
  ///@}
  ///@{
  /// Poses, steps + rounds values [m, m, degrees].
  std::vector<double> x, y, heading;
  ///@}
  std::vector<Round> rounds;   ///< what each round came to
  int sonar_count = 0;         ///< columns of `echoes`; 0 where they were not asked for
  std::vector<double> echoes;  ///< after each step, steps * sonar_count values [m]

  /// How many there are.
  std::size_t steps() const noexcept { return situation.size(); }

  /// Begins a round: its number and the pose it begins from. Where the last round has this number
  /// and ended at this pose, that one goes on.
  void begin_round(std::int32_t number, const Pose& pose);
  /// Makes room for so many more steps.
  void reserve(std::size_t more);
  /// Appends a step to the round begun last.
  void append(const StepRecord& step);
  /// The same in `rounds` alone, as runs do that keep only rounds.
  void count(const StepRecord& step) noexcept;

  /// Throws InvalidValue, naming the column, unless all are of the length that the rounds make and
  /// hold what a trial can write: rounds from 1, counts at least 0, known kinds and events.
  void validate() const;
};

}  // namespace devlearn
