#pragma once

#include <cstdint>
#include <memory>

#include "devlearn/learner.hpp"
#include "devlearn/random.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// What an agent knows when it chooses.
struct Observation {
  SituationId situation = -1;  ///< S_i
  Pose pose;                   ///< [m, m, degrees]
  double sef = 0.0;            ///< SEF here
  double goal_distance = 0.0;  ///< d_g [m]
  double clearance = 0.0;      ///< d_o [m]
  int motion_count = 0;        ///< choose one in 0 ... motion_count - 1
};

/// What an agent is told about the motion it chose.
struct Outcome {
  SituationId situation = -1;  ///< the next situation
  double sef = 0.0;            ///< SEF in it
  double smf = 0.0;            ///< as learned from: min(SMF, -1) for a collision
  bool collided = false;       ///< the body touched something
  bool arrived = false;        ///< d_g <= goal_radius
};

/// Whoever chooses motions in a trial.
class Agent {
 public:
  virtual ~Agent() = default;
  /// Step 3: a motion for what is observed.
  virtual Choice choose(const Observation& observation) = 0;
  /// Steps 4-5: what came of it.
  virtual Development observe(const Outcome& outcome) = 0;
  /// The choice just made was not executed.
  virtual void cancel() {}
  /// NUM_RM, for the record; 0 for agents without such lists.
  virtual std::int64_t explored_count() const { return 0; }
  /// NUM_M, likewise.
  virtual std::int64_t effective_count() const { return 0; }
};

/// The paper's learner as an agent; it shares the learner with whoever else holds it.
class LearnerAgent final : public Agent {
 public:
  /// learner: not null.
  explicit LearnerAgent(std::shared_ptr<Learner> learner);
  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  void cancel() override;
  std::int64_t explored_count() const override;
  std::int64_t effective_count() const override;
  /// The learner, never null.
  const std::shared_ptr<Learner>& learner() const noexcept { return learner_; }

 private:
  std::shared_ptr<Learner> learner_;
};

/// Uniformly random motions: what learning is measured against. It states the kind kUnstated.
class RandomAgent final : public Agent {
 public:
  /// seed: of the stream "agent".
  explicit RandomAgent(std::uint64_t seed) : random_(seed, "agent") {}
  /// One that goes on from a generator.
  explicit RandomAgent(const Random& random) : random_(random) {}
  Choice choose(const Observation& observation) override;
  Development observe(const Outcome& outcome) override;
  /// What it draws from.
  const Random& random() const noexcept { return random_; }

 private:
  Random random_;
};

}  // namespace devlearn
