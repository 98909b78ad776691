"""The paper's claims, each with the criterion it is held to and a control that should fail it.

``claims.json`` was committed before the first run of this program, and its criteria have not
changed since; approximate figures of an independent study of the same rules, on the same world,
were known when they were written. ``by_definition`` marks the part, claim or control, that comes
out as it does whatever the runs give. A claim's value is its measure, aggregated over the runs as
it says:

========== =====================================================================================
aggregate  value
========== =====================================================================================
median     median over the runs, runs without a value left out
mean       mean over the runs; of yes and no, the share of yes
max        the largest of any run
pooled     hits of all runs over cases of all runs
value      one figure of all runs together
========== =====================================================================================
"""

from __future__ import annotations

import json
import math
import operator
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .measures import Measures

_PATH = Path(__file__).parent / "claims.json"
_COMPARED = {">=": operator.ge, "<=": operator.le}
_REDUCED: Mapping[str, Callable[[Sequence[float]], Any]] = {
    "median": np.median,
    "mean": np.mean,
    "max": np.max,
}
# Which runs a claim is measured on; on "runs" where nothing else is said.
_OF_SIMILAR_WORLDS = "similar_worlds"
_OF_SIGMAS = ("sigma_shortens_exploration", "small_sigma_finds_better")


class Figure(NamedTuple):
    """A claim's value, and the 10th and 90th percentile of its runs where it has them."""

    value: float
    low: float | None = None
    high: float | None = None
    runs: int = 0


class Verdict(NamedTuple):
    """A claim as measured: the figure and whether it holds; the same of the control."""

    claim: dict[str, Any]
    figure: Figure
    holds: bool
    control: Figure
    control_holds: bool


class Results(NamedTuple):
    """Measures of all runs of one preset, in the order of their seeds."""

    runs: Sequence[Measures]
    random: Sequence[Measures]
    similar: Sequence[Measures]
    similar_random: Sequence[Measures]
    by_sigma: Mapping[float, Sequence[Measures]]
    reseeded: Sequence[Measures]


def claims() -> list[dict[str, Any]]:
    """The claims and their criteria, as committed."""
    loaded: list[dict[str, Any]] = json.loads(_PATH.read_text(encoding="utf-8"))["claims"]
    return loaded


def judge(results: Results) -> list[Verdict]:
    """Every claim, measured."""
    return [_verdict(claim, results) for claim in claims()]


def _verdict(claim: dict[str, Any], results: Results) -> Verdict:
    figure, control = _figure(claim, results), _control(claim, results)
    return Verdict(claim, figure, _holds(claim, figure), control, _holds(claim, control))


def _holds(claim: Mapping[str, Any], figure: Figure) -> bool:
    criterion = claim["criterion"]
    # NaN, a figure that could not be measured, never holds.
    return bool(_COMPARED[criterion["op"]](figure.value, criterion["bound"]))


def _figure(claim: Mapping[str, Any], results: Results) -> Figure:
    key = claim["id"]
    if key == "habits_differ":
        return _habits(results.runs)
    if key in _OF_SIGMAS:
        return _sigma_ratio(key, results.by_sigma[0.7], results.by_sigma[0.1])
    runs = results.similar if key == _OF_SIMILAR_WORLDS else results.runs
    return aggregate([run.get(key) for run in runs], claim["aggregate"])


def _control(claim: Mapping[str, Any], results: Results) -> Figure:
    key = claim["id"]
    if key == "habits_differ":
        return _habits(results.random)
    if key in _OF_SIGMAS:
        return _sigma_ratio(key, results.reseeded, results.by_sigma[0.3])
    if key == _OF_SIMILAR_WORLDS:
        return aggregate([run[key] for run in results.similar_random], claim["aggregate"])
    own = "control:" + key
    if any(own in run for run in results.runs):
        return aggregate([run.get(own) for run in results.runs], claim["aggregate"])
    return aggregate([run.get(key) for run in results.random], claim["aggregate"])


def aggregate(values: Sequence[Any], how: str) -> Figure:
    """The figure of all runs' values, those that are None left out; NaN where none is left."""
    present = [value for value in values if value is not None]
    if how == "pooled":
        hits, cases = np.sum(present, axis=0) if present else (0, 0)
        shares = [hit / of for hit, of in present if of]
        return _spread(hits / cases if cases else math.nan, shares)
    # A run may hold several values: one for each new start.
    numbers = [
        float(v) for value in present for v in (value if isinstance(value, list) else [value])
    ]
    if not numbers:
        return Figure(math.nan)
    return _spread(float(_REDUCED[how](numbers)), numbers)


def _spread(value: float, numbers: Sequence[float]) -> Figure:
    if not numbers:
        return Figure(value)
    low, high = np.percentile(numbers, [10, 90])
    return Figure(float(value), float(low), float(high), len(numbers))


def _habits(runs: Sequence[Measures]) -> Figure:
    habits = [run["habit"] for run in runs if run["habit"] is not None]
    return Figure(len(set(habits)) / len(habits) if habits else 0.0, runs=len(habits))


def _sigma_ratio(key: str, above: Sequence[Measures], below: Sequence[Measures]) -> Figure:
    measure, sign = ("settled_early", 1) if key == _OF_SIGMAS[0] else ("last_steps", -1)
    medians = [float(np.median([run[measure] for run in runs])) for runs in (above, below)]
    return Figure((medians[0] / medians[1]) ** sign, runs=len(above))
