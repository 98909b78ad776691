"""Files of map_server: what the YAML says, and what it makes of the pixels of its image."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import yaml
from PIL import Image

from .._calls import shown
from ..errors import FileError
from .frame import Frame

OCCUPIED, UNKNOWN = 100, -1  # of nav_msgs/OccupancyGrid; what lies between is free
MODES = ("trinary", "scale", "raw")

LONGEST_YAML = 1 << 13  # [bytes]; nested ones take PyYAML time that grows by the square
MOST_SIDE, MOST_CELLS = 10_000, 1 << 26

Occupancy = npt.NDArray[np.int8]
Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class MapFile:
    """What a map_server YAML says; nav2's map_io reads it so."""

    path: str
    image: Path
    resolution: float  # [m]
    origin: tuple[float, float, float]  # of the image's lower left corner: x, y [m], yaw [rad]
    negate: bool
    occupied_thresh: float
    free_thresh: float
    mode: str

    @classmethod
    def read(cls, path: str) -> MapFile:
        """Raises FileError, naming the field."""
        fields = _Fields(path)
        resolution = fields.number("resolution", 0.01, 10, " m")
        origin = fields.value("origin", "[x, y, yaw], three numbers [m, m, rad]", list)
        if len(origin) != 3:
            raise fields.refused("origin", origin, "[x, y, yaw], three numbers [m, m, rad]")
        x, y, yaw = (
            fields.number(f"origin[{i}]", -limit, limit, unit, value)
            for i, (value, limit, unit) in enumerate(
                zip(origin, (1e5, 1e5, 1e5), (" m", " m", " rad"))
            )
        )
        negate = fields.value("negate", "0 or 1, false or true", int)
        if negate not in (0, 1):
            raise fields.refused("negate", negate, "0 or 1, false or true")
        occupied = fields.number("occupied_thresh", 0, 1)
        free = fields.number("free_thresh", 0, 1)
        if free > occupied:
            raise fields.refused(
                "free_thresh", free, f"at most occupied_thresh, which is {occupied}"
            )
        mode = fields.value("mode", "trinary, scale or raw", str, "trinary").lower()
        if mode not in MODES:
            raise fields.refused("mode", mode, "trinary, scale or raw")
        image = fields.image()
        return cls(path, image, resolution, (x, y, yaw), bool(negate), occupied, free, mode)


