"""A record's rounds over its world, moment by moment: the frames of films."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, cast

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from matplotlib import patches
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text

from .._core import Kind, Robot
from ..record import Record
from .path import KINDS, apart, time_at_start
from .rounds import round_name
from .style import GREEN, GREY, INK, STYLE, VERMILLION, logarithmic, thousands, whole_numbers
from .world import DASHES, draw_arena, draw_obstacles, draw_target, move_to

Array = npt.NDArray[Any]

MOST_A_FRAME = 10_000
"""Steps that one frame adds to the path; of more, evenly many are drawn."""

# All in inches; how many pixels an inch has follows from a frame's width.
_WIDTH, _MARGIN = 4.8, 0.1
_HEAD, _COUNTS, _CURVE = 0.34, 0.3, 0.72
_LOWEST, _HIGHEST = 0.8, 7.2  # maps of arenas that are far from square
_NEWEST = 40  # steps drawn in full
_PALE = 0.35  # opacity of those before


class Scene:
    """A record's rounds, drawn in memory whatever display there is.

    World and curve of the rounds' steps are drawn once, and each step of a round once, pale; over
    these each frame has the newest steps, what moves, and the robot with its sonars. Frames follow
    each other: one of a moment before the last, or of another round, begins that round anew.

    Parameters: record; entries of its rounds that will be shown; width of a frame [pixels]. Raises
    InvalidValue where something moves in the world and the record does not tell when.
    """

    def __init__(self, record: Record, entries: Sequence[int], width: int) -> None:
        self._record = record
        self._world = record.world
        self._config = record.config.robot
        self._robot = Robot(self._world, self._config)
        self._offsets = record.offsets()
        for entry in entries:
            time_at_start(record, entry)  # refuses
        with mpl.rc_context(STYLE):
            self._lay_out(entries, width)
        self._canvas.draw()
        self._still = self._canvas.copy_from_bbox(self._figure.bbox)
        self._entry = -1

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of a frame [pixels], both even: films want that."""
        width, height = self._canvas.get_width_height()
        return width, height

    # --- what is drawn ----------------------------------------------------------------------------

    def _lay_out(self, entries: Sequence[int], width: int) -> None:
        world, many = self._world, len(self._record.rounds) > 1
        wide = _WIDTH - 2 * _MARGIN
        high = min(max(wide * world.height / world.width, _LOWEST), _HIGHEST)
        height = _HEAD + high + _COUNTS + many * _CURVE
        dpi = width / _WIDTH
        height = 2 * round(height * dpi / 2) / dpi
        self._figure = Figure(figsize=(_WIDTH, height), dpi=dpi)
        self._canvas = cast(Any, FigureCanvasAgg(self._figure))  # much of it has no types

        def axes(left: float, bottom: float, wide: float, high: float) -> Axes:
            return self._figure.add_axes(
                (left / _WIDTH, bottom / height, wide / _WIDTH, high / height)
            )

        below = height - _HEAD - high
        self._lay_out_map(axes(_MARGIN, below, wide, high))
        head = (height - _HEAD / 2) / height
        self._name = self._text(_MARGIN, head, 10, weight="bold")
        self._told = self._text(_WIDTH - _MARGIN, head, 9, ha="right")
        self._lay_out_counts(entries, (below - _COUNTS / 2) / height)
        self._curve = self._lay_out_curve(axes(0.6, 0.2, wide - 0.65, _CURVE - 0.3)) if many else ()

    def _lay_out_map(self, ax: Axes) -> None:
        self._map = ax
        draw_arena(ax, self._world)
        self._movers = draw_obstacles(ax, self._world)
        for patch in self._movers:
            patch.set_animated(True)
        ax.set_axis_off()
        self._kinds: dict[Kind, Line2D] = {}
        for kind, (_, how) in KINDS.items():
            (self._kinds[kind],) = ax.plot(
                [], [], markevery=3, solid_capstyle="round", animated=True, **how
            )
        self._touches = self._line(
            color=VERMILLION, linestyle="none", marker="o", markersize=4, markerfacecolor="none",
            markeredgewidth=0.8, alpha=0.6,
        )  # fmt: skip
        self._heard = self._line(color=INK, linewidth=0.6, marker="o", markersize=2.4, markevery=3)
        self._unheard = self._line(color=INK, linewidth=0.6, linestyle=DASHES)
        radius = self._config.radius
        self._start = patches.Circle(
            (0, 0), radius, facecolor="none", edgecolor=GREY, linewidth=0.8, animated=True
        )
        self._body = patches.Circle((0, 0), radius, facecolor=GREEN, animated=True)
        ax.add_patch(self._start)
        ax.add_patch(self._body)
        self._ahead = self._line(color="white", linewidth=2.0, solid_capstyle="butt")
        self._target = draw_target(ax, self._world)
        self._target.set_animated(True)

    def _line(self, **how: Any) -> Line2D:
        (line,) = self._map.plot([], [], animated=True, **how)
        return line

    def _text(self, x: float, y: float, size: float, **how: Any) -> Text:
        return self._figure.text(
            x / _WIDTH, y, "", fontsize=size, va="center", color=INK, animated=True, **how
        )

    def _lay_out_counts(self, entries: Sequence[int], y: float) -> None:
        """A row of what is counted, each with its look in the map and as much room as it takes."""
        most: dict[Kind | None, int] = dict.fromkeys([*KINDS, None], 0)
        for steps in map(self._steps_of, entries):
            counts = _counts(self._record.kind[steps], self._record.collided[steps])
            most = {what: max(count, counts[what]) for what, count in most.items()}
        looks: dict[Kind | None, tuple[str, dict[str, Any]]] = {
            kind: look for kind, look in KINDS.items() if most[kind]
        }
        looks[None] = "touches", _look_of(self._touches)
        letters = [len(f"{name} {thousands(most[kind])}") + 6 for kind, (name, _) in looks.items()]
        letter = min((_WIDTH - 2 * _MARGIN) / sum(letters), 0.06)
        self._counts: dict[Kind | None, tuple[str, Text]] = {}
        for before, (kind, (name, how)) in zip(np.cumsum([0, *letters]), looks.items()):
            x = _MARGIN + before * letter
            self._figure.add_artist(
                Line2D(np.array([x, x + 1.5 * letter, x + 3 * letter]) / _WIDTH, [y] * 3,
                       markevery=[1], **{**how, "markersize": 1.5 * how.get("markersize", 0)})
            )  # fmt: skip
            self._counts[kind] = name, self._text(x + 3.6 * letter, y, 7 * letter / 0.06)

    def _lay_out_curve(self, ax: Axes) -> tuple[Line2D, Line2D, Line2D]:
        """Steps by round: of all, pale; of those until now; of this one, as it grows."""
        self._steps = np.maximum(self._record.rounds["steps"], 1)
        rounds = np.arange(1, len(self._steps) + 1)
        ax.plot(rounds, self._steps, color=GREY, linewidth=0.6, alpha=0.5)
        logarithmic(ax.yaxis)
        ax.set_yticks(sorted({self._steps.min(), self._steps.max()}))
        ax.minorticks_off()
        ax.tick_params(width=0.5, length=2)
        whole_numbers(ax.xaxis)
        ax.margins(0.01, 0.12)
        ax.set_ylabel("steps", labelpad=2)
        ax.annotate(
            "round", (0, 0), (-4, -9), xycoords="axes fraction", textcoords="offset points",
            fontsize=7, ha="right", va="center",
        )  # fmt: skip
        (until,) = ax.plot([], [], color=INK, linewidth=0.9, animated=True)
        (now,) = ax.plot([], [], color=VERMILLION, linewidth=1.0, animated=True)
        (point,) = ax.plot(
            [], [], color=VERMILLION, marker="o", markersize=4, clip_on=False, animated=True
        )
        return until, now, point

    # --- frames -----------------------------------------------------------------------------------

    def frame(self, entry: int, at: float, speed: float) -> npt.NDArray[np.uint8]:
        """The moment of a round when ``at`` steps of it are made, from 0 to all: also between two.

        ``speed`` is said: how many times faster than the robot. (height, width, 3), red, green and
        blue.
        """
        if entry != self._entry or at < self._done:
            self._begin(entry)
        count = len(self._kind)
        self._add(int(at))
        self._canvas.restore_region(self._ground)
        pose = self._pose(at)
        x, y, heading = pose

        newest = np.arange(max(0, self._done - _NEWEST), self._done)
        self._draw_steps(newest, 1.0)
        if self._done < count:  # the part of a step
            line = self._kinds[Kind(int(self._kind[self._done]))]
            line.set_data(*np.array([self._places[self._done], (x, y)]).T)
            self._draw(line)

        time = self._began + at * self._config.sample_time
        for patch, mover in zip(self._movers, self._world.movers_at(time)):
            move_to(patch, mover)
            self._draw(patch)
        self._draw_sonars(pose, time)

        radius, angle = self._config.radius, math.radians(heading)
        touches = count > 0 and self._collided[min(self._done, count - 1)]
        self._body.set(
            center=(x, y),
            edgecolor=VERMILLION if touches else INK,
            linewidth=2.0 if touches else 0.8,
        )
        self._ahead.set_data([x, x + radius * math.cos(angle)], [y, y + radius * math.sin(angle)])
        self._draw(self._target, self._body, self._ahead)
        self._draw_words(at, speed)
        return np.asarray(self._canvas.buffer_rgba())[..., :3].copy()

    def _begin(self, entry: int) -> None:
        record, steps = self._record, self._steps_of(entry)
        poses = slice(steps.start + entry, steps.stop + entry + 1)
        self._entry, self._done = entry, 0
        self._kind, self._collided = record.kind[steps], record.collided[steps]
        self._places = _Places(record.x[poses], record.y[poses])
        self._heading = record.heading[poses]
        self._made: dict[Kind | None, int] = dict.fromkeys([*KINDS, None], 0)
        self._began = time_at_start(record, entry)
        self._name.set_text(round_name(record, entry).partition(" (")[0])
        self._canvas.restore_region(self._still)
        if self._curve:
            self._curve[0].set_data(np.arange(1, entry + 1), self._steps[:entry])
            self._draw(self._curve[0])
        self._start.center = self._pose(0)[:2]
        self._draw(self._start, self._name)
        self._ground = self._canvas.copy_from_bbox(self._figure.bbox)

    def _steps_of(self, entry: int) -> slice:
        begin, end = self._offsets[entry : entry + 2].tolist()
        return slice(begin, end)

    def _add(self, done: int) -> None:
        """The steps until then to the ground."""
        if done == self._done:
            return
        new = slice(self._done, done)
        for what, count in _counts(self._kind[new], self._collided[new]).items():
            self._made[what] += count
        self._canvas.restore_region(self._ground)
        some = np.arange(self._done, done, math.ceil((done - self._done) / MOST_A_FRAME))
        self._draw_steps(some, _PALE)
        touched = self._places[some[self._collided[some]] + 1]
        self._touches.set_data(touched.T)
        self._draw(self._touches)
        self._ground = self._canvas.copy_from_bbox(self._figure.bbox)
        self._done = done

    def _pose(self, at: float) -> tuple[float, float, float]:
        """A step turns at once, then drives: Eq. 1."""
        before = min(int(at), max(len(self._kind) - 1, 0))
        after, share = min(before + 1, len(self._kind)), at - before
        x, y = self._places[before] + share * (self._places[after] - self._places[before])
        return float(x), float(y), float(self._heading[after if share > 0 else before])

    def _draw_steps(self, steps: Array, opacity: float) -> None:
        kinds = self._kind[steps]
        for kind, line in self._kinds.items():
            line.set_alpha(opacity)
            chosen = steps[kinds == int(kind)]
            if len(chosen):
                line.set_data(*apart(self._places[chosen], self._places[chosen + 1]))
                self._draw(line)

    def _draw_sonars(self, pose: tuple[float, float, float], time: float) -> None:
        x, y, heading = pose
        echoes = self._robot.sonar(pose, time)
        angles = np.radians(heading + np.asarray(self._config.sonar_angles()))
        ahead = np.column_stack([np.cos(angles), np.sin(angles)])
        rim = np.array([x, y]) + self._config.radius * ahead
        ends = rim + echoes[:, None] * ahead
        met = echoes < self._config.sonar_range
        self._heard.set_data(*apart(ends[met], rim[met]))  # markers where they begin
        self._unheard.set_data(*apart(rim[~met], ends[~met]))
        self._draw(self._heard, self._unheard)

    def _draw_words(self, at: float, speed: float) -> None:
        steps, told = len(self._kind), f"step {thousands(self._done)}"
        color = INK
        if at < steps:
            told = f"{speed:.3g} \u00d7      {told}"
        elif self._record.rounds["arrived"][self._entry]:
            told, color = f"arrived in {thousands(steps)} steps", GREEN
        else:
            told, color = f"not arrived in {thousands(steps)} steps", VERMILLION
        self._told.set(text=told, color=color)
        self._draw(self._told)
        for kind, (name, text) in self._counts.items():
            text.set_text(f"{name} {thousands(self._made[kind])}")
            self._draw(text)
        if self._curve:
            _, now, point = self._curve
            number, high = self._entry + 1, max(at, 1.0)
            now.set_data([number, number], [1e-3, high])
            point.set_data([number], [high])
            self._draw(now, point)

    def _draw(self, *artists: Any) -> None:
        for artist in artists:
            self._figure.draw_artist(artist)


def _counts(kinds: Array, collided: Array) -> dict[Kind | None, int]:
    """Steps of each kind, and those that touched."""
    counts: dict[Kind | None, int] = {
        kind: int(np.count_nonzero(kinds == int(kind))) for kind in KINDS
    }
    return {**counts, None: int(np.count_nonzero(collided))}


class _Places:
    """Two columns as rows of (x, y), put together where they are asked for."""

    def __init__(self, x: Array, y: Array) -> None:
        self._x, self._y = x, y

    def __getitem__(self, which: Any) -> Array:
        return np.stack([self._x[which], self._y[which]], axis=-1)


def _look_of(line: Line2D) -> dict[str, Any]:
    return {
        "color": line.get_color(),
        "linestyle": "none",
        "marker": line.get_marker(),
        "markersize": line.get_markersize() / 1.5,
        "markerfacecolor": "none",
        "markeredgewidth": line.get_markeredgewidth(),
    }
