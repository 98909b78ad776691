"""The paper's four kinds of episode (section VI-A, Fig. 8): where they occur in a record."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .._core import Event, Kind
from ..errors import InvalidValue
from ..record import Record
from .counts import counts_before, window_of

MIN_RUN = 2  # steps of the shortest stretch that is one of several


class Episode(NamedTuple):
    """A stretch of the counts between the steps ``first`` and ``last``, from 1 as in Fig. 8.

    What happened at the steps first ... last - 1 shows in the counts of first + 1 ... last.
    """

    first: int
    last: int


def steps_of_kinds(record: Record, entry: int) -> dict[str, npt.NDArray[np.bool_]]:
    """Which steps of a round are of the paper's four kinds."""
    steps = record.steps_of(entry)
    kind, event, reduced = record.kind[steps], record.event[steps], record.reduced[steps]
    explored = np.diff(counts_before(record, entry)[0])
    effective = np.diff(counts_before(record, entry)[1])
    explore, exploit = kind == int(Kind.EXPLORE), kind == int(Kind.EXPLOIT)
    return {
        "a": explore & (explored > 0) & (effective > 0),
        "b": explore & (explored > 0) & (effective == 0),
        "c": exploit & (explored == 0) & (effective == 0),
        # An abandonment lowers NUM_M as well, and is none.
        "d": exploit & (reduced > 0) & (event != int(Event.ABANDONMENT)) & (effective < 0),
    }


def find_episodes(
    record: Record, entry: int = 0, window: tuple[int, int] = (0, 30)
) -> dict[str, Episode | None]:
    """Where the paper's four kinds of episode (section VI-A, Fig. 8) occur in a window of a round.

    - ``"a"``: the first exploration that is effective: NUM_RM and NUM_M rise;
    - ``"b"``: the longest run of explorations none of which is: NUM_RM rises, NUM_M stays;
    - ``"c"``: the longest run of exploitation in which neither changes;
    - ``"d"``: the first exploitation after which reduction development lowers NUM_M (an
      abandonment lowers it, too, and does not count).

    None where a kind does not occur. A run is two steps at least; of equal ones the first is taken.
    ``window=(0, 30)`` looks at the counts of the steps 1 to 30: an episode ends by step 30.
    """
    start, stop = window_of(record, entry, window)
    found: dict[str, Episode | None] = {}
    for name, which in steps_of_kinds(record, entry).items():
        # The outcome of the window's last step shows only beyond it.
        inside = np.flatnonzero(which[start : max(start, stop - 1)]) + start
        if name in ("a", "d"):
            found[name] = Episode(int(inside[0]) + 1, int(inside[0]) + 2) if len(inside) else None
            continue
        runs = np.split(inside, np.flatnonzero(np.diff(inside) > 1) + 1)
        longest = max(runs, key=len)  # the first of equals
        found[name] = (
            Episode(int(longest[0]) + 1, int(longest[-1]) + 2) if len(longest) >= MIN_RUN else None
        )
    return found


def find_abandonment(
    record: Record, entry: int = 0, window: tuple[int, int] = (0, 30)
) -> Episode | None:
    """The first exploitation in a window that lowers NUM_M by abandonment (step 4 of the method).

    In the counts it looks like the paper's kind d, which is reduction development alone.
    """
    start, stop = window_of(record, entry, window)
    steps = record.steps_of(entry)
    inside = np.flatnonzero(
        record.event[steps][start : max(start, stop - 1)] == int(Event.ABANDONMENT)
    )
    return Episode(start + int(inside[0]) + 1, start + int(inside[0]) + 2) if len(inside) else None


def find_window(
    record: Record, kinds: str = "abcd", entry: int = 0, length: int = 30
) -> tuple[int, int] | None:
    """Find the first ``length`` steps of a round that contain all these kinds of episode.

    For ``find_episodes`` and ``plot_episodes``. The round's very first steps are taken if they do;
    else the episode stands in the middle as far as the others allow. None if no window does.
    """
    for name in kinds:
        if name not in "abcd":
            raise InvalidValue("kinds", kinds, 'letters of "abcd"')
    if length < MIN_RUN + 1:
        raise InvalidValue("length", length, f"at least {MIN_RUN + 1}")
    _, steps = window_of(record, entry, None)
    starts = np.arange(max(1, steps - length + 1))
    holds = np.ones(len(starts), dtype=bool)
    for name, which in steps_of_kinds(record, entry).items():
        if name not in kinds:
            continue
        span = 1 if name in ("a", "d") else MIN_RUN
        begins = np.flatnonzero(which if span == 1 else which[:-1] & which[1:])
        following = np.searchsorted(begins, starts)
        there = following < len(begins)
        ends = np.full(len(starts), steps + length)
        ends[there] = begins[following[there]] + span
        holds &= ends < np.minimum(starts + length, steps)
    where = np.flatnonzero(holds)
    if len(where) == 0:
        return None
    gaps = np.flatnonzero(np.diff(where) > 1)
    first_run = where[: gaps[0] + 1] if len(gaps) else where
    start = 0 if first_run[0] == 0 else int(first_run[len(first_run[:length]) // 2])
    return start, min(start + length, steps)


def find_entry_and_window(
    record: Record, kinds: str = "abcd", length: int = 30
) -> tuple[int, tuple[int, int]] | None:
    """Find the first round of a record with such a window: its entry and ``find_window``'s answer.

    Reduction development, kind d, takes hundreds of exploitations in one place: the first
    round of free learning, as a rule, has none, path learning does.
    """
    for entry in range(len(record.rounds)):
        window = find_window(record, kinds, entry, length)
        if window is not None:
            return entry, window
    return None
