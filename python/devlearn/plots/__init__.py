"""The paper's figures, drawn from worlds, records and learners.

Plots only read: ``plot_x(record or world, *, ax=None) -> Axes`` never runs a trial. Without ``ax``
a new figure is made, at a journal column's width; with it nothing but these axes is touched.
``save(axes, path)`` writes the figure. To compose several panels in the same style::

    import matplotlib.pyplot as plt
    from devlearn import plots

    with plt.rc_context(plots.STYLE):
        figure, axes = plt.subplots(2, 2, layout="constrained")
    for entry, ax in enumerate(axes.flat):
        plots.plot_trajectory(record, ax=ax, entry=entry)

Colours are those of Okabe and Ito and matplotlib's cividis; what they tell apart differs in shape
or width as well, so that the figures can be read in grey. Needs matplotlib, which the extra
``plots`` brings. What has to be found or computed first is ``devlearn.analysis``'s.
"""

from __future__ import annotations

from ..errors import MissingExtra

try:
    import matplotlib as _matplotlib  # noqa: F401
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.plots", "matplotlib", "plots") from error

from ..analysis import (
    Episode,
    PreferenceField,
    counts_before,
    find_abandonment,
    find_entry_and_window,
    find_episodes,
    find_window,
    preference_field,
)
from .bands import Band, plot_bands
from .cells import plot_cells
from .counts import plot_counts
from .distribution import plot_distribution
from .episodes import plot_episodes
from .intervals import plot_intervals
from .looks import Look, look
from .panels import save
from .path import plot_trajectory
from .preferences import plot_preferences
from .rounds import plot_rounds
from .sef import plot_sef, plot_sef_surface
from .style import STYLE
from .world import plot_world

__all__ = [
    "STYLE",
    "Band",
    "Episode",
    "Look",
    "PreferenceField",
    "counts_before",
    "find_abandonment",
    "find_entry_and_window",
    "find_episodes",
    "find_window",
    "look",
    "plot_bands",
    "plot_cells",
    "plot_counts",
    "plot_distribution",
    "plot_episodes",
    "plot_intervals",
    "plot_preferences",
    "plot_rounds",
    "plot_sef",
    "plot_sef_surface",
    "plot_trajectory",
    "plot_world",
    "save",
    "preference_field",
]
