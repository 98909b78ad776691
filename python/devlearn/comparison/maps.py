"""How far what was learned from one start carries: from every start there is."""

from __future__ import annotations

import copy
import functools
import json
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .._core import Robot, Trial, TrialConfig, World
from ..analysis.ways import WayField
from ..experiments.measures import Run

REACH = f"{__name__}:reach"
"""The measure, as a sweep's ``measures`` names it."""
MOST = 5
"""A start is given up after so many times its shortest path."""


def reach(run: Run) -> dict[str, list[int | None]]:
    """A measure: the steps to the target from every situation, with a copy of what was learned.

    By situation: ``shortest``, the least steps from the middle of its cell and heading, None where
    the body does not fit or there is no way; ``steps``, what it took, None where it did not arrive
    within 5 times that.
    """
    shortest = _shortest_from_everywhere(run.trial)
    steps = [None if least is None else _steps_from(run.trial, i, least)
             for i, least in enumerate(shortest)]  # fmt: skip
    return {"shortest": shortest, "steps": steps}


def _steps_from(trial: Trial, situation: int, least: int) -> int | None:
    learned = copy.deepcopy(trial.agent if trial.learner is None else trial.learner)
    world = trial.world.with_start(trial.grid.centre(situation))
    fresh = Trial(world, trial.config, trial.seed, learned)
    _, steps, arrived, _ = fresh.path_learning(1, MOST * least, rounds_only=True).rounds[0]
    return int(steps) if arrived else None


def _shortest_from_everywhere(trial: Trial) -> list[int | None]:
    shared = trial.config.replace(learner=TrialConfig().learner)
    steps = _ways(trial.world.to_json(), json.dumps(shared.to_dict()))
    return [int(least) if 0 < least < math.inf else None for least in steps]


@functools.lru_cache(maxsize=8)
def _ways(world_json: str, config_json: str) -> npt.NDArray[np.float64]:
    """Least steps by situation; the same for all that learn in a world."""
    world, config = World.from_json(world_json), TrialConfig.from_dict(json.loads(config_json))
    grid = Trial(world, config).grid
    x, y, heading = np.array([grid.centre(i) for i in range(grid.count)]).T
    fits = np.asarray(world.clearance(x, y, walls_count=True)) > config.robot.radius
    ways = WayField(
        Robot(world, config.robot), headings=config.heading_bins, goal_radius=config.goal_radius
    )
    return np.where(fits, ways.steps(x, y, heading), np.inf)


class Map(NamedTuple):
    """What came of all starts of a world, over the runs of some seeds."""

    ratio: npt.NDArray[np.float64]
    """Steps over the shortest, the median of a cell's headings and runs, (rows, columns): inf where
    half do not arrive, NaN: no start."""
    arrived: list[float]
    """Share of the starts from which it arrives, a run each."""


def map_of(values: Sequence[str], trial: Trial) -> Map:
    """That of the values of the measure in runs like the trial, as the results hold them."""
    grid = trial.grid
    ratios, arrived = [], []
    for value in map(json.loads, values):
        least, steps = (
            np.array([math.nan if v is None else v for v in value[name]])
            for name in ("shortest", "steps")
        )
        ratio = np.where(np.isnan(steps), math.inf, steps) / least
        ratios.append(ratio.reshape(grid.rows, grid.columns, grid.headings))
        arrived.append(float(np.isfinite(ratio).sum() / (~np.isnan(least)).sum()))
    every = np.concatenate(ratios, axis=2)
    cells = np.full(every.shape[:2], math.nan)
    starts = ~np.isnan(every).all(axis=2)
    cells[starts] = np.nanmedian(every[starts], axis=1)
    return Map(cells, arrived)
