"""Outlines of obstacles, as points: for whoever draws lines only."""

from __future__ import annotations

import math
from typing import Union, cast

import numpy as np
import numpy.typing as npt

from .._core import Circle, Mover, MoverPath, Polygon, Polyline, Rectangle

Obstacle = Union[Circle, Rectangle, Polygon, Polyline]
Points = npt.NDArray[np.float64]

_AROUND = 48  # points on a circle


def corners(rectangle: Rectangle) -> Points:
    """Its four, counter-clockwise: (4, 2) [m]."""
    half = np.array(rectangle.size, dtype=float) / 2
    apart = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
    angle = math.radians(rectangle.angle)
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    return cast(Points, apart @ turn + np.array(rectangle.center))


def circle(radius: float, center: tuple[float, float] = (0.0, 0.0)) -> Points:
    """A circle as a closed line: (49, 2) [m]."""
    angles = np.linspace(0, 2 * np.pi, _AROUND + 1)
    around = np.column_stack([np.cos(angles), np.sin(angles)])
    return cast(Points, around * radius + np.array(center))


def outlines(obstacle: Obstacle) -> list[Points]:
    """Lines of points, each (n, 2) [m]: closed ones, a polygon's holes after it, or a wall."""
    if isinstance(obstacle, Circle):
        return [circle(obstacle.radius, (obstacle.center[0], obstacle.center[1]))]
    if isinstance(obstacle, Polyline):
        return [np.array(obstacle.points, dtype=float)]
    if isinstance(obstacle, Rectangle):
        return [_closed(corners(obstacle))]
    return [_closed(np.array(ring, dtype=float)) for ring in (obstacle.corners, *obstacle.holes)]


def course(mover: Mover) -> Points:
    """Where its centre goes, (n, 2) [m]: its path, or the box of its walk."""
    way = mover.course
    if isinstance(way, MoverPath):
        points = np.array(way.points, dtype=float)
        return _closed(points) if way.then == "around" else points
    (x, y), (right, top) = way.low, way.high
    return _closed(np.array([(x, y), (right, y), (right, top), (x, top)]))


def _closed(ring: Points) -> Points:
    return np.concatenate([ring, ring[:1]])
