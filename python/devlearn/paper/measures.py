"""What the claims of section VI are measured by: plain functions of records.

A run is two rounds of free learning, ``first`` and ``second``, and then ``paths``, the rounds of
path learning. Nothing here runs a trial.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import Kind, Tally
from ..experiments.measures import settled_from
from ..record import Record

Measures = dict[str, Any]  # of one run, by name

NEAR_TARGET = 0.6  # [m]
SETTLED_ROUNDS = 40


def first_arrival(record: Record, entry: int = 0) -> int | None:
    """Step, from 1, after which the target was first reached; None where it never was."""
    arrived = record.arrived[record.steps_of(entry)]
    return int(np.argmax(arrived)) + 1 if arrived.any() else None


def share_near_target(record: Record, last: int, distance: float = NEAR_TARGET) -> float:
    """Share of the last steps that end within ``distance`` [m] of the target."""
    return float(np.mean(record.goal_distance[-last:] <= distance))


def cells_visited(record: Record) -> int:
    """How many different cells of the situation grid the steps began in, whatever the heading."""
    return len(np.unique(record.situation // record.config.heading_bins))


def change_after(counts: npt.NDArray[np.int64], step: int) -> float:
    """|Change| of a count from a step to the end, as a share of its final value."""
    last = int(counts[-1])
    return abs(last - int(counts[step - 1])) / last if last else 0.0


def settled_round(record: Record, least: int = SETTLED_ROUNDS) -> int | None:
    """Number of the round from which to the last, at least ``least``, all motions are the same.

    None where the run has not settled, or its last round never arrived.
    """
    settled = settled_from(Tally.of(record).rounds, least)
    return None if settled is None else int(record.rounds["round"][settled])


def path_name(record: Record) -> str:
    """A short name of the last round's path: equal for equal motions."""
    return hashlib.sha256(record.motion[record.steps_of(-1)].tobytes()).hexdigest()[:12]


def habit(record: Record) -> str | None:
    """That of the path on which a run settled."""
    return None if settled_round(record) is None else path_name(record)


def late_increases(record: Record) -> dict[str, list[int]]:
    """Rounds of the second half that explored an unexplored motion: [how many, of how many].

    ``longer``: rounds that took more steps than the one before; ``others``: those that did not.
    """
    steps = record.rounds["steps"]
    explorations = np.concatenate([[0], np.cumsum(record.kind == Kind.EXPLORE)])
    explored = np.diff(explorations[record.offsets()]) > 0
    half = len(steps) // 2
    longer = np.diff(steps[half - 1 :]) > 0 if half else np.zeros(0, dtype=bool)
    late = explored[half:] if half else np.zeros(0, dtype=bool)
    return {
        "longer": [int(late[longer].sum()), int(longer.sum())],
        "others": [int(late[~longer].sum()), int((~longer).sum())],
    }


def mappings(records: Sequence[Record]) -> npt.NDArray[np.int64]:
    """The mapping (situation, motion) of every step, as one number each."""
    motions = len(records[0].config.robot.steering_angles)
    return np.concatenate([record.situation * motions + record.motion for record in records])


def repeated_explorations(records: Sequence[Record]) -> int:
    """Explorations of mappings beyond the first; the method promises none."""
    explored = mappings(records)[np.concatenate([r.kind for r in records]) == Kind.EXPLORE]
    return len(explored) - len(np.unique(explored))


def share(hits: npt.NDArray[np.bool_]) -> float:
    """Share of True; 0 of none."""
    return float(np.mean(hits)) if len(hits) else 0.0


def exploited_ineffective(records: Sequence[Record]) -> float:
    """Share of exploited motions that met SMF < 0 (Proof III's premise is that none does)."""
    smf = np.concatenate([record.smf_used for record in records])
    exploited = np.concatenate([record.kind for record in records]) == Kind.EXPLOIT
    return share(smf[exploited] < 0)
