"""Start and target, given or drawn where the robot fits, with a way between them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt
from skimage import measure, morphology

from .._core import Random, Robot, RobotDef, World, may_reach_target
from ..errors import FileError, InvalidValue
from .cells import Cells
from .frame import Frame, Numbers

FREELY = 0.0105  # what a body that drives freely keeps from everything [m]
DRAWS = 20

Place = Sequence[float]


class Places:
    """Where the robot fits, cell by cell: what is drawn from, and what is proposed instead."""

    def __init__(self, cells: Cells, frame: Frame, radius: float, image: str) -> None:
        """``radius``: of the robot [m]; ``image``: that the cells are of."""
        self._cells, self._frame, self._image = cells, frame, image
        self.radius = radius

    @cached_property
    def _regions(self) -> npt.NDArray[np.int64]:
        """The region of each cell in whose middle the body fits, from 1 on; of others 0."""
        # From the middle of an obstructed cell to its side is half a cell.
        room = (self.radius + FREELY) / self._cells.side + 0.5
        clear = np.pad(~self._cells.obstructed, 1)
        fits = morphology.isotropic_erosion(clear, room)[1:-1, 1:-1]
        return np.asarray(measure.label(fits, connectivity=1), dtype=np.int64)

    def region_of(self, place: Place | None) -> int:
        """That of the nearest cell; of None the one with the most free cells. 0: there is none."""
        regions = self._regions
        if place is None:
            counts = np.bincount(regions[self._cells.free], minlength=1)
            counts[0] = 0
            return int(counts.argmax())
        if not regions.any():
            return 0
        return int(regions[regions > 0][_distances(self._middles(None), place).argmin()])

    def _middles(self, region: int | None) -> Numbers:
        """Of a region's cells, or of all regions' [m]."""
        cells = self._regions > 0 if region is None else self._regions == region
        middles = (np.argwhere(cells)[:, ::-1] + 0.5) * self._cells.side
        return self._frame.points_to_map(np.asarray(middles))

    def nearest(self, place: Place, region: int | None = None) -> str:
        """The nearest place where the body fits, in words."""
        middles = self._middles(region)
        if len(middles) == 0:
            return f"there is no place for a body of radius {self.radius:g} m"
        return f"the nearest is {shown(middles[_distances(middles, place).argmin()])}"

    def pairs(
        self, start: Place | None, target: Place | None, random: Random
    ) -> Iterator[tuple[Place, Place]]:
        """Both as given, or what is not given drawn, again and again.

        That drawn later is at least half as far from the other as the farthest place of its region.
        Raises FileError where there is no region.
        """
        if start is not None and target is not None:
            yield start, target
            return
        region = self.region_of(start if start is not None else target)
        if region == 0:
            raise FileError(
                self._image,
                "",
                f"no free place with room for a body of radius {self.radius:g} m",
                "more room, or a robot of a smaller radius",
            )
        middles = self._middles(region)

        def drawn(away: Place | None) -> list[float]:
            if away is None:
                return list(middles[random.index(len(middles))].tolist())
            distances = _distances(middles, away)
            far = np.flatnonzero(distances >= 0.5 * distances.max())
            return list(middles[far[random.index(len(far))]].tolist())

        for _ in range(DRAWS):
            begin = start if start is not None else [*drawn(target), 30.0 * random.index(12)]
            yield begin, target if target is not None else drawn(begin)


def with_a_way(
    build: Callable[[Place, Place], World],
    places: Places,
    start: Place | None,
    target: Place | None,
    random: Random,
) -> World:
    """The world of a start and a target between which there is a way for the robot."""
    body = RobotDef(radius=places.radius)
    for begin, end in places.pairs(start, target, random):
        try:
            world = build(begin, end)
            if may_reach_target(Robot(world, body)):
                return world
        except InvalidValue as error:
            name = error.quantity.partition(".")[0]
            if name not in ("start", "target"):
                raise
            given = start if name == "start" else target
            if given is not None:
                allowed = f"{error.allowed}; {places.nearest(given)}"
                raise InvalidValue(error.quantity, error.value, allowed) from error
        else:
            if start is not None and target is not None:
                raise InvalidValue(
                    "target",
                    f"{shown(target)}, to which no way leads from the start {shown(start)} for a "
                    f"body of radius {places.radius:g} m",
                    "a place that it can get to; "
                    + places.nearest(target, places.region_of(start)),
                )
    for name, given in (("start", start), ("target", target)):
        if given is not None:
            raise InvalidValue(
                name,
                f"{shown(given)}, and no way between it and {DRAWS} places drawn for a body "
                f"of radius {places.radius:g} m",
                f"a place with a way to others; {places.nearest(given)}",
            )
    raise InvalidValue(
        "start and target",
        f"{DRAWS} draws without a way from one to the other",
        "both given: (x, y, heading) and (x, y)",
    )


def _distances(places: Numbers, place: Place) -> Numbers:
    return np.asarray(np.hypot(*(places - np.asarray(place[:2])).T))


def shown(place: Place) -> str:
    """In words."""
    return f"({place[0]:.4g}, {place[1]:.4g})"