class _Fields:
    """The fields of a map_server YAML, each asked for by what it has to be."""

    def __init__(self, path: str) -> None:
        self._path = path
        wanted = (
            "a map_server YAML: image, resolution, origin, negate, occupied_thresh, free_thresh"
        )
        file = Path(path)
        if not _is_file(file):
            raise FileError(path, "", "no such file", wanted)
        try:
            with file.open("rb") as opened:
                content = opened.read(LONGEST_YAML + 1)
        except OSError as error:
            raise FileError(path, "", error.strerror, "a file that can be read") from error
        if len(content) > LONGEST_YAML:
            raise FileError(path, "", "a longer file", f"a YAML of at most {LONGEST_YAML} bytes")
        try:
            # What few bytes can grow into without end.
            if any(isinstance(token, yaml.AliasToken) for token in yaml.scan(content)):
                raise FileError(path, "", "a YAML with aliases", wanted)
            self._fields = yaml.safe_load(content)
        except FileError:
            raise
        # PyYAML's own and, where a value is not what its tag says, whatever made it stumble.
        except (yaml.YAMLError, ValueError, LookupError, AttributeError, RecursionError) as error:
            why = " ".join(str(error).split())
            raise FileError(path, "", f"no YAML ({why})", wanted) from error
        if not isinstance(self._fields, dict):
            raise FileError(path, "", f"a {type(self._fields).__name__}", wanted)

    def refused(self, field: str, value: object, wanted: str) -> FileError:
        return FileError(self._path, field, shown(value), wanted)

    def value(self, field: str, wanted: str, kind: type, missing: Any = None) -> Any:
        value = self._fields.get(field, missing)
        if value is None:
            raise FileError(self._path, field, "nothing", wanted)
        if not isinstance(value, kind):
            raise self.refused(field, value, wanted)
        return value

    def number(
        self, field: str, least: float, greatest: float, unit: str = "", value: Any = None
    ) -> float:
        wanted = f"a number in [{least:g}, {greatest:g}]{unit}"
        if value is None:
            value = self.value(field, wanted, object)
        try:
            # ROS's YAML takes 5e-2 for a number, too, PyYAML for text.
            number = math.nan if isinstance(value, bool) else float(value)
        except (TypeError, ValueError, OverflowError):
            number = math.nan
        if not least <= number <= greatest:
            raise self.refused(field, value, wanted)
        return number

    def image(self) -> Path:
        wanted = "a PGM or PNG in the YAML's folder, or in one within"
        name: str = self.value("image", wanted, str)
        folder = Path(self._path).parent
        try:
            whole, path = folder.resolve(), (folder / name).resolve()
        except (OSError, ValueError, RuntimeError):  # a null, a link to itself
            raise self.refused("image", name, wanted) from None
        if whole not in path.parents:
            raise FileError(self._path, "image", f"{shown(name)}, outside of {whole}", wanted)
        if not _is_file(path):
            raise FileError(self._path, "image", f"{shown(name)}, which is no file", wanted)
        return path


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def occupancy_of(file: MapFile) -> tuple[Occupancy, Frame]:
    """Cells as nav_msgs/OccupancyGrid has them, 0 to 100 or -1, the lowest row first; their frame.

    What is too large is refused before a pixel is unpacked.
    """
    name = str(file.image)
    allowed = f"at most {MOST_SIDE} x {MOST_SIDE} cells, and {MOST_CELLS} in all"
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image = Image.open(file.image, formats=("PNG", "PPM"))
        with image:
            columns, rows = image.size
            if max(columns, rows) > MOST_SIDE or columns * rows > MOST_CELLS:
                raise FileError(name, "", f"{columns} x {rows} cells", allowed)
            frame = Frame.of(file.path, columns, rows, file.resolution, file.origin)
            grey, opaque = _grey(image)
    except FileError:
        raise
    except Image.DecompressionBombError as error:
        raise FileError(name, "", f"more cells than are read ({error})", allowed) from error
    except (OSError, ValueError, SyntaxError) as error:
        raise FileError(name, "", f"no image to be read ({error})", "a PGM or PNG") from error
    occupancy = _occupancy_of_shades(file)[grey]
    if opaque is not None and file.mode != "raw":
        occupancy[~opaque] = UNKNOWN
    return np.flipud(occupancy), frame


def _grey(image: Image.Image) -> tuple[npt.NDArray[np.uint8], Bools | None]:
    """Shades of 0 to 255, and which pixels are opaque, where the image says that."""
    if image.mode == "F":
        raise ValueError("a portable float map")
    if image.mode.startswith("I"):  # of 16 bits
        return ((np.asarray(image).astype(np.uint32) + 128) // 257).astype(np.uint8), None
    if "A" in image.getbands() or "transparency" in image.info:
        both = np.asarray(image.convert("RGBA").convert("LA"))
        return both[..., 0], both[..., 1] == 255
    return np.asarray(image.convert("L")), None


def _occupancy_of_shades(file: MapFile) -> Occupancy:
    """What each of the 256 shades of grey means."""
    shades = np.arange(256)
    if file.mode == "raw":
        return np.where(shades <= OCCUPIED, shades, UNKNOWN).astype(np.int8)
    dark = shades.astype(np.float32) / np.float32(255)  # single precision, as nav2 has it
    if not file.negate:
        dark = np.float32(1) - dark
    low, high = np.float32(file.free_thresh), np.float32(file.occupied_thresh)
    occupancy = np.full(256, UNKNOWN, dtype=np.int8)
    if file.mode == "scale":
        between = (dark > low) & (dark < high)
        occupancy[between] = np.rint(100 * (dark[between] - low) / (high - low))
    occupancy[dark >= high] = OCCUPIED
    occupancy[dark <= low] = 0
    return occupancy
