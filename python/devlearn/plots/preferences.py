"""What a learner prefers, as arrows over the arena."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from matplotlib.colors import LogNorm, Normalize

from .._core import AdaptiveLearner, Learner, SituationGrid, TrialConfig
from ..analysis.fields import (
    Source,
    config_of,
    grid_of,
    preference_field,
    world_of,
)
from .style import GREY, colorbar_beside, dark_cividis, legend_below, styled
from .world import arena_axes, draw_arena, draw_obstacles, draw_target

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@styled
def plot_preferences(
    world: Source,
    learner: Learner | AdaptiveLearner | None = None,
    *,
    grid: SituationGrid | None = None,
    config: TrialConfig | None = None,
    ax: Axes | None = None,
    colorbar: bool = True,
    legend: bool = True,
) -> Axes:
    """Draw what a learner prefers as a field of arrows over the arena.

    One arrow a cell (``preference_field``): its direction is where the preferred motions lead, its
    length how much the cell's headings agree, its colour how often they were learned, from pale to
    dark. A dot is a cell that was experienced and where nothing is effective. Cells whose centre
    the robot's body could not be at, as it would touch something, are left out, and no arrow
    reaches into an obstacle. Beyond the paper's figures.

    ``plot_preferences(trial)`` draws the trial's learner on the grid that it learns on. A Record
    and a Learner do as well; with a World alone the ``config`` or the ``grid`` that was learned on
    is needed. Raises InvalidValue.
    """
    place = world_of(world)
    grid = grid_of(world, grid, config)
    field = preference_field(world, learner, grid=grid, config=config)
    room = np.asarray(place.clearance(field.x, field.y, walls_count=True))
    stands = room > config_of(world, config).robot.radius - 1e-6  # but for rounding
    knows, nothing = stands & (field.times > 0), stands & (field.times == 0)
    ax = arena_axes(ax, place, bar=colorbar, legend=legend)
    draw_arena(ax, place)
    draw_obstacles(ax, place)
    width = 0.9 * min(grid.width / grid.columns, grid.height / grid.rows)
    length = np.minimum(width, 2 * room[knows])  # of the longest that keeps off what is near
    arrows = ax.quiver(
        field.x[knows],
        field.y[knows],
        length * field.u[knows],
        length * field.v[knows],
        field.times[knows],
        cmap=dark_cividis(),
        norm=_log_norm(field.times[knows]),
        angles="xy",
        scale_units="xy",
        scale=1.0,
        pivot="mid",
        units="xy",
        width=0.13 * width,
        headwidth=3.6,
        headlength=3.6,
        headaxislength=3.2,
        minlength=0.5,
        zorder=2.0,
    )
    arrows.set_gid("preferences")
    handles: list[Any] = []
    if nothing.any():
        handles += ax.plot(
            field.x[nothing],
            field.y[nothing],
            linestyle="none",
            marker="o",
            markersize=1.8,
            markerfacecolor="white",
            markeredgecolor=GREY,
            markeredgewidth=0.5,
            label="nothing effective",
            zorder=1.5,
            gid="nothing-effective",
        )
    handles.append(draw_target(ax, place))
    if legend:
        legend_below(ax, handles)
    if colorbar and knows.any():
        colorbar_beside(ax, arrows, "times learned")
    return ax


def _log_norm(times: npt.NDArray[np.int64]) -> Normalize:
    low, high = (int(times.min()), int(times.max())) if len(times) else (1, 10)
    return LogNorm(low, max(high, low + 1))
