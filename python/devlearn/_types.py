from __future__ import annotations

from typing import NamedTuple


class Pose(NamedTuple):
    """The robot's place and heading: x, y [m], heading [degrees, counter-clockwise from x]."""

    x: float
    y: float
    heading: float
