"""A learner of devlearn on an environment of others."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from .._calls import shown
from .._core import AdaptiveLearner, Learner, Observation, Outcome, Random
from ..errors import InvalidValue
from .others import Env, actions_of, allowed_of, require_whole, reset_seed
from .players import OfAdaptive, OfLearner, Player, player_of
from .situations import DiscreteSituations

Episodes = npt.NDArray[np.void]
EPISODE = np.dtype(
    [("return", np.float64), ("steps", np.int64), ("terminated", bool), ("truncated", bool)]
)
Evaluation = Union[Callable[[Any], float], str, None]
Estimate = Union[Callable[[Any], float], float]

_BETWEEN_REPORTS = 0.1  # seconds


class LearnerOn:
    """Any learner or agent of devlearn drives an environment of Gymnasium with discrete actions.

        env = gymnasium.make("CliffWalking-v1")
        learner = devlearn.AdaptiveLearner(devlearn.AdaptiveConfig(motion_count=4, hold_limit=1))
        on = devlearn.envs.LearnerOn(env, learner)
        episodes = on.run(300, seed=1)
        print(episodes["return"][-10:], on.evaluate(20)["return"].mean())

    A step is told as a trial tells it (docs/agents.md): an ``Observation`` before it, and an
    ``Outcome`` after. Which of it counts depends on the learner: a ``Learner`` learns from SMF
    alone, an ``AdaptiveLearner`` from cost and estimate, value learners from the cost. Motions are
    the environment's actions; those that ``info["action_mask"]`` rules out are not allowed. Where
    an episode is terminated, nothing follows, whether it ended well or not: the outcome has
    ``arrived``. Where it is only truncated, it has not. ``info["collided"]`` and
    ``info["event"]``, where there are such, are told, too; without the latter an arrival is event
    0 and a touch event 1, as in a trial.

    Parameters
    ----------
    env
        A gymnasium.Env with a Discrete action space.
    learner
        A Learner or AdaptiveLearner with as many motions, a value learner of devlearn.agents, a
        RandomAgent, or any object with choose(observation) and observe(outcome), and, if it likes,
        begin_round(), end_round(arrived) and cancel(). It is shared, not copied, and is what is
        saved: nothing else is learned.
    situations
        A function of an observation that gives a whole number in [0, 2**63); None: the space's own
        (``DiscreteSituations``). A Box needs one, such as ``TileSituations``.
    evaluation
        SEF: a function of an observation that gives a number, the higher the better. SMF is its
        value after a step less that before (Eq. 8), where the episode ends as everywhere. Or
        ``"reward"``: SMF is the step's reward, and SEF 0. A Learner needs one of them. None: SEF
        and SMF are 0.
    cost
        A function (reward, terminated) that gives what a step cost; None: -reward. An
        AdaptiveLearner takes costs >= 0, so that it needs one where rewards are positive.
    arrived
        A function (reward) that says of the last step of a terminated episode whether that reached
        what was to be reached; None: it always did. A round that ended otherwise is told as not
        arrived: an AdaptiveLearner makes no habit of falling into a hole.
    estimate
        The cost to go, a function of an observation, or a number for everywhere; above 0. Where an
        episode has terminated it is 0 by itself. For an AdaptiveLearner it should be no more than
        the true one, as far as you know.

    Raises
    ------
    InvalidValue
        For what it cannot drive (continuous actions, a vector of environments), and for what is
        missing, saying what to do.
    """

    def __init__(
        self,
        env: Env,
        learner: Any,
        *,
        situations: Callable[[Any], int] | None = None,
        evaluation: Evaluation = None,
        cost: Callable[[float, bool], float] | None = None,
        arrived: Callable[[float], bool] | None = None,
        estimate: Estimate = 1.0,
    ) -> None:
        self._motions, self._first_action = actions_of(env)
        self._env = env
        self._learner = learner
        self._player = player_of(learner)
        if isinstance(learner, (Learner, AdaptiveLearner)):
            count = learner.config.motion_count
            if count != self._motions:
                raise InvalidValue(
                    "LearnerOn.learner",
                    f"one of {count} motions",
                    f"motion_count={self._motions}, as many as the environment has actions",
                )
        self._situations = (
            DiscreteSituations.of(env.observation_space) if situations is None else situations
        )
        self._evaluation = evaluation
        self._cost = cost
        self._arrived = arrived
        self._estimate = estimate
        self._require_functions()
        self._seed, self._episode = 0, 0
        self._interrupted: Episodes | None = None

    @property
    def env(self) -> Env:
        """The environment."""
        return self._env

    @property
    def learner(self) -> Any:
        """Who learns."""
        return self._learner

    @property
    def situations(self) -> Callable[[Any], int]:
        """Which situation an observation is."""
        return self._situations

    @property
    def seed(self) -> int:
        """Of the episodes that are run."""
        return self._seed

    @property
    def episode(self) -> int:
        """The number of the next one, from 0."""
        return self._episode

    @property
    def interrupted(self) -> Episodes | None:
        """What the last run had finished, where an exception or Ctrl-C ended it; None otherwise."""
        return self._interrupted

    def run(
        self,
        episodes: int,
        *,
        seed: int | None = None,
        first: int | None = None,
        step_limit: int | None = 10_000,
        progress: Callable[[int, int], Any] | None = None,
    ) -> Episodes:
        """Learns for so many episodes.

        Episode i of a seed is reset with a seed drawn from both, so that it begins alike whatever
        was before it: runs in pieces, with evaluations between them or in another process, equal
        one in one call. The learner draws by its own seed.

        Parameters
        ----------
        episodes
            How many, >= 0.
        seed
            Of the environment, in [0, 2**64); None: as in the last run, 0 at first.
        first
            The first one's number, >= 0; None: 0 with a seed given, else what follows the last.
        step_limit
            Steps after which an episode is truncated, >= 1, if the environment has not ended it;
            None: only the environment ends it.
        progress
            Called as progress(done, total), in episodes, ten times a second at most and at the end.

        Returns
        -------
        Episodes
            An array with fields ``return`` (sum of the rewards), ``steps``, ``terminated`` and
            ``truncated``, an entry an episode.

        Raises
        ------
        InvalidValue
            For a bad argument, and for what a learner refuses, such as a negative cost. An episode
            that is broken off, also by Ctrl-C, is not counted: what was finished is in
            ``interrupted``, and the next run begins with it anew, the learner as it has become.
        """
        _require_run(episodes, step_limit, progress)
        if first is not None:
            require_whole("LearnerOn.run.first", first, 0)
        if seed is not None:
            Random(seed, "")  # which refuses what is none
            self._seed, self._episode = seed, 0
        if first is not None:
            self._episode = first
        self._interrupted = None
        played = np.zeros(episodes, EPISODE)
        reported = -math.inf
        done = 0
        try:
            while done < episodes:
                random = Random(self._seed, f"episode {self._episode}")
                played[done] = self._play(self._player, reset_seed(random), step_limit)
                done += 1
                self._episode += 1
                now = time.monotonic()
                if progress and (done == episodes or now - reported >= _BETWEEN_REPORTS):
                    progress(done, episodes)
                    reported = now
        except BaseException:
            self._interrupted = played[:done].copy()
            raise
        return played

    def evaluate(
        self, episodes: int = 100, *, seed: int = 0, step_limit: int | None = 10_000
    ) -> Episodes:
        """Plays so many episodes by what was learned. Learner and run stay as they are.

        A Learner plays its effective motion of highest orientation, an AdaptiveLearner its habit
        where it goes by one here, else the tried motion of least loss, a value learner that of the
        highest value, each of those allowed; where nothing is known, any motion, drawn. An object
        of yours plays as a copy of it, which goes on exploring and learning.

        The episodes of a seed are others than those that are run with it, and the same at each
        call. Parameters, result and errors as of ``run``.
        """
        _require_run(episodes, step_limit)
        played = np.zeros(episodes, EPISODE)
        for i in range(episodes):
            random = Random(seed, f"evaluation {i}")
            begin = reset_seed(random)
            played[i] = self._play(self._player.frozen(random), begin, step_limit)
        return played

    # --- an episode -------------------------------------------------------------------------------

    def _play(
        self, player: Player, seed: int, step_limit: int | None
    ) -> tuple[float, int, bool, bool]:
        observation, info = self._env.reset(seed=seed)
        situation, sef, estimate = self._senses(observation, False)
        total, reward, steps = 0.0, 0.0, 0
        terminated = truncated = False
        player.begin()
        while not (terminated or truncated):
            seen = Observation(
                situation,
                self._motions,
                estimate=estimate,
                sef=sef,
                allowed=allowed_of(info, self._motions),
            )
            motion = player.choose(seen)
            try:
                observation, gain, ended, cut, info = self._env.step(self._first_action + motion)
                reward, terminated, truncated = _finite("reward", gain), bool(ended), bool(cut)
                before = sef
                collided = bool(info.get("collided", False))
                situation, sef, estimate = self._senses(observation, terminated)
                player.observe(
                    Outcome(
                        situation,
                        cost=self._cost_of(reward, terminated),
                        estimate=estimate,
                        arrived=terminated,
                        collided=collided,
                        event=info.get("event", 0 if terminated else 1 if collided else -1),
                        sef=sef,
                        smf=reward if self._evaluation == "reward" else sef - before,
                    )
                )
            except BaseException:
                with contextlib.suppress(InvalidValue):  # where it was told already
                    player.cancel()
                raise
            total += reward
            steps += 1
            truncated = truncated or (steps == step_limit and not terminated)
        player.end(terminated and (self._arrived is None or bool(self._arrived(reward))))
        return total, steps, terminated, truncated

    def _senses(self, observation: Any, terminated: bool) -> tuple[int, float, float]:
        """Situation, SEF and estimate of an observation."""
        situation = self._situations(observation)
        sef = 0.0
        if callable(self._evaluation):
            sef = _finite("LearnerOn.evaluation", self._evaluation(observation))
        if terminated:
            return situation, sef, 0.0
        if not callable(self._estimate):
            return situation, sef, self._estimate
        return situation, sef, _estimated(self._estimate(observation))

    def _cost_of(self, reward: float, terminated: bool) -> float:
        given = -reward if self._cost is None else self._cost(reward, terminated)
        cost = _finite("LearnerOn.cost", given) + 0.0  # no -0.0
        if cost < 0.0 and isinstance(self._player, OfAdaptive):
            raise InvalidValue(
                "cost",
                f"{cost} of a step with reward {reward}",
                "at least 0, as an AdaptiveLearner learns from costs: give LearnerOn a "
                "cost=function(reward, terminated) in which what is good costs least",
            )
        return cost

    def _require_functions(self) -> None:
        """Refuses functions that are none, and what a learner cannot do without."""
        functions = {
            "situations": self._situations,
            "cost": self._cost,
            "arrived": self._arrived,
        }
        for name, given in functions.items():
            if given is not None and not callable(given):
                raise InvalidValue(f"LearnerOn.{name}", shown(given), "a function, or None")
        evaluation = self._evaluation
        if not (evaluation is None or evaluation == "reward" or callable(evaluation)):
            raise InvalidValue(
                "LearnerOn.evaluation", shown(evaluation), "a function, 'reward', or None"
            )
        if evaluation is None and isinstance(self._player, OfLearner):
            raise InvalidValue(
                "LearnerOn.evaluation",
                "None for a Learner",
                "a function of an observation that says how good it is to be there, or 'reward'",
            )
        shaping = getattr(getattr(self._learner, "config", None), "shaping", None)
        if shaping == "sef" and not callable(evaluation):
            raise InvalidValue(
                "LearnerOn.evaluation", shown(evaluation), "a function, for shaping='sef'"
            )
        if not callable(self._estimate):
            self._estimate = _estimated(self._estimate)


def _require_run(episodes: int, step_limit: int | None, progress: object = None) -> None:
    require_whole("episodes", episodes, 0)
    if step_limit is not None:
        require_whole("step_limit", step_limit, 1)
    if not (progress is None or callable(progress)):
        raise InvalidValue("progress", shown(progress), "a function (done, total), or None")


def _finite(quantity: str, value: object) -> float:
    try:
        number = math.nan if isinstance(value, (str, bytes)) else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise InvalidValue(quantity, shown(value), "a finite number")
    return number


def _estimated(value: object) -> float:
    estimate = _finite("LearnerOn.estimate", value)
    if estimate <= 0.0:
        raise InvalidValue(
            "LearnerOn.estimate", shown(value), "above 0, which is where an episode has terminated"
        )
    return estimate
