"""A Batch as Gymnasium sees it: spaces, observations, infos, seeds."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from .._calls import shown
from .._core import Batch, BatchConfig, BatchRows, TrialConfig, World
from ..errors import InvalidValue, WrongType

Array = npt.NDArray[Any]
Place = Union[World, str, "os.PathLike[str]"]

_OBSERVED = ("pose", "situation", "sonars", "goal_distance")
_LAST_SEED = 2**64 - 1


class View:
    """What Navigate and NavigateVector are made of.

    Parameters: count of environments; the others as Navigate's; autoreset, a BatchConfig's.
    """

    def __init__(
        self,
        count: int,
        *,
        world: Place,
        config: TrialConfig | None,
        actions: str,
        reward: str,
        observe: Sequence[str] | None,
        flat: bool,
        step_limit: int,
        random_starts: bool,
        autoreset: str,
    ) -> None:
        config = TrialConfig() if config is None else config
        if not isinstance(config, TrialConfig):
            raise WrongType("config", shown(config), "a TrialConfig or None")
        if not isinstance(flat, bool):
            raise WrongType("flat", shown(flat), "True or False")
        names = _known(observe, config)
        self.action_space = _choice(actions, config)
        self.flat = flat
        self.batch = Batch(
            world if isinstance(world, World) else World.load(world),
            count,
            config,
            BatchConfig(
                reward=reward,
                step_limit=step_limit,
                autoreset=autoreset,
                sonars="sonars" in names,
                random_starts=random_starts,
            ),
        )
        by_wheels = isinstance(self.action_space, spaces.Box)
        self.step = self.batch.drive_wheels if by_wheels else self.batch.step
        """A step by actions, one an environment."""
        self.observation_space = _space(self.batch, names, flat)
        # Arrays that show what is the case now.
        self._now = _columns(self.batch.rows, names)
        self._final = _columns(self.batch.final_rows, names) if autoreset == "same_step" else {}
        self._told = _told(self.batch.rows, masks=not by_wheels)
        self._told_finally = _told(self.batch.final_rows, masks=not by_wheels)
        self._came_of_it = {name: getattr(self.batch, name) for name in ("smf", "cost", "collided")}
        self.reward, self.terminated = self.batch.reward, self.batch.terminated
        self.truncated, self.begun = self.batch.truncated, self.batch.begun
        self._everyone = np.ones(count, dtype=np.bool_)
        self._everyone.flags.writeable = False

    # --- actions ----------------------------------------------------------------------------------

    def action(self, given: object) -> Array:
        """One of the action space. Raises InvalidValue for what is none."""
        space = self.action_space
        try:
            row = np.asarray(given)
        except ValueError:  # of rows of several lengths
            row = np.array(None)
        wheels = isinstance(space, spaces.Box)
        if row.dtype.kind not in ("iuf" if wheels else "iu") or not space.contains(row):
            last, most = self.batch.rows.allowed.shape[1] - 1, self.batch.config.robot.speed
            motion, speeds = (
                f"a whole number in [0, {last}]",
                f"two numbers in [-{most}, {most}] m/s",
            )
            raise InvalidValue("action", shown(given), speeds if wheels else motion)
        return row

    # --- observations -----------------------------------------------------------------------------

    def observations(self, copy: bool = True) -> Any:
        """A row an environment, of what is sensed now."""
        return self._seen(self._now, copy)

    def _seen(self, columns: Mapping[str, Array], copy: bool) -> Any:
        if self.flat:
            rows = [column.reshape(len(column), -1) for column in columns.values()]
            return np.concatenate(rows, axis=1, dtype=np.float64)
        return {name: column.copy() if copy else column for name, column in columns.items()}

    def row(self, i: int, finally_: bool = False) -> Any:
        """A copy of one row, of what is sensed now or was where the last episode ended."""
        columns = self._final if finally_ else self._now
        if self.flat:
            return np.concatenate([np.atleast_1d(c[i]) for c in columns.values()], dtype=np.float64)
        return {name: column[i].copy() for name, column in columns.items()}

    # --- infos ------------------------------------------------------------------------------------

    def info(self) -> dict[str, Any]:
        """That of the first environment."""
        told = {**self._told, **({} if self.begun[0] else self._came_of_it)}
        # Numbers are Python's: Gymnasium's vectors make arrays of objects of numpy's bools.
        return {n: c[0].copy() if c.ndim > 1 else c[0].item() for n, c in told.items()}

    def infos(self, stepped: bool) -> dict[str, Any]:
        """Those of all, as Gymnasium's vectors have them: beside each array one of who has it."""
        infos: dict[str, Any] = _of(self._everyone, self._told)
        if not stepped:
            return infos
        over = (self.terminated | self.truncated) & bool(self._final)
        still = self.begun | over  # of whom there is no outcome, or only a final one
        if not still.any():
            infos.update(_of(self._everyone, self._came_of_it))
        elif not still.all():
            infos.update(_of(~still, self._came_of_it))
        if over.any():
            final = np.full(len(over), None, dtype=object)
            for i in np.flatnonzero(over).tolist():
                final[i] = self.row(i, finally_=True)
            infos.update(final_obs=final, _final_obs=over, _final_info=over)
            infos["final_info"] = _of(over, {**self._told_finally, **self._came_of_it})
        return infos

    # --- resets -----------------------------------------------------------------------------------

    def reset(
        self,
        seeds: Sequence[int | None] | None,
        options: Mapping[str, Any] | None,
        known: Sequence[str],
    ) -> None:
        """Begins episodes: of all environments or of options' reset_mask.

        seeds: one an environment, None where its draws go on.
        """
        options = {} if options is None else options
        if not isinstance(options, Mapping) or not set(options) <= set(known):
            raise InvalidValue(
                "options", shown(options), f"a dict of {' and '.join(known)}, or {{}}"
            )
        count = len(self.batch)
        which = options.get("reset_mask")
        poses = options.get("pose")
        if poses is not None:
            poses = _poses(poses, count)
        if which is not None:
            which = _mask(which, count)
        if seeds is None:
            self.batch.reset(which=which, poses=poses)
            return
        seeded = np.array([seed is not None for seed in seeds])
        values = np.array([seed or 0 for seed in seeds], dtype=np.uint64)
        reset = np.ones(count, dtype=np.bool_) if which is None else which
        if (reset & ~seeded).any():  # of all, so that a pose of any is refused before any begins
            self.batch.reset(which=reset, poses=poses)
        if (reset & seeded).any():
            self.batch.reset(values, reset & seeded, poses)


