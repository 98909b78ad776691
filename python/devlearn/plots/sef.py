"""The state evaluation function over the arena: Fig. 4."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import numpy as np
from matplotlib.ticker import MaxNLocator

from .._core import StateEvaluation
from ..analysis.fields import Source, sef_field, world_of
from ..errors import InvalidValue
from .style import colorbar_beside, legend_below, new_figure, styled
from .world import arena_axes, draw_arena, draw_obstacles, draw_target

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@styled
def plot_sef(
    world: Source,
    *,
    ax: Axes | None = None,
    evaluation: StateEvaluation | None = None,
    walls_count: bool | None = None,
    kind: str = "map",
    points: int = 301,
    floor: float | None = None,
    colorbar: bool = True,
    legend: bool = True,
) -> Axes:
    """Draw the state evaluation function (Eq. 6) over the arena as a map: Fig. 4 from above.

    ``evaluation`` and ``walls_count`` are a record's or a trial's own, else the defaults. SEF falls
    steeply at the obstacles; the scale ends at ``floor`` (by default half of the target's term's
    range below that term's least value), everything below has the darkest colour, and the colour
    bar's pointed end says so. ``points`` along the longer side. ``kind="surface"`` is
    ``plot_sef_surface``.
    """
    if kind == "surface":
        return plot_sef_surface(
            world, ax=ax, evaluation=evaluation, walls_count=walls_count, floor=floor
        )
    if kind != "map":
        raise InvalidValue("kind", kind, '"map" or "surface"')
    energy = sef_field(world, evaluation, walls_count, points, floor)
    place = world_of(world)
    ax = arena_axes(ax, place, bar=colorbar, legend=legend)
    dx, dy = energy.x[1] - energy.x[0], energy.y[1] - energy.y[0]
    image = ax.imshow(
        energy.sef,
        extent=(
            energy.x[0] - dx / 2,
            energy.x[-1] + dx / 2,
            energy.y[0] - dy / 2,
            energy.y[-1] + dy / 2,
        ),
        origin="lower",
        cmap="cividis",
        vmin=energy.floor,
        vmax=float(energy.sef.max()),
        interpolation="bilinear",
        zorder=0.5,
    )
    image.set_gid("sef")
    levels = MaxNLocator(nbins=10).tick_values(energy.floor, float(energy.sef.max()))
    ax.contour(
        energy.x, energy.y, energy.sef, levels=levels, colors="white", linewidths=0.4, alpha=0.7
    )
    draw_arena(ax, place)
    draw_obstacles(ax, place, facecolor="none", edgecolor="white", linewidth=0.9, zorder=2.0)
    target = draw_target(ax, place)
    if legend:
        legend_below(ax, [target])
    if colorbar:
        clipped = bool(energy.sef.min() < energy.floor)
        colorbar_beside(ax, image, "SEF (no unit)", "min" if clipped else "neither")
    return ax


@styled
def plot_sef_surface(
    world: Source,
    *,
    ax: Axes | None = None,
    evaluation: StateEvaluation | None = None,
    walls_count: bool | None = None,
    points: int = 201,
    floor: float | None = None,
) -> Axes:
    """Draw the state evaluation function (Eq. 6) as a surface over the arena: Fig. 4.

    ``ax`` must be three-dimensional (``subplot_kw={"projection": "3d"}``). The pits at the
    obstacles are cut off at ``floor``, as in ``plot_sef``, and the vertical axis says so.
    """
    energy = sef_field(world, evaluation, walls_count, points, floor)
    place = world_of(world)
    if ax is None:
        ax = new_figure(3.0).add_axes((0.1, 0.09, 0.85, 0.93), projection="3d")
    if ax.name != "3d":
        raise InvalidValue("ax", f"{ax.name} axes", 'axes with projection "3d"')
    solid = cast(Any, ax)  # Axes3D, which matplotlib does not type
    xs, ys = np.meshgrid(energy.x, energy.y)
    surface = solid.plot_surface(
        xs,
        ys,
        np.maximum(energy.sef, energy.floor),
        cmap="cividis",
        rcount=points,
        ccount=points,
        linewidth=0,
        antialiased=False,
    )
    surface.set_rasterized(True)
    surface.set_gid("sef")
    clipped = bool(energy.sef.min() < energy.floor)
    solid.set_xlabel("x [m]")
    solid.set_ylabel("y [m]")
    solid.set_zlabel(f"SEF (cut off at {energy.floor:.3g})" if clipped else "SEF")
    solid.set_xlim(energy.x[0], energy.x[-1])
    solid.set_ylim(energy.y[0], energy.y[-1])
    for axis in (solid.xaxis, solid.yaxis):
        axis.set_major_locator(MaxNLocator(nbins=6, integer=True))
    solid.set_box_aspect(
        (place.width, place.height, 0.7 * min(place.width, place.height)), zoom=0.92
    )
    solid.view_init(elev=42, azim=-125)
    return ax
