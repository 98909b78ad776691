"""Mappings by step: Fig. 7."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis.counts import counts_before, window_of
from ..record import Record
from .rounds import round_name
from .style import (
    BLUE,
    VERMILLION,
    axes_of_height,
    say_nothing,
    styled,
    thousands,
    whole_numbers,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_EXPLORED: dict[str, Any] = {"color": BLUE, "linestyle": "-", "linewidth": 1.2}
_EFFECTIVE: dict[str, Any] = {"color": VERMILLION, "linestyle": (0, (3, 1)), "linewidth": 1.2}


@styled
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
    start, stop = window_of(record, entry, steps)
    explored, effective = counts_before(record, entry)
    number = np.arange(start + 1, stop + 1)
    few = len(number) <= 60
    ax = axes_of_height(ax, 2.4)
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
            label=name + (f" \u2212 {thousands(base)}" if relative else ""),
            gid=gid,
            **how,
        )
    ax.set_xlabel("step" if len(record.rounds) == 1 else f"step of {round_name(record, entry)}")
    ax.set_ylabel(f"mappings since step {start + 1}" if relative else "sensorimotor mappings")
    whole_numbers(ax.xaxis, ax.yaxis)
    if not few and not relative:
        ax.set_ylim(bottom=0)
    if len(number) == 0:
        say_nothing(ax, "no steps")
    if legend:
        ax.legend(loc="upper left" if few else "best", handlelength=2.4)
    return ax
