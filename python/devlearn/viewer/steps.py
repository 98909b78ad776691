"""The steps of a record on a page: which of them, and their columns."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .._core import SituationGrid
from ..analysis.fields import grid_of
from ..errors import InvalidValue
from ..record import Record
from .pack import Packer

_WHOLE_ROUNDS = 50  # that stay whole where a record is thinned, if it has so many

Indices = npt.NDArray[np.int64]


class Shown(NamedTuple):
    """What is shown of a record: all of it, or of a long one some."""

    entries: Indices
    """Indices of these in ``record.rounds``."""
    steps: Indices
    """Of these among the record's steps."""
    poses: Indices
    """Likewise: one before the steps of each entry, and one after each step."""
    counts: Indices
    """Steps of each entry."""
    every: int
    """One step in so many."""
    every_entry: int
    """One entry in so many."""

    @classmethod
    def of(cls, record: Record, most: int) -> Shown:
        """Of a record of more than ``most`` steps some rounds, whole while there are enough.

        The first and the last round are among them, and of each its last step.
        """
        rounds, total = len(record.rounds), len(record)
        every_entry = max(1, min(-(-total // most), rounds // _WHOLE_ROUNDS), -(-rounds // most))
        entries = np.unique(np.append(np.arange(0, rounds, every_entry), rounds - 1))
        offsets = record.offsets()
        every = max(1, -(-int(record.rounds["steps"][entries].sum()) // most))
        bounds = offsets.tolist()
        steps = [_some(bounds[e], bounds[e + 1], every) for e in entries.tolist()]
        poses = [np.append(bounds[e], of + 1) + e for e, of in zip(entries.tolist(), steps)]
        counts = np.array([len(of) for of in steps])
        return cls(
            entries, np.concatenate(steps), np.concatenate(poses), counts, every, every_entry
        )

    @property
    def thinned(self) -> bool:
        """Whether something is left out."""
        return self.every > 1 or self.every_entry > 1

    def situations(self, record: Record) -> tuple[Indices, Indices, Indices | None]:
        """Ids of the situations shown; of each step, its number among them, and the true one's.

        The last is None where the robot never errs about its situation.
        """
        believed, true = record.situation[self.steps], record.true_situation[self.steps]
        true = np.where(true < 0, believed, true)  # where files do not tell
        ids = np.unique(np.concatenate([believed, true]))
        errs = not np.array_equal(believed, true)
        return ids, np.searchsorted(ids, believed), np.searchsorted(ids, true) if errs else None


def _some(begin: int, end: int, every: int) -> Indices:
    """One index in so many, the last one always."""
    return np.arange(end - 1, begin - 1, -every)[::-1]


def pack_steps(packer: Packer, record: Record, shown: Shown) -> dict[str, Any]:
    """Packs poses, situations, motions and what came of them; gives the header's part."""
    told: dict[str, Any] = {}
    if shown.thinned:
        told["thinned"] = {"steps": shown.every, "rounds": shown.every_entry}
        packer.whole("stepNumber", shown.steps + 1)
        packer.whole("roundFirst", record.offsets()[:-1][shown.entries])
    world, steps = record.world, shown.steps
    for name, low, length in zip("xy", world.origin, (world.width, world.height)):
        values = getattr(record, name)[shown.poses]
        packer.parts(
            name,
            values,
            min(low, values.min(initial=low)),
            max(low + length, values.max(initial=low)),
        )
    packer.parts("heading", np.mod(record.heading[shown.poses], 360.0), 0.0, 360.0)
    packer.whole("roundShown", shown.counts)
    for name in ("motion", "kind", "collided", "arrived"):
        packer.whole(name, getattr(record, name)[steps])
    sef = record.sef[steps]
    packer.parts("sef", sef, sef.min(initial=0.0), sef.max(initial=0.0))
    if record.echoes is not None and record.echoes.shape[1] > 0:
        most = record.config.robot.sonar_range
        packer.parts("echoes", record.echoes[steps], 0.0, most)
    try:
        told["grid"] = _grid(grid_of(record), world.origin)
    except InvalidValue:
        told["grid"] = None  # situations of one's own are no cells
    return told


def _grid(grid: SituationGrid, origin: tuple[float, float]) -> dict[str, Any]:
    return {
        "origin": list(origin),
        "width": grid.width,
        "height": grid.height,
        "columns": grid.columns,
        "rows": grid.rows,
        "headings": grid.headings,
    }
