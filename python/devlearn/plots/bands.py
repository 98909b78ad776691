"""Curves with bands about them: learning, and performance profiles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
from matplotlib.ticker import PercentFormatter

from .looks import Look, look
from .style import axes_of_height, logarithmic, say_nothing, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_OPACITY = 0.12
_MARKERS = 5  # along a curve


class Band(NamedTuple):
    """A curve and what it lies within, arrays of one length; inf is beyond the axes."""

    x: npt.ArrayLike
    y: npt.ArrayLike
    low: npt.ArrayLike
    high: npt.ArrayLike


@styled
def plot_bands(
    values_by_label: Mapping[str, Band],
    *,
    ax: Axes | None = None,
    looks: Mapping[str, Look] | None = None,
    log: str = "xy",
    shares: bool = False,
    xlabel: str = "",
    ylabel: str = "",
    title: str = "",
) -> Axes:
    """Draw curves, each with its band; where a value is not finite the curve leaves the axes.

    ``looks`` by label; else each in its turn. ``log``: which axes are logarithmic, of "x", "y",
    "xy" and "". ``shares``: y is a share, in [0, 1].
    """
    ax = axes_of_height(ax, 2.4)
    bands = {name: np.array(band, dtype=float) for name, band in values_by_label.items()}
    every = np.concatenate([band[1] for band in bands.values()] or [np.empty(0)])
    finite = every[np.isfinite(every)]
    low, high = (0.0, 1.0) if shares else _limits(finite, "y" in log)
    for order, (name, (x, y, below, above)) in enumerate(bands.items()):
        how = looks[name] if looks else look(order)
        beyond = high * 10 if "y" in log else 2 * high - low
        y, below, above = (np.clip(values, min(low, 0.0), beyond) for values in (y, below, above))
        ax.fill_between(
            x, below, above, color=how.color, alpha=_OPACITY, linewidth=0, gid=f"band-{name}"
        )
        ax.plot(
            x, y, color=how.color, linestyle=how.dash, label=name, gid=f"curve-{name}",
            marker=how.marker, markersize=3.0, markeredgewidth=0,
            markevery=(order % 7, max(1, len(x) // _MARKERS)),
        )  # fmt: skip
    for axis, letter in ((ax.xaxis, "x"), (ax.yaxis, "y")):
        if letter in log:
            logarithmic(axis)
    if len(finite) == 0:
        say_nothing(ax, "none arrives")
    if shares:
        ax.yaxis.set_major_formatter(PercentFormatter(1.0))
        low, high = -0.02, 1.02
    ax.set_ylim(low, high)
    widest = np.concatenate([band[0] for band in bands.values()] or [np.array([1.0, 2.0])])
    ax.set_xlim(widest.min(), widest.max())
    ax.set(xlabel=xlabel, ylabel=ylabel, title=title)
    return ax


def _limits(values: npt.NDArray[np.float64], log: bool) -> tuple[float, float]:
    if len(values) == 0:
        return (0.9, 10.0) if log else (0.0, 1.0)
    low, high = float(values.min()), float(values.max())
    if log:
        return low / 1.1, max(high, 1.2 * low) * 1.2
    margin = 0.05 * (high - low) or 1.0
    return low - margin, high + margin
