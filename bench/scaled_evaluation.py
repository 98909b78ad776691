"""Does StateEvaluation.scaled do for a small robot what the defaults do not?

An arena of 1.2 m with the obstacles of the world `paper` at 0.24 of their size, and a robot of
3.7 cm radius, 0.1 m/s, 0.2 s a step. Each seed: 5000 steps of free learning, 100 rounds of path
learning of at most 2000 steps (the shortest path has 68), then one more frozen: the preferred
motion of each situation, a random one where there is none, and nothing is learned.

Held good, as said before it was run: with `scaled` at least 95 of 100 seeds arrive in each of the
last 50 rounds, and at least 95 once frozen.

    python bench/scaled_evaluation.py [SEEDS]
"""

from __future__ import annotations

import json
import math
import sys

import numpy as np
from devlearn import Random, RobotDef, StateEvaluation, Trial, TrialConfig, World

ARENA, RADIUS, ROUNDS, LAST, LIMIT = 1.2, 0.037, 100, 50, 2000
DEFAULT, SCALED = StateEvaluation(), StateEvaluation.scaled(ARENA, RADIUS)
EVALUATIONS = {
    "the defaults": DEFAULT,
    "a2 for the arena alone": DEFAULT.replace(a2=SCALED.a2),
    "a5 for the robot alone": DEFAULT.replace(a5=SCALED.a5),
    "scaled": SCALED,
}


def desk() -> World:
    """The world `paper` on a desk of ARENA."""
    paper = json.loads(World.load("paper").to_json())
    scale = ARENA / 5.0

    def shrunk(value: object) -> object:
        if isinstance(value, dict):
            return {
                key: v if key in ("angle", "heading") else shrunk(v) for key, v in value.items()
            }
        if isinstance(value, list):
            return [shrunk(v) for v in value]
        return value * scale if isinstance(value, (int, float)) else value

    small = {key: shrunk(value) for key, value in paper.items()}
    return World.from_json(json.dumps({**small, "version": paper["version"], "name": "desk"}))


def trial(evaluation: StateEvaluation, seed: int) -> Trial:
    """The small robot on the desk."""
    config = TrialConfig(
        robot=RobotDef(radius=RADIUS, sample_time=0.2, sonar_range=0.5),
        evaluation=evaluation,
        cell_size=ARENA / 20,
        goal_radius=RADIUS,
    )
    return Trial(desk(), config, seed=seed)


def arrives_frozen(trial: Trial, seed: int) -> bool:
    """Whether what was learned leads from start to target, nothing more being learned."""
    random = Random(seed, "frozen")
    pose, target = trial.world.start, trial.world.target
    for _ in range(LIMIT):
        motion = trial.learner.best(trial.grid.situation(pose))
        pose, _ = trial.robot.step(pose, random.index(5) if motion is None else motion)
        if math.dist(pose[:2], target) <= RADIUS:
            return True
    return False


def one(evaluation: StateEvaluation, seed: int) -> tuple[bool, float, bool]:
    """Whether the last rounds all arrived, their median steps, and whether it arrives frozen."""
    desk_trial = trial(evaluation, seed)
    desk_trial.free_learning(5000)
    rounds = desk_trial.path_learning(rounds=ROUNDS, step_limit=LIMIT).rounds
    late = np.asarray(rounds["steps"][-LAST:], dtype=float)
    return (
        bool(rounds["arrived"][-LAST:].all()),
        float(np.median(late)),
        arrives_frozen(desk_trial, seed),
    )


def main() -> None:
    """Measures."""
    seeds = range(101, 101 + (int(sys.argv[1]) if len(sys.argv) > 1 else 100))
    for name, evaluation in EVALUATIONS.items():
        arrived, steps, frozen = zip(*(one(evaluation, seed) for seed in seeds))
        low, median, high = np.percentile(steps, [10, 50, 90])
        print(
            f"{name:24} arrive in each late round {sum(arrived):3} of {len(seeds)}, "
            f"frozen {sum(frozen):3}; steps {median:.0f} ({low:.0f} to {high:.0f})",
            flush=True,
        )


if __name__ == "__main__":
    main()
