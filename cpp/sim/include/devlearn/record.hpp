#pragma once

#include <cstdint>
#include <vector>

#include "devlearn/choice.hpp"
#include "devlearn/detail/columns.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// Everything about one step of a trial; Record::step_columns says what each is.
struct Step {
  std::int32_t round = 0;
  SituationId situation = -1;
  SituationId true_situation = -1;
  std::int32_t motion = -1;
  Kind kind = Kind::kUnstated;
  double sef = 0.0;
  double smf = 0.0;
  double smf_used = 0.0;
  bool collided = false;
  bool arrived = false;
  double goal_distance = 0.0;
  double clearance = 0.0;
  double cost = 1.0;
  std::optional<double> value;
  Event event = Event::kNothing;
  std::int32_t reduced = 0;
  std::int64_t explored_count = 0;
  std::int64_t effective_count = 0;
  Pose pose;  ///< after the step [m, m, degrees]
};

/// What a round came to.
struct Round {
  std::int32_t round = 0;  ///< its number in the trial, from 1
  std::int64_t steps = 0;  ///< steps of it in this record
  bool arrived = false;    ///< whether d_g <= goal_radius after any of them
  /// Steps that the trial had made before, so that it began at `began` x sample_time [s]; -1: not
  /// known, as in files of builds that had no such field.
  std::int64_t began = -1;
};

/// What happened, as columns of one value a step. The poses are one more a round: round i's are
/// rows [first step + i, last step + i + 1], from where it began to where it ended. A record of
/// rounds only (RunOptions::rounds_only) has no rows and no poses.
struct Record {
  ///@{
  /// Of each step, as Step says.
  std::vector<std::int32_t> round;
  std::vector<SituationId> situation, true_situation;
  std::vector<std::int32_t> motion;
  std::vector<std::uint8_t> kind;
  std::vector<double> sef, smf, smf_used;
  std::vector<std::uint8_t> collided, arrived;
  std::vector<double> goal_distance, clearance;
  std::vector<double> cost, value;
  std::vector<std::uint8_t> event;
  std::vector<std::int32_t> reduced;
  std::vector<std::int64_t> explored_count, effective_count;
  ///@}
  ///@{
  /// Poses, steps + rounds values [m, m, degrees].
  std::vector<double> x, y, heading;
  ///@}

  /// The columns of one value a step: what of the step stands in each.
  static constexpr auto step_columns() {
    using namespace detail;
    using R = Record;
    return std::tuple{
        column("round", &R::round, &Step::round, from(1), "the round the step belongs to, from 1"),
        column("situation", &R::situation, &Step::situation, from(0),
               "before the step: S_i, in which the motion was chosen"),
        column("true_situation", &R::true_situation, &Step::true_situation, or_untold(),
               "the situation that the robot was in; another one where its odometry errs"),
        column("motion", &R::motion, &Step::motion, from(0), "index in M"),
        column("kind", &R::kind, &Step::kind, whole(0, 6), "why it was chosen, a Kind"),
        column("sef", &R::sef, &Step::sef, finite(), "after the step: SEF(t+1)"),
        column("smf", &R::smf, &Step::smf, finite(), "SEF(t+1) - SEF(t), Eq. 8"),
        column("smf_used", &R::smf_used, &Step::smf_used, finite(),
               "what was learned from: min(smf, -1) for a collision"),
        column("collided", &R::collided, &Step::collided, whole(0, 1),
               "whether the body touched something during the step"),
        column("arrived", &R::arrived, &Step::arrived, whole(0, 1),
               "after the step: d_g <= goal_radius"),
        column("goal_distance", &R::goal_distance, &Step::goal_distance, at_least_zero(),
               "after the step: d_g [m]"),
        column("clearance", &R::clearance, &Step::clearance, at_least_zero(),
               "after the step: d_o [m]"),
        column("cost", &R::cost, &Step::cost, or_unknown(0.0),
               "of the step: 1, and touch_cost more where it collided"),
        column("value", &R::value, &Step::value, or_unknown(),
               "after the step: cost to go as the agent expects it; NaN: it does not say"),
        column("event", &R::event, &Step::event, whole(0, 4), "what the outcome changed, an Event"),
        column("reduced", &R::reduced, &Step::reduced, from(0),
               "motions that reduction development removed"),
        column("explored_count", &R::explored_count, &Step::explored_count, from(0),
               "after the step: NUM_RM"),
        column("effective_count", &R::effective_count, &Step::effective_count, from(0),
               "after the step: NUM_M")};
  }
  /// The columns of one value a pose.
  static constexpr auto pose_columns() {
    using namespace detail;
    return std::tuple{column("x", &Record::x, &Pose::x, finite(), "of the robot's centre [m]"),
                      column("y", &Record::y, &Pose::y, finite(), "likewise [m]"),
                      column("heading", &Record::heading, &Pose::heading, finite(),
                             "counter-clockwise from x [degrees]")};
  }

  std::vector<Round> rounds;   ///< what each round came to
  int sonar_count = 0;         ///< columns of `echoes`; 0 where they were not asked for
  std::vector<double> echoes;  ///< after each step, steps * sonar_count values [m]

  /// How many there are.
  std::size_t steps() const noexcept { return situation.size(); }

  /// Whether it holds rounds without their steps and poses.
  bool rounds_only() const noexcept { return !rounds.empty() && x.empty(); }

  /// Begins a round: its number, the pose it begins from, and after how many steps. Where the last
  /// round has this number and ended at this pose, that one goes on.
  void begin_round(std::int32_t number, const Pose& pose, std::int64_t began = -1);
  /// Makes room for so many more steps.
  void reserve(std::size_t more);
  /// Appends a step to the round begun last.
  void append(const Step& step);
  /// The same in `rounds` alone, as runs do that keep only rounds.
  void count(const Step& step) noexcept;

  /// Throws InvalidValue, naming the column, unless all are of the length that the rounds make, or
  /// of rounds only empty, and hold what a trial can write: rounds from 1, each step in its round,
  /// counts at least 0, known kinds and events, finite poses.
  void validate() const;

 private:
  void require_steps_in_rounds() const;
};

}  // namespace devlearn
