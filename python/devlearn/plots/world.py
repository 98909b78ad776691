"""Worlds: Fig. 2, and what is drawn over them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from matplotlib import patches
from matplotlib.collections import PatchCollection
from matplotlib.lines import Line2D
from matplotlib.path import Path
from matplotlib.ticker import MaxNLocator, ScalarFormatter

from .._core import Circle, Polygon, Polyline, Rectangle, Robot, RobotDef, World
from ..analysis.fields import Source, config_of, world_of
from ..analysis.outlines import Obstacle, corners, course
from .style import (
    BLUE,
    COLUMN,
    GREEN,
    INK,
    OBSTACLE,
    VERMILLION,
    in_rows,
    legend_below,
    new_figure,
    styled,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

AT_START = "robot at start"
DASHES = (0, (4, 2))
LOWEST, HIGHEST = 0.3, 9.0  # axes of arenas that are far from square [inches]


def arena_axes(
    ax: Axes | None, world: World, *, bar: bool = False, legend: int = 0, title: int = 0
) -> Axes:
    """Axes for a map of the world, in a figure as high as that and the rows of text need."""
    if ax is not None:
        return ax
    # Around the axes, in inches. Automatic layouts do not foresee what equal aspects leave over.
    x, y = (
        0.062 * max(len(f"{edge:.0f}") for edge in (begin, begin + size))  # numbers at ticks
        for begin, size in zip(world.origin, (world.width, world.height))
    )
    left, right, bottom, top = 0.338 + y, 0.72 if bar else max(0.1, x / 2), 0.4, 0.08
    bottom += 0.22 * (legend > 0) + 0.15 * max(0, legend - 1)
    top += 0.2 * (title > 0) + 0.14 * max(0, title - 1)
    width = COLUMN - left - right
    height = min(max(width * world.height / world.width, LOWEST), HIGHEST)
    total = bottom + height + top
    figure = new_figure(total)
    return figure.add_axes((left / COLUMN, bottom / total, width / COLUMN, height / total))


def draw_obstacles(ax: Axes, world: World, time: float = 0.0, **how: Any) -> list[patches.Patch]:
    """The obstacles as patches, drawn as ``how`` says; movers where they are at ``time`` [s].

    Dashed is where the centre of each mover goes: its path, or the box of its walk. Returns the
    patches of the movers.
    """
    how = {"facecolor": OBSTACLE, "edgecolor": BLUE, "linewidth": 0.7, "zorder": 1.0, **how}
    drawn = [_patch_of(obstacle, how) for obstacle in world.obstacles]
    moving = [_patch_of(mover, how) for mover in world.movers_at(time)]
    # Each by itself can be told apart in an SVG; thousands would take minutes.
    many = len(drawn) > 1000
    alone = {"mover": moving} if many else {"obstacle": drawn, "mover": moving}
    # What lies beyond the walls, where a world lets an obstacle reach into them, is not shown.
    arena = patches.Rectangle(world.origin, world.width, world.height, transform=ax.transData)
    if many:
        ax.add_collection(
            PatchCollection(drawn, match_original=True, zorder=how["zorder"], clip_path=arena)
        )
    for name, each in alone.items():
        for i, patch in enumerate(each):
            patch.set_gid(f"{name}-{i}")
            ax.add_patch(patch)
            patch.set_clip_path(arena)
    for i, mover in enumerate(world.movers):
        ax.plot(
            *course(mover).T,
            color=how["edgecolor"],
            linewidth=0.7,
            linestyle=DASHES,
            zorder=how["zorder"],
            gid=f"course-{i}",
        )
    return moving


def _patch_of(obstacle: Obstacle, how: Mapping[str, Any]) -> patches.Patch:
    if isinstance(obstacle, Circle):
        return patches.Circle((obstacle.center[0], obstacle.center[1]), obstacle.radius, **how)
    if isinstance(obstacle, Rectangle):
        return patches.Polygon(corners(obstacle), closed=True, **how)
    if isinstance(obstacle, Polyline):
        wall = Path(np.array(obstacle.points, dtype=float))
        return patches.PathPatch(wall, fill=False, joinstyle="round", **how)
    if obstacle.holes:
        return patches.PathPatch(_outline(obstacle), **how)
    return patches.Polygon(np.array(obstacle.corners, dtype=float), closed=True, **how)


def move_to(patch: patches.Patch, mover: Obstacle) -> None:
    """The patch of a mover, where that is now."""
    if isinstance(mover, Circle):
        cast(patches.Circle, patch).center = (mover.center[0], mover.center[1])
    else:
        cast(patches.Polygon, patch).set_xy(corners(cast(Rectangle, mover)))


def _outline(polygon: Polygon) -> Path:
    """Holes turn the other way round, as is usual, so that nothing fills them."""

    def ring(corners: Sequence[tuple[float, float]], turn: int) -> Path:
        x, y = np.array(corners, dtype=float).T
        area = np.dot(x - x[0], np.roll(y, -1) - np.roll(y, 1))
        around = np.stack([x, y], axis=1)[:: int(np.sign(area)) * turn]
        return Path(np.concatenate([around, around[:1]]), closed=True)

    return Path.make_compound_path(
        ring(polygon.corners, 1), *(ring(hole, -1) for hole in polygon.holes)
    )


def draw_arena(ax: Axes, world: World) -> None:
    """The walls, and axes in metres that show one metre the same both ways."""
    wall = patches.Rectangle(
        world.origin,
        world.width,
        world.height,
        fill=False,
        edgecolor=INK,
        linewidth=1.6,
        zorder=4.0,
    )
    wall.set_gid("walls")
    ax.add_patch(wall)
    margin = 0.02 * max(world.width, world.height)
    x, y = world.origin
    ax.set_xlim(x - margin, x + world.width + margin)
    ax.set_ylim(y - margin, y + world.height + margin)
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(nbins=6, steps=[1, 2, 5, 10], integer=True))
        axis.set_major_formatter(ScalarFormatter(useOffset=False))
    for spine in ax.spines.values():
        spine.set_visible(False)


def draw_target(ax: Axes, world: World) -> Line2D:
    """The target as a star; for legends."""
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


def draw_robot(
    ax: Axes, radius: float, pose: Sequence[float], label: str, zorder: float = 5.0
) -> Line2D:
    """The body with its heading at a pose (x, y [m], heading [degrees]); for legends."""
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
    (named,) = ax.plot(
        [],
        [],
        marker="o",
        markersize=6,
        markerfacecolor=GREEN,
        markeredgecolor=INK,
        markeredgewidth=0.7,
        linestyle="none",
        label=label,
        gid="robot-named",
    )
    return named


def named_marks(ax: Axes) -> list[Line2D]:
    """Robot and target, where they are drawn; for legends."""
    return [line for line in ax.get_lines() if line.get_gid() in ("robot-named", "target")]


@styled
def plot_world(
    world: Source,
    *,
    ax: Axes | None = None,
    robot: RobotDef | None = None,
    pose: Sequence[float] | None = None,
    time: float = 0.0,
    sonar: bool = True,
    legend: bool = True,
) -> Axes:
    """Draw a world with the robot, its sonars and the target: Fig. 2.

    ``robot`` (a record's or a trial's own, else the paper's) stands at ``pose`` (x, y [m], heading
    [degrees]; the world's start). With ``sonar`` each ray runs from the body's rim to what it
    meets, a dot marking the echo; a ray that meets nothing ends, dashed, at the sonar's range.
    Movers are where they are at ``time`` [s]; dashed is their path, or the box of their walk.
    """
    body = robot if robot is not None else config_of(world).robot
    place = world_of(world)
    stand = tuple(place.start) if pose is None else tuple(pose)
    ax = arena_axes(ax, place, legend=(2 if place.movers and sonar else 1) if legend else 0)
    draw_arena(ax, place)
    draw_obstacles(ax, place, time)
    handles = [draw_robot(ax, body.radius, stand, AT_START if pose is None else "robot")]
    if sonar:
        echoes = Robot(place, body).sonar(stand, time)
        for i, (angle, echo) in enumerate(zip(body.sonar_angles(), echoes)):
            met = echo < body.sonar_range
            direction = math.radians(stand[2] + angle)
            reach = np.array([body.radius, body.radius + echo])
            ax.plot(
                stand[0] + reach * math.cos(direction),
                stand[1] + reach * math.sin(direction),
                color=INK,
                linewidth=0.7,
                linestyle="-" if met else DASHES,
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
    handles.append(draw_target(ax, place))
    if place.obstacles or place.movers:
        handles.append(_obstacle_handle())
    if place.movers:
        handles.append(
            Line2D([], [], color=BLUE, linewidth=0.7, linestyle=DASHES, label="where one moves")
        )
    if legend:
        columns = len(handles) if len(handles) < 5 else 3
        legend_below(ax, in_rows(handles, columns), columns)
    return ax


def _obstacle_handle() -> Any:
    return patches.Patch(facecolor=OBSTACLE, edgecolor=BLUE, linewidth=0.7, label="obstacle")
