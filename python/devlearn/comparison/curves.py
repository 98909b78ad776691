"""Learning over time: how long the path is on which a run goes after so many steps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..experiments import statistics
from ..plots.bands import Band
from .compared import Compared, Contender

WINDOW = 5
"""A run is as good as the median of so many rounds, the last that it finished."""
_POINTS = 48


def can_be_drawn(compared: Compared) -> bool:
    """Whether the results kept the rounds of all that ran."""
    runs = compared.frame[compared.frame["error"].isna()]["run"]
    return compared.results.with_rounds.issuperset(map(int, runs))


def learning_curves(compared: Compared, world: str) -> dict[str, Band]:
    """By contender, over steps, those of free learning counted: the median over seeds of the ratio
    of a round to the shortest path, and its 95 % interval; where that cannot be had of so few
    seeds, from the least to the greatest.
    """
    runs = {one.name: _runs(compared, one, world) for one in compared.learners}
    made = [ends for finished in runs.values() for ends, _ in finished if len(ends)]
    if not made:
        return {}
    first, last = min(ends[0] for ends in made), max(ends[-1] for ends in made)
    steps = np.unique(np.geomspace(first, max(last, 10 * first), _POINTS).astype(np.int64))
    return {name: _band(steps, finished) for name, finished in runs.items() if finished}


Finished = tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]]


def _runs(compared: Compared, contender: Contender, world: str) -> list[Finished]:
    """Of each run the step at which each round of path learning ended, and its ratio by then."""
    finished = []
    for row in compared.runs(contender, world).itertuples():
        if isinstance(row.error, str) or not row.shortest > 0:
            continue
        rounds = compared.results.rounds(int(row.run))
        ends = rounds["steps"].cumsum()[contender.free :]
        paths = rounds[contender.free :]
        ratios = np.where(paths["arrived"], paths["steps"], np.inf) / row.shortest
        finished.append((ends, _running_median(ratios)))
    return finished


def _running_median(values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    padded = np.concatenate([np.full(WINDOW - 1, np.nan), values])
    if not len(values):
        return values
    return np.asarray(
        np.nanmedian(np.lib.stride_tricks.sliding_window_view(padded, WINDOW), axis=1)
    )


def _band(steps: npt.NDArray[np.int64], finished: Sequence[Finished]) -> Band:
    """At each step the last ratio there was; before the first round ended it is infinite."""
    table = np.full((len(finished), len(steps)), np.inf)
    for row, (ends, ratios) in zip(table, finished):
        last = np.searchsorted(ends, steps, side="right") - 1
        row[last >= 0] = ratios[last[last >= 0]]
    found = [statistics.estimate_median(column[:, None]) for column in table.T]
    low = [column.min() if e.vacuous else e.low for e, column in zip(found, table.T)]
    high = [column.max() if e.vacuous else e.high for e, column in zip(found, table.T)]
    return Band(steps, np.array([e.value for e in found]), np.array(low), np.array(high))
