#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "body/drive.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/math.hpp"
#include "devlearn/trial.hpp"
#include "world/geometry.hpp"

// The rules of world, robot and trial without any rejection test or shortcut: everything is looked
// at every time, and whatever is not free goes through a Box2D world.
namespace plain {

using namespace devlearn;

/// Calls f(first, last) for each polygon's and rectangle's edges.
template <typename F>
void for_each_outline(const World& world, F f) {
  const std::vector<World::Edge>& edges = world.edges();
  for (std::size_t first = 4, i = 4; i < edges.size(); ++i) {
    if (!(edges[i].b == edges[first].a)) continue;
    f(edges.begin() + static_cast<std::ptrdiff_t>(first),
      edges.begin() + static_cast<std::ptrdiff_t>(i + 1));
    first = i + 1;
  }
}

inline bool inside_outline(const World& world, Point p) {
  bool inside_any = false;
  for_each_outline(world, [&](auto first, auto last) {
    bool inside = false;
    for (auto edge = first; edge != last; ++edge) {
      const Point a = edge->a, b = edge->b;
      if ((a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0.0) == (b.y > a.y)) {
        inside = !inside;
      }
    }
    inside_any |= inside;
  });
  return inside_any;
}

inline double wall_distance(const World& world, Point p) {
  return std::max(0.0, std::min({p.x, world.def().width - p.x, p.y, world.def().height - p.y}));
}

inline double clearance(const World& world, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 4; i < world.edges().size(); ++i) {
    const World::Edge& edge = world.edges()[i];
    least = std::min(least, std::sqrt(squared_distance(p, edge.a, edge.b)));
  }
  for (const Circle& circle : world.circles()) {
    least = std::min(least, std::max(0.0, distance(p, circle.center) - circle.radius));
  }
  return inside_outline(world, p) ? 0.0 : least;
}

inline double swept_clearance(const World& world, Point p, Point q) {
  double least = std::min(wall_distance(world, p), wall_distance(world, q));
  for (std::size_t i = 4; i < world.edges().size(); ++i) {
    least = std::min(least, swept_distance(world.edges()[i], p, q));
  }
  for (const Circle& circle : world.circles()) {
    least = std::min(least, swept_distance(circle, p, q));
  }
  return inside_outline(world, p) ? 0.0 : least;
}

inline World::Surroundings around(const World& world, Point p, double reach) {
  World::Surroundings near;
  for (const World::Edge& edge : world.edges()) {
    if (squared_distance(p, edge.a, edge.b) <= reach * reach) near.edges.push_back(edge);
  }
  for (const Circle& circle : world.circles()) {
    if (distance(p, circle.center) - circle.radius <= reach) near.circles.push_back(circle);
  }
  return near;
}

inline Robot::Step step(const Robot& robot, const Pose& pose, int motion) {
  const World& world = robot.world();
  const RobotDef& def = robot.def();
  const Point from{pose.x, pose.y};
  const double heading =
      wrapped_heading(pose.heading + def.steering_angles[static_cast<std::size_t>(motion)]);
  const Direction ahead = direction(heading);
  const double length = def.speed * def.sample_time;
  const Point straight{pose.x + length * ahead.x, pose.y + length * ahead.y};
  const auto ended = [&](Point at, bool collided) {
    return Robot::Step{{at.x, at.y, heading}, collided, clearance(world, at)};
  };

  if (swept_clearance(world, from, straight) > def.radius + 0.0105) return ended(straight, false);
  for (const auto& [rounds, depth] : {std::pair{kFewRounds, 0.0035}, {kManyRounds, 0.005}}) {
    const Drive drive = drive_in_box2d(around(world, from, reach_of(def)), def, from, heading,
                                       substeps_of(def), rounds);
    const Robot::Step end =
        ended(drive.touched ? Point{pose.x + drive.moved.x, pose.y + drive.moved.y} : straight,
              drive.touched);
    const Point at{end.pose.x, end.pose.y};
    if (std::min(end.clearance, wall_distance(world, at)) >= def.radius - depth) return end;
  }
  return ended(from, true);
}

/// Free learning of the paper's learner.
inline Record free_learning(const World& world, const TrialConfig& config, std::uint64_t seed,
                            int steps) {
  const Robot robot(world, config.robot);
  const Trial trial(world, config, seed);  // for its grid
  Learner learner(config.learner, seed);
  const Point target = world.def().target;
  const auto sef = [&](const Pose& pose, double to_obstacles) {
    return config.evaluation(std::sqrt((pose.x - target.x) * (pose.x - target.x) +
                                       (pose.y - target.y) * (pose.y - target.y)),
                             to_obstacles);
  };
  Record record;
  Pose pose = world.def().start;
  double before = sef(pose, clearance(world, {pose.x, pose.y}));
  record.begin_round(1, pose);
  for (int i = 0; i < steps; ++i) {
    StepRecord row;
    row.situation = trial.grid().situation(pose.x, pose.y, pose.heading);
    row.motion = learner.choose(row.situation).motion;
    const Robot::Step moved = step(robot, pose, row.motion);
    row.sef = sef(moved.pose, moved.clearance);
    row.smf = row.sef - before;
    row.smf_used = moved.collided ? std::min(row.smf, -1.0) : row.smf;
    row.collided = moved.collided;
    row.clearance = moved.clearance;
    row.event = learner.learn(row.smf_used).event;
    row.pose = pose = moved.pose;
    record.append(row);
    before = row.sef;
  }
  return record;
}

}  // namespace plain
