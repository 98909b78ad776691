#pragma once

#include <optional>

#include "devlearn/robot.hpp"
#include "devlearn/world.hpp"
#include "world/surfaces.hpp"

// How a drive along surfaces comes out, as Box2D has it.
namespace devlearn {

/// The least number of parts of a drive so short that none goes deeper than Box2D's slop.
int substeps_of(const RobotDef& robot);

/// Velocity iterations of Box2D's solver: few do, but not where surfaces wedge the body.
constexpr int kFewIterations = 8, kManyIterations = 60;

struct Drive {
  Point moved;           ///< from where it began
  bool touched = false;  ///< anything, at any time
};

/// How far from where a drive begins something may lie that it touches [m].
double reach_of(const RobotDef& robot);

/// Drives from a point along a heading, in a Box2D world of its own that is made of what is near
/// (Surfaces::around that point, up to reach_of): the outcome depends on nothing that happened
/// before.
Drive drive_in_box2d(const Surroundings& near, const RobotDef& robot, Point from, double heading,
                     int substeps, int iterations);

/// The same to the bit, by Box2D's own arithmetic for one disc that does not turn, without its
/// bookkeeping. Nothing where the body touches several things at once so far from where it began
/// that Box2D may have sorted them anew.
std::optional<Drive> drive_directly(const Surroundings& near, const RobotDef& robot, Point from,
                                    double heading, int substeps, int iterations);

}  // namespace devlearn
