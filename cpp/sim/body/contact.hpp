#pragma once

#include <box2d/box2d.h>

#include <vector>

#include "body/moving_shape.hpp"
#include "devlearn/robot.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/world.hpp"
#include "world/geometry.hpp"
#include "world/movers.hpp"

// How a drive comes out where there is something to touch, as Box2D has it.
namespace devlearn {

/// Velocity iterations of Box2D's solver: few do, but not where surfaces wedge the body.
constexpr int kFewIterations = 8, kManyIterations = 60;
/// Its position iterations.
constexpr int kPositionIterations = 3;

/// A drive in Box2D's terms, its origin where the body begins: the outcome depends on nothing that
/// happened before.
struct Scene {
  /// Of all that a body at a pose can touch within a step along a heading [m/s].
  Scene(const World& world, const RobotDef& robot, const Pose& pose, double heading, double speed,
        const TimeSpan& step);

  /// What goes straight and evenly all through the step, and is not held up by anything.
  struct Moving {
    MovingShape shape;
    b2Vec2 place, velocity;
  };

  /// f(i, shape) of all that stands still: edges, then circles.
  template <typename F>
  void for_each_surface(const F& f) const {
    std::size_t i = 0;
    for (const b2EdgeShape& edge : edges) f(i++, edge);
    for (const b2CircleShape& circle : circles) f(i++, circle);
  }
  /// Whether the way p-q leads through an edge from its front.
  bool passes(b2Vec2 p, b2Vec2 q) const;

  std::vector<b2EdgeShape> edges;
  std::vector<b2CircleShape> circles;
  std::vector<b2AABB> bounds;  // of edges, then circles
  std::vector<Moving> movers;
  b2CircleShape body;
  b2Vec2 velocity;
  int substeps;     // so many that none leads deeper than Box2D's slop
  float substep;    // [s]
  double furthest;  // how far from where it began the body can come among these [m]

  static constexpr float kDensity = 1.0f;  // of the body; no outcome depends on it

 private:
  double add_movers(const Movers& all, Point from, double reach, const TimeSpan& step);
  void add(const Edge& edge, Point from, double reach);
  void add(const Circle& circle, Point from, double reach);
};

struct Drive {
  Point moved;           ///< from where it began
  bool touched = false;  ///< anything, at any time
  bool passed = false;   ///< its centre, through an edge
  /// Where it was after each substep, from where it began: of a scene in which something moves.
  std::vector<Point> trail = {};
};

/// To be called before any drive, from any thread. Box2D keeps a table of kinds of contacts in a
/// global, which the first contact of the process fills; no other global is written by what is used
/// of it: its counters are those of distances and of continuous collision, which nothing here has.
void prepare_box2d();

/// Drives in a Box2D world of its own. In several threads at once, after prepare_box2d().
Drive drive_in_box2d(const Scene& scene, int iterations);

}  // namespace devlearn
