"""What is compared: the runs of a sweep, by agent, world and seed."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .. import _markup as markup
from .._core import Trial, World
from ..errors import InvalidValue
from ..experiments.contenders import trial_of
from ..experiments.measures import MEASURES
from ..experiments.store import Results
from ..plots.looks import Look, look

if TYPE_CHECKING:
    import pandas

FLOOR, BOUND = "RandomAgent", "ShortestPathAgent"
"""They do not learn: what any agent should surpass, and what none can."""
_MOST_SHOWN = 40  # worlds, and agents, in a notebook
_VARIANT = ["agent", "settings", "trial", "schedule"]


class Contender(NamedTuple):
    """An agent with its settings."""

    name: str
    """Short; no two have the same."""
    agent: str
    settings: dict[str, Any]
    trial: dict[str, Any]
    schedule: dict[str, Any]
    look: Look

    @property
    def learns(self) -> bool:
        """Whether it can become better."""
        return self.agent not in (FLOOR, BOUND)

    @property
    def free(self) -> int:
        """Rounds of free learning."""
        return len(self.schedule["free"])


class Compared:
    """The runs of a file of results that can be compared: of every agent, in the same worlds, for
    the same seeds. A run that failed by an error counts as the worst there can be.
    """

    def __init__(self, results: Results) -> None:
        """Raises InvalidValue where there is no seed for which every agent has run everywhere."""
        self.results = results
        frame = results.to_pandas()
        found = [*dict.fromkeys(frame[_VARIANT].itertuples(index=False, name=None))]
        self.contenders = _contenders(found)
        """In the order of the results."""
        frame["contender"] = [
            self.contenders[found.index(key)].name
            for key in frame[_VARIANT].itertuples(index=False, name=None)
        ]
        many = len(self.contenders)
        everywhere = frame.groupby("world", sort=False)["contender"].nunique()
        self.worlds = [str(world) for world in everywhere.index[everywhere == many]]
        """Those in which every agent has run."""
        shared = frame[frame["world"].isin(self.worlds)]
        whole = shared.groupby("seed").size()
        self.seeds = sorted(map(int, whole.index[whole == many * len(self.worlds)]))
        """Those for which all runs are there."""
        if not self.seeds:
            raise InvalidValue(
                "results", f"{len(frame)} runs, of no seed all",
                "results in which every agent has run in every world, for a seed at least",
            )  # fmt: skip
        self.frame: pandas.DataFrame = shared[shared["seed"].isin(self.seeds)]
        """A row a run, as Results.to_pandas gives, and ``contender``, its name."""
        self.left_out = len(frame) - len(self.frame)
        """Runs that have no counterpart."""
        self._by_measure: dict[str, Mapping[str, pandas.DataFrame]] = {}

    def _repr_html_(self) -> str:
        """For notebooks: of each agent, world by world, the median over the seeds of last_ratio."""
        worlds = self.worlds[:_MOST_SHOWN]
        table = self._tables("last_ratio")
        rows = [
            [one.name, *table[one.name][worlds].median().tolist()]
            for one in self.contenders[:_MOST_SHOWN]
        ]
        left = [
            f"{many - _MOST_SHOWN} more {what}"
            for many, what in ((len(self.worlds), "worlds"), (len(self.contenders), "agents"))
            if many > _MOST_SHOWN
        ]
        told = f"Medians over {markup.counted(len(self.seeds), 'seed')} of last_ratio: "
        told += MEASURES["last_ratio"].doc
        return (
            markup.paragraph(told)
            + markup.table(["agent", *worlds], rows)
            + (markup.paragraph(f"and {', '.join(left)}") if left else "")
        )

    @property
    def learners(self) -> list[Contender]:
        """Those that learn."""
        return [one for one in self.contenders if one.learns]

    def scores(
        self, contender: Contender, measure: str, worlds: Sequence[str] | None = None
    ) -> npt.NDArray[np.float64] | None:
        """What a measure has in each run, (seeds, worlds); inf: never.

        Worlds in which it has no value, as where there is no way, are left out; None: it has none.
        """
        table = self._tables(measure)[contender.name]
        values = table[list(worlds or self.worlds)].to_numpy(dtype=float)
        known = values[:, ~np.isnan(values).any(axis=0)]
        return known if known.size else None

    def runs(self, contender: Contender, world: str) -> pandas.DataFrame:
        """Rows of the frame, a seed each."""
        frame = self.frame
        mine = (frame["contender"] == contender.name) & (frame["world"] == world)
        return frame[mine].sort_values("seed")

    def trial(self, run: int) -> Trial:
        """A new trial of what made a run."""
        job = self.results.job(run)
        world = World.from_json(job.world_json)
        return trial_of(job.agent, job.settings, job.trial, world, job.seed)

    def _tables(self, measure: str) -> Mapping[str, pandas.DataFrame]:
        if measure not in self._by_measure:
            worst = 1.0 if MEASURES[measure].fraction else math.inf
            frame = self.frame.assign(
                value=self.frame[measure].where(self.frame["error"].isna(), worst)
            )
            self._by_measure[measure] = {
                str(name): rows.pivot(index="seed", columns="world", values="value")
                for name, rows in frame.groupby("contender")
            }
        return self._by_measure[measure]


def _contenders(variants: Sequence[tuple[str, str, str, str]]) -> list[Contender]:
    read = [(agent, *map(json.loads, rest)) for agent, *rest in variants]
    every = [{**settings, **trial, **schedule} for _, settings, trial, schedule in read]
    contenders = []
    for index, (agent, settings, trial, schedule) in enumerate(read):
        alike = [chosen for chosen, other in zip(every, read) if other[0] == agent]
        chosen = every[index]
        told = [
            _told(name, value)
            for name, value in chosen.items()
            if any(other.get(name) != value for other in alike)
        ]
        name = ", ".join([agent.rpartition(":")[2], *told])
        contenders.append(Contender(name, agent, settings, trial, schedule, look(index)))
    names = [one.name for one in contenders]
    return [  # of two modules' classes of one name, say
        one._replace(name=f"{one.name} ({index + 1})") if names.count(one.name) > 1 else one
        for index, one in enumerate(contenders)
    ]


def _told(name: str, value: Any) -> str:
    if name == "free":
        return f"{sum(value):,} free steps".replace(",", "\u2009") if value else "no free steps"
    return f"{name} {value if isinstance(value, str) else json.dumps(value)}"
