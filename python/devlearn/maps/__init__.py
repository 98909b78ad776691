"""Worlds from the maps that robots make: a YAML of ROS's map_server with its PGM or PNG.

Cells are read as nav2's map_server reads them. The outlines of what is occupied are traced,
simplified and kept in the map's own frame, so that a pose of the map is the same pose of the world;
docs/maps.md says what becomes of what. Needs the extra ``maps``: scikit-image, Shapely, Pillow and
PyYAML.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .._calls import path_text
from .._calls import shown as repr_of
from .._core import Random, RobotDef, World
from ..errors import FileError, InvalidValue, MissingExtra, WrongType

try:
    import shapely
    import skimage as _skimage  # noqa: F401
    import yaml as _yaml  # noqa: F401
    from PIL import Image as _Image  # noqa: F401
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.maps", error.name or "a package", "maps") from error

from .cells import Cells
from .files import OCCUPIED, UNKNOWN, MapFile, occupancy_of
from .outlines import MOST_OUTLINES, polygon_of, simplified, traced
from .places import Places, with_a_way

__all__ = ["MapImport", "import_ros_map"]

# What a world takes (docs/world-format.md).
_MOST_CORNERS = 1_000_000

_CUT = math.sqrt(0.125)  # how much of a cell's corner tracing cuts off, at the deepest [cells]


@dataclass(frozen=True)
class MapImport:
    """A world from a map, and what was made of it."""

    world: World
    columns: int
    """Cells of the image along its own x axis."""
    rows: int
    """Cells along its y axis."""
    resolution: float
    """The side of a cell [m]."""
    free: int
    """Cells that the map calls free."""
    occupied: int
    """Cells that it calls occupied."""
    unknown: int
    """Cells of which it says neither."""
    outlines: int
    """How many polygons."""
    corners: int
    """Of all outlines and holes together."""
    holes: int
    """Of all outlines together."""
    error: float
    """The greatest distance from an outline as traced to the one that was made of it [m]."""
    error_of_cells: float
    """The greatest distance from the edges of cells to the outlines [m]."""
    free_area: float
    """What of the image no outline holds [m^2]."""


def import_ros_map(
    path: str | os.PathLike[str],
    start: Sequence[float] | None = None,
    target: Sequence[float] | None = None,
    unknown: str = "occupied",
    tolerance: float | None = None,
    seed: int = 0,
    radius: float = 0.1,
) -> MapImport:
    """The world in a map of ROS's map_server, and what was made of it.

    Parameters
    ----------
    path
        Of the YAML. Its image lies in the same folder, or in one within.
    start
        (x, y, heading) [m, m, degrees] in the map's frame; None: drawn by ``seed``.
    target
        (x, y) [m] in the map's frame; None: drawn by ``seed``.
    unknown
        What unknown cells are: 'occupied', 'free', or 'border': occupied where one of the eight
        around is free, else free.
    tolerance
        How far an outline may lie from the one traced along the cells, in [0, 10] m; None: half a
        cell.
    seed
        Of all draws, in [0, 2^64 - 1].
    radius
        Of the robot that has to get from the start to the target, in [0.01, 10] m.

    Raises FileError, naming file and field, for a map that cannot be read or used, InvalidValue for
    all else.
    """
    RobotDef(radius=radius)  # refuses what is none
    random = Random(seed, "map")
    start = _given("start", start, "three numbers: x, y [m] and heading [degrees]")
    target = _given("target", target, "two numbers, x and y [m]")
    if unknown not in ("occupied", "free", "border"):
        raise InvalidValue("unknown", repr_of(unknown), "'occupied', 'free' or 'border'")
    if tolerance is not None:
        (tolerance,) = _numbers("tolerance", [tolerance], "a number in [0, 10] m, or None")
        if not 0 <= tolerance <= 10:
            raise InvalidValue("tolerance", tolerance, "in [0, 10] m")

    file = MapFile.read(path_text(path))
    image = str(file.image)
    occupancy, frame = occupancy_of(file)
    cells = Cells.of(occupancy, unknown, file.resolution, image)
    areas, error = simplified(
        traced(cells, image), 0.5 * cells.side if tolerance is None else tolerance, image
    )
    outlines = np.concatenate([frame.to_map(areas), frame.beyond()])
    corners = len(shapely.get_coordinates(outlines)) - len(shapely.get_rings(outlines))
    if len(outlines) > MOST_OUTLINES or corners > _MOST_CORNERS:
        raise FileError(
            image,
            "",
            f"{len(outlines)} outlines with {corners} corners",
            f"at most {MOST_OUTLINES} with {_MOST_CORNERS}: give a greater tolerance, or an image "
            "with less noise",
        )

    rows, columns = occupancy.shape
    error_of_cells = error + _CUT * cells.side + math.sqrt(2) * (cells.side - file.resolution)
    obstacles = [polygon_of(outline) for outline in outlines]
    description = (
        f"From {Path(file.path).name}: {columns} x {rows} cells of {file.resolution:g} m, unknown "
        f"ones {unknown}; outlines within {error_of_cells:.3g} m of the cells."
    )

    def build(start: Sequence[float], target: Sequence[float]) -> World:
        return World(
            *frame.size,
            start=start,
            target=target,
            obstacles=obstacles,
            name=_utf8(Path(file.path).stem),
            description=_utf8(description),
            origin=frame.low,
        )

    world = with_a_way(build, Places(cells, frame, radius, image), start, target, random)
    occupied, neither = (int(np.count_nonzero(occupancy == v)) for v in (OCCUPIED, UNKNOWN))
    return MapImport(
        world=world,
        columns=columns,
        rows=rows,
        resolution=file.resolution,
        free=occupancy.size - occupied - neither,
        occupied=occupied,
        unknown=neither,
        outlines=len(outlines),
        corners=corners,
        holes=int(shapely.get_num_interior_rings(outlines).sum()),
        error=error,
        error_of_cells=error_of_cells,
        free_area=float(np.prod(frame.sides) - shapely.area(areas).sum()),
    )


def _given(name: str, value: Sequence[float] | None, wanted: str) -> list[float] | None:
    if value is None:
        return None
    numbers = _numbers(name, value, wanted)
    if len(numbers) != (3 if name == "start" else 2) or not all(map(math.isfinite, numbers)):
        raise InvalidValue(name, repr_of(value), f"{wanted}, all finite")
    return numbers


def _numbers(name: str, value: Sequence[float], wanted: str) -> list[float]:
    """What is told as numbers, and not as text of them. Raises WrongType."""
    try:
        array = np.asarray([*value])
    except (TypeError, ValueError):
        array = np.asarray(None)
    if isinstance(value, (str, bytes, dict)) or array.ndim != 1 or array.dtype.kind not in "iuf":
        raise WrongType(name, repr_of(value), wanted)
    return list(map(float, array.tolist()))


def _utf8(text: str) -> str:
    return text.encode(errors="replace").decode()
