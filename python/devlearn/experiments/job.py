"""One run of a sweep: plain values that say which, and what came of it."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import json
import socket
import time
import traceback
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import Robot, RobotDef, Tally, Trial, TrialConfig, World, shortest_path
from ..record import Record
from . import measures
from .contenders import trial_of
from .measures import Run
from .schedule import Schedule

KEEP = ("nothing", "rounds", "record")


@dataclasses.dataclass(frozen=True)
class Job:
    """A run that is asked for."""

    world: str
    """Its name in the sweep: of one that ships, of a file, or such as ``similar:7``."""
    world_json: str
    agent: str
    settings: Mapping[str, Any]
    """The agent's own, as far as they were set."""
    trial: Mapping[str, Any]
    """Changed fields of TrialConfig, by dotted names."""
    schedule: Schedule
    seed: int
    label: str = ""
    """A short name of agent and settings, for people."""
    measures: tuple[str, ...] = ()
    """Those of one's own, as ``module:function``, beside devlearn's."""
    keep: str = "nothing"
    """What stays of it beside its measures: 'nothing', 'rounds', or the
    whole 'record', too."""

    def variant(self) -> dict[str, Any]:
        """What is the same in every world and for every seed."""
        return {
            "agent": self.agent,
            "settings": dict(self.settings),
            "trial": dict(self.trial),
            **self.schedule.to_dict(),
        }


def canonical(value: object) -> str:
    """As JSON, the same text for the same value."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"))


@functools.lru_cache(maxsize=256)
def world_hash(text: str) -> str:
    """That of World.hash, of its JSON."""
    return hashlib.sha256(text.encode()).hexdigest()


@dataclasses.dataclass
class Row:
    """What came of a run: measures, or the traceback of what it failed by."""

    measures: dict[str, float | str | None] = dataclasses.field(default_factory=dict)
    shortest: int | None = None
    error: str | None = None
    rounds: bytes | None = None
    """`Tally.rounds`, packed by `packed`."""
    record: bytes | None = None
    """The Record, as Record.save writes it."""
    seconds: float = 0.0
    """Processor time."""
    host: str = ""
    finished: str = ""


def execute(job: Job) -> Row:
    """Makes a run; what goes wrong in it is in the row."""
    began = time.thread_time()
    try:
        row = _made(job)
    except KeyboardInterrupt:
        raise
    except BaseException:
        # What is no text, such as half a surrogate pair, no file of results can hold.
        told = traceback.format_exc().encode(errors="backslashreplace").decode()
        row = Row(error=told)
    row.seconds = time.thread_time() - began
    row.host = socket.gethostname()
    row.finished = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
    return row


def _made(job: Job) -> Row:
    world = _world(job.world_json)
    trial = trial_of(job.agent, job.settings, job.trial, world, job.seed)
    run = run_of(trial, job.schedule, record=bool(job.measures) or job.keep == "record")
    row = Row({name: one.of(run) for name, one in measures.MEASURES.items()}, run.shortest)
    for name in job.measures:
        row.measures[name] = measures.value_of(name, run)
    if job.keep != "nothing":
        row.rounds = packed(run.rounds)
    if job.keep == "record":
        assert run.record is not None
        row.record = run.record.to_bytes()
    return row


def run_of(trial: Trial, schedule: Schedule, *, record: bool = False) -> Run:
    """Runs a new trial by a schedule; ``record`` keeps every step."""
    shortest = shortest_from_start(trial.world.to_json(), trial.config)
    tally = Tally()
    began = time.thread_time()
    parts = [*schedule.parts(trial, tally=tally, rounds_only=not record)]
    seconds = time.thread_time() - began
    return Run(
        rounds=tally.rounds,
        frees=len(schedule.free),
        schedule=schedule,
        shortest=shortest,
        record=Record.concatenate(parts) if record else None,
        trial=trial,
        seconds=seconds,
    )


@functools.lru_cache(maxsize=64)
def _world(text: str) -> World:
    return World.from_json(text)


def shortest_from_start(world_json: str, config: TrialConfig) -> int | None:
    """Steps of the shortest path from a world's start; None where there is no way."""
    return _shortest(world_json, canonical(config.robot.to_dict()), config.goal_radius)


@functools.lru_cache(maxsize=4096)
def _shortest(world_json: str, robot: str, goal_radius: float) -> int | None:
    robot_def = RobotDef.from_dict(json.loads(robot))
    return shortest_path(Robot(_world(world_json), robot_def), goal_radius=goal_radius).steps


# --- rounds in a file -----------------------------------------------------------------------------


def packed(rounds: npt.NDArray[np.void]) -> bytes:
    """Column by column, which packs better: zlib of what numpy.save would write of each."""
    columns = [np.ascontiguousarray(rounds[name]).tobytes() for name in rounds.dtype.names or ()]
    return zlib.compress(b"".join(columns), 6)


def unpacked(content: bytes) -> npt.NDArray[np.void]:
    """The reverse."""
    dtype = Tally().rounds.dtype
    plain = zlib.decompress(content)
    rounds = np.zeros(len(plain) // sum(dtype[n].itemsize for n in dtype.names or ()), dtype)
    at = 0
    for name in dtype.names or ():
        size = len(rounds) * dtype[name].itemsize
        rounds[name] = np.frombuffer(plain[at : at + size], dtype[name])
        at += size
    return rounds
