"""Steps by round: Table 1, and the numbers behind Fig. 10."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

from ..errors import InvalidValue
from ..record import Record
from .style import BLUE, GREEN, INK, VERMILLION, axes_of_height, legend_below, styled, whole_numbers

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def round_name(record: Record, entry: int) -> str:
    """A round as it was asked for, counted from 1; and the trial's number where that is another."""
    count, number = len(record.rounds), int(record.rounds["round"][entry])
    if count == 1:
        return f"round {number}"
    asked = entry % count + 1
    name = f"round {asked} of {count}"
    return name if asked == number else f"{name} ({number} of the trial)"


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

    Rounds that did not arrive are crosses. They are numbered as in ``record.rounds``, through all
    the trial; where these begin later, a second axis above counts them from 1, as they were asked
    for. ``shortest`` [steps] draws the shortest possible path, ``settled`` marks the round, by its
    number in ``record.rounds``, from which on the path is always the same. ``log`` puts the steps
    on a logarithmic axis; by default where they span more than a factor of ten. Raises InvalidValue
    for a record of no rounds.
    """
    rounds = record.rounds
    if len(rounds) == 0:
        raise InvalidValue("record", "no rounds", "one that holds rounds")
    if settled is not None and settled not in rounds["round"]:
        known = f"{rounds['round'].min()} to {rounds['round'].max()}"
        raise InvalidValue("settled", settled, f"a round of the record: {known}")
    ax = axes_of_height(ax, 2.5)
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
        whose = "" if number[0] == 1 or len(number) == 1 else " of the trial"
        label = f"settled from round {settled}{whose}: {same[-1]:g}"
        handles.append(
            ax.axvline(settled, color=GREEN, linestyle="-.", label=label, zorder=1.0, gid="settled")
        )
    _count(ax, number)
    ax.set_ylabel("steps of the round")
    if log:
        ax.set_yscale("log")
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_major_formatter(ScalarFormatter())
        ax.yaxis.set_minor_formatter(NullFormatter())
    else:
        whole_numbers(ax.yaxis)
        ax.set_ylim(0, None if every else 1)
    if legend:
        legend_below(ax, handles, columns=min(2, len(handles)), length=2.2)
    return ax


def _count(ax: Axes, number: npt.NDArray[np.int32]) -> None:
    """The axis of the trial's numbers of rounds; above it, where they differ, the record's own."""
    whole_numbers(ax.xaxis)
    low, high = ax.dataLim.intervalx
    ax.set_xlim(low - 0.5, high + 0.5 + 0.02 * (high - low))  # no round 0
    before, count = int(number[0]) - 1, len(number)
    ax.set_xlabel("round" if before == 0 or count == 1 else "round of the trial")
    for above in [axis for axis in ax.child_axes if axis.get_gid() == "asked"]:
        above.remove()  # of another record, drawn before
    if before > 0 and count > 1 and number[-1] - before == count:
        counts: Any = lambda n: n - before, lambda n: n + before
        above = ax.secondary_xaxis("top", functions=counts)
        above.set_xlabel(f"round of these {count}")
        above.set_gid("asked")
        whole_numbers(above.xaxis)
