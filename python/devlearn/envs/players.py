"""Learners and agents of all kinds as one: who chooses, is told what came of it, and knows best."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np

from .._calls import shown
from .._core import (
    AdaptiveLearner,
    Appraisal,
    DynaQ,
    ExpectedSarsa,
    Learner,
    LrtaStar,
    Observation,
    OperantConditioning,
    Outcome,
    PrioritizedSweeping,
    QLearning,
    Random,
    RandomAgent,
    RMax,
    SalientEvents,
    SarsaLambda,
)
from .._types import Choice
from ..errors import InvalidValue
from .others import is_whole

_VALUE_AGENTS = (
    QLearning,
    ExpectedSarsa,
    SarsaLambda,
    DynaQ,
    PrioritizedSweeping,
    LrtaStar,
    RMax,
    SalientEvents,
    Appraisal,
)


class _Agent(Protocol):
    """An agent of C++, in a loop of one's own."""

    def begin_round(self) -> None: ...
    def choose(self, observation: Observation) -> Choice: ...
    def observe(self, outcome: Outcome) -> None: ...
    def cancel(self) -> None: ...
    def end_round(self, arrived: bool) -> None: ...


def _allowed(seen: Observation) -> Sequence[int]:
    if seen.allowed is None:
        return range(seen.motion_count)
    allowed: list[int] = np.flatnonzero(seen.allowed).tolist()
    return allowed


class Player:
    """Who plays episodes: what a trial calls of an agent (docs/agents.md), and ``frozen``."""

    def begin(self) -> None:
        """An episode begins."""

    def choose(self, seen: Observation) -> int:
        """A motion for what is observed."""
        raise NotImplementedError

    def observe(self, outcome: Outcome) -> None:
        """What came of it."""
        raise NotImplementedError

    def cancel(self) -> None:
        """Nothing came of it."""

    def end(self, arrived: bool) -> None:
        """The episode has ended: where nothing follows, or not."""

    def frozen(self, random: Random) -> Player:
        """One that plays by what this one has learned, and changes nothing in it."""
        raise NotImplementedError


class Knowing(Player):
    """One that can name the best of the motions allowed."""

    def best(self, seen: Observation) -> Sequence[int]:
        """Motions than which it knows none better; all that are allowed where it knows nothing."""
        raise NotImplementedError

    def frozen(self, random: Random) -> Player:
        """Greedy; among equals it draws."""
        return _Greedy(self, random)


class _Greedy(Player):
    def __init__(self, player: Knowing, random: Random) -> None:
        self._player = player
        self._random = random

    def choose(self, seen: Observation) -> int:
        best = self._player.best(seen)
        return best[self._random.index(len(best))]

    def observe(self, outcome: Outcome) -> None:
        pass

    def frozen(self, random: Random) -> Player:
        return _Greedy(self._player, random)


class OfLearner(Knowing):
    """The paper's: it learns from SMF."""

    def __init__(self, learner: Learner) -> None:
        self._learner = learner

    def choose(self, seen: Observation) -> int:
        """As Learner."""
        return self._learner.choose(seen.situation, seen.allowed).motion

    def observe(self, outcome: Outcome) -> None:
        """As Learner.learn."""
        self._learner.learn(outcome.smf)

    def cancel(self) -> None:
        """As Learner."""
        self._learner.cancel()

    def best(self, seen: Observation) -> Sequence[int]:
        """As Learner.best, of those allowed."""
        memory = self._learner.situation(seen.situation)
        orientation = dict(zip(memory.effective, memory.orientation))
        allowed = _allowed(seen)
        effective = [motion for motion in memory.effective if motion in allowed]
        return [max(effective, key=orientation.__getitem__)] if effective else allowed


class OfAdaptive(Knowing):
    """The adaptive one: it learns from cost and estimate, in rounds."""

    def __init__(self, learner: AdaptiveLearner) -> None:
        self._learner = learner

    def begin(self) -> None:
        """As AdaptiveLearner.begin_round."""
        self._learner.begin_round()

    def choose(self, seen: Observation) -> int:
        """As AdaptiveLearner."""
        return self._learner.choose(seen.situation, seen.estimate, seen.allowed).motion

    def observe(self, outcome: Outcome) -> None:
        """As AdaptiveLearner.learn."""
        self._learner.learn(outcome.cost, outcome.situation, outcome.estimate, outcome.collided)

    def cancel(self) -> None:
        """As AdaptiveLearner."""
        self._learner.cancel()

    def end(self, arrived: bool) -> None:
        """As AdaptiveLearner.end_round."""
        self._learner.end_round(arrived)

    def best(self, seen: Observation) -> Sequence[int]:
        """As AdaptiveLearner.best, of those allowed."""
        memory = self._learner.situation(seen.situation)
        allowed = _allowed(seen)
        tried = [motion for motion in allowed if motion not in memory.unexplored]
        return [min(tried, key=memory.losses.__getitem__)] if tried else allowed

    def frozen(self, random: Random) -> Player:
        """By its habit, where a round that begins here goes by it; else greedy."""
        return _ByHabit(self, self._learner.copy(), random)


