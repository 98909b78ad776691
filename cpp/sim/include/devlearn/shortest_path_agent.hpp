#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/robot.hpp"

namespace devlearn {

/// Follows the way that shortest_path finds from where the robot stands: with the map, the bound of
/// what can be learned without one. It keeps to one way, and plans anew where it is off that. At
/// the target it makes the first motion that touches nothing. Of movers it knows nothing: where one
/// pushed it off its way, it plans anew.
class ShortestPathAgent final : public Agent {
 public:
  /// In a state, and in files.
  static constexpr const char* kKind = "shortest_path";

  /// robot: as the trial's, in its world; without a safety margin, of which no plan knows.
  /// goal_radius: of the target, in (0, 100] m. Throws InvalidValue.
  explicit ShortestPathAgent(const Robot& robot, double goal_radius = 0.1);
  /// One that goes on from a state of its kind. Throws FileError, naming `source`.
  explicit ShortestPathAgent(const AgentState& state, const std::string& source = "state");
  /// For LoadOptions: that of a state of its kind, else null.
  static std::shared_ptr<Agent> maker(const AgentState& state);

  /// The motion that leads along the way. Throws InvalidValue where no way is found, where the
  /// motion is not allowed, for a pose where the body does not fit, or another motion_count.
  Choice choose(const Observation& observation) override;
  Development observe(const Outcome&) override { return {}; }
  std::optional<AgentState> state() const override;

  /// The robot that it plans for, in a world without movers.
  const Robot& robot() const noexcept { return robot_; }
  double goal_radius() const noexcept { return goal_radius_; }  ///< [m]

 private:
  int motion_to(const Pose& from, const Pose* to) const;

  Robot robot_;
  double goal_radius_;
  std::vector<Pose> way_;
};

}  // namespace devlearn
