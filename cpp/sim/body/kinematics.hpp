#pragma once

#include <optional>

#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/world.hpp"

// Eq. 1 and 2, and where nothing stands in the way of them.
namespace devlearn {

/// No step is longer [m].
constexpr double kLongestStep = 1.0;

/// How far a motion turns, counter-clockwise [degrees]. Throws InvalidValue for one outside M.
double steering_angle(const RobotDef& robot, int motion);
/// v t_s, how far a step drives [m].
double step_length(const RobotDef& robot) noexcept;

/// How far from everything free ways keep the body's centre, at the least [m].
double free_room(const RobotDef& robot) noexcept;

/// Eq. 1, the turn: the heading of the drive [degrees]. Throws InvalidValue for a motion outside M.
double heading_after(const RobotDef& robot, const Pose& pose, int motion);

/// Eq. 1, the drive: where so many metres lead with nothing in the way.
Pose driven(const Pose& pose, double heading, double length) noexcept;

/// Whether the body sweeps from a pose straight to another, `length` away, without coming so near
/// to anything that stands still that Box2D had a say.
bool way_is_free(const World& world, const RobotDef& robot, const Pose& from, const Pose& to,
                 double length) noexcept;

/// The next pose where the way to it is free of what stands still; nothing where it is not. Throws
/// InvalidValue for a motion outside M.
std::optional<Pose> free_step(const World& world, const RobotDef& robot, const Pose& pose,
                              int motion);

}  // namespace devlearn
