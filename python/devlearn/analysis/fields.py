"""Fields over the arena: the state evaluation, and what a learner prefers."""

from __future__ import annotations

import math
from typing import NamedTuple, Union

import numpy as np
import numpy.typing as npt

from .._core import (
    AdaptiveLearner,
    Learner,
    SituationGrid,
    StateEvaluation,
    Trial,
    TrialConfig,
    World,
)
from ..errors import InvalidValue
from ..record import Record

Source = Union[World, Record, Trial]  # of a world, and of more but for the first


def world_of(source: Source) -> World:
    """The world itself, or that of a record or a trial."""
    return source if isinstance(source, World) else source.world


def config_of(source: Source, config: TrialConfig | None = None) -> TrialConfig:
    """The configuration given, else a record's or a trial's own, else the default."""
    if config is not None:
        return config
    return TrialConfig() if isinstance(source, World) else source.config


def grid_of(
    source: Source, grid: SituationGrid | None = None, config: TrialConfig | None = None
) -> SituationGrid:
    """The grid given, else the one that a trial of this source and configuration learns on.

    Raises InvalidValue for a world alone, which knows none.
    """
    if grid is not None:
        return grid
    _refuse_own(source, "situations", "grid=, the one that they are of")
    if config is None and isinstance(source, World):
        raise InvalidValue(
            "grid", "none, and a World alone, which does not say on which grid was learned",
            "the Trial or its Record instead of the World, or grid=, or config=",
        )  # fmt: skip
    if config is None and isinstance(source, Trial):
        return source.grid
    return Trial(world_of(source), config_of(source, config)).grid


def _refuse_own(source: Source, part: str, allowed: str) -> None:
    """Refuse a part of one's own, of which nothing is known here."""
    if isinstance(source, Trial) and getattr(source, part) is not None:
        raise InvalidValue(part, "the trial's own", allowed)
    if isinstance(source, Record) and part in source.provenance:
        raise InvalidValue(part, source.provenance[part], allowed)


class SefField(NamedTuple):
    """SEF (Eq. 6) at the points of a mesh over the arena."""

    x: npt.NDArray[np.float64]
    """Columns of the mesh [m], from 0 to the arena's width: (n,)."""
    y: npt.NDArray[np.float64]
    """Rows [m], from 0 to its height: (m,)."""
    sef: npt.NDArray[np.float64]
    """SEF, no unit: (m, n)."""
    floor: float
    """Where a scale may end: below it are but the pits at the obstacles."""


def sef_field(
    source: Source,
    evaluation: StateEvaluation | None = None,
    walls_count: bool | None = None,
    points: int = 301,
    floor: float | None = None,
) -> SefField:
    """SEF over the arena, ``points`` (at least 2) along its longer side.

    ``evaluation`` and ``walls_count`` are a record's or a trial's own, else the defaults. SEF falls
    steeply at the obstacles, which would take most of a scale: ``floor`` is by default half of the
    range of the target's term below that term's least value, and never below the least SEF. Raises
    InvalidValue.
    """
    if points < 2:
        raise InvalidValue("points", points, "at least 2")
    if evaluation is None:
        _refuse_own(source, "evaluation", "evaluation=, a StateEvaluation to draw")
    world, config = world_of(source), config_of(source)
    evaluate = evaluation if evaluation is not None else config.evaluation
    walls = config.walls_count if walls_count is None else walls_count
    step = max(world.width, world.height) / (points - 1)
    x, y = (
        np.linspace(start, start + side, max(2, round(side / step) + 1))
        for start, side in zip(world.origin, (world.width, world.height))
    )
    xs, ys = np.meshgrid(x, y)
    goal = np.hypot(xs - world.target[0], ys - world.target[1])
    sef = np.asarray(evaluate(goal, world.clearance(xs, ys, walls_count=walls)))
    if floor is None:
        term = np.asarray(evaluate(goal, np.full_like(goal, np.inf)))
        floor = float(term.min() - 0.5 * (term.max() - term.min()))
        floor = max(floor, float(sef.min()))
    return SefField(x, y, sef, floor)


class PreferenceField(NamedTuple):
    """What a learner prefers, cell by cell; arrays of one value a cell experienced."""

    x: npt.NDArray[np.float64]
    """Centre of the cell [m]."""
    y: npt.NDArray[np.float64]
    u: npt.NDArray[np.float64]
    """Mean direction of the preferred motions; its length in [0, 1] is their concentration."""
    v: npt.NDArray[np.float64]
    times: npt.NDArray[np.int64]
    """How often the preferred motions were learned; 0 where no mapping is effective."""


def preference_field(
    world: Source,
    learner: Learner | AdaptiveLearner | None = None,
    *,
    grid: SituationGrid | None = None,
    config: TrialConfig | None = None,
) -> PreferenceField:
    """Where a learner prefers to go, cell by cell; ``plot_preferences`` draws it.

    In each situation experienced the best motion (``learner.best``: the effective one of the
    highest orientation, or the tried one of the least expected loss) gives the direction heading +
    steering angle. A cell's arrow is the mean of these unit vectors over its headings, each
    weighted by how often that motion was learned: of length 1 where all agree, short where the
    headings lead different ways.

    ``world`` is best the Trial, whose learner is meant where none is given, or its Record: both
    know the grid that was learned on and the robot's motions. With a World alone ``config`` or
    ``grid`` is needed; the motions are those of ``config``, else the paper's. Raises InvalidValue.
    """
    if learner is None and isinstance(world, Trial):
        learner = world.learner
    if learner is None:
        raise InvalidValue(
            "learner", "none", "a Learner or AdaptiveLearner, or a Trial whose agent is one"
        )
    grid = grid_of(world, grid, config)
    angles = config_of(world, config).robot.steering_angles
    motions = learner.config.motion_count
    if motions != len(angles):
        raise InvalidValue(
            "learner.config.motion_count", motions, f"{len(angles)}, one of each steering angle"
        )
    cells: dict[tuple[float, float], list[float]] = {}
    for situation in learner.situations():
        if situation >= grid.count:
            raise InvalidValue("situation", situation, f"of the grid: below {grid.count}")
        x, y, heading = grid.centre(situation)
        cell = cells.setdefault((x, y), [0.0, 0.0, 0])
        motion = learner.best(situation)
        if motion is None:
            continue
        times = _times_learned(learner, situation, motion)
        direction = math.radians(heading + angles[motion])
        cell[0] += times * math.cos(direction)
        cell[1] += times * math.sin(direction)
        cell[2] += times
    sums = np.array([[*at, *cell] for at, cell in cells.items()], dtype=float).reshape(-1, 5)
    total = np.maximum(sums[:, 4], 1.0)
    return PreferenceField(
        sums[:, 0],
        sums[:, 1],
        sums[:, 2] / total,
        sums[:, 3] / total,
        sums[:, 4].astype(np.int64),
    )


def _times_learned(learner: Learner | AdaptiveLearner, situation: int, motion: int) -> int:
    if isinstance(learner, AdaptiveLearner):
        return learner.situation(situation).times[motion]
    memory = learner.situation(situation)
    return memory.times_learned[memory.effective.index(motion)]
