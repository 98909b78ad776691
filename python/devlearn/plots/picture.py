"""A world drawn once, and a robot in it frame by frame: arrays of pixels, or a window."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, cast

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from matplotlib import patches
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .._core import RobotDef, World
from .style import GREEN, INK, STYLE
from .world import draw_arena, draw_obstacles, draw_target, move_to

_DPI = 100
_LEAST, _MOST = 64, 2000  # heights of pictures of arenas that are far from square [pixels]


class Picture:
    """A world, drawn in memory whatever display there is, and frames of a robot in it.

    Parameters: world; robot, whose body is drawn; width of a frame [pixels].
    """

    def __init__(self, world: World, robot: RobotDef, width: int = 480) -> None:
        high = min(max(width * world.height / world.width, _LEAST), _MOST)
        height = 2 * round(high / 2)  # even: films want that
        with mpl.rc_context(STYLE):
            figure = Figure(figsize=(width / _DPI, height / _DPI), dpi=_DPI)
            self._canvas = cast(Any, FigureCanvasAgg(figure))  # much of it has no types
            self._axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
            self._axes.set_axis_off()
            draw_arena(self._axes, world)
            self._movers = draw_obstacles(self._axes, world)
            for mover in self._movers:
                mover.set_animated(True)
            draw_target(self._axes, world)
            (self._way,) = self._axes.plot([], [], color=INK, linewidth=0.8, animated=True)
            self._body = patches.Circle(
                (0.0, 0.0), robot.radius, facecolor=GREEN, edgecolor=INK, animated=True
            )
            self._axes.add_patch(self._body)
            (self._ahead,) = self._axes.plot([], [], color="white", linewidth=2.0, animated=True)
            self._canvas.draw()
        self._world = world
        self._still = self._canvas.copy_from_bbox(figure.bbox)

    def frame(
        self,
        pose: Sequence[float],
        way: Sequence[Sequence[float]] = (),
        time: float = 0.0,
    ) -> npt.NDArray[np.uint8]:
        """The robot at a pose (x, y [m], heading [degrees]), and the places it came by.

        Movers are where they are at ``time`` [s].

        (height, width, 3), red, green and blue.
        """
        x, y, heading = pose
        radius, angle = self._body.radius, math.radians(heading)
        self._body.center = (x, y)
        self._ahead.set_data([x, x + radius * math.cos(angle)], [y, y + radius * math.sin(angle)])
        self._way.set_data([place[0] for place in way], [place[1] for place in way])
        for patch, mover in zip(self._movers, self._world.movers_at(time)):
            move_to(patch, mover)
        self._canvas.restore_region(self._still)
        for artist in (*self._movers, self._way, self._body, self._ahead):
            self._axes.draw_artist(artist)
        return np.asarray(self._canvas.buffer_rgba())[..., :3].copy()


class Window:
    """Frames on a display. Raises RuntimeError where there is none that matplotlib can use."""

    def __init__(self, title: str) -> None:
        import matplotlib.pyplot as plt

        try:
            figure = plt.figure(title)
        except Exception as error:  # what a toolkit raises without a display is its own
            raise RuntimeError(f"no display: {error}") from error
        if figure.canvas.required_interactive_framework is None:
            plt.close(figure)
            raise RuntimeError(f"no display: matplotlib draws with {plt.get_backend()}")
        self._figure, self._pause, self._close = figure, plt.pause, plt.close
        self._axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self._axes.set_axis_off()
        self._image: Any = None

    def show(self, frame: npt.NDArray[np.uint8], seconds: float) -> None:
        """Shows a frame for so long."""
        if self._image is None:
            self._image = self._axes.imshow(frame)
        self._image.set_data(frame)
        self._pause(seconds)

    def close(self) -> None:
        """Closes it."""
        self._close(self._figure)
