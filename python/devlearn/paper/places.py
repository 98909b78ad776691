"""Starts that section VI draws by chance, once and for all."""

from __future__ import annotations

import math

from .._core import Random, Robot, TrialConfig, World, shortest_path
from .._types import Pose
from ..errors import InvalidValue


def shortest(world: World, config: TrialConfig) -> int:
    """Steps of the shortest path from the world's start; InvalidValue where there is none."""
    path = shortest_path(Robot(world, config.robot), goal_radius=config.goal_radius)
    if path.steps is None:
        raise InvalidValue("world", "no way to the target", "a target that the robot can reach")
    return path.steps


def new_starts(world: World, config: TrialConfig, count: int = 8) -> list[tuple[Pose, int]]:
    """New start poses for the learning-ability test, each with the steps of its shortest path.

    Uniform over the places with 0.05 m of room, at least 1.5 m from target and start, on headings
    of the grid; the same for a world at every call. Raises InvalidValue for a world without room.
    """
    random = Random(0, "starts")
    robot = Robot(world, config.robot)
    starts: list[tuple[Pose, int]] = []
    for _ in range(1000 * count):
        x = world.origin[0] + random.uniform() * world.width
        y = world.origin[1] + random.uniform() * world.height
        heading = random.index(config.heading_bins) * 360.0 / config.heading_bins
        if world.clearance(x, y, walls_count=True) < config.robot.radius + 0.05:
            continue
        if min(math.dist((x, y), world.target), math.dist((x, y), world.start[:2])) < 1.5:
            continue
        steps = shortest_path(robot, (x, y, heading), config.goal_radius).steps
        if steps:
            starts.append((Pose(x, y, heading), steps))
            if len(starts) == count:
                return starts
    raise InvalidValue("world", f"{len(starts)} new starts", f"room for {count}, far from target")
