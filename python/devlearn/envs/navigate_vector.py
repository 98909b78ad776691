"""NavigateVector: many robots, stepped by one call."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from .._calls import shown
from .._core import TrialConfig
from ..errors import InvalidValue, WrongType
from .navigate import Navigate, known_render_mode, picture_of
from .view import Place, View, require_seed

if TYPE_CHECKING:
    from ..plots.picture import Picture


class NavigateVector(VectorEnv[Any, Any, Any]):
    """Many of ``devlearn/Navigate-v0``, stepped together by one call of C++ without the GIL.

    Row i is, to the bit, what Navigate gives that was reset with seed s + i, where this was reset
    with s. Where an episode has ended, the next begins by itself: by the next step, whose action
    is ignored and whose reward is 0 (``"next_step"``); by the step that ended it, which tells the
    last observation and info as ``final_obs`` and ``final_info`` (``"same_step"``); or, not by
    itself, by ``reset(options={"reset_mask": mask})`` (``"disabled"``).

    Parameters: num_envs, in [1, 2^20]; autoreset_mode, one of these or Gymnasium's AutoresetMode;
    copy, whether what is returned stays as it is when the next step is made: without, arrays of
    observations are views that each step changes; render_mode, ``"rgb_array"`` or None; all others
    as Navigate's. Raises InvalidValue.
    """

    def __init__(
        self,
        num_envs: int = 1,
        world: Place = "paper",
        config: TrialConfig | None = None,
        *,
        actions: str = "steering",
        reward: str = "shaped",
        observe: Sequence[str] | None = None,
        flat: bool = False,
        step_limit: int = 10000,
        random_starts: bool = False,
        autoreset_mode: str | AutoresetMode = "next_step",
        copy: bool = True,
        render_mode: str | None = None,
    ) -> None:
        mode = _known_mode(autoreset_mode)
        if not isinstance(copy, bool):
            raise WrongType("copy", shown(copy), "True or False")
        self._view = View(
            num_envs,
            world=world,
            config=config,
            actions=actions,
            reward=reward,
            observe=observe,
            flat=flat,
            step_limit=step_limit,
            random_starts=random_starts,
            autoreset=mode.name.lower(),
        )
        self.num_envs = num_envs = len(self._view.batch)
        self.metadata = {
            "render_modes": ["rgb_array"],
            "render_fps": Navigate.metadata["render_fps"],
            "autoreset_mode": mode,
        }
        self.render_mode = known_render_mode(render_mode, self.metadata["render_modes"])
        self.single_observation_space = self._view.observation_space
        self.single_action_space = self._view.action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._copy = copy
        self._seeded = False
        self._picture: Picture | None = None

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Begins an episode in every environment.

        seed: s for seeds s, s + 1, ..., or one an environment (None: its draws go on; at first from
        a seed drawn by chance). options: ``reset_mask``, a bool an environment, which of them are
        reset; ``pose``, where robots begin [m, m, degrees]: three numbers, or (num_envs, 3). Raises
        InvalidValue.
        """
        if isinstance(seed, (list, tuple, np.ndarray)):
            if len(seed) != self.num_envs:
                wanted = f"{self.num_envs}, one an environment"
                raise InvalidValue("seed", f"{len(seed)} of them", wanted)
            seeds = [self._drawn() if one is None else require_seed(one) for one in seed]
        else:
            if seed is not None:
                seed = require_seed(seed, self.num_envs)
            super().reset(seed=seed)
            first = self._drawn() if seed is None else seed
            seeds = [None if first is None else first + i for i in range(self.num_envs)]
        self._view.reset(seeds, options, ["reset_mask", "pose"])
        self._seeded = True
        return self._view.observations(self._copy), self._view.infos(stepped=False)

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Makes a motion in every environment, or drives at wheel speeds, a row each.

        Raises InvalidValue for an action that there is not and, where autoreset is disabled, where
        an episode has ended; then nothing was stepped.
        """
        view = self._view
        view.step(actions)
        return (
            view.observations(self._copy),
            view.reward.copy(),
            view.terminated.copy(),
            view.truncated.copy(),
            view.infos(stepped=True),
        )

    # A seed by chance where there was none yet; None where draws go on.
    def _drawn(self) -> int | None:
        return None if self._seeded else int(self.np_random.integers(2**63))

    def render(self) -> tuple[npt.NDArray[np.uint8], ...] | None:
        """A picture of each environment, as Navigate draws it, without the way."""
        if self.render_mode is None:
            return None
        if self._picture is None:
            self._picture = picture_of(self._view)
        batch, frame = self._view.batch, self._picture.frame
        return tuple(frame(pose, time=time) for pose, time in zip(batch.poses(), batch.times()))


def _known_mode(given: str | AutoresetMode) -> AutoresetMode:
    if isinstance(given, AutoresetMode):
        return given
    for mode in AutoresetMode:
        if given == mode.name.lower():
            return mode
    known = " or ".join(repr(mode.name.lower()) for mode in AutoresetMode)
    raise InvalidValue("autoreset_mode", shown(given), f"{known}, or an AutoresetMode")
