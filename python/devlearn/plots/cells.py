"""Values over the cells of a world."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from matplotlib.colors import ListedColormap, LogNorm, Normalize

from ..analysis.fields import Source, world_of
from .style import VERMILLION, colorbar_beside, dark_cividis, styled
from .world import arena_axes, draw_arena, draw_obstacles, draw_target

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@styled
def plot_cells(
    world: Source,
    values: npt.ArrayLike,
    *,
    ax: Axes | None = None,
    limits: tuple[float, float] | None = None,
    log: bool = False,
    label: str = "",
    title: str = "",
) -> Axes:
    """Draw a value a cell over a world, (rows, columns), the first row at the bottom.

    NaN leaves a cell white, inf is drawn in a colour of its own. ``limits`` of the colours; else
    those of the values. ``label`` names the colour bar, and without one there is none.
    """
    place = world_of(world)
    cells = np.asarray(values, dtype=float)
    ax = arena_axes(ax, place, bar=bool(label), title=bool(title))
    x, y = (
        np.linspace(begin, begin + side, count + 1)
        for begin, side, count in zip(
            place.origin, (place.width, place.height), reversed(cells.shape)
        )
    )
    finite = cells[np.isfinite(cells)]
    low, high = limits or ((finite.min(), finite.max()) if len(finite) else (1.0, 2.0))
    norm = LogNorm(low, high, clip=True) if log else Normalize(low, high, clip=True)
    drawn = ax.pcolormesh(
        x, y, np.ma.masked_invalid(cells), cmap=dark_cividis(), norm=norm, linewidth=0,
        rasterized=True, zorder=0.5, gid="cells",
    )  # fmt: skip
    never = np.where(np.isposinf(cells), 1.0, np.nan)
    ax.pcolormesh(
        x, y, np.ma.masked_invalid(never), cmap=ListedColormap([VERMILLION]), linewidth=0,
        rasterized=True, zorder=0.6, gid="never",
    )  # fmt: skip
    draw_arena(ax, place)
    draw_obstacles(ax, place)
    draw_target(ax, place)
    if label:
        colorbar_beside(ax, drawn, label)
    if title:
        ax.set_title(title)
    return ax
