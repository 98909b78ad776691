"""How many mappings were explored and are effective, step by step."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .._core import Event, Kind
from ..errors import InvalidValue
from ..record import Record


def counts_before(
    record: Record, entry: int = 0
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """NUM_RM and NUM_M of one round as the paper's Figs. 7 and 8 count them.

    Element ``t - 1`` is the count before the outcome of step ``t``, for t = 1 ... steps, and one
    more element follows, the count after the last step: a motion explored at step 24 shows at step
    25. (``Record.explored_count`` and ``effective_count`` count after each step.)
    """
    steps = record.steps_of(entry)
    explored, effective = record.explored_count[steps], record.effective_count[steps]
    if steps.stop == steps.start:
        nothing = np.zeros(1, dtype=np.int64)
        return nothing, nothing
    first = steps.start
    if first > 0:
        before = int(record.explored_count[first - 1]), int(record.effective_count[first - 1])
    else:  # what the record's first step changed is known from what it was
        event = record.event[0]
        developed = int(event == Event.EXTENSION) - int(event == Event.ABANDONMENT)
        before = (
            max(0, int(explored[0]) - int(record.kind[0] == Kind.EXPLORE)),
            max(0, int(effective[0]) - developed + int(record.reduced[0])),
        )
    return np.concatenate([[before[0]], explored]), np.concatenate([[before[1]], effective])


def window_of(record: Record, entry: int, window: tuple[int, int] | None) -> tuple[int, int]:
    """``window`` within the round, as a half-open range of its steps."""
    steps = record.steps_of(entry)
    count = steps.stop - steps.start
    if window is None:
        return 0, count
    start, stop = window
    if not 0 <= start < stop:
        raise InvalidValue("window", (start, stop), "0 <= start < stop")
    return min(start, count), min(stop, count)
