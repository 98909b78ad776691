#pragma once

#include <vector>

#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// The shortest way, in steps, that the robot's own motions allow from a pose to the target
/// without touching anything: what a learnt path is measured against.
///
/// A search by A* over poses, of which those in one cell of a quarter step with one heading
/// [degrees] count as one; so a way could in rare cases be a step shorter still. goal_radius: of
/// the target, in (0, 100] m.
/// Returns the poses, from `start` to the first within goal_radius; empty where there is no way.
/// Throws InvalidValue for a start where the body does not fit, or a world of more than 10^9 cells.
std::vector<Pose> shortest_path(const Robot& robot, const Pose& start, double goal_radius = 0.1);

}  // namespace devlearn
