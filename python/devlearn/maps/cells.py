"""Which cells of a map an obstacle holds."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..errors import FileError
from .files import OCCUPIED, UNKNOWN, Bools, Occupancy
from .frame import LEAST_SIDE

# Where an outline cuts a cell's corner its own corners are so far apart [cells].
_CORNERS = math.sqrt(0.5)


@dataclass(frozen=True)
class Cells:
    """Square cells, row by row from the lowest."""

    obstructed: Bools
    free: Bools  # since the map says so, or the user does of what is unknown
    side: float  # [m]

    @classmethod
    def of(cls, occupancy: Occupancy, unknown: str, side: float, image: str) -> Cells:
        """With unknown cells 'occupied', 'free', or 'border': occupied beside a free one."""
        neither = occupancy == UNKNOWN
        obstructed = occupancy == OCCUPIED
        free = ~(obstructed | neither)
        if unknown == "free":
            free |= neither
        elif unknown == "border":
            obstructed |= neither & _with_those_around(free)
        else:
            obstructed |= neither
        if not free.any():
            raise FileError(
                image,
                "",
                f"no free cell: {np.count_nonzero(occupancy == OCCUPIED)} occupied, "
                f"{np.count_nonzero(neither)} unknown",
                "free space: see negate and free_thresh in the YAML, and unknown cells",
            )
        return cls(obstructed, free, side)._large_enough()

    def _large_enough(self) -> Cells:
        """The same of cells whose outlines a world takes.

        Of smaller ones two by two are one: obstructed where any of the four is.
        """
        if _CORNERS * self.side >= LEAST_SIDE:
            return self
        obstructed, free = _any_of_four(self.obstructed), _any_of_four(self.free)
        return Cells(obstructed, free & ~obstructed, 2 * self.side)


def _with_those_around(cells: Bools) -> Bools:
    """These and the eight around each."""
    wide = np.pad(cells, 1)
    wide = wide[:-2] | wide[1:-1] | wide[2:]
    return wide[:, :-2] | wide[:, 1:-1] | wide[:, 2:]


def _any_of_four(cells: Bools) -> Bools:
    rows, columns = cells.shape
    even = np.pad(cells, ((0, rows % 2), (0, columns % 2)))
    return np.asarray(even.reshape(-(-rows // 2), 2, -1, 2).any(axis=(1, 3)))
