"""Worlds and starts that section VI draws by chance, once and for all."""

from __future__ import annotations

import math

import numpy as np

from .._core import (
    Circle,
    Polygon,
    Random,
    Rectangle,
    Robot,
    TrialConfig,
    World,
    shortest_path,
)
from .._types import Pose
from ..errors import InvalidValue


def new_starts(world: World, config: TrialConfig, count: int = 8) -> list[tuple[Pose, int]]:
    """New start poses for the learning-ability test, each with the steps of its shortest path.

    Uniform over the places with 0.05 m of room, at least 1.5 m from target and start, on headings
    of the grid; the same for a world at every call. Raises InvalidValue for a world without room.
    """
    random = Random(0, "starts")
    robot = Robot(world, config.robot)
    starts: list[tuple[Pose, int]] = []
    for _ in range(1000 * count):
        x, y = random.uniform() * world.width, random.uniform() * world.height
        heading = random.index(config.heading_bins) * 360.0 / config.heading_bins
        if world.clearance(x, y, walls_count=True) < config.robot.radius + 0.05:
            continue
        if min(math.dist((x, y), world.target), math.dist((x, y), world.start[:2])) < 1.5:
            continue
        way = shortest_path(robot, (x, y, heading), config.goal_radius)
        if len(way) > 1:
            starts.append((Pose(x, y, heading), len(way) - 1))
            if len(starts) == count:
                return starts
    raise InvalidValue("world", f"{len(starts)} new starts", f"room for {count}, far from target")


def similar_world(index: int) -> World:
    """A random world like that of Fig. 2: eight obstacles of its sizes, elsewhere.

    They keep 0.35 m from each other, so that there is a way everywhere, and off start and target.
    """
    paper = World.load("paper")
    random = Random(index, "similar world")
    sizes = [_bounding_radius(obstacle) for obstacle in paper.obstacles]
    places: list[tuple[float, float, float]] = [
        (*paper.start[:2], 0.2),
        (*paper.target, 0.2),
    ]
    obstacles: list[Circle | Rectangle | Polygon] = []
    for obstacle, size in zip(paper.obstacles, sizes):
        while True:
            x, y = random.uniform() * paper.width, random.uniform() * paper.height
            if all(math.dist((x, y), p[:2]) >= size + p[2] + 0.35 for p in places):
                break
        places.append((x, y, size))
        obstacles.append(_moved(obstacle, x, y, random.uniform() * 360.0))
    return World(
        paper.width,
        paper.height,
        paper.start,
        paper.target,
        obstacles,
        name=f"similar {index}",
        description="Eight obstacles with the sizes of the paper's, placed at random.",
    )


def _centre(obstacle: Circle | Rectangle | Polygon) -> tuple[float, float]:
    if isinstance(obstacle, Polygon):
        x, y = np.mean(obstacle.corners, axis=0)
        return float(x), float(y)
    return obstacle.center


def _bounding_radius(obstacle: Circle | Rectangle | Polygon) -> float:
    if isinstance(obstacle, Circle):
        return obstacle.radius
    if isinstance(obstacle, Rectangle):
        return math.hypot(*obstacle.size) / 2
    return max(math.dist(corner, _centre(obstacle)) for corner in obstacle.corners)


def _moved(
    obstacle: Circle | Rectangle | Polygon, x: float, y: float, angle: float
) -> Circle | Rectangle | Polygon:
    if isinstance(obstacle, Circle):
        return Circle((x, y), obstacle.radius)
    if isinstance(obstacle, Rectangle):
        return Rectangle((x, y), obstacle.size, obstacle.angle + angle)
    from_x, from_y = _centre(obstacle)
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return Polygon(
        [
            (
                x + cos * (cx - from_x) - sin * (cy - from_y),
                y + sin * (cx - from_x) + cos * (cy - from_y),
            )
            for cx, cy in obstacle.corners
        ]
    )
