#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "devlearn/random.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"

namespace devlearn {

/// What shortest_path found.
struct ShortestPath {
  /// The lower bound where there is no way at all.
  static constexpr std::int64_t kNoWay = std::numeric_limits<std::int64_t>::max();

  /// From the start to the first within the goal's radius; empty where no way was found.
  std::vector<Pose> poses;
  /// No way has fewer steps; kNoWay where there is none.
  std::int64_t lower_bound = 0;

  /// Whether a way was found.
  bool found() const noexcept { return !poses.empty(); }
  /// Steps of the way; kNoWay where none was found.
  std::int64_t steps() const noexcept {
    return found() ? static_cast<std::int64_t>(poses.size()) - 1 : kNoWay;
  }
  /// Whether that is known to be the least, or that there is no way.
  bool exact() const noexcept { return steps() == lower_bound; }
};

/// The shortest way, in steps, that the robot's own motions allow from a pose to the target
/// without touching anything that stands still: what a learnt path is measured against. Of movers
/// it knows nothing. goal_radius: of the target, in (0, 100] m.
///
/// First a grid of at most 2^22 cells over the arena is flooded from the target, through every cell
/// that may hold a place where the body fits: what that does not reach has no way. Then A* goes
/// over poses, of which those in one cell of a quarter step with one heading [degrees] count as
/// one; `exact` is meant up to that, so a way could in rare cases be a step shorter still. Where A*
/// has not ended after 2^22 poses (an arena of some 10 m among obstacles, or 100 m in the open),
/// its lower bound is kept, and a search that follows the flood's distances, for as many poses
/// again, finds a way that may be longer than the shortest, mostly by a few per cent. Where that
/// finds none either, it is open whether there is one. So an arena of any size takes seconds, and
/// less than 1 GB.
///
/// `interrupt` is called every now and then; where it returns true the search ends with what it
/// knows. Throws InvalidValue for a start where the body does not fit.
ShortestPath shortest_path(const Robot& robot, const Pose& start, double goal_radius = 0.1,
                           const std::function<bool()>& interrupt = {});

/// Whether a body of that size may get from a pose to within goal_radius of the target, by motions
/// of any kind: the flood of shortest_path alone. False is certain; true up to the flood's cells,
/// half a step or a 2048th of the arena, and to what the robot's motions allow. Throws InvalidValue
/// as shortest_path does.
bool may_reach_target(const Robot& robot, const Pose& start, double goal_radius = 0.1);

/// The places from which a body of that size may get to the target, as may_reach_target has it,
/// found once for all: what starts are drawn from.
class StartPlaces {
 public:
  /// Takes as long as may_reach_target at worst. Throws InvalidValue for a goal_radius outside
  /// (0, 100] m, and where there is no such place.
  explicit StartPlaces(const Robot& robot, double goal_radius = 0.1);

  /// A pose drawn evenly over these places, but for the target's surroundings of goal_radius, and
  /// over all headings. The body fits there and touches nothing, movers at that time [s] included;
  /// where they leave no such place, it is the world's start.
  Pose draw(Random& random, double time = 0.0) const;

 private:
  World world_;
  double goal_radius_, room_, cell_;
  std::vector<Point> corners_;  // of the flood's cells in whose middle the body fits: of least x, y
};

}  // namespace devlearn
