"""Section VI of the paper as experiments: what is run, and what is measured of it.

A run is two rounds of free learning and then path learning, all from the start pose (section VI-A
to C). ``execute`` makes one run from a job, plain values that a process can be sent and a journal
can hold, and measures it by everything that ``claims.json`` names.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from .._core import (
    Circle,
    Kind,
    Learner,
    Polygon,
    Random,
    RandomAgent,
    Rectangle,
    Robot,
    Trial,
    TrialConfig,
    World,
    shortest_path,
)
from .._types import Pose
from ..errors import InvalidValue
from ..record import Record
from . import measures

FREE_STEPS = 10_000
STEP_LIMIT = 10_000
PATH_ROUNDS = 600
CONTROL_ROUNDS = 60
SIMILAR_ROUNDS = 100
SIMILAR_CONTROL_ROUNDS = 20
HOPELESS_ROUNDS = 20  # a run is ended once so many rounds in a row never arrived
NEW_START_ROUNDS = 40
TRAPPED_ROUNDS = 3  # so many failed rounds in a row from a new start, and it is given up
USEFUL = 1.5  # a useful path is at most so many times the shortest
# The claims compare 0.1, 0.3 and 0.7; the figure shows more.
SIGMAS = {"paper": (0.1, 0.3, 0.5, 0.7, 0.9), "step5": (0.1, 0.3, 0.7)}
RESEEDED = 1000  # seeds of the control for sigma begin here
PRESETS = ("paper", "step5")

Measures = dict[str, Any]


class Run(NamedTuple):
    """One run with everything it left: records and the trial itself."""

    first: Record
    second: Record
    paths: Record
    trial: Trial


def preset(name: str) -> TrialConfig:
    """The configuration of a preset, 'paper' or 'step5'. Raises InvalidValue."""
    if name not in PRESETS:
        raise InvalidValue("preset", repr(name), " or ".join(map(repr, PRESETS)))
    return TrialConfig.step5() if name == "step5" else TrialConfig.paper()


def run(
    world: World,
    config: TrialConfig,
    seed: int,
    *,
    agent: object = None,
    rounds: int = PATH_ROUNDS,
    free_steps: int = FREE_STEPS,
    step_limit: int = STEP_LIMIT,
) -> Run:
    """Two rounds of free learning, then path learning of up to ``rounds`` rounds.

    Path learning goes by 20 rounds, and ends early after 20 that never arrived: a robot that is
    trapped stays so.
    """
    trial = Trial(world, config, seed, agent)
    first, second = trial.free_learning(free_steps), trial.free_learning(free_steps)
    parts: list[Record] = []
    while rounds > 0:
        parts.append(trial.path_learning(min(rounds, HOPELESS_ROUNDS), step_limit))
        rounds -= HOPELESS_ROUNDS
        if not parts[-1].rounds["arrived"].any():
            break
    return Run(first, second, Record.concatenate(parts), trial)


def settled_runs(world: World, config: TrialConfig, first_seed: int = 1) -> Iterator[Run]:
    """Runs of seeds from ``first_seed`` up that settled, each on a path of its own."""
    habits: set[str] = set()
    for seed in range(first_seed, first_seed + 1000):
        candidate = run(world, config, seed)
        habit = measures.habit(candidate.paths)
        if habit is not None and habit not in habits:
            habits.add(habit)
            yield candidate


# --- jobs ---------------------------------------------------------------------------------------


def job(
    world: World,
    config: TrialConfig,
    seed: int,
    *,
    agent: str = "learner",
    rounds: int = PATH_ROUNDS,
    shortest: int | None = None,
    starts: Sequence[tuple[Pose, int]] = (),
) -> dict[str, Any]:
    """A run as plain values. agent: 'learner' or 'random'. starts: new, with shortest paths."""
    return {
        "world": world.to_json(),
        "config": config.to_dict(),
        "seed": seed,
        "agent": agent,
        "rounds": rounds,
        "shortest": shortest,
        "starts": [[list(pose), steps] for pose, steps in starts],
    }


def execute(job: Mapping[str, Any]) -> Measures:
    """Makes a run and measures it: claim id -> value, and ``control:`` claim id -> value."""
    world = World.from_json(job["world"])
    config = TrialConfig.from_dict(job["config"])
    agent = RandomAgent(job["seed"]) if job["agent"] == "random" else None
    made = run(world, config, job["seed"], agent=agent, rounds=job["rounds"])
    result = _measure_run(made, job["shortest"])
    if agent is None:
        result |= _measure_learner(made, job["shortest"])
    else:
        result |= _measure_random(made)
    if job["starts"]:
        assert made.trial.learner is not None
        learned, fresh = made.trial.learner, Learner(config.learner, job["seed"])
        result["new_starts"] = _rounds_from(world, config, learned, job["starts"])
        result["control:new_starts"] = _rounds_from(world, config, fresh, job["starts"])
    return result


def _measure_run(made: Run, shortest: int | None) -> Measures:
    first, second, paths = made.first, made.second, made.paths
    steps = paths.rounds["steps"]
    arrivals = [measures.first_arrival(r) or FREE_STEPS for r in (first, second)]
    settled = measures.settled_round(paths)
    unsettled = 3 + PATH_ROUNDS
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
        found = useful_round(world, config, learner, pose, shortest)
        needed.append(NEW_START_ROUNDS + 1 if found is None else len(found.rounds))
    return needed


def useful_round(
    world: World, config: TrialConfig, learner: Learner, start: Sequence[float], shortest: int
) -> Record | None:
    """Section VI-D: rounds from a new start until one arrives within 1.5 times the shortest path.

    With a copy of what was learned. None where none of 40 rounds does, or three in a row failed.
    """
    trial = Trial(world.with_start(start), config, learner.seed, copy.copy(learner))
    rounds: list[Record] = []
    while len(rounds) < NEW_START_ROUNDS:
        rounds.append(trial.path_learning(1, STEP_LIMIT))
        if rounds[-1].rounds["arrived"][0] and len(rounds[-1]) <= USEFUL * shortest:
            return Record.concatenate(rounds)
        if not any(record.rounds["arrived"][0] for record in rounds[-TRAPPED_ROUNDS:]) and (
            len(rounds) >= TRAPPED_ROUNDS
        ):
            return None
    return None


# --- what is drawn by chance, once and for all ----------------------------------------------------


def new_starts(world: World, config: TrialConfig, count: int = 8) -> list[tuple[Pose, int]]:
    """New start poses for the learning-ability test, each with the steps of its shortest path.

    Uniform over the places with 0.05 m of room, at least 1.5 m from target and start, on headings
    of the grid; the same for a world at every call. Raises InvalidValue for a world without room.
    """
    random = Random(0, "starts")
    robot = Robot(world, config.robot)
    starts: list[tuple[Pose, int]] = []
    for _ in range(1000 * count):
        x, y = random.uniform() * world.width, random.uniform() * world.height
        heading = random.index(config.heading_bins) * 360.0 / config.heading_bins
        if world.clearance(x, y, walls_count=True) < config.robot.radius + 0.05:
            continue
        if min(math.dist((x, y), world.target), math.dist((x, y), world.start[:2])) < 1.5:
            continue
        way = shortest_path(robot, (x, y, heading), config.goal_radius)
        if len(way) > 1:
            starts.append((Pose(x, y, heading), len(way) - 1))
            if len(starts) == count:
                return starts
    raise InvalidValue("world", f"{len(starts)} new starts", f"room for {count}, far from target")


def similar_world(index: int) -> World:
    """A random world like that of Fig. 2: eight obstacles of its sizes, elsewhere.

    They keep 0.35 m from each other, so that there is a way everywhere, and off start and target.
    """
    paper = World.load("paper")
    random = Random(index, "similar world")
    sizes = [_bounding_radius(obstacle) for obstacle in paper.obstacles]
    places: list[tuple[float, float, float]] = [
        (*paper.start[:2], 0.2),
        (*paper.target, 0.2),
    ]
    obstacles: list[Circle | Rectangle | Polygon] = []
    for obstacle, size in zip(paper.obstacles, sizes):
        while True:
            x, y = random.uniform() * paper.width, random.uniform() * paper.height
            if all(math.dist((x, y), p[:2]) >= size + p[2] + 0.35 for p in places):
                break
        places.append((x, y, size))
        obstacles.append(_moved(obstacle, x, y, random.uniform() * 360.0))
    return World(
        paper.width,
        paper.height,
        paper.start,
        paper.target,
        obstacles,
        name=f"similar {index}",
        description="Eight obstacles with the sizes of the paper's, placed at random.",
    )


def _centre(obstacle: Circle | Rectangle | Polygon) -> tuple[float, float]:
    if isinstance(obstacle, Polygon):
        x, y = np.mean(obstacle.corners, axis=0)
        return float(x), float(y)
    return obstacle.center


def _bounding_radius(obstacle: Circle | Rectangle | Polygon) -> float:
    if isinstance(obstacle, Circle):
        return obstacle.radius
    if isinstance(obstacle, Rectangle):
        return math.hypot(*obstacle.size) / 2
    return max(math.dist(corner, _centre(obstacle)) for corner in obstacle.corners)


def _moved(
    obstacle: Circle | Rectangle | Polygon, x: float, y: float, angle: float
) -> Circle | Rectangle | Polygon:
    if isinstance(obstacle, Circle):
        return Circle((x, y), obstacle.radius)
    if isinstance(obstacle, Rectangle):
        return Rectangle((x, y), obstacle.size, obstacle.angle + angle)
    from_x, from_y = _centre(obstacle)
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return Polygon(
        [
            (
                x + cos * (cx - from_x) - sin * (cy - from_y),
                y + sin * (cx - from_x) + cos * (cy - from_y),
            )
            for cx, cy in obstacle.corners
        ]
    )
