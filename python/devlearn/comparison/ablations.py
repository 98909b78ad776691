"""Each setting of a method alone away from its default: what it does for the paths."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from .. import plots
from ..errors import FileError, InvalidValue
from ..experiments import spec as specs
from ..experiments import statistics
from ..experiments.spec import Spec
from .compared import Compared, Contender
from .figures import Picture, of_seeds, picture
from .tables import (
    BRIEFLY,
    Cell,
    Column,
    Scores,
    Table,
    improvement,
    interval,
    mean,
    median,
    middle,
    percent,
    told,
)

SHIPPED = Path(__file__).with_name("ablations.toml")
_DEFAULTS_OF = {"step5": "paper"}  # a preset that is another with settings changed
_SHOWN = (
    Column("last rounds / L", "interquartile mean", "last_ratio", middle),
    Column("within 1.25 L", "steps, median", "within_1_25", median),
    Column("failed rounds", "mean", "failed_share", mean),
)


def read(path: Path = SHIPPED) -> Spec:
    """A sweep's file with one more table, ``alone``: by agent, alternatives of settings.

    As many agents as there are alternatives: each has one of them set, and all else as
    ``settings`` has it. Fields of the TrialConfig stand in a table ``trial`` in it. Raises
    FileError.
    """
    values = specs.toml(path)
    alone = values.pop("alone", {})
    try:
        base = specs.read(values)
        variants = [*base.variants]
        for agent, changes in _each(alone):
            settings = {**values.get("settings", {}).get(agent, {}), **changes.get("settings", {})}
            one = specs.read({
                **values, "agents": [agent], "settings": {agent: settings},
                "trial": {**values.get("trial", {}), **changes.get("trial", {})},
            })  # fmt: skip
            variants += one.variants
    except FileError:
        raise
    except InvalidValue as error:
        raise FileError(str(path), error.quantity, error.value, error.allowed) from error
    return dataclasses.replace(base, variants=variants, values={**values, "alone": alone})


def _each(alone: object) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """By agent, what is changed: a setting, or a field of the trial, and its alternatives."""
    wanted = "a table of tables, an agent's settings each"
    if not isinstance(alone, dict):
        raise InvalidValue("alone", repr(alone), wanted)
    for agent, table in alone.items():
        if not isinstance(table, dict):
            raise InvalidValue(f"alone.{agent}", repr(table), wanted)
        for name, alternatives in table.items():
            if name == "trial" and isinstance(alternatives, dict):
                for field, values in alternatives.items():
                    yield agent, {"trial": {field: values}}
            else:
                yield agent, {"settings": {name: alternatives}}


class Effects(NamedTuple):
    """What the settings of an agent do."""

    agent: str
    table: Table
    pictures: list[Picture]
    n: str


def effects(compared: Compared) -> Iterator[Effects]:
    """By agent, against its defaults, paired by world and seed."""
    defaults = {one.agent: one for one in compared.contenders if not one.settings and not one.trial}
    changed: dict[str, list[Contender]] = {}
    for one in compared.contenders:
        agent = _DEFAULTS_OF.get(one.agent, one.agent)
        if agent in defaults and one is not defaults[agent]:
            changed.setdefault(agent, []).append(one)
    for agent, others in changed.items():
        yield _effects(compared, defaults[agent], others)


def _effects(compared: Compared, default: Contender, others: list[Contender]) -> Effects:
    head = []
    for column in _SHOWN:
        head += [Cell(column.title, column.of), Cell("better than the default", "in the same pair")]
    head[-1] = Cell("failed rounds", "more than by default, mean")
    rows = []
    for one in [default, *others]:
        cells = []
        for column in _SHOWN:
            ours, theirs = (compared.scores(c, column.measure) for c in (one, default))
            if ours is None or theirs is None or ours.shape != theirs.shape:
                cells += [Cell("no value")] * 2
                continue
            cells.append(told(column.estimate(ours), column.write))
            cells.append(Cell("") if one is default else _against(column, ours, theirs))
        rows.append((_short(one, default), cells))
    runs = f"{len(compared.worlds)} worlds x {of_seeds(compared)}"
    return Effects(
        default.agent, Table(head, rows), [*_drawn(compared, default, others, runs)], runs
    )


def _short(one: Contender, default: Contender) -> str:
    if one is default:
        return "defaults"
    return one.name.partition(", ")[2] or f"preset {one.name}"


def _against(column: Column, ours: Scores, theirs: Scores) -> Cell:
    if column.measure == "failed_share":
        more = statistics.bootstrap(
            statistics.difference(statistics.mean), ours, theirs, paired=True
        )
        return told(more, lambda share: f"{round(100 * share, 1) + 0.0:+.1f} %")  # not -0.0
    found = statistics.estimate_improvement(ours, theirs, paired=True)
    return Cell(percent(found.value), interval(found, percent))


def _drawn(
    compared: Compared, default: Contender, others: list[Contender], runs: str
) -> Iterator[Picture]:
    for measure in ("last_ratio", "within_1_25"):
        found = {
            _short(one, default): improvement(compared, one, default, measure) for one in others
        }
        rows = {name: (e.value, e.low, e.high) for name, e in found.items() if e is not None}
        if not rows:
            continue
        axes = plots.plot_intervals(
            rows, bound=0.5, limits=(0.0, 1.0), shares=True,
            xlabel="better than the defaults", title=f"{default.agent}: {BRIEFLY[measure]}",
        )  # fmt: skip
        yield picture(
            axes,
            f"How often each setting, alone, is better than the defaults of {default.agent} in the "
            f"same world with the same seed, ties by half: {runs}; 95 % intervals.",
        )
