"""Records made by hand, step by step."""

import devlearn
import numpy as np
from devlearn import Event, Kind
from devlearn.record import STEP_COLUMNS, provenance_of

E, X, H = Kind.EXPLORE, Kind.EXPLOIT, Kind.EXHAUSTED


def hand_made(steps, *, before=(0, 0), rounds=None):
    """A record of (kind, event, reduced) a step, with the counts that follow from them."""
    kind, event, reduced = (np.array(column) for column in zip(*steps))
    entered = (event == Event.EXTENSION).astype(int)
    left = (event == Event.ABANDONMENT) + reduced
    rounds = rounds or [(1, len(steps), False)]
    columns = {name: np.zeros(len(steps), dtype) for name, dtype in STEP_COLUMNS.items()}
    columns |= {
        "kind": kind.astype(np.uint8),
        "event": event.astype(np.uint8),
        "reduced": reduced.astype(np.int32),
        "explored_count": np.cumsum(kind == E) + before[0],
        "effective_count": np.cumsum(entered - left) + before[1],
        "rounds": np.array(rounds, dtype=[("round", "i4"), ("steps", "i8"), ("arrived", "?")]),
    }
    columns |= {name: np.zeros(len(steps) + len(rounds)) for name in ("x", "y", "heading")}
    world = devlearn.World.load("empty")
    provenance = provenance_of(world, devlearn.TrialConfig(), 0, None)
    return devlearn.Record(columns, provenance)


EFFECTIVE = (E, Event.EXTENSION, 0)
INEFFECTIVE = (E, Event.REJECTION, 0)
NO_CHANGE = (X, Event.ORIENTATION, 0)
REDUCTION = (X, Event.ORIENTATION, 1)
ABANDONMENT = (X, Event.ABANDONMENT, 0)
RETRY = (H, Event.EXTENSION, 0)

#  steps          1-2              3            4-6                7-11
ALL_FOUR = [INEFFECTIVE] * 2 + [EFFECTIVE] + [NO_CHANGE] * 3 + [INEFFECTIVE] * 5
#  steps          12            13            14-17           18 ...
ALL_FOUR += [EFFECTIVE] + [ABANDONMENT] + [NO_CHANGE] * 4 + [REDUCTION] + [RETRY] * 12
