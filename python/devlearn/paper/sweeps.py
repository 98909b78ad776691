"""Section VI as sweeps, and what a run of theirs is measured by: all that ``claims.json`` names."""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from .._core import Kind, Learner, LearnerConfig, TrialConfig, World
from .._types import Pose
from ..experiments import contenders, store
from ..experiments.job import canonical
from ..experiments.measures import Run, computing_waste, learning_waste, settled_from
from ..experiments.spec import Spec, Together, read
from . import measures, places, schedule
from .claims import Results
from .measures import Measures

CLAIMS = f"{__name__}:claims"
NEW_STARTS = f"{__name__}:new_starts"


class Planned(NamedTuple):
    """The sweeps of one preset, as `Results` has their runs."""

    runs: Sequence[Spec]
    random: Sequence[Spec]
    similar: Sequence[Spec]
    similar_random: Sequence[Spec]
    by_sigma: Mapping[float, Sequence[Spec]]
    reseeded: Sequence[Spec]

    def all(self) -> list[Spec]:
        """One after the other."""
        every = [*self.runs, *self.random, *self.similar, *self.similar_random, *self.reseeded]
        return every + [spec for specs in self.by_sigma.values() for spec in specs]


def planned(preset: str, seeds: Sequence[int]) -> Planned:
    """What is run of a preset."""

    def of(agent: str, seeds: Sequence[int] = seeds, **more: Any) -> Spec:
        whole = {**schedule.SECTION_VI.to_dict(), "worlds": ["paper"], "measures": [CLAIMS], **more}
        return read({**whole, "agents": [agent], "seeds": [*seeds]})

    def in_similar(agent: str, rounds: int) -> list[Spec]:
        return [of(agent, [s], worlds=[f"similar:{s}"], rounds=rounds) for s in seeds]

    # Their rounds are of the runs beyond the paper, too.
    runs = [of(preset, measures=[CLAIMS, NEW_STARTS], keep="rounds")]
    own = contenders.preset(preset).learner
    assert isinstance(own, LearnerConfig)
    # Random motions learn nothing, so they are the same control for both presets.
    return Planned(
        runs=runs,
        random=[of("RandomAgent", rounds=schedule.CONTROL_ROUNDS)],
        similar=in_similar(preset, schedule.SIMILAR_ROUNDS),
        similar_random=in_similar("RandomAgent", schedule.SIMILAR_CONTROL_ROUNDS),
        by_sigma={
            sigma: runs if sigma == own.sigma else [of(preset, settings={preset: {"sigma": sigma}})]
            for sigma in schedule.SIGMAS[preset]
        },
        reseeded=[of(preset, [seed + schedule.RESEEDED for seed in seeds])],
    )


def results(plan: Planned, file: store.Results) -> Results:
    """What came of a preset's runs."""

    def made(specs: Sequence[Spec]) -> list[Measures]:
        return [
            {**row[CLAIMS], **(row[NEW_STARTS] or {})} for row in file.rows(Together(specs).jobs())
        ]

    return Results(
        runs=made(plan.runs),
        random=made(plan.random),
        similar=made(plan.similar),
        similar_random=made(plan.similar_random),
        by_sigma={sigma: made(specs) for sigma, specs in plan.by_sigma.items()},
        reseeded=made(plan.reseeded),
    )


# --- measures -------------------------------------------------------------------------------------


def claims(run: Run) -> Measures:
    """Claim id -> value, and ``control:`` claim id -> value."""
    assert run.record is not None
    made = schedule.run_of(run.record, run.trial)
    own = _of_random(run, made) if run.trial.learner is None else _of_learner(run, made)
    return _of_any(run, made) | own


