"""The look of all plots: colours, settings, axes, legends."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar, cast

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from matplotlib.transforms import ScaledTranslation

from .._calls import shown
from .._colours import BLACK as BLACK
from .._colours import BLUE as BLUE
from .._colours import GREEN as GREEN
from .._colours import GREY as GREY
from .._colours import INK as INK
from .._colours import OBSTACLE as OBSTACLE
from .._colours import ORANGE as ORANGE
from .._colours import PURPLE as PURPLE
from .._colours import SKY as SKY
from .._colours import VERMILLION as VERMILLION
from ..errors import WrongType

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

COLUMN = 3.5  # a journal column [inches]
STYLE: Any = {  # matplotlib's own type lists every setting by name
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.linewidth": 1.0,
    "legend.frameon": False,
    "figure.dpi": 200,
    "savefig.dpi": 200,
    "svg.fonttype": "none",
    "text.usetex": False,
}
"""The rc settings under which everything here is drawn; for ``matplotlib.rc_context``."""

_F = TypeVar("_F", bound=Callable[..., Any])


# What a plot reads, by the name of its first argument.
_READS: dict[str, tuple[Callable[[Any], object], str]] = {
    "record": (lambda read: hasattr(read, "steps_of"), "a Record, as the phases of a Trial give"),
    "world": (
        # Of the type: a record makes its world anew each time it is asked.
        lambda read: hasattr(type(read), "obstacles") or hasattr(type(read), "world"),
        "a World, or a Trial or Record in one",
    ),
    "values_by_label": (
        lambda read: isinstance(read, Mapping),
        "a dict or the like from labels to samples",
    ),
}


def styled(plot: _F) -> _F:
    """A plot drawn under ``STYLE``, of what it can read. Raises WrongType for anything else."""
    first = next(iter(inspect.signature(plot).parameters))
    can_be_read, wanted = _READS.get(first, (lambda _: True, ""))

    @functools.wraps(plot)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        read = args[0] if args else kwargs.get(first)
        if not can_be_read(read):
            raise WrongType(first, shown(read), wanted)
        with mpl.rc_context(STYLE):
            return plot(*args, **kwargs)

    return cast(_F, wrapper)


def new_figure(height: float, **how: Any) -> Figure:
    """A figure of a column's width and this height [inches].

    pyplot keeps what it makes until it is told to close it, so it makes the figure only where it
    is interactive, as in a notebook, and shows it.
    """
    if mpl.is_interactive():
        import matplotlib.pyplot as plt

        return plt.figure(figsize=(COLUMN, height), **how)
    figure = Figure(figsize=(COLUMN, height), **how)
    FigureCanvasAgg(figure)  # draws in memory, whatever backend is set
    return figure


def axes_of_height(ax: Axes | None, height: float) -> Axes:
    """The axes given, else new ones of a column's width and this height [inches]."""
    if ax is not None:
        return ax
    return new_figure(height, layout="constrained").add_subplot()


def in_rows(handles: Sequence[Any], columns: int) -> list[Any]:
    """Handles in the order in which a legend of so many columns shows them row by row."""
    return [handle for i in range(columns) for handle in handles[i::columns]]


def legend_below(
    ax: Axes, handles: Sequence[Any], columns: int | None = None, length: float = 1.5
) -> None:
    """Outside the data, under the label of the x axis; its lines so many letters long."""
    below = ax.transAxes + ScaledTranslation(0, -28 / 72, ax.figure.dpi_scale_trans)
    ax.legend(
        handles=list(handles),
        loc="upper center",
        bbox_to_anchor=(0.5, 0.0),
        bbox_transform=below,
        ncol=columns or len(handles),
        borderaxespad=0.0,
        handletextpad=0.5,
        columnspacing=0.7,
        handlelength=length,
    )


def colorbar_beside(ax: Axes, colours: Any, label: str, extend: str = "neither") -> None:
    """Beside the axes and as high as they are."""
    beside = ax.inset_axes((1.03, 0.0, 0.045, 1.0))
    bar = ax.figure.colorbar(colours, cax=beside, label=label, extend=extend)
    if isinstance(colours.norm, LogNorm):
        logarithmic(bar.ax.yaxis)
    bar.outline.set_linewidth(0.4)


def say_nothing(ax: Axes, what: str) -> None:
    """What is missing, in the middle of axes without data; their ticks would mean nothing."""
    ax.text(0.5, 0.5, what, transform=ax.transAxes, ha="center", va="center", gid="nothing")
    if not any(np.size(line.get_xydata()) for line in ax.get_lines()):
        ax.set(xticks=[], yticks=[])


def thousands(count: int) -> str:
    """A number with its thousands apart."""
    return f"{count:,}".replace(",", "\u2009")


def logarithmic(axis: Axis) -> None:
    """A logarithmic axis with plain numbers at its ticks: 2, 50, 10 k, 1 M."""
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})  # type: ignore[attr-defined]
    axis.set_major_locator(_LogLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: _short(value)))
    axis.set_minor_formatter(NullFormatter())


class _LogLocator(LogLocator):
    """Powers of ten; where there are less than two of them, 2 and 5 as well."""

    def __init__(self) -> None:
        super().__init__(numticks=9)

    def tick_values(self, vmin: float, vmax: float) -> Any:
        few = vmax < 100 * max(vmin, 1e-300)
        self.set_params(subs=(1.0, 2.0, 5.0) if few else (1.0,))
        return super().tick_values(vmin, vmax)


def _short(value: float) -> str:
    for size, unit in ((1e6, " M"), (1e3, " k")):
        if abs(value) >= size:
            return f"{value / size:.3g}{unit}"
    return f"{value:.3g}"


def whole_numbers(*axes: Axis) -> None:
    """Ticks at whole numbers only."""
    for axis in axes:
        axis.set_major_locator(MaxNLocator(nbins=7, integer=True, min_n_ticks=1))


def dark_cividis() -> ListedColormap:
    """Cividis from pale to dark, without the yellow that white paper swallows."""
    return ListedColormap(mpl.colormaps["cividis"](np.linspace(0.82, 0.0, 256)))
