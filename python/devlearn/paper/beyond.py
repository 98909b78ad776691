"""Beyond the paper: its learner and the adaptive one in every world that ships."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import Trial, TrialConfig, World
from ..experiments import contenders
from ..experiments.schedule import Schedule
from ..plots.panels import panels, shared_legend
from ..plots.style import BLACK, BLUE, VERMILLION, styled
from ..record import Record
from . import measures, places, schedule
from .figures import Drawn
from .measures import Measures

MOST_SEEDS = 10
_LATE = 20


def schedules() -> dict[str, Schedule]:
    """What is run, by preset: the adaptive learner needs no free learning before."""
    return {"paper": schedule.SECTION_VI, "adaptive": schedule.SECTION_VI.replace(free=())}


def planned(worlds: Sequence[str], seeds: Sequence[int]) -> list[dict[str, Any]]:
    """The runs, as plain values."""
    return [
        {
            "beyond": True,
            "world": World.load(world).to_json(),
            "config": contenders.preset(name).to_dict(),
            "seed": seed,
            "schedule": plan.to_dict(),
        }
        for world in worlds
        for name, plan in schedules().items()
        for seed in seeds
    ]


def execute(job: Mapping[str, Any]) -> Measures:
    """Makes a run: steps of its rounds of path learning, and what became of them."""
    config = TrialConfig.from_dict(job["config"])
    trial = Trial(World.from_json(job["world"]), config, job["seed"])
    plan = Schedule(**job["schedule"])
    whole = Record.concatenate([*plan.parts(trial)])
    paths = whole.part(slice(len(plan.free), None))
    arrived = paths.rounds["arrived"]
    settled = measures.settled_round(paths)
    return {
        "steps": paths.rounds["steps"].tolist(),
        "arrived": arrived.tolist(),
        "settled": None if settled is None else settled - len(plan.free),
        "total": len(whole),
    }


def by_world(
    worlds: Sequence[str], seeds: Sequence[int], runs: Sequence[Measures]
) -> dict[str, dict[str, list[Measures]]]:
    """Runs by world and preset, in the order in which they were planned."""
    found = iter(runs)
    return {
        name: {preset: [next(found) for _ in seeds] for preset in schedules()} for name in worlds
    }


def shortest_of(worlds: Sequence[str]) -> dict[str, int]:
    """Steps of the shortest path in each."""
    return {name: places.shortest(World.load(name), TrialConfig.paper()) for name in worlds}


def _rounds(run: Measures, count: int, limit: int) -> npt.NDArray[np.float64]:
    """Steps by round; where it failed, and where the run ended early, the limit."""
    steps = np.full(count, limit, dtype=float)
    arrived = np.asarray(run["arrived"], dtype=bool)
    steps[: len(arrived)] = np.where(arrived, run["steps"], limit)
    return steps


@styled
def draw(
    found: Mapping[str, Mapping[str, Sequence[Measures]]], shortest: Mapping[str, int]
) -> Drawn:
    """Steps by round in each world under both presets."""
    columns = 4
    figure, axes = panels(-(-len(found) // columns), columns, width=9.6, height=4.8)
    for (name, by_preset), ax in zip(found.items(), axes):
        for (preset, runs), color, line in zip(by_preset.items(), (BLUE, VERMILLION), ("-", "--")):
            plan = schedules()[preset]
            steps = np.array([_rounds(run, plan.rounds, plan.step_limit) for run in runs])
            low, median, high = np.percentile(steps, [10, 50, 90], axis=0)
            rounds = np.arange(1, plan.rounds + 1)
            ax.fill_between(rounds, low, high, color=color, alpha=0.18, linewidth=0)
            ax.plot(rounds, median, line, color=color, label=preset)
        ax.axhline(shortest[name], color=BLACK, linewidth=0.8, linestyle=":", label="shortest path")
        ax.set(xscale="log", yscale="log", title=name, xlabel="round")
    for ax in axes[len(found) :]:
        ax.set_axis_off()
    for ax in axes[::columns]:
        ax.set_ylabel("steps of the round")
    shared_legend(figure, axes[:1])
    return Drawn(
        "beyond_presets",
        figure,
        "Steps by round in the worlds that ship, median and 10th to 90th percentile of the runs; a "
        "round that failed, or that a run without hope left out, stands at 10 000.",
    )


def table(
    found: Mapping[str, Mapping[str, Sequence[Measures]]], shortest: Mapping[str, int]
) -> list[list[str]]:
    """A row a world: what each preset came to."""
    rows = [["world", "shortest path"]]
    for preset in schedules():
        rows[0] += [
            f"{preset}: last round / shortest", "settled, from round",
            f"failed after round {_LATE}", "steps in all",
        ]  # fmt: skip
    for name, by_preset in found.items():
        row = [name, str(shortest[name])]
        for preset, runs in by_preset.items():
            plan = schedules()[preset]
            last = [_rounds(run, plan.rounds, plan.step_limit)[-1] for run in runs]
            settled = [run["settled"] for run in runs if run["settled"] is not None]
            arrived = sum(step < plan.step_limit for step in last)
            late = sum(
                int(np.sum(_rounds(run, plan.rounds, plan.step_limit)[_LATE:] >= plan.step_limit))
                for run in runs
            )
            row += [
                f"{np.median(last) / shortest[name]:.2f}" if 2 * arrived > len(runs) else "fails",
                f"{len(settled)} of {len(runs)}"
                + (f", {np.median(settled):.0f}" if settled else ""),
                f"{late / max(1, len(runs) * (plan.rounds - _LATE)):.1%}",
                f"{np.median([run['total'] for run in runs]) / 1e3:.0f} thousand",
            ]
        rows.append(row)
    return rows
