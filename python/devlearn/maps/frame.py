"""How a map's image lies in the map's frame, which is the world's."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt
import shapely

from ..errors import FileError

# What a world takes (docs/world-format.md): as an arena, and of a polygon [m, m^2].
LEAST_ARENA, GREATEST_ARENA = 0.5, 1000.0
LEAST_SIDE, LEAST_AREA = 0.01, 1e-4

Numbers = npt.NDArray[np.float64]
Shapes = npt.NDArray[np.object_]  # of Shapely


@dataclass(frozen=True)
class Frame:
    """How an image lies in its map: metres along its edges from its lower left corner, turned."""

    sides: tuple[float, float]  # of the image [m]
    origin: Numbers
    turn: Numbers  # of row vectors along the image's axes to those along the map's

    @classmethod
    def of(
        cls,
        path: str,
        columns: int,
        rows: int,
        resolution: float,
        origin: tuple[float, float, float],
    ) -> Frame:
        """Of so many cells [m] from an origin (x, y, yaw) on [m, m, rad]."""
        x, y, yaw = origin
        along, across = math.cos(yaw), math.sin(yaw)
        turn = np.array([[along, across], [-across, along]])
        frame = cls((columns * resolution, rows * resolution), np.array([x, y]), turn)
        if not all(LEAST_ARENA <= side <= GREATEST_ARENA for side in frame.size):
            width, height = frame.size
            raise FileError(
                path,
                "resolution",
                f"{resolution:g} m, an arena of {width:g} m x {height:g} m",
                f"{LEAST_ARENA:g} to {GREATEST_ARENA:g} m each way",
            )
        return frame

    @cached_property
    def _corners(self) -> Numbers:
        """Of the image, counter-clockwise, turned but not moved."""
        width, height = self.sides
        return np.array([[0, 0], [width, 0], [width, height], [0, height]]) @ self.turn

    @property
    def size(self) -> tuple[float, float]:
        """Of the arena, the rectangle around the image [m]."""
        width, height = np.ptp(self._corners, axis=0).tolist()
        return width, height

    @property
    def low(self) -> tuple[float, float]:
        """The arena's corner of least x and y [m]."""
        x, y = (self.origin + self._corners.min(axis=0)).tolist()
        return x, y

    def points_to_map(self, points: Numbers) -> Numbers:
        """(n, 2), along the image's edges from its lower left corner [m], in the map."""
        return self.origin + points @ self.turn

    def to_map(self, shapes: Shapes) -> Shapes:
        """The same of shapes."""
        return np.asarray(shapely.transform(shapes, self.points_to_map), dtype=object)

    def beyond(self) -> Shapes:
        """What of the arena lies outside of the image: a triangle at each side of a turned one."""
        found = []
        for a, b in zip(self._corners, np.roll(self._corners, -1, axis=0)):
            (dx, dy) = b - a
            if min(abs(dx), abs(dy)) < LEAST_SIDE or abs(dx * dy) / 2 < LEAST_AREA:
                continue
            # The image lies on the left of its side.
            corner = (b[0], a[1]) if dx * dy > 0 else (a[0], b[1])
            found.append(shapely.Polygon(self.origin + np.array([a, corner, b])))
        return np.array(found, dtype=object)
