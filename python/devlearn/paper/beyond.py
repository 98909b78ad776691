"""Beyond the paper: its learner and the adaptive one in every world that ships."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from ..experiments import store
from ..experiments.measures import settled_from
from ..experiments.schedule import Schedule
from ..experiments.spec import Spec, read
from ..plots.panels import panels, shared_legend
from ..plots.style import BLACK, BLUE, VERMILLION, styled
from . import measures, schedule
from .figures import Drawn
from .measures import Measures

MOST_SEEDS = 10
_LATE = 20


def schedules() -> dict[str, Schedule]:
    """What is run, by preset: the adaptive learner needs no free learning before."""
    return {"paper": schedule.SECTION_VI, "adaptive": schedule.SECTION_VI.replace(free=())}


def planned(worlds: Sequence[str], seeds: Sequence[int]) -> dict[str, Spec]:
    """The sweep of each preset."""
    return {
        preset: read(
            {**plan.to_dict(), "worlds": [*worlds], "agents": [preset], "seeds": [*seeds],
             "keep": "rounds"}
        )
        for preset, plan in schedules().items()
    }  # fmt: skip


def results(
    plan: Mapping[str, Spec], file: store.Results
) -> tuple[dict[str, dict[str, list[Measures]]], dict[str, int]]:
    """What came of the runs, by world and preset, and the steps of each world's shortest path."""
    found: dict[str, dict[str, list[Measures]]] = {}
    shortest = {}
    for preset, spec in plan.items():
        for row in file.rows(spec.jobs()):
            rounds = file.rounds(row["run"])
            measured = measure(rounds, len(schedules()[preset].free))
            found.setdefault(row["world"], {}).setdefault(preset, []).append(measured)
            shortest[row["world"]] = row["shortest"]
    return found, shortest


def measure(rounds: npt.NDArray[np.void], frees: int) -> Measures:
    """Steps of the rounds of path learning, and what became of them."""
    paths = rounds[frees:]
    settled = settled_from(paths, measures.SETTLED_ROUNDS)
    return {
        "steps": paths["steps"].tolist(),
        "arrived": paths["arrived"].tolist(),
        "settled": None if settled is None else settled + 1,
        "total": int(rounds["steps"].sum()),
    }


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
