"""Steps by round: Table 1, and the numbers behind Fig. 10."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

from ..record import Record
from .style import BLUE, GREEN, INK, VERMILLION, axes_of_height, legend_below, styled, whole_numbers

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@styled
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
    ax = axes_of_height(ax, 2.5)
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
    whole_numbers(ax.xaxis)
    if log:
        ax.set_yscale("log")
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_major_formatter(ScalarFormatter())
        ax.yaxis.set_minor_formatter(NullFormatter())
    elif every:
        ax.set_ylim(bottom=0)
    if legend:
        legend_below(ax, handles, columns=min(2, len(handles)))
    return ax