class _ByHabit(_Greedy):
    def __init__(self, player: OfAdaptive, copied: AdaptiveLearner, random: Random) -> None:
        super().__init__(player, random)
        self._copied = copied
        self._begins = True

    def begin(self) -> None:
        self._copied.begin_round()
        self._begins = True

    def choose(self, seen: Observation) -> int:
        if self._begins:  # a round goes by habit, or not, from its first choice on
            self._copied.choose(seen.situation, seen.estimate, seen.allowed)
            self._copied.cancel()
            self._begins = False
        habit = self._copied.explain(seen.situation, seen.allowed).habit
        return habit if habit in _allowed(seen) else super().choose(seen)


class _OfAgent(Player):
    def __init__(self, agent: _Agent) -> None:
        self._agent = agent

    def begin(self) -> None:
        self._agent.begin_round()

    def choose(self, seen: Observation) -> int:
        return self._agent.choose(seen).motion

    def observe(self, outcome: Outcome) -> None:
        self._agent.observe(outcome)

    def cancel(self) -> None:
        self._agent.cancel()

    def end(self, arrived: bool) -> None:
        self._agent.end_round(arrived)


class OfValues(_OfAgent, Knowing):
    """A textbook learner of values, or of probabilities: ``value(situation, motion)``."""

    def __init__(self, agent: _Agent, value: Callable[[int, int], float | None]) -> None:
        super().__init__(agent)
        self._value = value

    def best(self, seen: Observation) -> Sequence[int]:
        """Those of the highest value."""
        motions = _allowed(seen)
        values = [self._value(seen.situation, motion) for motion in motions]
        known = [value for value in values if value is not None]
        highest = max(known, default=None)
        return [motion for motion, value in zip(motions, values) if value == highest]


class OfRandom(_OfAgent, Knowing):
    """Random motions, which are as good as any."""

    def best(self, seen: Observation) -> Sequence[int]:
        """All of them."""
        return _allowed(seen)


class OfObject(Player):
    """Any object with choose(observation) and observe(outcome)."""

    def __init__(self, agent: Any) -> None:
        self._agent = agent

    def _call(self, method: str, *arguments: object) -> None:
        if hasattr(self._agent, method):
            getattr(self._agent, method)(*arguments)

    def begin(self) -> None:
        """If it has begin_round."""
        self._call("begin_round")

    def choose(self, seen: Observation) -> int:
        """Its choice: an index, or a Choice."""
        chosen = self._agent.choose(seen)
        motion = chosen.motion if isinstance(chosen, Choice) else chosen
        if not is_whole(motion) or motion not in _allowed(seen):
            self.cancel()
            raise InvalidValue(
                "agent's choice", shown(chosen), f"a motion of those allowed, {[*_allowed(seen)]}"
            )
        return int(motion)

    def observe(self, outcome: Outcome) -> None:
        """Tells it."""
        self._agent.observe(outcome)

    def cancel(self) -> None:
        """If it has cancel."""
        self._call("cancel")

    def end(self, arrived: bool) -> None:
        """If it has end_round."""
        self._call("end_round", arrived)

    def frozen(self, random: Random) -> Player:
        """A copy, which goes on as ever: exploring and learning."""
        return OfObject(copy.deepcopy(self._agent))


def player_of(learner: object) -> Player:
    """Whoever is named as a learner. Raises InvalidValue."""
    own_way = hasattr(learner, "observe")  # a class derived from a learner, with ways of its own
    if isinstance(learner, Learner) and not own_way:
        return OfLearner(learner)
    if isinstance(learner, AdaptiveLearner) and not own_way:
        return OfAdaptive(learner)
    if isinstance(learner, _VALUE_AGENTS):
        return OfValues(learner, learner.value)
    if isinstance(learner, OperantConditioning):
        return OfValues(learner, learner.probability)
    if isinstance(learner, RandomAgent):
        return OfRandom(learner)
    methods = (getattr(learner, name, None) for name in ("choose", "observe"))
    if isinstance(learner, type) or not all(map(callable, methods)):
        raise InvalidValue(
            "LearnerOn.learner",
            shown(learner),
            "a Learner, an AdaptiveLearner, one of devlearn.agents that needs no map, a "
            "RandomAgent, or an object with choose(observation) and observe(outcome)",
        )
    return OfObject(learner)
