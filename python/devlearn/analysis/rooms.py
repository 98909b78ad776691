"""What of a world a body fits in, and the gaps that it does not fit through."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .._core import World

_MOST_CELLS = 1 << 22
_CELLS = 8  # along the body's diameter, where the arena has no more than so many in all

Numbers = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]


@dataclass(frozen=True)
class Gap:
    """What parts rooms: a passage too narrow for the body."""

    width: float
    """Up to a cell's side [m]."""
    place: tuple[float, float]
    """(x, y) [m]."""


class Rooms:
    """The regions of a world that a body fits in, and the gaps between them.

    By square cells, of an eighth of the body's diameter or as many as 2^22 make the arena; what is
    told is right up to the side of one. Where the body fits in the middle of a cell it may stand;
    what it can drive between is a room.
    """

    def __init__(self, world: World, radius: float = 0.1) -> None:
        """``radius``: of the body [m]."""
        self.cell = max(2 * radius / _CELLS, math.sqrt(world.width * world.height / _MOST_CELLS))
        """The side of a cell [m]."""
        self._world, self._radius = world, radius
        self._columns = math.ceil(world.width / self.cell)
        self._rows = math.ceil(world.height / self.cell)
        x, y = self._middles(np.arange(self._columns * self._rows))
        self._clearance = np.asarray(world.clearance(x, y, walls_count=True))
        fits = self._clearance >= radius
        self._room = np.where(fits, _components(fits, self._sides()), -1)

    @property
    def count(self) -> int:
        """How many rooms there are."""
        return len(np.unique(self._room[self._room >= 0]))

    @property
    def area(self) -> float:
        """Where the body may stand, in all rooms [m^2]."""
        return float(np.count_nonzero(self._room >= 0) * self.cell**2)

    @property
    def area_of_start(self) -> float:
        """The same of the room that the start is in [m^2]."""
        return float(np.count_nonzero(self._of_start()) * self.cell**2)

    def nearest_to_target(self) -> tuple[float, tuple[float, float]] | None:
        """How near the body gets to the target [m], and where; None: no room at the start."""
        cells = np.flatnonzero(self._of_start())
        if len(cells) == 0:
            return None
        x, y = self._middles(cells)
        distances = np.hypot(x - self._world.target[0], y - self._world.target[1])
        at = int(distances.argmin())
        return float(distances[at]), (float(x[at]), float(y[at]))

    def gaps(self) -> list[Gap]:
        """The widest that part each two rooms, one less than there are rooms at most.

        The widest first: where all of them were open, the body could go everywhere.
        """
        a, b = self._sides()
        width = np.minimum(self._clearance[a], self._clearance[b])
        narrow = (width < self._radius) & (width > 0)
        a, b, width = a[narrow], b[narrow], width[narrow]
        # Kruskal's: the widest sides join what they are between; a room's cell stands for the room.
        root = np.where(self._room >= 0, self._room, np.arange(len(self._room)))
        found = []
        for i in np.argsort(-width, kind="stable").tolist():
            one, other = (_root_of(root, cell) for cell in (int(a[i]), int(b[i])))
            if one == other:
                continue
            if self._room[one] >= 0 and self._room[other] >= 0:
                x, y = self._middles(a[i : i + 1])
                found.append(Gap(2 * float(width[i]), (float(x[0]), float(y[0]))))
            if self._room[other] >= 0:
                one, other = other, one
            root[other] = one
        return found

    def _of_start(self) -> npt.NDArray[np.bool_]:
        x, y = self._world.origin
        column = min(int((self._world.start.x - x) / self.cell), self._columns - 1)
        row = min(int((self._world.start.y - y) / self.cell), self._rows - 1)
        room = self._room[row * self._columns + column]
        return np.asarray((self._room == room) & (self._room >= 0))

    def _middles(self, cells: Indices) -> tuple[Numbers, Numbers]:
        x, y = self._world.origin
        rows, columns = np.divmod(cells, self._columns)
        return x + (columns + 0.5) * self.cell, y + (rows + 0.5) * self.cell

    def _sides(self) -> tuple[Indices, Indices]:
        """Of all sides between two cells the cells."""
        cells = np.arange(self._columns * self._rows).reshape(self._rows, self._columns)
        pairs = [(cells[:, :-1], cells[:, 1:]), (cells[:-1], cells[1:])]
        first, second = (np.concatenate([p[i].ravel() for p in pairs]) for i in (0, 1))
        return first, second


def _root_of(root: Indices, cell: int) -> int:
    while (above := int(root[cell])) != cell:
        root[cell] = root[above]  # half the way each time
        cell = int(root[cell])
    return cell


def _components(cells: npt.NDArray[np.bool_], sides: tuple[Indices, Indices]) -> Indices:
    """Of each cell the least that one comes to over sides between these cells."""
    both = cells[sides[0]] & cells[sides[1]]
    a, b = sides[0][both], sides[1][both]
    root = np.arange(len(cells))
    while len(a):
        np.minimum.at(root, np.maximum(root[a], root[b]), np.minimum(root[a], root[b]))
        while True:
            further = root[root]
            if np.array_equal(further, root):
                break
            root = further
        open_ = root[a] != root[b]
        a, b = a[open_], b[open_]
    return root
