"""Paths: Figs. 6, 9, 10, 11 and 12."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

from .._colours import BY_KIND
from .._core import Kind
from ..errors import InvalidValue
from ..record import Record
from .rounds import round_name
from .style import (
    INK,
    colorbar_beside,
    dark_cividis,
    in_rows,
    legend_below,
    styled,
    thousands,
)
from .world import (
    AT_START,
    arena_axes,
    draw_arena,
    draw_obstacles,
    draw_robot,
    draw_target,
    named_marks,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Told apart by width and marker, not by colour alone; drawn in this order.
_LOOKS: dict[Kind, tuple[str, dict[str, Any]]] = {
    Kind.UNSTATED: ("no reason given", {"linewidth": 0.8}),
    Kind.HELD: ("held", {"linewidth": 1.8}),
    Kind.HABIT: ("habit", {"linewidth": 1.1}),
    Kind.DEVIATION: ("deviation", {"linewidth": 1.4, "marker": "^", "markersize": 2.6}),
    Kind.EXPLORE: ("explore", {"linewidth": 1.4, "marker": "o", "markersize": 2.2}),
    Kind.EXHAUSTED: ("exhausted", {"linewidth": 0.5, "marker": "x", "markersize": 2.6}),
    Kind.EXPLOIT: ("exploit", {"linewidth": 0.8}),
}
KINDS: dict[Kind, tuple[str, dict[str, Any]]] = {
    kind: (_LOOKS[kind][0], {"color": color, **_LOOKS[kind][1]}) for kind, color in BY_KIND.items()
}


@styled
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

    ``entry`` is the index in ``record.rounds``; the title counts from 1, as rounds are asked for,
    and gives the trial's number of the round where that is another. ``by="kind"`` tells steps
    apart by why their motion was chosen, each marker standing where the choice was made, with their
    numbers in the legend; ``by="time"`` colours by step; ``None`` draws one line in ``color``,
    named ``label``. ``world=False`` adds the path to what is already drawn. Movers are drawn where
    they were when the entry began.
    """
    if by not in ("kind", "time", None):
        raise InvalidValue("by", by, '"kind", "time" or None')
    path = record.path(entry)
    place = record.world
    bar = legend and by == "time" and len(path) > 1
    kinds = record.kind[record.steps_of(entry)]
    met = len(np.unique(kinds)) if by == "kind" else 1
    columns = min(met, 3)
    rows = -(-(met + 2) // columns) if met > 1 else 1  # with robot and target
    _, steps, arrived, _ = record.rounds[entry]
    name = round_name(record, entry)
    told = name + ("\n" if name.endswith(")") else ": ") + f"{thousands(steps)} steps"
    told += "" if arrived else ", not arrived"
    ax = arena_axes(
        ax, place, bar=bar, legend=legend and rows, title=title and 1 + told.count("\n")
    )
    if world:
        draw_arena(ax, place)
        draw_obstacles(ax, place, time_at_start(record, entry))
    handles: list[Any] = []
    if by == "kind":
        for order, (kind, (name, how)) in enumerate(KINDS.items()):
            chosen = kinds == int(kind)
            count = int(np.count_nonzero(chosen))
            if count == 0:
                continue
            (line,) = ax.plot(
                *apart(path[:-1][chosen, :2], path[1:][chosen, :2]),
                markevery=3,
                markeredgewidth=0.7 if how.get("marker") == "x" else 0.0,
                solid_capstyle="round",
                label=f"{name} ({thousands(count)})",
                zorder=2.0 + 0.1 * order,
                gid=f"path-{name}",
                **how,
            )
            handles.append(_shown_larger(line))
    elif by == "time":
        segments = np.stack([path[:-1, :2], path[1:, :2]], axis=1)
        lines_by_time = LineCollection(
            list(segments), cmap=dark_cividis(), linewidths=1.0, capstyle="round", zorder=2.0
        )
        lines_by_time.set_array(np.arange(1, len(path)))
        lines_by_time.set_gid("path")
        ax.add_collection(lines_by_time, autolim=False)
        if bar:
            colorbar_beside(ax, lines_by_time, "step")
    else:
        (line,) = ax.plot(
            path[:, 0], path[:, 1], color=color, linewidth=0.9, label=label, zorder=2.0, gid="path"
        )
        handles += [line] if label is not None else []
    if world:
        draw_robot(ax, record.config.robot.radius, path[0], AT_START, zorder=3.0)
        draw_target(ax, place)
    if legend and (world or by == "kind"):
        marks = named_marks(ax)
        if len(handles) > 1:
            legend_below(ax, in_rows([*handles, *marks], columns), columns=columns, length=1.3)
        else:
            legend_below(ax, [*handles, *marks])
    if title:
        ax.set_title(told)
    return ax


def apart(
    begins: npt.NDArray[np.float64], ends: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    """Steps from (n, 2) to (n, 2) as one line's x and y, (2, 3 n): nothing joins them."""
    lines = np.full((len(begins), 3, 2), np.nan)
    lines[:, 0], lines[:, 1] = begins, ends
    return lines.reshape(-1, 2).T


def time_at_start(record: Record, entry: int) -> float:
    """When the entry began [s]; 0 in a world where nothing moves, whatever the file says."""
    return float(record.times(entry)[0]) if record.world.movers else 0.0


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