def _of_any(run: Run, made: schedule.Run) -> Measures:
    paths = run.paths
    steps, arrived = paths["steps"], paths["arrived"]
    arrivals = [_arrival(run, entry) for entry in (0, 1)]
    settled = settled_from(paths, measures.SETTLED_ROUNDS)
    planned = schedule.SECTION_VI
    unsettled = len(planned.free) + planned.rounds + 1
    return {
        "first_arrival": arrivals[0],
        "stays_at_target": measures.share_near_target(made.first, 2000),
        "arrives_sooner": arrivals[1] / arrivals[0],
        "wanders_less": measures.cells_visited(made.second) / measures.cells_visited(made.first),
        "rounds_shorten": float(np.mean(steps[-20:]) / np.mean(steps[:20])),
        "settles": settled is not None,
        "settled_early": unsettled if settled is None else int(paths["round"][settled]),
        "settled_path_is_short": steps[-1] / run.shortest if run.shortest and arrived[-1] else None,
        "habit": None if settled is None else measures.path_name(made.paths),
        "last_steps": float(np.mean(steps[-20:])),
        "no_collision": int(run.rounds["touches"][0]) / int(run.rounds["steps"][0]),
        "settled_path_is_free": not paths["touches"][-1],
        "similar_worlds": bool(arrived[-20:].all()),
        "every_round_arrives": int(np.count_nonzero(~arrived)),
        "round_steps": steps.tolist(),
        "round_arrived": arrived.tolist(),
    }


def _arrival(run: Run, entry: int) -> int:
    """The step of a round, from 1, that first reached the target, or its last one."""
    return int(run.rounds["first_arrival"][entry] or run.rounds["steps"][entry])


def _of_learner(run: Run, made: schedule.Run) -> Measures:
    learner, config = run.trial.learner, run.trial.config.learner
    assert isinstance(learner, Learner)
    assert isinstance(config, LearnerConfig)
    records = [made.first, made.second, made.paths]
    late = measures.late_increases(made.paths)
    reached, arrival = bool(run.rounds["first_arrival"][0]), _arrival(run, 0)
    kinds = np.concatenate([r.kind for r in records])
    return {
        "explored_count_settles": measures.change_after(made.first.explored_count, 3000),
        "effective_count_settles": measures.change_after(made.first.effective_count, 3000),
        "late_increases_explore": late["longer"],
        "control:late_increases_explore": late["others"],
        "exploited_are_effective": measures.exploited_ineffective(records),
        "ineffective_explored_once": measures.repeated_explorations(records),
        "learning_waste_is_small": measures.share(kinds == Kind.EXHAUSTED),
        "computing_waste_is_small": computing_waste(run),
        "fewer_mappings": learner.effective_count / (run.trial.grid.count * config.motion_count),
        "control:fewer_mappings": 1.0,
        "mappings_explored": learner.explored_count,
        "mappings_effective": learner.effective_count,
        "control:settled_path_is_short": arrival / run.shortest
        if reached and run.shortest
        else None,
        "control:settled_path_is_free": not made.first.collided[:arrival].any(),
    }


def _of_random(run: Run, made: schedule.Run) -> Measures:
    tried = measures.mappings([made.first])
    _, first = np.unique(tried, return_index=True)
    new = np.zeros(len(tried), dtype=np.int64)
    new[first] = 1
    return {
        "explored_count_settles": measures.change_after(np.cumsum(new), 3000),
        "effective_count_settles": measures.change_after(
            np.cumsum(new * (made.first.smf_used >= 0)), 3000
        ),
        "exploited_are_effective": computing_waste(run),  # of who updates at every step
        "ineffective_explored_once": int(run.rounds["known_ineffective"].sum()),
        "learning_waste_is_small": learning_waste(run),
        "computing_waste_is_small": computing_waste(run),
    }


def new_starts(run: Run) -> Measures:
    """From each new start, rounds until one arrives usefully: having learned, and not."""
    trial = run.trial
    assert isinstance(trial.learner, Learner)
    assert isinstance(trial.config.learner, LearnerConfig)
    fresh = Learner(trial.config.learner, trial.seed)
    starts = _new_starts(trial.world.to_json(), canonical(trial.config.to_dict()))

    def rounds_of(learner: Learner) -> list[int]:
        needed = []
        for pose, shortest in starts:
            found = schedule.useful_round(trial.world, trial.config, learner, pose, shortest)
            needed.append(schedule.NEW_START_ROUNDS + 1 if found is None else len(found.rounds))
        return needed

    return {"new_starts": rounds_of(trial.learner), "control:new_starts": rounds_of(fresh)}


@functools.lru_cache(maxsize=8)
def _new_starts(world: str, config: str) -> list[tuple[Pose, int]]:
    return places.new_starts(World.from_json(world), TrialConfig.from_dict(json.loads(config)))
