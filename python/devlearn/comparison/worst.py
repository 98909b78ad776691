"""Each agent's worst run, made again from the results to see where it went."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

from .._files import code_version
from ..experiments.store import Results
from ..record import Record
from .compared import Compared, Contender


class Worst(NamedTuple):
    """A run and its last round."""

    contender: Contender
    world: str
    seed: int
    failed: float
    """Share of its rounds that failed."""
    rounds: int
    """How many it made, those of free learning counted."""
    record: Record
    """Of the last rounds; the last of them is the run's."""


def can_be_made_again(results: Results) -> bool:
    """Whether these are results of this very code, of which runs are equal to the bit."""
    return results.meta["code"] == code_version()


def worst_run(compared: Compared, contender: Contender) -> Worst | None:
    """The one with the most failed rounds, then the longest last ones, then the most steps.

    None where every run ended by an error.
    """
    frame = compared.frame
    runs = frame[(frame["contender"] == contender.name) & frame["error"].isna()]
    if not len(runs):
        return None
    by = ["failed_share", "last_ratio", "steps"]
    row = runs.sort_values(by, ascending=False, kind="stable").iloc[0]
    run = int(row["run"])
    job, trial = compared.results.job(run), compared.trial(run)
    parts = deque(job.schedule.parts(trial), maxlen=1)
    last = parts[0] if parts else None
    if last is None or not len(last.rounds):
        return None
    return Worst(contender, job.world, job.seed, float(row["failed_share"]), trial.round, last)
