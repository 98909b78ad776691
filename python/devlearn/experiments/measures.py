"""What runs are measured by: one registry, for whoever runs, compares or writes of them.

The built-in measures are functions of a `Run`'s rounds alone, which every agent fills alike. One of
one's own is a function of a `Run` with its Record, by name: ``my_module:my_function``.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .._calls import shown
from .._core import Trial
from ..errors import InvalidValue
from ..record import Record
from .contenders import of_module
from .schedule import Schedule

LAST = 20
"""So many rounds are the last ones."""
USEFUL, NEAR = 1.5, 1.25
"""A path is useful, and near the shortest, that is at most so many times as long."""


class Run(NamedTuple):
    """A run: what a measure is a function of."""

    rounds: npt.NDArray[np.void]
    """An entry a round, as `devlearn.Tally.rounds` tells; those of free learning first."""
    frees: int
    """How many are of free learning."""
    schedule: Schedule
    shortest: int | None
    """Steps of the shortest path from the start; None where there is no way."""
    record: Record | None
    """All steps; None where only measures of devlearn's are asked for."""
    trial: Trial
    seconds: float
    """Processor time of its steps."""

    @property
    def paths(self) -> npt.NDArray[np.void]:
        """The rounds of path learning."""
        return self.rounds[self.frees :]


class Measure(NamedTuple):
    """A function of a run; inf: never; None: it has no value."""

    name: str
    doc: str
    unit: str
    of: Callable[[Run], float | None]
    less_is_better: bool = True
    fraction: bool = False
    """Whether it is a share, to be written in percent."""


def first_arrival(run: Run) -> float:
    """Steps until the target is first reached, those of free learning counted; inf: never."""
    found = np.flatnonzero(run.rounds["first_arrival"])
    if not len(found):
        return math.inf
    return int(run.rounds["steps"][: found[0]].sum() + run.rounds["first_arrival"][found[0]])


def within(factor: float) -> Callable[[Run], float | None]:
    """Steps until the end of the first round of path learning of at most factor x shortest."""

    def steps(run: Run) -> float | None:
        if run.shortest is None:
            return None
        good = run.paths["arrived"] & (run.paths["steps"] <= factor * run.shortest)
        if not good.any():
            return math.inf
        return int(run.rounds["steps"][: run.frees + int(good.argmax()) + 1].sum())

    return steps


def last_ratio(run: Run) -> float | None:
    """Median steps of the last 20 rounds over the shortest; a failed round is infinitely long."""
    if not run.shortest or not len(run.paths):
        return None
    return float(np.median(_steps(run)[-LAST:])) / run.shortest


def settled_round(run: Run, least: int = LAST) -> float:
    """The round of path learning, from 1, from which on all arrive by the same motions.

    inf where the last ``least`` did not. A run that ended early, without hope, has not settled.
    """
    settled = settled_from(run.paths, least) if len(run.paths) == run.schedule.rounds else None
    return math.inf if settled is None else settled + 1


def settled_from(paths: npt.NDArray[np.void], least: int) -> int | None:
    """Which of these rounds, from 0, is the first from which on all arrive by the same motions.

    None where the last ``least`` did not.
    """
    if not len(paths):
        return None
    other = np.flatnonzero((paths["path"] != paths["path"][-1]) | ~paths["arrived"])
    first = int(other[-1]) + 1 if len(other) else 0
    return first if len(paths) - first >= least else None


def settled_ratio(run: Run) -> float | None:
    """Steps of the path on which it settled over the shortest; inf where it did not settle."""
    if not run.shortest:
        return None
    return int(run.paths["steps"][-1]) / run.shortest if settled_round(run) < math.inf else math.inf


def failed_share(run: Run) -> float | None:
    """Share of the rounds of path learning that did not arrive, those left out counted."""
    planned = run.schedule.rounds
    return 1.0 - int(run.paths["arrived"].sum()) / planned if planned else None


