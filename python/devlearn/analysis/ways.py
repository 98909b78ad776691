"""How far it is to the target, from anywhere."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .._core import Robot
from ..errors import InvalidValue

_CELLS = 4  # along a step's drive; poses of one heading in one of them count as one
_SAMPLES = 4  # of a drive, where it is looked for what stands in the way
_MOST_HEADINGS = 360
_MOST_POSES = 2**28

Numbers = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]


class WayField:
    """The least steps to the target that the robot's own motions need, from every pose at once.

    A search by breadth, from the target backwards: a step is a turn and a drive straight on, so the
    poses before a pose lie one drive behind it. Those in one cell of a quarter of a drive with one
    heading count as one: a value may be a step or two off that of `devlearn.shortest_path`, a few
    more where the body fits narrowly.
    """

    def __init__(self, robot: Robot, *, headings: int = 12, goal_radius: float = 0.1) -> None:
        """``headings``: of the poses that will be asked for, multiples of 360 / headings degrees.

        goal_radius: of the target [m]. Raises InvalidValue where turns lead to more than 360
        headings, and for an arena of more than 2^28 such poses.
        """
        self._world, body = robot.world, robot.definition
        self._radius = body.radius
        self._drive = body.speed * body.sample_time
        self._headings = _headings(body.steering_angles, headings)
        turns = np.rint(np.array(body.steering_angles) * self._headings / 360)
        self._turns = np.unique(turns.astype(np.int64) % self._headings)
        self._cell = self._drive / _CELLS
        self._columns, self._rows = (
            int(side / self._cell) + 1 for side in (self._world.width, self._world.height)
        )
        poses = self._columns * self._rows * self._headings
        if poses > _MOST_POSES:
            raise InvalidValue(
                "poses of the arena", poses, f"at most {_MOST_POSES}: a smaller arena, longer steps"
            )
        self._steps = np.full(poses, -1, dtype=np.int32)
        self._search(goal_radius)

    def steps(self, x: npt.ArrayLike, y: npt.ArrayLike, heading: npt.ArrayLike) -> Numbers:
        """From poses ([m], [m], [degrees]), arrays of one shape; inf where there is no way."""
        bins = np.rint(np.asarray(heading) * self._headings / 360).astype(np.int64)
        places = self._places(np.asarray(x), np.asarray(y), bins % self._headings)
        steps = self._steps[places]
        return np.where(steps < 0, np.inf, steps)

    def _search(self, goal_radius: float) -> None:
        x, y, heading = self._at_target(goal_radius)
        angles = 2 * np.pi * np.arange(self._headings) / self._headings
        drives = self._drive * np.stack([np.cos(angles), np.sin(angles)])
        steps = 0
        while len(x):
            self._steps[self._places(x, y, heading)] = steps
            steps += 1
            x, y, heading = self._driven(x, y, heading, *drives[:, heading])
            # Whichever turn was made before the drive.
            x, y = np.repeat(x, len(self._turns)), np.repeat(y, len(self._turns))
            heading = (heading[:, None] - self._turns).ravel() % self._headings
            places = self._places(x, y, heading)
            new = np.flatnonzero(self._steps[places] < 0)
            new = new[np.unique(places[new], return_index=True)[1]]
            x, y, heading = x[new], y[new], heading[new]

    def _at_target(self, goal_radius: float) -> tuple[Numbers, Numbers, Indices]:
        """Where ways end: within the radius, in any heading."""
        reach = int(goal_radius / self._cell)
        offsets = self._cell * np.arange(-reach, reach + 1)
        dx, dy = (offset.ravel() for offset in np.meshgrid(offsets, offsets))
        x, y = self._world.target[0] + dx, self._world.target[1] + dy
        there = (np.hypot(dx, dy) <= goal_radius) & self._inside(x, y)
        there[there] = self._fits(x[there], y[there])
        x, y = x[there], y[there]
        return (
            np.repeat(x, self._headings),
            np.repeat(y, self._headings),
            np.tile(np.arange(self._headings), len(x)),
        )

    def _driven(
        self, x: Numbers, y: Numbers, heading: Indices, dx: Numbers, dy: Numbers
    ) -> tuple[Numbers, Numbers, Indices]:
        """Where drives to these poses began, and their headings; but for those that touch."""
        for part in np.arange(1, _SAMPLES + 1) / _SAMPLES:
            fits = self._fits(x - part * dx, y - part * dy)
            x, y, heading, dx, dy = x[fits], y[fits], heading[fits], dx[fits], dy[fits]
        return x - dx, y - dy, heading

    def _inside(self, x: Numbers, y: Numbers) -> npt.NDArray[np.bool_]:
        left, low = self._world.origin
        across = (x >= left) & (x <= left + self._world.width)
        return across & (y >= low) & (y <= low + self._world.height)

    def _fits(self, x: Numbers, y: Numbers) -> npt.NDArray[np.bool_]:
        """Where the body touches nothing."""
        return np.asarray(self._world.clearance(x, y, walls_count=True)) > self._radius

    def _places(self, x: Numbers, y: Numbers, heading: Indices) -> Indices:
        """Indices of poses."""
        left, low = self._world.origin
        column = np.clip((x - left) / self._cell, 0, self._columns - 1).astype(np.int64)
        row = np.clip((y - low) / self._cell, 0, self._rows - 1).astype(np.int64)
        return (row * self._columns + column) * self._headings + heading


def _headings(angles: Sequence[float], least: int) -> int:
    """How many headings there are, if a pose's is a multiple of 360 / ``least`` degrees."""
    for count in range(least, _MOST_HEADINGS + 1, least):
        turns = np.array(angles) * count / 360
        if np.allclose(turns, np.rint(turns), rtol=0, atol=1e-9):
            return count
    raise InvalidValue(
        "steering_angles", list(angles), f"turns that lead to at most {_MOST_HEADINGS} headings"
    )
