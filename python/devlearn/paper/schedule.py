"""Section VI: what is run, and its runs."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from .._core import Learner, Trial, TrialConfig, World
from ..experiments.schedule import Schedule
from ..record import Record
from . import measures

READINGS = ("paper", "step5")  # of the paper
SECTION_VI = Schedule()
CONTROL_ROUNDS = 60
SIMILAR_ROUNDS = 100
SIMILAR_CONTROL_ROUNDS = 20
NEW_START_ROUNDS = 40
NEW_START_HOPELESS = 3  # so many failed rounds in a row from a new start, and it is given up
USEFUL = 1.5  # a useful path is at most so many times the shortest
# The claims compare 0.1, 0.3 and 0.7; the figure shows more.
SIGMAS = {"paper": (0.1, 0.3, 0.5, 0.7, 0.9), "step5": (0.1, 0.3, 0.7)}
RESEEDED = 1000  # seeds of the control for sigma begin here


class Run(NamedTuple):
    """One run with everything it left: its two rounds of free learning, its paths, the trial."""

    first: Record
    second: Record
    paths: Record
    trial: Trial


def run(
    world: World,
    config: TrialConfig,
    seed: int,
    schedule: Schedule | None = None,
    *,
    agent: object = None,
) -> Run:
    """A run by a schedule of two rounds of free learning; by default section VI's."""
    trial = Trial(world, config, seed, agent)
    return run_of(Record.concatenate([*(schedule or SECTION_VI).parts(trial)]), trial)


def run_of(whole: Record, trial: Trial) -> Run:
    """The run of which this is the whole record."""
    first, second, paths = slice(0, 1), slice(1, 2), slice(2, None)
    return Run(whole.part(first), whole.part(second), whole.part(paths), trial)


def settled_runs(world: World, config: TrialConfig, first_seed: int = 1) -> Iterator[Run]:
    """Runs of seeds from ``first_seed`` up that settled, each on a path of its own."""
    habits: set[str] = set()
    for seed in range(first_seed, first_seed + 1000):
        candidate = run(world, config, seed)
        habit = measures.habit(candidate.paths)
        if habit is not None and habit not in habits:
            habits.add(habit)
            yield candidate


def useful_round(
    world: World, config: TrialConfig, learner: Learner, start: Sequence[float], shortest: int
) -> Record | None:
    """Section VI-D: rounds from a new start until one arrives within 1.5 times the shortest path.

    With a copy of what was learned. None where none of 40 rounds does, or three in a row failed.
    """
    limit = SECTION_VI.step_limit
    planned = Schedule((), NEW_START_ROUNDS, limit, NEW_START_HOPELESS)
    trial = Trial(world.with_start(start), config, learner.seed, copy.copy(learner))
    rounds: list[Record] = []
    for record in planned.parts(trial, most=limit):
        rounds.append(record)
        if record.rounds["arrived"][0] and len(record) <= USEFUL * shortest:
            return Record.concatenate(rounds)
    return None
