"""The learner of a record on a page: what the page needs to follow it."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import AdaptiveLearner, Event, Learner
from ..analysis import Replay, first_learner, learner_chose
from ..errors import InvalidValue
from ..record import Record
from .pack import Packer
from .steps import Indices, Shown

_FRAMES = 100  # moments at which an adaptive learner's losses are told
_MOST_LOSSES = 2**24  # in all of them


def pack_learner(packer: Packer, record: Record, shown: Shown, notes: list[str]) -> dict[str, Any]:
    """Packs what tells of the learner; gives the header's part, and notes of what is not shown.

    The paper's learner is not told but lived through once more by the page, which needs its memory
    before the first step. An adaptive one is told at some moments. Raises FileError where the
    record's learner cannot be read.
    """
    ids, situation, true = shown.situations(record)
    learner = first_learner(record)
    if learner is not None and shown.thinned:
        learner = None
        notes.append(
            "The record is too long to be shown step by step, and so to be followed by its "
            "learner: lists and arrows are not shown. Show a part of it, such as --rounds 1:20."
        )
    elif learner is None:
        notes.append(_why_not(record))
    if isinstance(learner, Learner):
        memory = learner.memory()
        rest = np.setdiff1d(ids, memory.situation)
        order = np.concatenate([memory.situation, rest])
        told = _paper(packer, record, learner)
    elif isinstance(learner, AdaptiveLearner):
        order, told = _adaptive(packer, record, ids, notes)
    else:
        order, told = ids, {}
    by_id = np.argsort(order)
    number = by_id[np.searchsorted(order, ids, sorter=by_id)]
    packer.whole("situation", number[situation])
    if true is not None:
        packer.whole("trueSituation", number[true])
    packer.whole("idLow", order & 0xFFFFFFFF)
    packer.whole("idHigh", order >> 32)
    if not isinstance(learner, Learner):
        packer.floats("smf", record.smf_used[shown.steps], 4)
        packer.whole("event", record.event[shown.steps])
        packer.whole("explored", np.minimum(record.explored_count[shown.steps], 2**32 - 1))
        packer.whole("effective", np.minimum(record.effective_count[shown.steps], 2**32 - 1))
    return told


def _why_not(record: Record) -> str:
    if learner_chose(record):
        return (
            "The record does not carry what its learner knew at its first step: lists and arrows "
            "are not shown. Phases with learner=True keep it."
        )
    agent = record.provenance.get("agent", "which the record does not name")
    return f"The agent, {agent}, keeps no lists: there are none to be shown."


def _paper(packer: Packer, record: Record, learner: Learner) -> dict[str, Any]:
    memory = learner.memory()
    for name in ("effective_count", "ineffective_count", "motions", "times_learned"):
        packer.whole(name, getattr(memory, name))
    packer.floats("orientation", memory.orientation)
    packer.floats("smf", record.smf_used)
    # What all of it comes to, by which the page sees whether it followed.
    final = {"explored": record.explored_count[-1:], "effective": record.effective_count[-1:]}
    return {
        "learner": {
            "kind": "paper",
            "config": learner.config.to_dict(),
            "known": len(memory.situation),
            "final": {name: int(count.sum()) for name, count in final.items()},
            "eventCounts": np.bincount(record.event, minlength=len(Event)).tolist(),
            "reduced": int(record.reduced.sum()),
        }
    }


def _adaptive(
    packer: Packer, record: Record, ids: Indices, notes: list[str]
) -> tuple[Indices, dict[str, Any]]:
    """Expected losses and numbers of outcomes at some moments; the situations' order."""
    replay = Replay(record)
    motions = replay.learner.config.motion_count
    situations = len(ids) + replay.learner.situations_experienced
    frames = max(2, min(_FRAMES, _MOST_LOSSES // max(1, situations * motions)))
    moments = np.unique(np.linspace(0, len(record), frames).astype(int))
    seen: list[dict[str, npt.NDArray[Any]]] = []
    for moment in moments.tolist():
        try:
            seen.append(_arrays(replay.to(moment).to_bytes()))
        except InvalidValue as error:
            notes.append(f"The learner could be followed to step {replay.steps} only: {error}.")
            moments = moments[: len(seen)]
            break
    met = seen[-1]["situation"]
    order = np.concatenate([met, np.setdiff1d(ids, met)])
    losses = np.zeros((len(seen), len(order), motions))
    outcomes = np.zeros(losses.shape, np.int64)
    first = np.zeros(len(order))
    for loss, times, arrays in zip(losses, outcomes, seen):
        known = len(arrays["situation"])
        loss[:known], first[:known] = arrays["loss"], arrays["first_estimate"]
        times[:known] = _times(arrays)
    packer.parts("losses", losses, 0.0, float(losses.max(initial=1.0)), losses[0].size)
    packer.whole("outcomes", outcomes, outcomes[0].size)
    packer.floats("firstEstimate", first, 4)
    return order, {
        "learner": {
            "kind": "adaptive",
            "config": replay.learner.config.to_dict(),
            "moments": moments.tolist(),
            "known": [len(arrays["situation"]) for arrays in seen],
        }
    }


def _times(arrays: dict[str, npt.NDArray[Any]]) -> Indices:
    """How many outcomes each mapping has, those that came again counted again."""
    counts = arrays["outcome_count"]
    mapping = np.repeat(np.arange(counts.size), counts.ravel())
    times = np.bincount(mapping, arrays["times"], counts.size)
    return times.astype(np.int64).reshape(counts.shape)


def _arrays(snapshot: bytes) -> dict[str, npt.NDArray[Any]]:
    """The arrays in a snapshot, which docs/snapshot-format.md tells of."""
    dtypes = {"F64": "<f8", "I64": "<i8", "I32": "<i4", "U32": "<u4"}
    end = 8 + int.from_bytes(snapshot[:8], "little")
    header = json.loads(snapshot[8:end])
    return {
        name: np.frombuffer(
            snapshot[end + about["data_offsets"][0] : end + about["data_offsets"][1]],
            dtypes[about["dtype"]],
        ).reshape(about["shape"])
        for name, about in header.items()
        if name != "__metadata__" and about["dtype"] in dtypes
    }
