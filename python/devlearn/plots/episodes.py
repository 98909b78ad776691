"""The paper's four kinds of episode, marked in the counts: Fig. 8."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import patches

from ..analysis.counts import counts_before, window_of
from ..analysis.episodes import find_abandonment, find_episodes
from ..record import Record
from .counts import plot_counts
from .style import GREEN, GREY, INK, PURPLE, VERMILLION, axes_of_height, legend_below, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# The paper's rectangles (section VI-A).
_EPISODES: dict[str, tuple[str, dict[str, Any]]] = {
    "a": ("effective exploration", {"edgecolor": GREEN, "linestyle": "-"}),
    "b": ("ineffective explorations", {"edgecolor": PURPLE, "linestyle": (0, (4, 1.5))}),
    "c": ("exploitation, no change", {"edgecolor": INK, "linestyle": (0, (1, 1))}),
    "d": ("exploitation, reduction", {"edgecolor": VERMILLION, "linestyle": "-."}),
    # Not the paper's.
    "d*": ("exploitation, abandonment", {"edgecolor": GREY, "linestyle": "-."}),
}


@styled
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
    start, stop = window_of(record, entry, window)
    relative = start > 0
    ax = plot_counts(
        record,
        ax=axes_of_height(ax, 3.0),
        entry=entry,
        steps=window,
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
        legend_below(ax, handles, columns=2, length=2.2)
    return ax
