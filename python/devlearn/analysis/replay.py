"""A record's learner once more, step by step."""

from __future__ import annotations

import math
from collections.abc import Iterator

from .._core import AdaptiveConfig, AdaptiveLearner, Kind, Learner, SituationGrid
from ..errors import FileError, InvalidValue
from ..record import Record
from .fields import grid_of

# As records name them, and as snapshots do.
_LEARNERS = ("devlearn._core.Learner", "devlearn._core.AdaptiveLearner", "learner", "adaptive")


def first_learner(record: Record) -> Learner | AdaptiveLearner | None:
    """The learner as it was before a record's first step; None where the record cannot tell.

    The one that it carries. Without one, a new learner of the record's configuration and seed,
    where its agent is devlearn's own and nothing had been explored before its first step. Raises
    FileError where what the record carries is no learner's snapshot.
    """
    if record.learner is not None:
        for kind in (Learner, AdaptiveLearner):
            try:
                return kind.from_bytes(record.learner)
            except FileError as error:
                refusal = error
        raise refusal
    if not learner_chose(record) or "config" not in record.provenance:
        return None
    if len(record) and record.explored_count[0] > (record.kind[0] == int(Kind.EXPLORE)):
        return None
    config, seed = record.config.learner, record.provenance.get("seed", 0)
    if isinstance(config, AdaptiveConfig):
        return AdaptiveLearner(config, seed)
    return Learner(config, seed)


def learner_chose(record: Record) -> bool:
    """Whether a record's agent was a Learner or an AdaptiveLearner."""
    return record.provenance.get("agent") in _LEARNERS


class Replay:
    """A record's learner, taken through what it met by its own rules, in C++.

    ``learner`` is as it was after ``steps`` steps of the record: equal to the bit, its draws
    included, as long as the robot's safety layer allowed every motion (records do not tell what it
    refused; the paper's learner then differs in its draws alone).
    """

    def __init__(self, record: Record) -> None:
        """Before the first step. Raises InvalidValue where the record does not tell the learner."""
        learner = first_learner(record)
        if learner is None:
            raise InvalidValue(
                "record.learner", "None, of a learner that had learned before",
                "a record that carries its learner, as phases with learner=True give",
            )  # fmt: skip
        self.learner: Learner | AdaptiveLearner = learner
        self.steps = 0
        self._record = record
        if isinstance(learner, AdaptiveLearner):
            self._rounds = _Rounds(record)

    def to(self, steps: int) -> Learner | AdaptiveLearner:
        """Goes on until so many steps are made; the learner then.

        Raises InvalidValue for fewer than were made, or more than there are; and where the learner
        chooses or learns otherwise than the record says, so that it is not the one recorded.
        """
        if not self.steps <= steps <= len(self._record):
            raise InvalidValue("steps", steps, f"in [{self.steps}, {len(self._record)}]")
        if isinstance(self.learner, AdaptiveLearner):
            while self.steps < steps:
                self._rounds.make(self.learner, self.steps)
                self.steps += 1
        else:
            self._learn(self.learner, steps)
        return self.learner

    def _learn(self, learner: Learner, end: int) -> None:
        record = self._record
        told = ("situation", "motion", "smf_used", "event", "reduced", "effective_count")
        columns = (getattr(record, name)[self.steps : end].tolist() for name in told)
        every_allowed = record.config.robot.safety_margin is None
        for situation, motion, smf, *came in zip(*columns):
            chosen = learner.choose(situation).motion
            if every_allowed and chosen != motion:
                raise _another(f"record.motion[{self.steps}]", motion, chosen, "chooses")
            learned = learner.learn(smf, motion)
            for name, value in zip(told[3:], came):
                found = int(getattr(learned, name))
                if found != value:
                    raise _another(f"record.{name}[{self.steps}]", value, found, "learns")
            self.steps += 1


def _another(quantity: str, value: int, found: int, does: str) -> InvalidValue:
    return InvalidValue(quantity, value, f"{found}, as the learner replayed {does}")


def parts(record: Record, *entries: slice) -> Iterator[Record]:
    """``record.part`` of each, one after the other, with the learner as it was when they began.

    Those that end before another begins; of a record that tells its learner, and as far as that can
    be replayed. Raises InvalidValue for a record of rounds only.
    """
    replay = None if first_learner(record) is None else Replay(record)
    for these in entries:
        part = record.part(these)
        if replay is not None:
            first = min(these.indices(len(record.rounds))[0], len(record.rounds))
            try:
                part.learner = replay.to(int(record.offsets()[first])).to_bytes()
            except InvalidValue:
                replay = None
        yield part


class _Rounds:
    """What an adaptive learner is told at each step of a record, and when rounds begin and end."""

    def __init__(self, record: Record) -> None:
        self._record = record
        config = record.config
        self._step = config.robot.speed * config.robot.sample_time
        self._target = record.world.target
        self._grid: SituationGrid = grid_of(record)
        self._begins: dict[int, int] = {}  # step -> entry
        self._ends: dict[int, int] = {}
        for entry, (begin, end) in enumerate(zip(record.offsets(), record.offsets()[1:])):
            if begin < end:
                self._begins[int(begin)] = entry
                self._ends[int(end) - 1] = entry
        self._estimate = 0.0

    def make(self, learner: AdaptiveLearner, step: int) -> None:
        record = self._record
        entry = self._begins.get(step)
        if entry is not None:
            self._begin(learner, entry)
        choice = learner.choose(int(record.situation[step]), self._estimate)
        for name, found in (("motion", choice.motion), ("kind", int(choice.kind))):
            value = int(getattr(record, name)[step])
            if value != found:
                raise _another(f"record.{name}[{step}]", value, found, "chooses")
        arrived = bool(record.arrived[step])
        self._estimate = 0.0 if arrived else float(record.goal_distance[step]) / self._step
        learner.learn(
            float(record.cost[step]),
            self._next(step),
            self._estimate,
            interrupted=bool(record.collided[step]),
        )
        if step in self._ends and self._arrives(step):
            learner.end_round(True)

    def _begin(self, learner: AdaptiveLearner, entry: int) -> None:
        record = self._record
        x, y, _ = record.path(entry)[0]
        dx, dy = x - self._target[0], y - self._target[1]
        distance = math.sqrt(dx * dx + dy * dy)
        arrived = distance <= record.config.goal_radius
        self._estimate = 0.0 if arrived else distance / self._step
        number = record.rounds["round"][entry]
        if learner.in_round and entry and number == record.rounds["round"][entry - 1]:
            return  # it goes on
        if learner.in_round:
            learner.end_round(False)
        learner.begin_round()

    def _next(self, step: int) -> int:
        """The situation after a step: the next one's, unless a round ends there."""
        record = self._record
        entry = self._ends.get(step)
        if entry is None:
            return int(record.situation[step + 1])
        return self._grid.situation(tuple(record.path(entry)[-1]))

    def _arrives(self, step: int) -> bool:
        """Whether a round ended by arriving, as those of path learning do at once."""
        record = self._record
        steps = record.steps_of(self._ends[step])
        arrived = record.arrived[steps]
        return bool(arrived[-1]) and not arrived[:-1].any()
