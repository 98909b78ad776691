"""Estimates with their intervals, one below the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.ticker import PercentFormatter

from .looks import Look, look
from .style import GREY, axes_of_height, logarithmic, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ROW = 0.19  # inches


@styled
def plot_intervals(
    values_by_label: Mapping[str, Sequence[float]],
    *,
    ax: Axes | None = None,
    looks: Mapping[str, Look] | None = None,
    bound: float | None = None,
    limits: tuple[float, float] | None = None,
    log: bool = False,
    shares: bool = False,
    xlabel: str = "",
    title: str = "",
) -> Axes:
    """Draw estimates, a row each: (value, low, high), the interval a line through the value.

    Ends that are infinite reach to the edge of the axes. ``bound`` draws a line down, such as where
    two are equals; ``limits`` are those of the axis; ``shares`` writes it in percent.
    """
    rows = {name: tuple(map(float, row)) for name, row in values_by_label.items()}
    ax = axes_of_height(ax, 0.75 + _ROW * max(1, len(rows)))
    if log:
        logarithmic(ax.xaxis)
    finite = [end for row in rows.values() for end in row if np.isfinite(end)]
    finite += [bound] if bound is not None else []
    left, right = limits or _limits(finite, log)
    for place, (name, (value, low, high)) in enumerate(rows.items()):
        how = looks[name] if looks else look(place)
        ends = np.clip([low, high], left, right)
        ax.plot(ends, [place] * 2, color=how.color, linewidth=1.3, solid_capstyle="butt",
                gid=f"interval-{name}")  # fmt: skip
        if np.isfinite(value):
            ax.plot(value, place, color=how.color, marker=how.marker, markersize=4.5,
                    markeredgewidth=0, clip_on=False, zorder=3.0, gid=f"value-{name}")  # fmt: skip
    if bound is not None:
        ax.axvline(bound, color=GREY, linewidth=0.8, linestyle=(0, (4, 2)), zorder=0, gid="bound")
    ax.set_xlim(left, right)
    ax.set_yticks(range(len(rows)), list(rows))
    ax.set_ylim(len(rows) - 0.5, -0.5)
    ax.tick_params(axis="y", length=0)
    ax.grid(axis="x", color="#DDDDDD", linewidth=0.5)
    ax.set_axisbelow(True)
    if shares:
        ax.xaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    ax.set(xlabel=xlabel, title=title)
    return ax


def _limits(finite: Sequence[float], log: bool) -> tuple[float, float]:
    if not finite:
        return (0.1, 10.0) if log else (0.0, 1.0)
    low, high = min(finite), max(finite)
    if log:
        return low / 1.15, high * 1.15
    margin = 0.05 * (high - low) or 0.5
    return low - margin, high + margin
