#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/trial_config.hpp"
#include "devlearn/world.hpp"

namespace devlearn {

/// A robot in its world as an agent meets it, step by step: what it senses, and what comes of a
/// motion. All of the closed loop but whoever chooses: a Trial is an environment and an agent.
///
/// A new one stands at the world's start. Several that share a world, robot and configuration are
/// twins: making one costs little, and threads may step different twins at once.
class Environment {
 public:
  /// Throws InvalidValue.
  explicit Environment(const World& world, const TrialConfig& config = {}, std::uint64_t seed = 0,
                       TrialParts parts = {});
  ~Environment();
  ///@{
  /// It moves, and is not copied.
  Environment(Environment&&) noexcept;
  Environment& operator=(Environment&&) noexcept;
  ///@}

  /// Another of the same world, robot and configuration, at the start. It shares what never
  /// changes.
  Environment twin(std::uint64_t seed) const;

  /// Another with the same robot and configuration in another world, at its start; the time is the
  /// same. The arena has to be, too, for the situations are its grid's. Throws InvalidValue.
  Environment in(const World& world) const;

  /// Where the robot is, and all that else decides what it senses there: what a snapshot keeps.
  struct Place {
    Pose pose;      ///< its own [m, m, degrees]
    Pose estimate;  ///< the pose that odometry makes of its way; without noise, the same
    Random noise;   ///< from which what is sensed here, and the next motion, are spoiled
    /// So many sample times have passed, over all rounds.
    std::int64_t steps = 0;
  };
  /// All that changes from step to step.
  struct State {
    Place place;                      ///< where the robot is
    Observation here;                 ///< what is sensed; `allowed` is told by look()
    SituationId true_situation = -1;  ///< that of the pose; `here` has that of the estimate
    bool arrived = false;             ///< d_g <= goal_radius, of the pose
  };

  /// What came of a motion.
  struct Transition {
    State next;       ///< after it
    double smf;       ///< SMF = SEF(t+1) - SEF(t), Eq. 8
    Outcome outcome;  ///< what an agent learns from
  };

  /// Where the robot is.
  const State& state() const noexcept { return state_; }
  /// Likewise, its pose [m, m, degrees].
  const Pose& pose() const noexcept { return state_.place.pose; }
  /// The world's time, steps made so far x sample_time [s]: where its movers are.
  double time() const noexcept { return time_of(state_.place); }
  /// Whether it is at the target: d_g <= goal_radius.
  bool arrived() const noexcept { return state_.arrived; }
  /// What its sonars hear: sonar_count values [m], as Robot::sonar has them, spoiled by noise.
  std::vector<double> echoes() const { return heard(state_.place); }
  /// The same, filled in; `echoes` has room for sonar_count values.
  void echoes(double* echoes) const { hear(state_.place, echoes); }

  /// What an agent chooses by: what is sensed here, and what the robot can make of its motions. It
  /// is valid until the next call.
  const Observation& look();

  /// What would come of a motion, a function of state and motion alone; nothing is moved. Throws
  /// InvalidValue for a motion outside M; what functions of one's own throw comes out.
  Transition after(int motion) const;
  /// Likewise, of a sample time at constant wheel speeds (Robot::drive_wheels). Noise spoils their
  /// arc's turn and chord; where the robot slips, it makes a motion in their place.
  Transition after(const WheelSpeeds& speeds) const;
  /// What is sensed where the robot is put, which knows its pose then. Throws InvalidValue where it
  /// does not fit.
  State standing(const Pose& pose) const;
  /// Likewise, in the midst of a way.
  State standing(const Place& place) const;
  /// Goes on from a state of this environment, or of a twin.
  void enter(const State& state) noexcept { state_ = state; }

  ///@{
  /// What it was made of.
  const World& world() const noexcept { return fixed_->robot.world(); }
  const Robot& robot() const noexcept { return fixed_->robot; }
  /// The grid of config, whether or not its situations are used.
  const SituationGrid& grid() const noexcept { return fixed_->grid; }
  const TrialConfig& config() const noexcept { return fixed_->config; }
  const TrialParts& parts() const noexcept { return fixed_->parts; }
  ///@}

 private:
  // What never changes, and is checked once.
  struct Fixed {
    Fixed(const World& world, const TrialConfig& given, TrialParts own);
    void require_parts() const;

    TrialConfig config;
    Robot robot;
    SituationGrid grid;
    TrialParts parts;
  };

  // At the start.
  Environment(std::shared_ptr<const Fixed> fixed, const Random& noise, std::int64_t steps = 0);
  double time_of(const Place& place) const noexcept {
    return static_cast<double>(place.steps) * config().robot.sample_time;
  }
  template <typename Command>
  Transition transition(const Command& command) const;
  Robot::Move moved(int motion, Random& noise) const;
  Robot::Move moved(const WheelSpeeds& speeds, Random& noise) const;
  std::optional<int> slipped(Random& noise) const;
  Pose reckoned(const Pose& pose, Random& noise) const;
  State sensed(const Place& place) const;
  double clearance(const Place& place) const;
  void hear(const Place& place, double* echoes) const;
  std::vector<double> heard(const Place& place) const;
  Random noise_to_come() const noexcept;
  double distance_to_target(const Pose& pose) const noexcept;
  SituationId situation(const Senses& senses) const;
  double sef(const Senses& senses, SituationId situation) const;
  Outcome outcome_of(const State& next, double smf, bool collided) const;

  std::shared_ptr<const Fixed> fixed_;
  State state_;
  std::unique_ptr<bool[]> allowed_;  // a bool a motion
};

}  // namespace devlearn