def touching_share(run: Run) -> float | None:
    """Share of the steps of the last 20 rounds in which the body touched something."""
    last = run.paths[-LAST:]
    steps = int(last["steps"].sum())
    return int(last["touches"].sum()) / steps if steps else None


def learning_waste(run: Run) -> float | None:
    """Share of all steps that executed a mapping already known as ineffective."""
    return _share(run, "known_ineffective", "steps")


def computing_waste(run: Run) -> float | None:
    """Share of the updates that followed an ineffective motion.

    An agent that tells of no development updates at every step.
    """
    if run.rounds["updates"].any():
        return _share(run, "ineffective_updates", "updates")
    return _share(run, "ineffective", "steps")


def mappings(run: Run) -> float | None:
    """Mappings (situation, motion) in use at the end: the effective ones; all that were tried,
    of an agent that keeps no lists.
    """
    if not len(run.rounds):
        return None
    last = run.rounds[-1]
    return int(last["effective_count"] or last["mappings"])


def steps(run: Run) -> float:
    """All steps, those of free learning, too."""
    return int(run.rounds["steps"].sum())


def nanoseconds(run: Run) -> float | None:
    """Processor time of a step, the body's included."""
    total = steps(run)
    return 1e9 * run.seconds / total if total else None


def _share(run: Run, hits: str, of: str) -> float | None:
    cases = int(run.rounds[of].sum())
    return int(run.rounds[hits].sum()) / cases if cases else None


def _steps(run: Run) -> npt.NDArray[np.float64]:
    """Steps by round; infinite for those that failed, or that a run without hope left out."""
    steps = np.full(run.schedule.rounds, np.inf)
    steps[: len(run.paths)] = np.where(run.paths["arrived"], run.paths["steps"], np.inf)
    return steps


MEASURES: Mapping[str, Measure] = {
    measure.name: measure
    for measure in (
        Measure("first_arrival", "steps until the target is first reached", "steps", first_arrival),
        Measure(
            "within_1_5", "steps until a round within 1.5 of the shortest", "steps", within(USEFUL)
        ),
        Measure(
            "within_1_25", "steps until a round within 1.25 of the shortest", "steps", within(NEAR)
        ),
        Measure("last_ratio", "last 20 rounds, over the shortest path", "", last_ratio),
        Measure("settled_ratio", "settled path, over the shortest", "", settled_ratio),
        Measure("settled_round", "round from which settled", "round", settled_round),
        Measure("failed_share", "failed rounds", "", failed_share, fraction=True),
        Measure("touching_share", "steps touching, last 20 rounds", "", touching_share,
                fraction=True),
        Measure("learning_waste", "steps on mappings known as ineffective", "", learning_waste,
                fraction=True),
        Measure("computing_waste", "updates after ineffective motions", "", computing_waste,
                fraction=True),
        Measure("mappings", "mappings in use", "", mappings),
        Measure("steps", "steps in all", "steps", steps),
        Measure("run_ns_a_step", "processor time of a step", "ns", nanoseconds),
    )
}  # fmt: skip


def own(name: str) -> Callable[[Run], object]:
    """A measure of one's own, ``module:function``. Raises InvalidValue."""
    if ":" not in name:
        raise InvalidValue(
            "measures", repr(name), "module:function; devlearn's own are always measured"
        )
    return of_module("measures", name)


def value_of(name: str, run: Run) -> float | str | None:
    """What a measure of one's own gives: a number, None, or in JSON what else it holds.

    Raises InvalidValue for what JSON cannot hold.
    """
    value = own(name)(run)
    if value is None or isinstance(value, float):
        return value
    try:
        if isinstance(value, (bool, int, np.generic)):
            return float(value)
        return json.dumps(value)
    except (TypeError, ValueError) as error:
        raise InvalidValue(name, shown(value), "a number, None, or what JSON can hold") from error
