"""The tables of the page: estimates, each with its interval and what it is of."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..experiments import statistics
from ..experiments.measures import MEASURES, NEAR, Measure
from ..experiments.statistics import Estimate
from .compared import Compared, Contender

Scores = npt.NDArray[np.float64]


class Cell(NamedTuple):
    """A value as it is written, and what stands below it."""

    text: str
    spread: str = ""
    bad: bool = False


class Table(NamedTuple):
    """A table of the page: a head, and rows, each a contender's or a world's."""

    head: Sequence[Cell]
    rows: Sequence[tuple[str, Sequence[Cell]]]


# --- how numbers are written ----------------------------------------------------------------------


def written(measure: Measure, value: float) -> str:
    """A value of a measure."""
    if math.isinf(value):
        return "never"
    if measure.fraction:
        return percent(value)
    if measure.unit == "steps":
        return f"{value:.0f}" if value < 1000 else f"{value / 1000:.1f} k"
    if measure.unit in ("round", "ns") or value >= 1000:
        return f"{value:.0f}"
    return f"{value:.2f}"


def percent(share: float) -> str:
    """A share."""
    return f"{100 * share:.1f} %"


def told(estimate: Estimate, write: Callable[[float], str]) -> Cell:
    """An estimate with its interval."""
    return Cell(write(estimate.value), interval(estimate, write))


def interval(estimate: Estimate, write: Callable[[float], str]) -> str:
    """From where to where; of few runs there may be none."""
    if estimate.vacuous:
        return f"no interval of n = {estimate.n}"
    low = write(estimate.low) if estimate.low > -math.inf else "any"
    return f"{low} to {write(estimate.high)}"


BRIEFLY = {"last_ratio": "last rounds / L", "within_1_25": f"steps to within {NEAR} L"}
"""What measures are called where there is little room; L is the shortest path."""

# --- what is estimated ----------------------------------------------------------------------------


def median(scores: Scores) -> Estimate:
    """The median of all runs."""
    return statistics.estimate_median(scores)


def middle(scores: Scores) -> Estimate:
    """The mean of the middle half of all runs."""
    return statistics.bootstrap(statistics.interquartile_mean, scores)


def mean(scores: Scores) -> Estimate:
    """The mean of all runs."""
    return statistics.bootstrap(statistics.mean, scores)


def reached(scores: Scores) -> Estimate:
    """The share of the runs that are not inf."""
    finite = int(np.isfinite(scores).sum())
    share = statistics.estimate_share(finite, scores.size)
    return Estimate(share.value, share.low, share.high, len(scores), share.level)


class Column(NamedTuple):
    """A column of the first table: an estimate of a measure."""

    title: str
    of: str
    measure: str
    estimate: Callable[[Scores], Estimate]

    def write(self, value: float) -> str:
        """A value of it."""
        share = self.estimate is reached
        return percent(value) if share else written(MEASURES[self.measure], value)


FIRST = (
    Column("first arrival", "steps, median", "first_arrival", median),
    Column(f"within {NEAR} L", "steps, median", "within_1_25", median),
    Column(f"within {NEAR} L", "of the runs", "within_1_25", reached),
    Column("last rounds / L", "interquartile mean", "last_ratio", middle),
    Column("failed rounds", "mean", "failed_share", mean),
    Column("settled", "of the runs", "settled_round", reached),
    Column("a step", "ns, median", "run_ns_a_step", median),
)


def estimate(compared: Compared, contender: Contender, column: Column) -> Estimate | None:
    """That of a contender over all worlds; None where the measure has no value."""
    scores = compared.scores(contender, column.measure)
    return None if scores is None else column.estimate(scores)


def over_all_worlds(compared: Compared) -> Table:
    """The first table: a row a contender."""
    rows = []
    for contender in compared.contenders:
        cells = []
        for column in FIRST:
            found = estimate(compared, contender, column)
            cells.append(Cell("no value") if found is None else told(found, column.write))
        rows.append((contender.name, cells))
    return Table([Cell(column.title, column.of) for column in FIRST], rows)


def by_world(compared: Compared, measure: Measure) -> Table:
    """Medians of a measure: a row a contender, a column a world."""
    rows = []
    for contender in compared.contenders:
        cells = []
        for world in compared.worlds:
            scores = compared.scores(contender, measure.name, [world])
            if scores is None:
                cells.append(Cell("no value"))
            else:
                cells.append(told(median(scores), lambda value: written(measure, value)))
        rows.append((contender.name, cells))
    return Table([Cell(world) for world in compared.worlds], rows)


def failures(compared: Compared) -> Table:
    """Where each contender fails: a row a world, a column a contender."""
    rows = []
    for world in compared.worlds:
        cells = []
        for contender in compared.contenders:
            runs = compared.runs(contender, world)
            errors = int(runs["error"].notna().sum())
            scores = compared.scores(contender, "failed_share", [world])
            if scores is None:
                cells.append(Cell("no value"))
                continue
            failed = mean(scores)
            settled = compared.scores(contender, "settled_round", [world])
            restless = 0 if settled is None else int(np.isinf(settled).sum())
            below = [interval(failed, percent)] if failed.value else []
            below += [f"{restless} of {len(runs)} unsettled"] if restless else []
            below += [f"{errors} of {len(runs)} by an error"] if errors else []
            cells.append(Cell(percent(failed.value), "\n".join(below), failed.value >= 0.5))
        rows.append((world, cells))
    return Table([Cell(one.name) for one in compared.contenders], rows)


# --- against a reference --------------------------------------------------------------------------


def improvement(
    compared: Compared, contender: Contender, reference: Contender, measure: str
) -> Estimate | None:
    """How likely a contender is better than the reference in the same world with the same seed."""
    # Worlds without a value have none of either, as it is the world that has none.
    ours, theirs = (compared.scores(one, measure) for one in (contender, reference))
    if ours is None or theirs is None or ours.shape != theirs.shape:
        return None
    return statistics.estimate_improvement(ours, theirs, paired=True)
