"""TaskEnv: a task of devlearn.tasks as an environment."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from .. import tasks
from .._calls import shown
from ..errors import InvalidValue
from .others import is_whole
from .view import require_seed


class TaskEnv(gymnasium.Env[Any, int]):
    """A task of ``devlearn.tasks``, such as ``devlearn/Balance-v0``.

    An action is a motion. An observation is the situation's id; of a task that senses, a dict of
    ``situation`` and ``senses``, its numbers in float64. The reward is the outcome's, -cost. An
    episode is terminated where the task ends it, well or not, and never truncated here. ``info``
    has ``sef`` and ``estimate``, ``action_mask``, int8, where not every motion is allowed, and
    after a step ``smf``, ``cost``, ``collided``, ``event`` and ``succeeded``.

    Where an episode has ended, nothing is observed any more: situation and estimate are the
    outcome's, the senses those before the last step.

    Parameters
    ----------
    task : Task or str
        A task, which is shared, or the name of a class in devlearn.tasks.
    config : optional
        Its settings, where it is made by name; None: the defaults.

    Raises InvalidValue.
    """

    def __init__(self, task: tasks.Task | str, config: Any = None) -> None:
        self._task = _made(task, config)
        self._task.begin(0)
        self._seen = self._task.observation()
        self._under_way = False
        situations: Any = spaces.Discrete(self._task.situation_count)
        if self._seen.senses is not None:
            most = np.finfo(np.float64).max
            box = spaces.Box(-most, most, self._seen.senses.shape, dtype=np.float64)
            situations = spaces.Dict({"situation": situations, "senses": box})
        self.observation_space = situations
        self.action_space: Any = spaces.Discrete(self._task.motion_count)

    @property
    def task(self) -> tasks.Task:
        """What it is an environment of."""
        return self._task

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begins an episode: the task's of this seed, in [0, 2^64 - 1].

        None: of one drawn from the environment's generator. options: there are none. Raises
        InvalidValue.
        """
        if seed is not None:
            seed = require_seed(seed)
        super().reset(seed=seed)
        if options:
            raise InvalidValue("options", shown(options), "none")
        self._task.begin(int(self.np_random.integers(2**63)) if seed is None else seed)
        self._seen = self._task.observation()
        self._under_way = True
        return self._observed(self._seen.situation), self._told()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Makes a motion.

        Raises InvalidValue for an action that there is not, and where no episode is under way.
        """
        if not self._under_way:
            raise InvalidValue("step", "called where no episode is under way", "reset first")
        if not is_whole(action):
            raise InvalidValue("action", shown(action), f"one of {self.action_space}")
        outcome = self._task.step(int(action))
        if outcome.arrived:
            self._under_way = False
        else:
            self._seen = self._task.observation()
        info = {
            **self._told(),
            "sef": outcome.sef,
            "estimate": outcome.estimate,
            "smf": outcome.smf,
            "cost": outcome.cost,
            "collided": outcome.collided,
            "event": outcome.event,
            "succeeded": outcome.arrived and self._task.succeeded,
        }
        observed = self._observed(outcome.situation)
        return observed, outcome.reward, outcome.arrived, False, info

    def _observed(self, situation: int) -> Any:
        if self._seen.senses is None:
            return np.int64(situation)
        return {"situation": np.int64(situation), "senses": self._seen.senses}

    def _told(self) -> dict[str, Any]:
        told: dict[str, Any] = {"sef": self._seen.sef, "estimate": self._seen.estimate}
        if self._seen.allowed is not None:
            told["action_mask"] = np.asarray(self._seen.allowed, dtype=np.int8)
        return told


def _made(task: object, config: Any) -> tasks.Task:
    if isinstance(task, tasks.Task):
        if config is not None:
            raise InvalidValue("config", shown(config), "none, where a task is given")
        return task
    named = getattr(tasks, task, None) if isinstance(task, str) else None
    if task not in tasks.__all__ or not hasattr(named, "Config"):
        names = [name for name in tasks.__all__ if hasattr(getattr(tasks, name), "Config")]
        raise InvalidValue("task", shown(task), "a Task, or one of " + ", ".join(names))
    made: tasks.Task = named(config)  # type: ignore[misc]
    return made
