"""What is run: rounds of free learning, then of path learning."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any, NamedTuple

from .._core import Trial
from ..errors import InvalidValue
from ..record import Record

Rounds = Sequence[tuple[int, int, bool]]


class Next(NamedTuple):
    """What comes next in an experiment."""

    begins: bool
    """Whether it begins a new round, or goes on with the present one."""
    free: bool
    """Whether that is a round of free learning, or one of path learning."""
    steps: int
    """What is left of the round, at most."""
    rounds: int = 1
    """So many rounds alike may be run at once, before there is anything to decide."""


@dataclasses.dataclass(frozen=True)
class Schedule:
    """An experiment: rounds of free learning, then of path learning, all from the start pose.

    What comes next is told from the trial and the rounds that were, so that an experiment goes on
    from any step at which it was saved, to the same history. Raises InvalidValue.
    """

    free: Sequence[int] = (10_000, 10_000)
    """Steps of each round of free learning, in [0, 2^40]."""
    rounds: int = 600
    """Rounds of path learning, in [0, 2^30]."""
    step_limit: int = 10_000
    """Steps after which a round of path learning has failed, in [1, 2^40]."""
    hopeless: int = 20
    """Ends early once so many rounds of path learning in a row have failed, as a robot that is
    trapped stays so: in [0, 2^30]; 0: never."""

    def __post_init__(self) -> None:
        if not isinstance(self.free, (list, tuple)):
            raise InvalidValue("Schedule.free", repr(self.free), "a list of whole numbers")
        object.__setattr__(self, "free", tuple(self.free))
        for steps in self.free:
            _require("Schedule.free", steps, 0, 40)
        _require("Schedule.rounds", self.rounds, 0, 30)
        _require("Schedule.step_limit", self.step_limit, 1, 40)
        _require("Schedule.hopeless", self.hopeless, 0, 30)

    def replace(self, **changes: Any) -> Schedule:
        """The same with some fields changed."""
        return dataclasses.replace(self, **changes)

    def to_dict(self) -> dict[str, Any]:
        """Its fields, as JSON can hold them."""
        return {**dataclasses.asdict(self), "free": list(self.free)}

    def next(self, trial: Trial, rounds: Rounds) -> Next | None:
        """What comes next, or None at the end.

        ``rounds`` are those of the trial so far, the present one last: number, steps, arrived.
        """
        number, frees = trial.round, len(self.free)
        if number > 0:
            free = number <= frees
            left = (self.free[number - 1] if free else self.step_limit) - rounds[-1][1]
            if left > 0 and (free or not trial.arrived):
                return Next(False, free, left)
        if number < frees:
            return Next(True, True, self.free[number])
        to_come = frees + self.rounds - number
        if self.hopeless:
            failed = 0
            for _, _, arrived in islice(reversed(rounds), len(rounds) - frees):
                if arrived:
                    break
                failed += 1
            to_come = min(to_come, self.hopeless - failed)
        return Next(True, False, self.step_limit, to_come) if to_come > 0 else None

    def parts(
        self,
        trial: Trial,
        done: Record | None = None,
        most: int | None = None,
        **options: Any,
    ) -> Iterator[Record]:
        """Goes on with a trial to the end; ``done`` is the record of all there was so far.

        A part holds at most ``most`` steps of one round; or whole rounds, as many as can be run
        at once. ``options`` are those of the trial's phases.
        """
        rounds = [] if done is None else _plain(done)
        while (ahead := self.next(trial, rounds)) is not None:
            steps = ahead.steps if most is None else min(most, ahead.steps)
            if most is None and ahead.begins and not ahead.free:
                part = trial.path_learning(ahead.rounds, steps, **options)
            else:
                if ahead.begins:
                    trial.begin_round()
                go_on = trial.run if ahead.free else trial.finish_round
                part = go_on(steps, **options)
            new = _plain(part)
            if not ahead.begins:
                number, before, _ = rounds.pop()
                new = [(number, before + new[0][1], new[0][2])]
            rounds += new
            yield part


def _require(quantity: str, value: object, least: int, power: int) -> None:
    if type(value) is not int or not least <= value <= 2**power:
        raise InvalidValue(quantity, repr(value), f"a whole number in [{least}, 2^{power}]")


def _plain(record: Record) -> list[tuple[int, int, bool]]:
    rounds: list[tuple[int, int, bool]] = record.rounds[["round", "steps", "arrived"]].tolist()
    return rounds
