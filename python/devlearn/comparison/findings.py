"""What stands out, in sentences that are computed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from ..experiments.measures import NEAR
from ..experiments.statistics import Estimate
from .compared import Compared, Contender
from .tables import FIRST, Column, estimate, improvement, interval, percent

_FIRST_ARRIVAL, _NEAR, _NEAR_SHARE, _LAST, _FAILED, _SETTLED, _ = FIRST

Found = Sequence[tuple[Contender, Estimate]]


def findings(compared: Compared, references: Sequence[Contender]) -> list[str]:
    """Sentences about those that learn, from the first table and the pairs."""
    if not compared.learners:
        return ["None of these agents learns."]
    return [
        *_ends(compared), *_gets_near(compared), *_settles(compared),
        *_against(compared, references), *_where(compared), *_errors(compared),
    ]  # fmt: skip


def _of(compared: Compared, column: Column) -> Found:
    """Those that have an estimate, the lowest first."""
    found = [(one, estimate(compared, one, column)) for one in compared.learners]
    return sorted(((one, e) for one, e in found if e is not None), key=lambda pair: pair[1].value)


def _with(column: Column, found: Estimate) -> str:
    return f"{column.write(found.value)} ({interval(found, column.write)})"


def _ends(compared: Compared) -> Iterator[str]:
    ends = [(one, e) for one, e in _of(compared, _LAST) if e.value < math.inf]
    if not ends:
        yield "None ends on a path that arrives in three quarters of the runs."
        return
    (best, its), *others = ends
    text = (
        f"{best.name} ends on the shortest paths, {_with(_LAST, its)} times the shortest there is"
    )
    if others:
        next_best, theirs = others[0]
        text += f"; next is {next_best.name} with {_with(_LAST, theirs)}"
    yield text + "."


def _gets_near(compared: Compared) -> Iterator[str]:
    shares = _of(compared, _NEAR_SHARE)
    always = [one.name for one, e in shares if e.value == 1]
    if always:
        yield (
            f"Those that get within {NEAR} of the shortest path in every run: {_listed(always)}."
        )
    elif shares:
        one, most = shares[-1]
        yield (
            f"None gets within {NEAR} of the shortest path in every run; {one.name} does the most "
            f"often, in {_with(_NEAR_SHARE, most)} of its runs."
        )
    soon = [(one, e) for one, e in _of(compared, _NEAR) if e.value < math.inf]
    if soon:
        first, its = soon[0]
        yield f"The soonest is {first.name}, after {_with(_NEAR, its)} steps in the median."


def _settles(compared: Compared) -> Iterator[str]:
    shares = [(one, e) for one, e in reversed(_of(compared, _SETTLED)) if e.value > 0]
    if not shares:
        yield "None settles on one path."
        return
    one, most = shares[0]
    yield f"{one.name} settles the most often, in {_with(_SETTLED, most)} of its runs."


def _against(compared: Compared, references: Sequence[Contender]) -> Iterator[str]:
    for reference in references:
        others = [one for one in compared.learners if one is not reference]
        found = [(one, improvement(compared, one, reference, "last_ratio")) for one in others]
        better = [one.name for one, e in found if e is not None and e.low > 0.5]
        worse = [one.name for one, e in found if e is not None and e.high < 0.5]
        open_ = [one.name for one in others if one.name not in (*better, *worse)]
        told = [
            f"{_who(names, others)} in {how} rounds than {reference.name} more often than not"
            for names, how in ((better, "shorter"), (worse, "longer"))
            if names
        ]
        if open_:
            told.append(f"of {_listed(open_)} these runs do not tell")
        if told:
            yield f"In the same world with the same seed {'; '.join(told)}."


def _who(names: Sequence[str], others: Sequence[Contender]) -> str:
    if len(names) == len(others) > 1:
        return f"all {len(others)} others end"
    return f"{_listed(names)} {'end' if len(names) > 1 else 'ends'}"


def _where(compared: Compared) -> Iterator[str]:
    failing = {}
    for world in compared.worlds:
        scores = {
            one.name: compared.scores(one, "failed_share", [world]) for one in compared.learners
        }
        failing[world] = [
            name for name, shares in scores.items() if shares is not None and shares.mean() >= 0.5
        ]
    hardest = max(compared.worlds, key=lambda world: len(failing[world]))
    if failing[hardest]:
        yield (
            f"The hardest world is {hardest}: half of the rounds or more fail of "
            f"{_listed(failing[hardest])}."
        )
    else:
        yield "In no world half of the rounds of any of them fail."


def _errors(compared: Compared) -> Iterator[str]:
    errors = int(compared.frame["error"].notna().sum())
    if errors:
        share = errors / len(compared.frame)
        yield (
            f"{errors} runs ({percent(share)}) ended by an error, and count as the worst there is."
        )


def _listed(names: Sequence[str]) -> str:
    if len(names) < 2:
        return names[0] if names else "none"
    return f"{', '.join(names[:-1])} and {names[-1]}"
