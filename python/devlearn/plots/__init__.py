"""The paper's figures, drawn from worlds, records and learners.

Plots only read: ``plot_x(record or world, *, ax=None) -> Axes`` never runs a trial. Without ``ax``
a new figure is made, at a journal column's width; with it nothing but these axes is touched. To
compose several panels in the same style::

    import matplotlib.pyplot as plt
    from devlearn import plots

    with plt.rc_context(plots.STYLE):
        figure, axes = plt.subplots(2, 2, layout="constrained")
    for entry, ax in enumerate(axes.flat):
        plots.plot_trajectory(record, ax=ax, entry=entry)

Colours are those of Okabe and Ito and matplotlib's cividis; what they tell apart differs in shape
or width as well, so that the figures can be read in grey. Needs matplotlib:
``pip install devlearn[plots]``.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, cast

import numpy as np
import numpy.typing as npt

try:
    import matplotlib as mpl
except ImportError as error:
    raise ImportError(
        "devlearn.plots needs matplotlib, which is not installed: pip install devlearn[plots]"
    ) from error
from matplotlib import patches
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, ScalarFormatter
from matplotlib.transforms import ScaledTranslation

from .._core import (
    Circle,
    Event,
    Kind,
    Learner,
    Rectangle,
    Robot,
    RobotDef,
    SituationGrid,
    StateEvaluation,
    TrialConfig,
    World,
)
from ..errors import InvalidValue
from ..record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

__all__ = [
    "STYLE",
    "Episode",
    "PreferenceField",
    "counts_before",
    "find_abandonment",
    "find_entry_and_window",
    "find_episodes",
    "find_window",
    "plot_counts",
    "plot_distribution",
    "plot_episodes",
    "plot_preferences",
    "plot_rounds",
    "plot_sef",
    "plot_sef_surface",
    "plot_trajectory",
    "plot_world",
    "preference_field",
]

# --- style ----------------------------------------------------------------------------------------

# Okabe and Ito (2008): told apart by the colour-blind.
BLACK = "#000000"
ORANGE = "#E69F00"
SKY = "#56B4E9"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILLION = "#D55E00"
PURPLE = "#CC79A7"
GREY = "#7F7F7F"
INK = "#222222"
OBSTACLE = "#A9CBE6"  # the paper's blue, light enough to draw over

COLUMN = 3.5  # a journal column [inches]
STYLE: Any = {  # matplotlib's own type lists every setting by name
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.linewidth": 1.0,
    "legend.frameon": False,
    "figure.dpi": 200,
    "savefig.dpi": 200,
    "svg.fonttype": "none",
}
"""The rc settings under which everything here is drawn; for ``matplotlib.rc_context``."""

_F = TypeVar("_F", bound=Callable[..., Any])


def _styled(plot: _F) -> _F:
    @functools.wraps(plot)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        with mpl.rc_context(STYLE):
            return plot(*args, **kwargs)

    return cast(_F, wrapper)


def _axes(ax: Axes | None, height: float) -> Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    _, ax = plt.subplots(figsize=(COLUMN, height), layout="constrained")
    return ax


def _arena_axes(
    ax: Axes | None, world: World, *, bar: bool = False, legend: bool = False, title: bool = False
) -> Axes:
    """Axes for a map of the world, in a figure as high as that needs."""
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    # Around the axes, in inches. Automatic layouts do not foresee what equal aspects leave over.
    left, right, bottom, top = 0.4, 0.72 if bar else 0.1, 0.4, 0.08
    bottom += 0.22 * legend
    top += 0.2 * title
    width = COLUMN - left - right
    height = width * world.height / world.width
    total = bottom + height + top
    figure = plt.figure(figsize=(COLUMN, total))
    return figure.add_axes((left / COLUMN, bottom / total, width / COLUMN, height / total))


def _legend_below(ax: Axes, handles: Sequence[Any], columns: int | None = None) -> None:
    """Outside the data, under the label of the x axis."""
    below = ax.transAxes + ScaledTranslation(0, -28 / 72, ax.figure.dpi_scale_trans)
    ax.legend(
        handles=list(handles),
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        bbox_transform=below,
        ncol=columns or len(handles),
        borderaxespad=0.0,
        handletextpad=0.5,
        columnspacing=1.0,
        handlelength=2.2 if columns else 1.5,
    )


def _colorbar(ax: Axes, colours: Any, label: str, extend: str = "neither") -> None:
    """Beside the axes and as high as they are."""
    beside = ax.inset_axes((1.03, 0.0, 0.045, 1.0))
    bar = ax.figure.colorbar(colours, cax=beside, label=label, extend=extend)
    bar.outline.set_linewidth(0.4)


def _thousands(count: int) -> str:
    return f"{count:,}".replace(",", "\u2009")


# --- worlds: Figs. 2 and 4 ------------------------------------------------------------------------


def _world_of(source: World | Record) -> World:
    return source.world if isinstance(source, Record) else source


def _config_of(source: World | Record, config: TrialConfig | None) -> TrialConfig:
    if config is not None:
        return config
    return source.config if isinstance(source, Record) else TrialConfig()


def _draw_obstacles(ax: Axes, world: World, **how: Any) -> None:
    how = {"facecolor": OBSTACLE, "edgecolor": BLUE, "linewidth": 0.7, "zorder": 1.0, **how}
    for i, obstacle in enumerate(world.obstacles):
        patch: patches.Patch
        if isinstance(obstacle, Circle):
            patch = patches.Circle((obstacle.center[0], obstacle.center[1]), obstacle.radius, **how)
        elif isinstance(obstacle, Rectangle):
            patch = patches.Polygon(_corners(obstacle), closed=True, **how)
        else:
            patch = patches.Polygon(np.array(obstacle.corners, dtype=float), closed=True, **how)
        patch.set_gid(f"obstacle-{i}")
        ax.add_patch(patch)
        # What lies beyond the walls, where a world lets an obstacle reach into them, is not shown.
        patch.set_clip_path(
            patches.Rectangle((0, 0), world.width, world.height, transform=ax.transData)
        )


def _corners(rectangle: Rectangle) -> npt.NDArray[np.float64]:
    half = np.array(rectangle.size, dtype=float) / 2
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
    angle = math.radians(rectangle.angle)
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    return cast("npt.NDArray[np.float64]", corners @ turn + np.array(rectangle.center))


def _draw_arena(ax: Axes, world: World) -> None:
    """The walls, and axes in metres that show one metre the same both ways."""
    wall = patches.Rectangle(
        (0, 0), world.width, world.height, fill=False, edgecolor=INK, linewidth=1.6, zorder=4.0
    )
    wall.set_gid("walls")
    ax.add_patch(wall)
    margin = 0.02 * max(world.width, world.height)
    ax.set_xlim(-margin, world.width + margin)
    ax.set_ylim(-margin, world.height + margin)
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10], integer=True))
    for spine in ax.spines.values():
        spine.set_visible(False)


def _draw_target(ax: Axes, world: World) -> Line2D:
    (star,) = ax.plot(
        *world.target,
        marker="*",
        markersize=10,
        markerfacecolor=VERMILLION,
        markeredgecolor="white",
        markeredgewidth=0.6,
        linestyle="none",
        label="target",
        zorder=6.0,
        gid="target",
    )
    return star


def _draw_robot(ax: Axes, radius: float, pose: Sequence[float], zorder: float = 5.0) -> None:
    x, y, heading = pose
    body = patches.Circle(
        (x, y), radius, facecolor=GREEN, edgecolor=INK, linewidth=0.7, zorder=zorder
    )
    body.set_gid("robot")
    ax.add_patch(body)
    angle = math.radians(heading)
    ax.plot(
        [x, x + radius * math.cos(angle)],
        [y, y + radius * math.sin(angle)],
        color="white",
        linewidth=1.2,
        solid_capstyle="butt",
        zorder=zorder + 0.1,
        gid="heading",
    )


def _robot_handle(label: str = "robot") -> Line2D:
    return Line2D(
        [],
        [],
        marker="o",
        markersize=6,
        markerfacecolor=GREEN,
        markeredgecolor=INK,
        markeredgewidth=0.7,
        linestyle="none",
        label=label,
    )


@_styled
def plot_world(
    world: World | Record,
    *,
    ax: Axes | None = None,
    robot: RobotDef | None = None,
    pose: Sequence[float] | None = None,
    sonar: bool = True,
    legend: bool = True,
) -> Axes:
    """Draw a world with the robot, its sonars and the target: Fig. 2.

    ``robot`` (a record's own, else the paper's) stands at ``pose`` (x, y [m], heading [degrees];
    the world's start). With ``sonar`` each ray runs from the body's rim to what it meets, a dot
    marking the echo; a ray that meets nothing ends, dashed, at the sonar's range.
    """
    body = robot if robot is not None else _config_of(world, None).robot
    place = _world_of(world)
    stand = tuple(place.start) if pose is None else tuple(pose)
    ax = _arena_axes(ax, place, legend=legend)
    _draw_arena(ax, place)
    _draw_obstacles(ax, place)
    handles = [_robot_handle()]
    if sonar:
        echoes = Robot(place, body).sonar(stand)
        for i, (angle, echo) in enumerate(zip(body.sonar_angles(), echoes)):
            met = echo < body.sonar_range
            direction = math.radians(stand[2] + angle)
            reach = np.array([body.radius, body.radius + echo])
            ax.plot(
                stand[0] + reach * math.cos(direction),
                stand[1] + reach * math.sin(direction),
                color=INK,
                linewidth=0.7,
                linestyle="-" if met else (0, (4, 2)),
                marker="o" if met else None,
                markersize=2.6,
                markevery=[1],
                zorder=3.0,
                clip_on=False,
                gid=f"sonar-{i}",
            )
        handles.append(
            Line2D(
                [], [], color=INK, linewidth=0.7, marker="o", markersize=2.6, label="sonar, echo"
            )
        )
    _draw_robot(ax, body.radius, stand)
    handles.append(_draw_target(ax, place))
    if place.obstacles:
        handles.append(_obstacle_handle())
    if legend:
        _legend_below(ax, handles)
    return ax


def _obstacle_handle() -> Any:
    return patches.Patch(facecolor=OBSTACLE, edgecolor=BLUE, linewidth=0.7, label="obstacle")


class _Energy(NamedTuple):
    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    sef: npt.NDArray[np.float64]
    floor: float


def _energy(
    source: World | Record,
    evaluation: StateEvaluation | None,
    walls_count: bool | None,
    points: int,
    floor: float | None,
) -> _Energy:
    if points < 2:
        raise InvalidValue("points", points, "at least 2")
    world = _world_of(source)
    config = _config_of(source, None)
    sef = evaluation if evaluation is not None else config.evaluation
    walls = config.walls_count if walls_count is None else walls_count
    step = max(world.width, world.height) / (points - 1)
    x = np.linspace(0, world.width, max(2, round(world.width / step) + 1))
    y = np.linspace(0, world.height, max(2, round(world.height / step) + 1))
    xs, ys = np.meshgrid(x, y)
    goal = np.hypot(xs - world.target[0], ys - world.target[1])
    values = np.asarray(sef(goal, world.clearance(xs, ys, walls_count=walls)))
    if floor is None:
        # The pits at the obstacles would take most of the scale. Below what the target's term alone
        # gives anywhere, half of that term's range is shown.
        term = np.asarray(sef(goal, np.full_like(goal, np.inf)))
        floor = float(term.min() - 0.5 * (term.max() - term.min()))
        floor = max(floor, float(values.min()))
    return _Energy(x, y, values, floor)


@_styled
def plot_sef(
    world: World | Record,
    *,
    ax: Axes | None = None,
    evaluation: StateEvaluation | None = None,
    walls_count: bool | None = None,
    kind: str = "map",
    points: int = 301,
    floor: float | None = None,
    colorbar: bool = True,
) -> Axes:
    """Draw the state evaluation function (Eq. 6) over the arena as a map: Fig. 4 from above.

    ``evaluation`` and ``walls_count`` are a record's own, else the defaults. SEF falls steeply at
    the obstacles; the scale ends at ``floor`` (by default half of the target's term's range below
    that term's least value), everything below has the darkest colour, and the colour bar's pointed
    end says so. ``points`` along the longer side. ``kind="surface"`` is ``plot_sef_surface``.
    """
    if kind == "surface":
        return plot_sef_surface(
            world, ax=ax, evaluation=evaluation, walls_count=walls_count, floor=floor
        )
    if kind != "map":
        raise InvalidValue("kind", kind, '"map" or "surface"')
    energy = _energy(world, evaluation, walls_count, points, floor)
    place = _world_of(world)
    ax = _arena_axes(ax, place, bar=colorbar)
    dx, dy = energy.x[1] - energy.x[0], energy.y[1] - energy.y[0]
    image = ax.imshow(
        energy.sef,
        extent=(-dx / 2, place.width + dx / 2, -dy / 2, place.height + dy / 2),
        origin="lower",
        cmap="cividis",
        vmin=energy.floor,
        vmax=float(energy.sef.max()),
        interpolation="bilinear",
        zorder=0.5,
    )
    image.set_gid("sef")
    levels = MaxNLocator(nbins=10).tick_values(energy.floor, float(energy.sef.max()))
    ax.contour(
        energy.x, energy.y, energy.sef, levels=levels, colors="white", linewidths=0.4, alpha=0.7
    )
    _draw_arena(ax, place)
    _draw_obstacles(ax, place, facecolor="none", edgecolor="white", linewidth=0.9, zorder=2.0)
    _draw_target(ax, place)
    if colorbar:
        clipped = bool(energy.sef.min() < energy.floor)
        _colorbar(ax, image, "SEF (no unit)", "min" if clipped else "neither")
    return ax


@_styled
def plot_sef_surface(
    world: World | Record,
    *,
    ax: Axes | None = None,
    evaluation: StateEvaluation | None = None,
    walls_count: bool | None = None,
    points: int = 201,
    floor: float | None = None,
) -> Axes:
    """Draw the state evaluation function (Eq. 6) as a surface over the arena: Fig. 4.

    ``ax`` must be three-dimensional (``subplot_kw={"projection": "3d"}``). The pits at the
    obstacles are cut off at ``floor``, as in ``plot_sef``, and the vertical axis says so.
    """
    energy = _energy(world, evaluation, walls_count, points, floor)
    place = _world_of(world)
    if ax is None:
        import matplotlib.pyplot as plt

        figure = plt.figure(figsize=(COLUMN, 3.0))
        ax = figure.add_axes((0.1, 0.09, 0.85, 0.93), projection="3d")
    if ax.name != "3d":
        raise InvalidValue("ax", f"{ax.name} axes", 'axes with projection "3d"')
    solid = cast(Any, ax)  # Axes3D, which matplotlib does not type
    xs, ys = np.meshgrid(energy.x, energy.y)
    surface = solid.plot_surface(
        xs,
        ys,
        np.maximum(energy.sef, energy.floor),
        cmap="cividis",
        rcount=points,
        ccount=points,
        linewidth=0,
        antialiased=False,
    )
    surface.set_rasterized(True)
    surface.set_gid("sef")
    clipped = bool(energy.sef.min() < energy.floor)
    solid.set_xlabel("x [m]")
    solid.set_ylabel("y [m]")
    solid.set_zlabel(f"SEF (cut off at {energy.floor:.3g})" if clipped else "SEF")
    solid.set_xlim(0, place.width)
    solid.set_ylim(0, place.height)
    for axis in (solid.xaxis, solid.yaxis):
        axis.set_major_locator(MaxNLocator(nbins=6, integer=True))
    solid.set_box_aspect(
        (place.width, place.height, 0.7 * min(place.width, place.height)), zoom=0.92
    )
    solid.view_init(elev=42, azim=-125)
    return ax


# --- paths: Figs. 6, 9, 10, 11 and 12 -------------------------------------------------------------

# Told apart by width and marker, not by colour alone; drawn in this order.
_KINDS: dict[Kind, tuple[str, dict[str, Any]]] = {
    Kind.UNSTATED: ("no reason given", {"color": GREY, "linewidth": 0.8}),
    Kind.EXPLORE: (
        "explore",
        {"color": ORANGE, "linewidth": 1.4, "marker": "o", "markersize": 2.2},
    ),
    Kind.EXHAUSTED: (
        "exhausted",
        {"color": BLUE, "linewidth": 0.5, "marker": "x", "markersize": 2.6},
    ),
    Kind.EXPLOIT: ("exploit", {"color": BLACK, "linewidth": 0.8}),
}


@_styled
def plot_trajectory(
    record: Record,
    *,
    ax: Axes | None = None,
    entry: int = 0,
    by: str | None = "kind",
    color: str = INK,
    label: str | None = None,
    world: bool = True,
    legend: bool = True,
    title: bool = True,
) -> Axes:
    """Draw the path of one round over its world: Figs. 6 and 9 to 12.

    ``entry`` is the index in ``record.rounds``. ``by="kind"`` tells explored, exploited and
    exhausted steps apart, each marker standing where the choice was made, with their numbers in the
    legend; ``by="time"`` colours by step; ``None`` draws one line in ``color`` (``label`` for a
    legend of your own). ``world=False`` adds the path to what is already drawn.
    """
    if by not in ("kind", "time", None):
        raise InvalidValue("by", by, '"kind", "time" or None')
    path = record.path(entry)
    place = record.world
    timed, kinded = by == "time", by == "kind"
    ax = _arena_axes(ax, place, bar=legend and timed, legend=legend and kinded, title=title)
    if world:
        _draw_arena(ax, place)
        _draw_obstacles(ax, place)
    handles: list[Any] = []
    if by == "kind":
        kinds = record.kind[record.steps_of(entry)]
        for order, (kind, (name, how)) in enumerate(_KINDS.items()):
            chosen = kinds == int(kind)
            count = int(np.count_nonzero(chosen))
            if count == 0:
                continue
            lines = np.full((count, 3, 2), np.nan)
            lines[:, 0] = path[:-1][chosen, :2]
            lines[:, 1] = path[1:][chosen, :2]
            (line,) = ax.plot(
                *lines.reshape(-1, 2).T,
                markevery=3,
                markeredgewidth=0.7 if how.get("marker") == "x" else 0.0,
                solid_capstyle="round",
                label=f"{name} ({_thousands(count)})",
                zorder=2.0 + 0.1 * order,
                gid=f"path-{name}",
                **how,
            )
            handles.append(_shown_larger(line))
    elif by == "time":
        segments = np.stack([path[:-1, :2], path[1:, :2]], axis=1)
        lines_by_time = LineCollection(
            list(segments), cmap=_dark_cividis(), linewidths=1.0, capstyle="round", zorder=2.0
        )
        lines_by_time.set_array(np.arange(1, len(path)))
        lines_by_time.set_gid("path")
        ax.add_collection(lines_by_time, autolim=False)
        if legend:
            _colorbar(ax, lines_by_time, "step")
    else:
        ax.plot(
            path[:, 0], path[:, 1], color=color, linewidth=0.9, label=label, zorder=2.0, gid="path"
        )
    if world:
        _draw_robot(ax, record.config.robot.radius, path[0], zorder=3.0)
        _draw_target(ax, place)
    if legend and handles:
        _legend_below(ax, handles)
    if title:
        number, steps, arrived = record.rounds[entry]
        ax.set_title(
            f"round {number}: {_thousands(steps)} steps" + ("" if arrived else ", not arrived")
        )
    return ax


def _shown_larger(line: Line2D) -> Line2D:
    """The same line for a legend, where a marker of 2 points is hard to see."""
    return Line2D(
        [0, 1],
        [0, 0],
        color=line.get_color(),
        linewidth=line.get_linewidth(),
        marker=line.get_marker(),
        markersize=1.6 * line.get_markersize(),
        markeredgewidth=line.get_markeredgewidth(),
        label=str(line.get_label()),
    )


# --- mappings: Figs. 7 and 8 ----------------------------------------------------------------------

_EXPLORED: dict[str, Any] = {"color": BLUE, "linestyle": "-", "linewidth": 1.2}
_EFFECTIVE: dict[str, Any] = {"color": VERMILLION, "linestyle": (0, (3, 1)), "linewidth": 1.2}


def counts_before(
    record: Record, entry: int = 0
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """NUM_RM and NUM_M of one round as the paper's Figs. 7 and 8 count them.

    Element ``t - 1`` is the count before the outcome of step ``t``, for t = 1 ... steps, and one
    more element follows, the count after the last step: a motion explored at step 24 shows at step
    25. (``Record.explored_count`` and ``effective_count`` count after each step.)
    """
    steps = record.steps_of(entry)
    explored, effective = record.explored_count[steps], record.effective_count[steps]
    if steps.stop == steps.start:
        nothing = np.zeros(1, dtype=np.int64)
        return nothing, nothing
    first = steps.start
    if first > 0:
        before = int(record.explored_count[first - 1]), int(record.effective_count[first - 1])
    else:  # what the record's first step changed is known from what it was
        event = record.event[0]
        developed = int(event == Event.EXTENSION) - int(event == Event.ABANDONMENT)
        before = (
            max(0, int(explored[0]) - int(record.kind[0] == Kind.EXPLORE)),
            max(0, int(effective[0]) - developed + int(record.reduced[0])),
        )
    return np.concatenate([[before[0]], explored]), np.concatenate([[before[1]], effective])


def _window(record: Record, entry: int, window: tuple[int, int] | None) -> tuple[int, int]:
    """``window`` within the round, as a half-open range of its steps."""
    count = int(record.rounds["steps"][entry])
    start, stop = (0, count) if window is None else window
    if not 0 <= start < stop:
        raise InvalidValue("window", (start, stop), "0 <= start < stop")
    return min(start, count), min(stop, count)


@_styled
def plot_counts(
    record: Record,
    *,
    ax: Axes | None = None,
    entry: int = 0,
    steps: tuple[int, int] | None = None,
    relative: bool = False,
    legend: bool = True,
) -> Axes:
    """Draw how many mappings were explored, and how many are effective, by step: Fig. 7.

    Steps count from 1; the values at step t are those before its outcome (``counts_before``).
    ``steps=(start, stop)`` is a half-open range: ``(0, 30)`` shows the steps 1 to 30 (Fig. 8).
    ``relative`` counts from what there was at the first step shown, which the legend then gives.
    """
    start, stop = _window(record, entry, steps)
    explored, effective = counts_before(record, entry)
    number = np.arange(start + 1, stop + 1)
    few = len(number) <= 60
    ax = _axes(ax, 2.4)
    for gid, name, values, how, marker in (
        ("explored", "explored, NUM$_\\mathrm{RM}$", explored, _EXPLORED, "o"),
        ("effective", "effective, NUM$_\\mathrm{M}$", effective, _EFFECTIVE, "s"),
    ):
        base = int(values[start]) if relative and len(number) else 0
        ax.plot(
            number,
            values[start:stop] - base,
            marker=marker if few else None,
            markersize=2.6,
            label=name + (f" \u2212 {_thousands(base)}" if relative else ""),
            gid=gid,
            **how,
        )
    ax.set_xlabel("step")
    ax.set_ylabel(f"mappings since step {start + 1}" if relative else "sensorimotor mappings")
    _whole_numbers(ax.xaxis, ax.yaxis)
    if not few and not relative:
        ax.set_ylim(bottom=0)
    if legend:
        ax.legend(loc="upper left" if few else "best", handlelength=2.4)
    return ax


def _whole_numbers(*axes: Axis) -> None:
    for axis in axes:
        axis.set_major_locator(MaxNLocator(nbins=7, integer=True, min_n_ticks=2))


class Episode(NamedTuple):
    """A stretch of the counts between the steps ``first`` and ``last``, from 1 as in Fig. 8.

    What happened at the steps first ... last - 1 shows in the counts of first + 1 ... last.
    """

    first: int
    last: int


# The paper's rectangles (section VI-A). A run is at least two steps long.
_MIN_RUN = 2
_EPISODES: dict[str, tuple[str, dict[str, Any]]] = {
    "a": ("effective exploration", {"edgecolor": GREEN, "linestyle": "-"}),
    "b": ("ineffective explorations", {"edgecolor": PURPLE, "linestyle": (0, (4, 1.5))}),
    "c": ("exploitation, no change", {"edgecolor": INK, "linestyle": (0, (1, 1))}),
    "d": ("exploitation, reduction", {"edgecolor": VERMILLION, "linestyle": "-."}),
    # Not the paper's.
    "d*": ("exploitation, abandonment", {"edgecolor": GREY, "linestyle": "-."}),
}


def _of_kinds(record: Record, entry: int) -> dict[str, npt.NDArray[np.bool_]]:
    """Which steps of a round are of the paper's four kinds."""
    steps = record.steps_of(entry)
    kind, event, reduced = record.kind[steps], record.event[steps], record.reduced[steps]
    explored = np.diff(counts_before(record, entry)[0])
    effective = np.diff(counts_before(record, entry)[1])
    explore, exploit = kind == int(Kind.EXPLORE), kind == int(Kind.EXPLOIT)
    return {
        "a": explore & (explored > 0) & (effective > 0),
        "b": explore & (explored > 0) & (effective == 0),
        "c": exploit & (explored == 0) & (effective == 0),
        # An abandonment lowers NUM_M as well, and is none.
        "d": exploit & (reduced > 0) & (event != int(Event.ABANDONMENT)) & (effective < 0),
    }


def find_episodes(
    record: Record, entry: int = 0, window: tuple[int, int] = (0, 30)
) -> dict[str, Episode | None]:
    """Where the paper's four kinds of episode (section VI-A, Fig. 8) occur in a window of a round.

    - ``"a"``: the first exploration that is effective: NUM_RM and NUM_M rise;
    - ``"b"``: the longest run of explorations none of which is: NUM_RM rises, NUM_M stays;
    - ``"c"``: the longest run of exploitation in which neither changes;
    - ``"d"``: the first exploitation after which reduction development lowers NUM_M (an
      abandonment lowers it, too, and does not count).

    None where a kind does not occur. A run is two steps at least; of equal ones the first is taken.
    ``window=(0, 30)`` looks at the counts of the steps 1 to 30: an episode ends by step 30.
    """
    start, stop = _window(record, entry, window)
    found: dict[str, Episode | None] = {}
    for name, which in _of_kinds(record, entry).items():
        # The outcome of the window's last step shows only beyond it.
        inside = np.flatnonzero(which[start : max(start, stop - 1)]) + start
        if name in ("a", "d"):
            found[name] = Episode(int(inside[0]) + 1, int(inside[0]) + 2) if len(inside) else None
            continue
        runs = np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1)
        longest = max(runs, key=len)  # the first of equals
        found[name] = (
            Episode(int(longest[0]) + 1, int(longest[-1]) + 2) if len(longest) >= _MIN_RUN else None
        )
    return found


def find_abandonment(
    record: Record, entry: int = 0, window: tuple[int, int] = (0, 30)
) -> Episode | None:
    """The first exploitation in a window that lowers NUM_M by abandonment (step 4 of the method).

    In the counts it looks like the paper's kind d, which is reduction development alone.
    """
    start, stop = _window(record, entry, window)
    steps = record.steps_of(entry)
    inside = np.flatnonzero(
        record.event[steps][start : max(start, stop - 1)] == int(Event.ABANDONMENT)
    )
    return Episode(start + int(inside[0]) + 1, start + int(inside[0]) + 2) if len(inside) else None


def find_window(
    record: Record, kinds: str = "abcd", entry: int = 0, length: int = 30
) -> tuple[int, int] | None:
    """Find the first ``length`` steps of a round that contain all these kinds of episode.

    For ``find_episodes`` and ``plot_episodes``. The round's very first steps are taken if they do;
    else the episode stands in the middle as far as the others allow. None if no window does.
    """
    for name in kinds:
        if name not in "abcd":
            raise InvalidValue("kinds", kinds, 'letters of "abcd"')
    if length < _MIN_RUN + 1:
        raise InvalidValue("length", length, f"at least {_MIN_RUN + 1}")
    steps = int(record.rounds["steps"][entry])
    starts = np.arange(max(1, steps - length + 1))
    holds = np.ones(len(starts), dtype=bool)
    for name, which in _of_kinds(record, entry).items():
        if name not in kinds:
            continue
        span = 1 if name in ("a", "d") else _MIN_RUN
        begins = np.flatnonzero(which if span == 1 else which[:-1] & which[1:])
        following = np.searchsorted(begins, starts)
        there = following < len(begins)
        ends = np.full(len(starts), steps + length)
        ends[there] = begins[following[there]] + span
        holds &= ends < np.minimum(starts + length, steps)
    where = np.flatnonzero(holds)
    if len(where) == 0:
        return None
    gaps = np.flatnonzero(np.diff(where) > 1)
    first_run = where[: gaps[0] + 1] if len(gaps) else where
    start = 0 if first_run[0] == 0 else int(first_run[len(first_run[:length]) // 2])
    return start, min(start + length, steps)


def find_entry_and_window(
    record: Record, kinds: str = "abcd", length: int = 30
) -> tuple[int, tuple[int, int]] | None:
    """Find the first round of a record with such a window: its entry and ``find_window``'s answer.

    Reduction development, kind d, takes hundreds of exploitations in one place: the first
    round of free learning, as a rule, has none, path learning does.
    """
    for entry in range(len(record.rounds)):
        window = find_window(record, kinds, entry, length)
        if window is not None:
            return entry, window
    return None


@_styled
def plot_episodes(
    record: Record,
    *,
    ax: Axes | None = None,
    entry: int = 0,
    window: tuple[int, int] = (0, 30),
    legend: bool = True,
) -> Axes:
    """Draw the mapping counts of a window with the paper's four kinds of episode marked: Fig. 8.

    The rectangles a to d are those of ``find_episodes``. Of a kind that does not occur in the
    window the picture says so; ``window=find_window(record, "d")`` shows one that has it, the
    counts beginning at 0 in any window but the first. Where
    d is absent, d* marks an abandonment, which lowers NUM_M as well (``find_abandonment``).
    """
    start, stop = _window(record, entry, window)
    relative = start > 0
    ax = plot_counts(
        record,
        ax=_axes(ax, 3.0),
        entry=entry,
        steps=(start, stop),
        relative=relative,
        legend=False,
    )
    counts = np.stack(counts_before(record, entry))
    episodes = find_episodes(record, entry, window)
    absent = [f"{name} ({_EPISODES[name][0]})" for name, found in episodes.items() if not found]
    if episodes["d"] is None:
        episodes["d*"] = find_abandonment(record, entry, window)
    if stop <= start:
        return ax
    if relative:
        counts = counts - counts[:, start : start + 1]
    low, high = int(counts[:, start:stop].min()), int(counts[:, start:stop].max())
    unit = max(0.12, 0.01 * (high - low))
    handles: list[Any] = [*ax.get_lines()]
    for order, (name, episode) in enumerate(episodes.items()):
        meaning, how = _EPISODES[name]
        if episode is None:
            continue
        shown = slice(episode.first - 1, episode.last)
        pad = (4 - 0.7 * order) * unit  # edges that meet stay apart
        bottom = int(counts[:, shown].min()) - pad
        top = int(counts[:, shown].max()) + pad
        rectangle = patches.Rectangle(
            (episode.first - 0.25, bottom),
            episode.last - episode.first + 0.5,
            top - bottom,
            fill=False,
            linewidth=1.1,
            zorder=3.0,
            label=f"{name}: {meaning}",
            gid=f"episode-{name}",
            **how,
        )
        ax.add_patch(rectangle)
        handles.append(rectangle)
        ax.annotate(
            name,
            ((episode.first + episode.last) / 2, top),
            xytext=(0, 1.5),
            textcoords="offset points",
            ha="center",
            va="bottom",
            fontweight="bold",
            fontstyle="italic",
            gid=f"label-{name}",
        )
    ax.set_xlim(start + 0.3, stop + 0.7)
    ax.set_ylim(low - 8 * unit, high + 18 * unit)
    if absent:
        ax.set_title(
            f"absent from steps {start + 1} to {stop}: " + ",\n".join(absent),
            fontsize=7,
            gid="absent",
        )
    if legend:
        _legend_below(ax, handles, columns=2)
    return ax


# --- rounds: Fig. 10 and Table 1 ------------------------------------------------------------------


@_styled
def plot_rounds(
    record: Record,
    *,
    ax: Axes | None = None,
    shortest: float | None = None,
    settled: int | None = None,
    log: bool | None = None,
    legend: bool = True,
) -> Axes:
    """Draw the steps that each round took: Table 1, and the numbers behind Fig. 10.

    Rounds that did not arrive are crosses. ``shortest`` [steps] draws the shortest possible path,
    ``settled`` marks the round from which on the path is always the same. ``log`` puts the steps on
    a logarithmic axis; by default where they span more than a factor of ten.
    """
    ax = _axes(ax, 2.5)
    rounds = record.rounds
    number, steps = rounds["round"], rounds["steps"].astype(float)
    arrived = rounds["arrived"]
    every = [*steps[steps > 0], *([shortest] if shortest is not None else [])]
    if log is None:
        log = bool(every) and max(every) > 10 * min(every)
    handles: list[Any] = ax.plot(
        number[arrived],
        steps[arrived],
        color=BLUE,
        linewidth=0.5,
        marker="o",
        markersize=2.0,
        markeredgewidth=0,
        label="arrived",
        gid="arrived",
    )
    if not arrived.all():
        handles += ax.plot(
            number[~arrived],
            steps[~arrived],
            color=VERMILLION,
            linestyle="none",
            marker="x",
            markersize=4.5,
            markeredgewidth=1.2,
            label="not arrived",
            zorder=3.0,
            gid="failed",
        )
    if shortest is not None:
        handles.append(
            ax.axhline(
                shortest,
                color=INK,
                linestyle=(0, (4, 2)),
                linewidth=0.9,
                label=f"shortest possible: {shortest:g}",
                gid="shortest",
            )
        )
    if settled is not None:
        same = steps[number >= settled]
        label = f"settled from round {settled}" + (f": {same[-1]:g}" if len(same) else "")
        handles.append(
            ax.axvline(settled, color=GREEN, linestyle="-.", label=label, zorder=1.0, gid="settled")
        )
    ax.set_xlabel("round")
    ax.set_ylabel("steps of the round")
    _whole_numbers(ax.xaxis)
    if log:
        ax.set_yscale("log")
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_major_formatter(ScalarFormatter())
        ax.yaxis.set_minor_formatter(NullFormatter())
    elif every:
        ax.set_ylim(bottom=0)
    if legend:
        _legend_below(ax, handles, columns=min(2, len(handles)))
    return ax


# --- preferences ----------------------------------------------------------------------------------


class PreferenceField(NamedTuple):
    """What a learner prefers, cell by cell; arrays of one value a cell experienced."""

    x: npt.NDArray[np.float64]
    """Centre of the cell [m]."""
    y: npt.NDArray[np.float64]
    u: npt.NDArray[np.float64]
    """Mean direction of the preferred motions; its length in [0, 1] is their concentration."""
    v: npt.NDArray[np.float64]
    times: npt.NDArray[np.int64]
    """How often the preferred motions were learned; 0 where no mapping is effective."""


def preference_field(
    world: World | Record,
    learner: Learner,
    *,
    grid: SituationGrid | None = None,
    config: TrialConfig | None = None,
) -> PreferenceField:
    """Where a learner prefers to go, cell by cell, as ``plot_preferences`` draws it.

    In each situation experienced the effective motion of the highest orientation (the first of
    equals) gives the direction heading + steering angle. A cell's arrow is the mean of these unit
    vectors over its headings, each weighted by how often that motion was learned: of length 1 where
    all agree, short where the headings lead different ways.
    """
    config = _config_of(world, config)
    place = _world_of(world)
    if grid is None:
        columns, rows = (
            max(1, math.ceil(side / config.cell_size - 1e-9))
            for side in (place.width, place.height)
        )
        grid = SituationGrid(
            max(place.width, columns * config.cell_size),
            max(place.height, rows * config.cell_size),
            columns,
            rows,
            config.heading_bins,
        )
    angles = config.robot.steering_angles
    cells: dict[tuple[float, float], list[float]] = {}
    for situation in learner.situations():
        if situation >= grid.count:
            raise InvalidValue("situation", situation, f"of the grid: below {grid.count}")
        x, y, heading = grid.centre(situation)
        cell = cells.setdefault((x, y), [0.0, 0.0, 0])
        memory = learner.situation(situation)
        if not memory.effective:
            continue
        best = int(np.argmax(memory.orientation))
        motion, times = memory.effective[best], memory.times_learned[best]
        if motion >= len(angles):
            raise InvalidValue("motion", motion, f"one of the robot's {len(angles)}")
        direction = math.radians(heading + angles[motion])
        cell[0] += times * math.cos(direction)
        cell[1] += times * math.sin(direction)
        cell[2] += times
    sums = np.array([[*at, *cell] for at, cell in cells.items()], dtype=float).reshape(-1, 5)
    total = np.maximum(sums[:, 4], 1.0)
    return PreferenceField(
        sums[:, 0],
        sums[:, 1],
        sums[:, 2] / total,
        sums[:, 3] / total,
        sums[:, 4].astype(np.int64),
    )


def _dark_cividis() -> ListedColormap:
    """Cividis from pale to dark, without the yellow that white paper swallows."""
    return ListedColormap(mpl.colormaps["cividis"](np.linspace(0.82, 0.0, 256)))


@_styled
def plot_preferences(
    world: World | Record,
    learner: Learner,
    *,
    grid: SituationGrid | None = None,
    config: TrialConfig | None = None,
    ax: Axes | None = None,
    colorbar: bool = True,
    legend: bool = True,
) -> Axes:
    """Draw what a learner prefers as a field of arrows over the arena.

    One arrow a cell (``preference_field``): its direction is where the preferred motions lead, its
    length how much the cell's headings agree, its colour how often they were learned, from pale to
    dark. A dot is a cell that was experienced and where nothing is effective. ``grid`` and
    ``config`` are the trial's (a record's own, else the defaults); beyond the paper's figures.
    """
    place = _world_of(world)
    config = _config_of(world, config)
    field = preference_field(world, learner, grid=grid, config=config)
    ax = _arena_axes(ax, place, bar=colorbar, legend=legend)
    _draw_arena(ax, place)
    _draw_obstacles(ax, place)
    knows = field.times > 0
    width = 0.9 * config.cell_size
    if grid is not None:
        width = 0.9 * min(grid.width / grid.columns, grid.height / grid.rows)
    arrows = ax.quiver(
        field.x[knows],
        field.y[knows],
        width * field.u[knows],
        width * field.v[knows],
        field.times[knows],
        cmap=_dark_cividis(),
        norm=_log_norm(field.times[knows]),
        angles="xy",
        scale_units="xy",
        scale=1.0,
        pivot="mid",
        units="xy",
        width=0.13 * width,
        headwidth=3.6,
        headlength=3.6,
        headaxislength=3.2,
        minlength=0.5,
        zorder=2.0,
    )
    arrows.set_gid("preferences")
    handles: list[Any] = []
    if not knows.all():
        handles += ax.plot(
            field.x[~knows],
            field.y[~knows],
            linestyle="none",
            marker="o",
            markersize=1.8,
            markerfacecolor="white",
            markeredgecolor=GREY,
            markeredgewidth=0.5,
            label="nothing effective",
            zorder=1.5,
            gid="nothing-effective",
        )
    handles.append(_draw_target(ax, place))
    if legend:
        _legend_below(ax, handles)
    if colorbar and knows.any():
        _colorbar(ax, arrows, "times learned")
    return ax


def _log_norm(times: npt.NDArray[np.int64]) -> Normalize:
    low, high = (int(times.min()), int(times.max())) if len(times) else (1, 10)
    return LogNorm(low, max(high, low + 1))


# --- statistics over seeds ------------------------------------------------------------------------


@_styled
def plot_distribution(
    values_by_label: Mapping[str, npt.ArrayLike],
    *,
    ax: Axes | None = None,
    ylabel: str = "",
    bound: float | None = None,
) -> Axes:
    """Draw samples side by side, each value a point over a box of median and quartiles.

    The whiskers reach from the 10th to the 90th percentile. Values that are not finite are left out
    and their number stands at the label. ``bound`` draws a line, such as a claim's criterion.
    """
    ax = _axes(ax, 2.5)
    labels = []
    for position, (label, values) in enumerate(values_by_label.items(), start=1):
        every = np.asarray(values, dtype=float).ravel()
        sample = np.sort(every[np.isfinite(every)])
        missing = len(every) - len(sample)
        labels.append(label + (f"\n({missing} without value)" if missing else ""))
        if len(sample) == 0:
            continue
        ax.boxplot(
            [sample],
            positions=[position],
            widths=0.5,
            whis=(10, 90),
            showfliers=False,
            medianprops={"color": VERMILLION, "linewidth": 1.6},
            boxprops={"color": INK, "linewidth": 0.8},
            whiskerprops={"color": INK, "linewidth": 0.8},
            capprops={"color": INK, "linewidth": 0.8},
        )
        # Spread sideways by the golden ratio: even, and the same each time.
        spread = (np.arange(len(sample)) * 0.618034) % 1.0 - 0.5
        ax.plot(
            position + 0.36 * spread,
            sample,
            linestyle="none",
            marker="o",
            markersize=2.4,
            markerfacecolor=BLUE,
            markeredgewidth=0,
            alpha=0.65,
            zorder=3.0,
            gid=f"sample-{position}",
        )
    if bound is not None:
        ax.axhline(bound, color=GREEN, linestyle=(0, (4, 2)), linewidth=0.9, gid="bound")
    ax.set_xlim(0.4, len(labels) + 0.6)
    ax.set_xticks(range(1, len(labels) + 1), labels)
    ax.set_ylabel(ylabel)
    return ax
