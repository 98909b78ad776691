"""Outlines of what is obstructed, in the image's frame [m]: traced along cells, then simplified."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import shapely
from skimage import measure

from .._core import Polygon
from ..errors import FileError
from .cells import Cells
from .files import Bools
from .frame import LEAST_AREA, Numbers, Shapes

MOST_BORDERS = 1 << 22  # sides of cells between what is obstructed and what is not
MOST_OUTLINES = 100_000  # of a world (docs/world-format.md)
MOST_PAIRS = 2_000_000_000  # of rings and corners, which GEOS compares: ten seconds at worst

Indices = npt.NDArray[np.int64]


def traced(cells: Cells, image: str) -> Shapes:
    """Areas with holes, their corners in the middles of the cells' sides.

    Between them outlines run straight, so that walls along the image's axes are exact and corners
    are cut. Cells that touch at a corner are one area.
    """
    # The arena's walls close what lies at the image's border.
    padded = np.pad(cells.obstructed, 1)
    borders = sum(int(np.count_nonzero(way[1:] != way[:-1])) for way in (padded, padded.T))
    if borders > MOST_BORDERS:
        raise FileError(
            image,
            "",
            f"{borders} sides of cells between occupied and free ones",
            f"at most {MOST_BORDERS}: an image with less noise",
        )
    contours = measure.find_contours(padded, 0.5, fully_connected="high")
    if not contours:
        return np.array([], dtype=object)
    ring = np.repeat(np.arange(len(contours)), [len(contour) for contour in contours])
    points, ring = _corners(np.concatenate(contours)[:, ::-1], ring)
    # The middle of cell 0 is half a cell from the image's edge, and padding put one before it.
    rings = shapely.linearrings((points - 0.5) * cells.side, indices=ring)
    return _areas(rings)


def _corners(points: Numbers, ring: Indices) -> tuple[Numbers, Indices]:
    """Of closed rings of points the corners, without what lies straight between them."""
    within = ring[1:] == ring[:-1]
    points, ring, way = points[:-1][within], ring[:-1][within], np.diff(points, axis=0)[within]
    before = np.roll(way, 1, axis=0)
    first = np.flatnonzero(np.diff(ring, prepend=-1))
    before[first] = way[np.append(first[1:], len(ring)) - 1]
    corner = (way != before).any(axis=1)
    return points[corner], ring[corner]


def _areas(rings: Shapes) -> Shapes:
    """Of rings that do not touch, around areas counter-clockwise, around holes clockwise."""
    around = shapely.is_ccw(rings)
    shells, holes = rings[around], rings[~around]
    solid = shapely.polygons(shells)
    shapely.prepare(solid)
    # A hole belongs to the smallest of the areas that are around it.
    places = shapely.STRtree(shapely.get_point(holes, 0))
    shell, hole = places.query(solid, predicate="contains")
    order = np.lexsort((shapely.area(solid)[shell], hole))
    shell, hole = shell[order], hole[order]
    smallest = np.flatnonzero(np.diff(hole, prepend=-1))
    smallest = smallest[np.argsort(shell[smallest], kind="stable")]
    owners, first = np.unique(shell[smallest], return_index=True)
    for owner, held in zip(owners, np.split(hole[smallest], first[1:])):
        solid[owner] = shapely.polygons(shells[owner], holes[held])
    return np.asarray(solid)


def simplified(areas: Shapes, tolerance: float, image: str) -> tuple[Shapes, float]:
    """Each with fewer corners, its outline within the tolerance; and the greatest distance [m].

    Raises FileError where they are so many that it would take long.

    GEOS keeps outlines apart, but not always within the tolerance, nor in all cases large enough
    for a world. Then an area is simplified by half the tolerance, or stays as it was traced.
    """
    if tolerance == 0.0:
        return areas, 0.0
    rings, corners = len(shapely.get_rings(areas)), len(shapely.get_coordinates(areas))
    if len(areas) > MOST_OUTLINES or rings * corners > MOST_PAIRS:
        raise FileError(
            image,
            "",
            f"{rings} outlines and holes with {corners} corners",
            f"at most {MOST_OUTLINES} outlines, and at most {MOST_PAIRS} for the product of both "
            "numbers: an image with less noise, or a tolerance of 0, which leaves corners as they "
            "are",
        )
    outlines, distances = areas.copy(), np.zeros(len(areas))
    left = np.arange(len(areas))
    for part in (1.0, 0.5):
        if len(left) == 0:
            break
        # Together, so that they keep apart.
        whole = shapely.simplify(shapely.multipolygons(areas[left]), part * tolerance)
        simple = np.asarray(shapely.get_parts(whole), dtype=object)
        moved = _distances(areas[left], simple)
        good = _lawful(simple) & (moved <= tolerance)
        outlines[left[good]], distances[left[good]] = simple[good], moved[good]
        left = left[~good]
    return outlines, float(distances.max(initial=0.0))


def _lawful(areas: Shapes) -> Bools:
    """Which of them a world takes, as it takes all that were traced."""
    rings, owner = shapely.get_rings(areas, return_index=True)
    lawful = shapely.is_valid(areas) & shapely.is_simple(shapely.boundary(areas))
    lawful[owner[shapely.area(shapely.polygons(rings)) < LEAST_AREA]] = False
    return np.asarray(lawful)


def _distances(areas: Shapes, outlines: Shapes) -> Numbers:
    """The greatest from a corner of each area to the side of its outline that replaced it [m].

    An outline's corners are some of the area's, in their order.
    """
    rings, owner = shapely.get_rings(areas, return_index=True)
    closed, ring = shapely.get_coordinates(rings, return_index=True)
    within = np.append(ring[1:] == ring[:-1], False)
    corners, ring = _as_complex(closed[within]), ring[within]
    kept = np.flatnonzero(np.isin(corners, _as_complex(shapely.get_coordinates(outlines))))
    # The kept corners before and after each, around the ring.
    first = np.searchsorted(ring[kept], np.arange(len(rings)), "left")[ring]
    last = np.searchsorted(ring[kept], np.arange(len(rings)), "right")[ring] - 1
    before = np.searchsorted(kept, np.arange(len(corners)), "right") - 1
    after = np.where(before < last, before + 1, first)
    before = np.where(before < first, last, before)
    start, way = corners[kept[before]], corners[kept[after]] - corners[kept[before]]
    along = ((corners - start) * way.conj()).real / np.abs(way) ** 2
    greatest = np.zeros(len(areas))
    distance = np.abs(corners - start - np.clip(along, 0.0, 1.0) * way)
    np.maximum.at(greatest, owner[ring], distance)
    return greatest


def _as_complex(points: Numbers) -> npt.NDArray[np.complex128]:
    return np.asarray(points[:, 0] + 1j * points[:, 1])


def polygon_of(area: shapely.Polygon) -> Polygon:
    """As a world has it."""
    corners, *holes = (
        [(x, y) for x, y in shapely.get_coordinates(ring)[:-1].tolist()]
        for ring in shapely.get_rings(area)
    )
    return Polygon(corners, holes=holes)
