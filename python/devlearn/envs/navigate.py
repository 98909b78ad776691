"""Navigate: one robot that finds its way."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt

from .._calls import shown
from .._core import TrialConfig
from ..errors import InvalidValue
from .view import Place, View, require_seed

if TYPE_CHECKING:
    from ..plots.picture import Picture, Window

_FRAMES_A_SECOND = 10


class Navigate(gymnasium.Env[Any, Any]):
    """The paper's robot in any world, on its way to the target: ``devlearn/Navigate-v0``.

    An action is a motion, an index of ``config.robot.steering_angles`` by which the robot turns
    before it drives; with ``actions="wheels"`` it is the speeds of the left and right wheel [m/s],
    forwards or backwards, each at most ``config.robot.speed``, held for a sample time
    (``Robot.drive_wheels``). An episode begins at the world's start, is terminated where the robot
    arrives (d_g <= goal_radius), and truncated after ``step_limit`` steps without that.

    An observation is a dict of

    - ``pose``: x, y, heading [m, m, degrees], float64
    - ``situation``: the id of the situation on config's grid
    - ``sonars``: echo distances from the body's rim [m], float64

    or of those that ``observe`` names, ``goal_distance`` [m], an array of one, among them; with
    ``flat`` their numbers in a row, float64. ``info`` has ``action_mask``, int8, 1 for the motions
    that the robot's safety layer allows (the others are made, too, where they are chosen; there is
    none of wheel speeds);
    ``goal_distance``, ``clearance`` [m], ``estimate`` (the cost to go at the least, in steps); and
    after a step ``smf``, ``cost`` and ``collided``.

    Parameters
    ----------
    world : World, str or path
        A world, the name of one that ships, or its file.
    config : TrialConfig
        The robot, its situations and its evaluation. None: the paper's.
    actions : str
        ``"steering"``, a ``Discrete``, or ``"wheels"``, a ``Box``, for a robot without a safety
        layer.
    reward : str
        ``"shaped"``: -cost and by how much the estimate of the cost to go fell, so that a straight
        step towards the target is worth about 0 and others less (potential-based, Ng et al. 1999;
        without discount). ``"cost"``: -1, and touch_cost less where the robot touched something.
        ``"smf"``: what the paper's learner learns from (Eq. 8). ``"sparse"``: 1 at the target.
    observe : sequence of str
        What is observed, in this order. None: pose, situation and, where there are any, sonars.
    flat : bool
        Whether observations are one array.
    step_limit : int
        In [1, 2^40].
    random_starts : bool
        Whether an episode begins at a pose drawn, by the environment's seed, among those that may
        get to the target, in place of the world's start.
    render_mode : str
        ``"rgb_array"``, ``"human"`` or None. Pictures need the extra ``plots``.

    Raises InvalidValue.
    """

    metadata: ClassVar[dict[str, Any]] = {  # type: ignore[misc]
        "render_modes": ["rgb_array", "human"],
        "render_fps": _FRAMES_A_SECOND,
    }
    """What Gymnasium asks of rendering."""

    def __init__(
        self,
        world: Place = "paper",
        config: TrialConfig | None = None,
        *,
        actions: str = "steering",
        reward: str = "shaped",
        observe: Sequence[str] | None = None,
        flat: bool = False,
        step_limit: int = 10000,
        random_starts: bool = False,
        render_mode: str | None = None,
    ) -> None:
        self._view = View(
            1,
            world=world,
            config=config,
            actions=actions,
            reward=reward,
            observe=observe,
            flat=flat,
            step_limit=step_limit,
            random_starts=random_starts,
            autoreset="disabled",
        )
        self.observation_space = self._view.observation_space
        self.action_space = self._view.action_space
        self.render_mode = known_render_mode(render_mode, self.metadata["render_modes"])
        self._seeded = False
        self._way: list[tuple[float, float]] = []
        self._picture: Picture | None = None
        self._window: Window | None = None
        self._told_of_display = False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begins an episode.

        seed, in [0, 2^64 - 1]: of the environment's draws (None: they go on; at first from a seed
        drawn by chance). options: ``pose``, where the robot begins [m, m, degrees]. Raises
        InvalidValue.
        """
        if seed is not None:
            seed = require_seed(seed)
        super().reset(seed=seed)
        if seed is None and not self._seeded:
            seed = int(self.np_random.integers(2**63))
        self._view.reset(None if seed is None else [seed], options, ["pose"])
        self._seeded = True
        self._way = []
        self._watch()
        return self._view.row(0), self._view.info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Makes a motion, or drives at wheel speeds.

        Raises InvalidValue for an action that there is not, or where the episode has ended.
        """
        view = self._view
        view.step(view.action(action)[None])
        self._watch()
        reward, over, cut = view.reward[0], view.terminated[0], view.truncated[0]
        return view.row(0), float(reward), bool(over), bool(cut), view.info()

    def action_masks(self) -> npt.NDArray[np.bool_]:
        """Which motions the robot's safety layer allows now, as sb3-contrib asks for it.

        Raises InvalidValue where actions are wheel speeds.
        """
        if isinstance(self.action_space, gymnasium.spaces.Box):
            wanted = "'steering': masks are of motions"
            raise InvalidValue("actions", "'wheels'", wanted)
        allowed: npt.NDArray[np.bool_] = self._view.batch.rows.allowed[0]
        return allowed.copy()

    # --- pictures ---------------------------------------------------------------------------------

    def render(self) -> Any:
        """The robot in its world, and the way of the episode so far.

        An array of (height, width, 3), uint8, where ``render_mode`` is ``"rgb_array"``.
        """
        if self.render_mode == "rgb_array":
            return self._frame()
        return None

    def close(self) -> None:
        """Closes the window, if there is one."""
        if self._window is not None:
            self._window.close()
            self._window = None

    # After each step: the way goes on, and who watches is shown it.
    def _watch(self) -> None:
        if self.render_mode is None:
            return
        x, y, _ = self._view.batch.poses()[0]
        self._way.append((x, y))
        if self.render_mode == "human":
            self._show()

    def _frame(self) -> npt.NDArray[np.uint8]:
        if self._picture is None:
            self._picture = picture_of(self._view)
        batch = self._view.batch
        return self._picture.frame(batch.poses()[0], self._way, batch.times()[0])

    def _show(self) -> None:
        from ..plots.picture import Window

        if self._told_of_display:
            return
        try:
            self._window = self._window or Window("devlearn/Navigate-v0")
        except RuntimeError as error:
            self._told_of_display = True
            logging.getLogger(__name__).warning(
                "nothing is shown: %s; render_mode='rgb_array' gives pictures as arrays, which "
                "gymnasium.wrappers.RecordVideo makes films of",
                error,
            )
            return
        self._window.show(self._frame(), 1.0 / _FRAMES_A_SECOND)


def picture_of(view: View) -> Picture:
    """What frames of its environments are drawn in. Raises MissingExtra without matplotlib."""
    from ..plots.picture import Picture

    return Picture(view.batch.world, view.batch.config.robot)


def known_render_mode(given: str | None, known: Sequence[str]) -> str | None:
    """The mode. Raises InvalidValue for one that there is not."""
    if given is not None and given not in known:
        raise InvalidValue("render_mode", shown(given), f"None, {' or '.join(map(repr, known))}")
    return given
