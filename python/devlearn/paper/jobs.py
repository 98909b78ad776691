"""Runs of section VI as jobs, plain values that a process can be sent and a journal can hold.

``execute`` makes one and measures it by everything that ``claims.json`` names.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .._core import Kind, Learner, LearnerConfig, RandomAgent, TrialConfig, World
from .._types import Pose
from ..experiments.schedule import Schedule
from . import measures, schedule
from .measures import Measures
from .schedule import Run


def job(
    world: World,
    config: TrialConfig,
    seed: int,
    *,
    agent: str = "learner",
    rounds: int | None = None,
    shortest: int | None = None,
    starts: Sequence[tuple[Pose, int]] = (),
) -> dict[str, Any]:
    """A run as plain values. agent: 'learner' or 'random'. starts: new, with shortest paths.

    ``rounds`` of path learning are section VI's where nothing else is said.
    """
    planned = schedule.SECTION_VI
    if rounds is not None:
        planned = planned.replace(rounds=rounds)
    return {
        "world": world.to_json(),
        "config": config.to_dict(),
        "seed": seed,
        "agent": agent,
        "schedule": planned.to_dict(),
        "shortest": shortest,
        "starts": [[list(pose), steps] for pose, steps in starts],
    }


def execute(job: Mapping[str, Any]) -> Measures:
    """Makes a run and measures it: claim id -> value, and ``control:`` claim id -> value."""
    world = World.from_json(job["world"])
    config = TrialConfig.from_dict(job["config"])
    agent = RandomAgent(job["seed"]) if job["agent"] == "random" else None
    made = schedule.run(world, config, job["seed"], Schedule(**job["schedule"]), agent=agent)
    result = _measure_run(made, job["shortest"])
    if agent is None:
        result |= _measure_learner(made, job["shortest"])
    else:
        result |= _measure_random(made)
    if job["starts"]:
        assert isinstance(made.trial.learner, Learner)
        assert isinstance(config.learner, LearnerConfig)
        learned, fresh = made.trial.learner, Learner(config.learner, job["seed"])
        result["new_starts"] = _rounds_from(world, config, learned, job["starts"])
        result["control:new_starts"] = _rounds_from(world, config, fresh, job["starts"])
    return result


def _measure_run(made: Run, shortest: int | None) -> Measures:
    first, second, paths = made.first, made.second, made.paths
    steps = paths.rounds["steps"]
    arrivals = [measures.first_arrival(r) or len(r) for r in (first, second)]
    settled = measures.settled_round(paths)
    planned = schedule.SECTION_VI
    unsettled = len(planned.free) + planned.rounds + 1
    last_arrived = bool(paths.rounds["arrived"][-1])
    return {
        "first_arrival": arrivals[0],
        "stays_at_target": measures.share_near_target(first, 2000),
        "arrives_sooner": arrivals[1] / arrivals[0],
        "wanders_less": measures.cells_visited(second) / measures.cells_visited(first),
        "rounds_shorten": float(np.mean(steps[-20:]) / np.mean(steps[:20])),
        "settles": settled is not None,
        "settled_early": unsettled if settled is None else settled,
        "settled_path_is_short": steps[-1] / shortest if shortest and last_arrived else None,
        "habit": measures.habit(paths),
        "last_steps": float(np.mean(steps[-20:])),
        "no_collision": measures.share(first.collided),
        "settled_path_is_free": not paths.collided[paths.steps_of(-1)].any(),
        "similar_worlds": bool(paths.rounds["arrived"][-20:].all()),
        "every_round_arrives": int(np.count_nonzero(~paths.rounds["arrived"])),
        "round_steps": steps.tolist(),
        "round_arrived": paths.rounds["arrived"].tolist(),
    }


def _measure_learner(made: Run, shortest: int | None) -> Measures:
    records = [made.first, made.second, made.paths]
    late = measures.late_increases(made.paths)
    arrival = measures.first_arrival(made.first)
    grid = made.trial.grid
    table = grid.count * made.trial.config.learner.motion_count
    learner = made.trial.learner
    assert learner is not None
    kinds = np.concatenate([r.kind for r in records])
    return {
        "explored_count_settles": measures.change_after(made.first.explored_count, 3000),
        "effective_count_settles": measures.change_after(made.first.effective_count, 3000),
        "late_increases_explore": late["longer"],
        "control:late_increases_explore": late["others"],
        "exploited_are_effective": measures.exploited_ineffective(records),
        "ineffective_explored_once": measures.repeated_explorations(records),
        "learning_waste_is_small": measures.share(kinds == Kind.EXHAUSTED),
        "computing_waste_is_small": measures.computing_waste(records),
        "fewer_mappings": learner.effective_count / table,
        "control:fewer_mappings": 1.0,
        "mappings_explored": learner.explored_count,
        "mappings_effective": learner.effective_count,
        "control:settled_path_is_short": arrival / shortest if arrival and shortest else None,
        "control:settled_path_is_free": not made.first.collided[:arrival].any(),
    }


def _measure_random(made: Run) -> Measures:
    records = [made.first, made.second, made.paths]
    tried = measures.mappings([made.first])
    _, first = np.unique(tried, return_index=True)
    new = np.zeros(len(tried), dtype=np.int64)
    new[first] = 1
    again = measures.known_ineffective(records)
    smf = np.concatenate([r.smf_used for r in records])
    return {
        "explored_count_settles": measures.change_after(np.cumsum(new), 3000),
        "effective_count_settles": measures.change_after(
            np.cumsum(new * (made.first.smf_used >= 0)), 3000
        ),
        "exploited_are_effective": measures.share(smf < 0),
        "ineffective_explored_once": int(np.count_nonzero(again)),
        "learning_waste_is_small": measures.share(again),
        "computing_waste_is_small": measures.share(smf < 0),
    }


def _rounds_from(
    world: World, config: TrialConfig, learner: Learner, starts: Sequence[Any]
) -> list[int]:
    """For each start, rounds until one arrives usefully; each with a fresh copy of the learner."""
    needed = []
    for pose, shortest in starts:
        found = schedule.useful_round(world, config, learner, pose, shortest)
        needed.append(schedule.NEW_START_ROUNDS + 1 if found is None else len(found.rounds))
    return needed
