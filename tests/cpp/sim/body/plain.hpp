#pragma once

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "devlearn/learner.hpp"
#include "devlearn/math.hpp"
#include "devlearn/trial.hpp"
#include "world/geometry.hpp"
#include "world/surfaces.hpp"

// The rules of world, robot and trial without any rejection test or shortcut: everything is looked
// at every time, and whatever is not free goes through a Box2D world. The numbers of these rules
// stand here a second time, so that a slip in the product's shows.
namespace plain {

using namespace devlearn;

/// Calls f(first, last) for each polygon's and rectangle's edges.
template <typename F>
void for_each_outline(const World& world, F f) {
  auto first = world.surfaces().edges().begin() + 4;
  for (const Obstacle& obstacle : world.def().obstacles) {
    std::size_t count = std::holds_alternative<Rectangle>(obstacle) ? 4 : 0;
    if (const auto* polygon = std::get_if<Polygon>(&obstacle)) {
      count = polygon->corners.size();
      for (const auto& hole : polygon->holes) count += hole.size();
    }
    if (count == 0) continue;
    const auto last = first + static_cast<std::ptrdiff_t>(count);
    f(first, last);
    first = last;
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
  for (std::size_t i = 4; i < world.surfaces().edges().size(); ++i) {
    const Edge& edge = world.surfaces().edges()[i];
    least = std::min(least, std::sqrt(squared_distance(p, edge.a, edge.b)));
  }
  for (const Circle& circle : world.surfaces().circles()) {
    least = std::min(least, std::max(0.0, distance(p, circle.center) - circle.radius));
  }
  return inside_outline(world, p) ? 0.0 : least;
}

inline double swept_clearance(const World& world, Point p, Point q) {
  double least = std::min(wall_distance(world, p), wall_distance(world, q));
  for (std::size_t i = 4; i < world.surfaces().edges().size(); ++i) {
    least = std::min(least, swept_distance(world.surfaces().edges()[i], p, q));
  }
  for (const Circle& circle : world.surfaces().circles()) {
    least = std::min(least, swept_distance(circle, p, q));
  }
  return inside_outline(world, p) ? 0.0 : least;
}

/// What is near a point.
struct Surroundings {
  std::vector<Edge> edges;
  std::vector<Circle> circles;
  void add(const Edge& edge) { edges.push_back(edge); }
  void add(const Circle& circle) { circles.push_back(circle); }
};

inline Surroundings around(const World& world, Point p, double reach) {
  Surroundings near;
  for (const Edge& edge : world.surfaces().edges()) {
    if (squared_distance(p, edge.a, edge.b) <= reach * reach) near.edges.push_back(edge);
  }
  for (const Circle& circle : world.surfaces().circles()) {
    if (distance(p, circle.center) - circle.radius <= reach) near.circles.push_back(circle);
  }
  return near;
}

/// How a drive came out.
struct Drive {
  Point moved;
  bool touched = false;
  bool passed = false;
};

/// Whether a body's centre on its way p-q goes in at an edge's right and out at its left.
inline bool passes(Point p, Point q, const Edge& edge) {
  const Point side = edge.b - edge.a;
  const double from = cross(side, p - edge.a), to = cross(side, q - edge.a);
  if (from > 0.0 || to <= 0.0) return false;
  const double at = dot(side, along(p, q - p, from / (from - to)) - edge.a);
  return at >= 0.0 && at <= dot(side, side);
}

/// Drives in a Box2D world, its origin where the body begins, of what is near.
inline Drive drive(const Surroundings& near, const RobotDef& robot, Point from, double heading,
                   int substeps, int iterations) {
  const auto local = [&](Point p) {
    return b2Vec2(static_cast<float>(p.x - from.x), static_cast<float>(p.y - from.y));
  };
  b2World physics(b2Vec2(0.0f, 0.0f));
  physics.SetAllowSleeping(false);
  physics.SetWarmStarting(false);
  physics.SetContinuousPhysics(false);
  const b2BodyDef ground_def;
  b2Body* ground = physics.CreateBody(&ground_def);
  b2FixtureDef smooth;
  smooth.friction = 0.0f;
  for (Edge edge : near.edges) {
    // No more of it than lies within this of the start [m], for the sake of floats.
    const double kept = robot.radius + robot.speed * robot.sample_time + 1.05;
    const double length = distance(edge.a, edge.b);
    const Point unit{(edge.b.x - edge.a.x) / length, (edge.b.y - edge.a.y) / length};
    const double foot = dot(from - edge.a, unit), aside = cross(unit, from - edge.a);
    const double half = std::sqrt(std::max(0.0, kept * kept - aside * aside));
    const Point begin = edge.a;
    const bool begins_wall = edge.before == edge.b, ends_wall = edge.after == edge.a;
    if (foot > half) {
      edge.a = along(begin, unit, foot - half);
      edge.before = along(edge.a, unit, -1.0);
    }
    if (foot + half < length) {
      edge.b = along(begin, unit, foot + half);
      edge.after = along(edge.b, unit, 1.0);
    }
    if ((begins_wall && foot <= half) || (ends_wall && foot + half >= length)) {
      // The last micrometre of a thin wall's end is on both of its sides.
      for (Point* p : {&edge.a, &edge.b}) *p = {p->x - 1e-6 * unit.y, p->y + 1e-6 * unit.x};
    }
    b2EdgeShape shape;
    shape.SetOneSided(local(edge.before), local(edge.a), local(edge.b), local(edge.after));
    smooth.shape = &shape;
    ground->CreateFixture(&smooth);
  }
  for (const Circle& circle : near.circles) {
    b2CircleShape shape;
    shape.m_p = local(circle.center);
    shape.m_radius = static_cast<float>(circle.radius);
    smooth.shape = &shape;
    ground->CreateFixture(&smooth);
  }
  b2BodyDef body_def;
  body_def.type = b2_dynamicBody;
  body_def.fixedRotation = true;
  const Direction ahead = direction(heading);
  body_def.linearVelocity =
      b2Vec2(static_cast<float>(robot.speed * ahead.x), static_cast<float>(robot.speed * ahead.y));
  b2Body* body = physics.CreateBody(&body_def);
  b2CircleShape disc;
  disc.m_radius = static_cast<float>(robot.radius);
  smooth.shape = &disc;
  smooth.density = 1.0f;
  body->CreateFixture(&smooth);

  Drive drive;
  for (int i = 0; i < substeps; ++i) {
    const b2Vec2 before = body->GetPosition();
    physics.Step(static_cast<float>(robot.sample_time / substeps), iterations, 3);
    const auto global = [&](b2Vec2 v) { return Point{from.x + v.x, from.y + v.y}; };
    for (const Edge& edge : near.edges) {
      drive.passed |= passes(global(before), global(body->GetPosition()), edge);
    }
    for (const b2ContactEdge* c = body->GetContactList(); c != nullptr; c = c->next) {
      drive.touched = drive.touched || c->contact->IsTouching();
    }
  }
  drive.moved = {body->GetPosition().x, body->GetPosition().y};
  return drive;
}

inline double heading_after(const Robot& robot, const Pose& pose, int motion) {
  return wrapped_heading(pose.heading +
                         robot.def().steering_angles[static_cast<std::size_t>(motion)]);
}

/// What a robot drives against within a step.
inline Surroundings within_reach(const Robot& robot, Point from) {
  const RobotDef& def = robot.def();
  return around(robot.world(), from, def.radius + def.speed * def.sample_time + 0.05);
}

/// A step with Box2D all the way, free or not.
inline Robot::Move simulated(const Robot& robot, const Pose& pose, int motion, int substeps = 15) {
  const double heading = heading_after(robot, pose, motion);
  const Point from{pose.x, pose.y};
  const Drive end = drive(within_reach(robot, from), robot.def(), from, heading, substeps, 8);
  return {{pose.x + end.moved.x, pose.y + end.moved.y, heading}, end.touched};
}

inline Robot::Move step(const Robot& robot, const Pose& pose, int motion) {
  const World& world = robot.world();
  const RobotDef& def = robot.def();
  const Point from{pose.x, pose.y};
  const double heading = heading_after(robot, pose, motion);
  const Direction ahead = direction(heading);
  const double length = def.speed * def.sample_time;
  const Pose straight{pose.x + length * ahead.x, pose.y + length * ahead.y, heading};

  if (swept_clearance(world, from, {straight.x, straight.y}) > def.radius + 0.0105) {
    return {straight, false};
  }
  const int substeps = std::max(15, static_cast<int>(std::ceil(length / 0.0034)));
  for (const auto& [iterations, depth] : {std::pair{8, 0.0035}, {60, 0.005}}) {
    const Drive end = drive(within_reach(robot, from), def, from, heading, substeps, iterations);
    const Pose at =
        end.touched ? Pose{pose.x + end.moved.x, pose.y + end.moved.y, heading} : straight;
    const double room =
        std::min(clearance(world, {at.x, at.y}), wall_distance(world, {at.x, at.y}));
    if (!end.passed && room >= def.radius - depth) return {at, end.touched};
  }
  return {{from.x, from.y, heading}, true};
}

/// Free learning of the paper's learner.
inline Record free_learning(const World& world, const TrialConfig& config, std::uint64_t seed,
                            int steps) {
  const Robot robot(world, config.robot);
  const Trial trial(world, config, seed);  // for its grid
  Learner learner(std::get<LearnerConfig>(config.learner), seed);
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
    Step row;
    row.situation = trial.grid().situation(pose.x, pose.y, pose.heading);
    row.motion = learner.choose(row.situation).motion;
    const Robot::Move moved = step(robot, pose, row.motion);
    row.clearance = clearance(world, {moved.pose.x, moved.pose.y});
    row.sef = sef(moved.pose, row.clearance);
    row.smf = row.sef - before;
    row.smf_used = moved.collided ? std::min(row.smf, -1.0) : row.smf;
    row.collided = moved.collided;
    row.event = learner.learn(row.smf_used).event;
    row.pose = pose = moved.pose;
    record.append(row);
    before = row.sef;
  }
  return record;
}

}  // namespace plain
