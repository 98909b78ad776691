"""Samples side by side: what is measured over seeds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from .style import BLUE, GREEN, INK, VERMILLION, axes_of_height, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@styled
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
    ax = axes_of_height(ax, 2.5)
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
