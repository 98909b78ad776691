"""The settings of the textbook agents, found by a search that is the same for each.

Twelve settings each, its defaults and 11 drawn from the choices in `SEARCHED`, in worlds that the
comparison does not show. The one of the least mean of (steps of all rounds) / (rounds x shortest
path) is taken; a round that failed, or was left out, costs as many steps as the limit of a round.
"""

from __future__ import annotations

import dataclasses
import json
import math
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from .._core import Random
from .._files import made_folder
from ..experiments import spec as specs
from ..experiments.job import canonical
from ..experiments.schedule import Schedule
from ..experiments.store import Results
from ..experiments.sweep import sweep
from ..record import written_aside

WORLDS = ("similar:40-43",)
SEEDS = "0-2"
ROUNDS, LIMIT = 300, 10_000
TRIES = 12

_OF_VALUES = {
    "alpha": (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0),
    "gamma": (1.0, 0.99, 0.95),
    "epsilon": (0.0, 0.001, 0.003, 0.01, 0.03, 0.1),
    "first_value": ("estimate", "constant"),
    "shaping": ("none", "sef", "estimate"),
}
_OF_PLANNING = {**_OF_VALUES, "planning_steps": (5, 10, 20)}
SEARCHED: Mapping[str, Mapping[str, Sequence[Any]]] = {
    "QLearning": _OF_VALUES,
    "ExpectedSarsa": _OF_VALUES,
    "SarsaLambda": {
        **_OF_VALUES,
        "trace_decay": (0.9,),
        "traces": ("accumulating", "replacing"),
    },
    "DynaQ": _OF_PLANNING,
    "PrioritizedSweeping": {**_OF_PLANNING, "theta": (0.001, 0.01, 0.1, 1.0)},
    "LrtaStar": {
        "first_value": ("estimate", "constant"),
        "initial_value": tuple(range(-200, 1, 5)),
    },
    "RMax": {
        "m": (1, 2, 3, 5),
        "gamma": (1.0, 0.99, 0.95),
        "first_value": ("estimate", "constant"),
        "theta": (1e-6, 1e-3, 0.1, 1.0),
        "least_value": (-1000.0, -300.0),
    },
    "OperantConditioning": {
        "reward_step": (0.01, 0.03, 0.1, 0.2, 0.3, 0.5),
        "penalty_step": (0.0, 0.001, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5),
        "reinforced_by": ("smf", "reward"),
    },
}


class Found(NamedTuple):
    """The best settings of an agent."""

    settings: Mapping[str, Any]
    cost: float
    """Steps over as many shortest paths, the mean of the runs."""


def drawn(agent: str, count: int = TRIES) -> list[dict[str, Any]]:
    """The settings that are tried, all different: the defaults, and others by chance."""
    random = Random(0, f"settings of {agent}")
    tried: list[dict[str, Any]] = [
        {"trace_decay": 0.9} if "trace_decay" in SEARCHED[agent] else {},
    ]
    while len(tried) < count:
        these = {n: choices[random.index(len(choices))] for n, choices in SEARCHED[agent].items()}
        if these.get("first_value") == "estimate":
            these.pop("initial_value", None)
        if these not in tried:
            tried.append(these)
    return tried


def search(
    output: str | os.PathLike[str],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    worlds: Sequence[str] = WORLDS,
    seeds: str = SEEDS,
    tries: int = TRIES,
    rounds: int = ROUNDS,
    say: Callable[[str], None] = print,
) -> dict[str, Found]:
    """Searches, and writes settings.toml into the folder ``output``: tables for a sweep's file.

    Stopped, it goes on from search.sqlite, in the folder, too. Raises InvalidValue, FileError.
    """
    folder = made_folder(output)
    values = {
        "worlds": [*worlds], "agents": [*SEARCHED], "seeds": seeds, "free": [], "rounds": rounds,
        "step_limit": LIMIT, "keep": "rounds",
    }  # fmt: skip
    variants = [
        variant
        for agent in SEARCHED
        for settings in drawn(agent, tries)
        for variant in specs.read(
            {**values, "agents": [agent], "settings": {agent: settings}}
        ).variants
    ]
    asked = dataclasses.replace(specs.read(values), variants=variants)
    say(f"{len(asked)} runs: {tries} settings of {len(SEARCHED)} agents")
    results = sweep(asked, folder / "search.sqlite", workers=workers, scheduler=scheduler)
    found = best(results, tries)
    for agent, one in found.items():
        say(f"{agent}: {one.cost:.3f} times the shortest path, {dict(one.settings)}")
    with written_aside(folder / "settings.toml", "w") as file:
        file.write(as_toml(found))
    return found


def best(results: Results, tries: int = TRIES) -> dict[str, Found]:
    """Of each agent the settings of the least cost, the first among equals."""
    frame = results.to_pandas()
    costs: dict[tuple[str, str], list[float]] = {}
    for row in frame.itertuples():
        costs.setdefault((row.agent, row.settings), []).append(_cost(results, row))
    found = {}
    for agent in SEARCHED:
        tried = drawn(agent, tries)
        means = [np.mean(costs[agent, canonical(settings)]) for settings in tried]
        least = int(np.argmin(means))
        found[agent] = Found(tried[least], float(means[least]))
    return found


def _cost(results: Results, row: Any) -> float:
    if isinstance(row.error, str) or not row.shortest > 0:
        return math.inf
    schedule = Schedule(**json.loads(row.schedule))
    rounds = results.rounds(int(row.run))
    return cost(rounds["steps"], rounds["arrived"], schedule, int(row.shortest))


def cost(steps: Any, arrived: Any, schedule: Schedule, shortest: int) -> float:
    """Steps of all rounds, arrays of those that were made, over as many shortest paths."""
    made = int(np.where(arrived, steps, schedule.step_limit).sum())
    left_out = schedule.rounds - len(steps)
    return (made + left_out * schedule.step_limit) / (schedule.rounds * shortest)


def as_toml(found: Mapping[str, Found]) -> str:
    """Tables of settings, as a sweep's file has them."""
    tables = []
    for agent, one in found.items():
        lines = [f"# {one.cost:.3f} times the shortest path", f"[settings.{agent}]"]
        lines += [f"{name} = {json.dumps(value)}" for name, value in one.settings.items()]
        tables.append("\n".join(lines) + "\n")
    return "\n".join(tables)