def require_seed(seed: object, count: int = 1) -> int:
    """A seed from which ``count`` environments have one each, by counting up. Raises WrongType."""
    most = _LAST_SEED - (count - 1)
    try:
        value = -1 if isinstance(seed, bool) else operator.index(seed)  # type: ignore[arg-type]
    except TypeError:
        value = -1
    if not 0 <= value <= most:
        raise InvalidValue("seed", shown(seed), f"None, or a whole number in [0, {most}]")
    return value


def _choice(actions: str, config: TrialConfig) -> spaces.Space[Any]:
    robot = config.robot
    if actions == "steering":
        return spaces.Discrete(len(robot.steering_angles))
    if actions != "wheels":
        raise InvalidValue("actions", shown(actions), "'steering' or 'wheels'")
    if robot.safety_margin is not None:
        wanted = "None with actions='wheels': a safety layer rules out motions, not wheel speeds"
        raise InvalidValue("RobotDef.safety_margin", shown(robot.safety_margin), wanted)
    return spaces.Box(-robot.speed, robot.speed, (2,), dtype=np.float64)


def _known(observe: Sequence[str] | None, config: TrialConfig) -> tuple[str, ...]:
    there = tuple(n for n in _OBSERVED if n != "sonars" or config.robot.sonar_count)
    if observe is None:
        return there[:-1]
    names = () if isinstance(observe, str) or not isinstance(observe, Sequence) else tuple(observe)
    if not names or any(name not in there or names.count(name) > 1 for name in names):
        raise InvalidValue("observe", shown(observe), f"None, or some of {', '.join(there)}")
    return names


def _space(batch: Batch, names: Sequence[str], flat: bool) -> spaces.Space[Any]:
    world, robot, noise = batch.world, batch.config.robot, batch.config.noise
    x, y = world.origin
    low, high = [x, y, 0.0], [x + world.width, y + world.height, 360.0]
    farthest = math.hypot(world.width, world.height)
    if noise.odometry_turn or noise.odometry_drive:  # estimates may drift out of the arena
        low, high, farthest = [-np.inf, -np.inf, 0.0], [np.inf, np.inf, 360.0], np.inf
    kinds: dict[str, spaces.Space[Any]] = {
        "pose": spaces.Box(np.array(low), np.array(high), dtype=np.float64),
        "situation": spaces.Discrete(batch.grid.count),
        "sonars": spaces.Box(0.0, robot.sonar_range, (robot.sonar_count,), dtype=np.float64),
        "goal_distance": spaces.Box(0.0, farthest, dtype=np.float64),
    }
    if not flat:
        return spaces.Dict({name: kinds[name] for name in names})
    kinds["situation"] = spaces.Box(0.0, batch.grid.count - 1.0, (1,), dtype=np.float64)
    boxes: Any = [kinds[name] for name in names]
    return spaces.Box(
        np.concatenate([box.low for box in boxes]),
        np.concatenate([box.high for box in boxes]),
        dtype=np.float64,
    )


def _columns(rows: BatchRows, names: Sequence[str]) -> dict[str, Array]:
    columns = {
        "pose": rows.pose,
        "situation": rows.situation,
        "sonars": rows.echoes,
        "goal_distance": rows.goal_distance[:, None],
    }
    return {name: columns[name] for name in names}


def _told(rows: BatchRows, masks: bool) -> dict[str, Array]:
    told = {
        "goal_distance": rows.goal_distance,
        "clearance": rows.clearance,
        "estimate": rows.estimate,
    }
    # As Discrete.sample takes it.
    return {"action_mask": rows.allowed.view(np.int8), **told} if masks else told


def _of(who: Array, columns: Mapping[str, Array]) -> dict[str, Array]:
    infos = {}
    everyone = who.all()
    for name, column in columns.items():
        infos[name], infos[f"_{name}"] = column.copy(), who
        if not everyone:
            infos[name][~who] = 0
    return infos


def _poses(given: object, count: int) -> Array:
    try:
        poses = np.array(given, dtype=np.float64)
        return np.broadcast_to(poses, (count, 3)) if poses.ndim <= 2 else poses
    except (TypeError, ValueError):
        each = "x, y, heading [m, m, degrees]"
        wanted = each if count == 1 else f"{each}, of all or one for each of {count} environments"
        raise InvalidValue("options['pose']", shown(given), wanted) from None


def _mask(given: object, count: int) -> Array:
    mask = np.asarray(given)
    if mask.dtype != np.bool_ or mask.shape != (count,) or not mask.any():
        wanted = f"{count} bools, one an environment, some of them True"
        raise InvalidValue("options['reset_mask']", shown(given), wanted)
    return mask
