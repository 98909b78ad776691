#pragma once

#include <optional>

#include "sim/world/random_worlds.hpp"

// Movers to state laws on.

inline devlearn::Mover random_mover(devlearn::Random& random, double side) {
  using devlearn::MoverPath;
  devlearn::Mover mover;
  const double size = between(random, 0.05, 0.4);
  if (random.index(2) == 0) {
    mover.shape = devlearn::Circle{{}, size};
  } else {
    mover.shape = devlearn::Rectangle{
        {}, 2.0 * size, between(random, 0.02, 2.0 * size), between(random, -180.0, 180.0)};
  }
  if (random.index(2) == 0) {
    MoverPath path;
    const auto count = 2 + random.index(4);
    for (unsigned i = 0; i < count; ++i) path.points.push_back(point_in(random, side));
    path.speed = between(random, 0.01, 1.0);
    path.then = static_cast<MoverPath::Then>(random.index(3));
    mover.course = path;
  } else {
    const devlearn::Point a = point_in(random, side), b = point_in(random, side);
    devlearn::MoverWalk walk;
    walk.seed = random.next();
    walk.low = {std::min(a.x, b.x), std::min(a.y, b.y)};
    walk.high = {std::max(a.x, b.x), std::max(a.y, b.y)};
    walk.leg_time = between(random, 1.5, 6.0) * side;
    mover.course = walk;
  }
  return mover;
}

/// A square world of obstacles and movers, which may come anywhere but to the start.
inline devlearn::World random_moving_world(devlearn::Random& random, int obstacles, int movers,
                                           double side) {
  while (true) {
    devlearn::WorldDef def = random_world(random, obstacles, side).def();
    for (int i = 0; i < movers; ++i) def.movers.push_back(random_mover(random, side));
    try {
      return devlearn::World(def);
    } catch (const devlearn::InvalidValue&) {  // a course over the start
    }
  }
}

/// Of a mover where it is.
inline devlearn::Point centre_of(const devlearn::Obstacle& there) {
  if (const auto* circle = std::get_if<devlearn::Circle>(&there)) return circle->center;
  return std::get<devlearn::Rectangle>(there).center;
}

/// What a world is at a time, if nothing moved.
inline devlearn::World frozen(const devlearn::World& world, double time) {
  devlearn::WorldDef def = world.standing().def();
  for (const devlearn::Obstacle& there : world.movers_at(time)) def.obstacles.push_back(there);
  return devlearn::World(def);
}
