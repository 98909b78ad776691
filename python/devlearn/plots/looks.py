"""Many lines side by side, each told from the others by colour, dashes and marker."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from matplotlib.lines import Line2D

from .style import BLUE, GREEN, GREY, INK, ORANGE, PURPLE, SKY, VERMILLION, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_COLOURS = (VERMILLION, BLUE, GREEN, ORANGE, PURPLE, SKY, INK, GREY)
_DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.5, 1)), (0, (6, 1.5, 1.5, 1.5)))
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*", "<", ">", "p")


class Look(NamedTuple):
    """How the lines and points of one of many are drawn."""

    color: str
    dash: Any
    """As matplotlib's linestyle."""
    marker: str


def look(index: int) -> Look:
    """That of the one with this index, from 0; the first 32 differ in colour or dashes."""
    return Look(
        _COLOURS[index % len(_COLOURS)],
        _DASHES[(index + index // len(_COLOURS)) % len(_DASHES)],
        _MARKERS[index % len(_MARKERS)],
    )


def swatch(look: Look) -> Axes:
    """A line with its marker alone, for tables."""
    figure = new_figure(0.12)
    figure.set_figwidth(0.36)
    ax = figure.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    ax.set(xlim=(0, 2), ylim=(-1, 1))
    ax.add_line(
        Line2D([0.05, 1, 1.95], [0, 0, 0], color=look.color, linestyle=look.dash, linewidth=1.4,
               marker=look.marker, markevery=[1], markersize=5, markeredgewidth=0)
    )  # fmt: skip
    return ax
