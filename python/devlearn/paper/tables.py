"""Tables and numbers of the report, of measures that are there."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..record import written_aside
from . import schedule
from .claims import Figure, Results, Verdict
from .measures import Measures

# Table 1 of the paper: steps of different rounds.
PAPER_TABLE_1 = {
    33: 194, 95: 177, 130: 165, 202: 164, 246: 153, 247: 151,
    253: 154, 288: 152, 301: 155, 313: 150, 341: 149, 382: 149,
}  # fmt: skip


def steps_over_runs(runs: Sequence[Mapping[str, Any]]) -> npt.NDArray[np.float64]:
    """Steps of each round, over the runs: 10th percentile, median and 90th, (3, rounds).

    The rounds that a run was not given as it was hopeless count as failed.
    """
    rounds, limit = schedule.SECTION_VI.rounds, schedule.SECTION_VI.step_limit
    steps = [run["round_steps"] for run in runs]
    padded = [[*of_run, *[limit] * (rounds - len(of_run))] for of_run in steps]
    return np.asarray(np.percentile(padded, [10, 50, 90], axis=0))


def table_1(one: schedule.Run, results: Mapping[str, Results]) -> list[list[Any]]:
    """Table 1 of the paper beside a run that settled and the spread of all; a header row first."""
    rounds = one.paths.rounds
    rows: list[list[Any]] = [
        ["round", "paper", f"seed {one.trial.seed}"]
        + [f"{name} {what}" for name in results for what in ("p10", "median", "p90")]
    ]
    spreads = [steps_over_runs(result.runs) for result in results.values()]
    for number, paper in PAPER_TABLE_1.items():
        row: list[Any] = [number, paper, int(rounds["steps"][rounds["round"] == number][0])]
        for spread in spreads:
            row += [round(float(steps), 1) for steps in spread[:, number - 3]]
        rows.append(row)
    return rows


def summarise(results: Mapping[str, Results], shortest: int) -> list[list[str]]:
    """What became of the main runs, a column a preset; a header row first."""

    def column(runs: Sequence[Measures]) -> dict[str, str]:
        settled = [run for run in runs if run["settles"]]
        lengths = [run["round_steps"][-1] for run in settled]
        failed = [run["every_round_arrives"] for run in runs]
        return {
            "runs": str(len(runs)),
            "target first reached, round 1 [step]": _spread([r["first_arrival"] for r in runs]),
            "runs that settled": f"{len(settled)}",
            "settled from round": _spread([run["settled_early"] for run in settled]),
            f"steps of the settled path (shortest: {shortest})": _spread(lengths),
            "different settled paths": str(len({run["habit"] for run in settled})),
            "steps of the last round": _spread([run["round_steps"][-1] for run in runs]),
            "runs with a round that never arrived": str(sum(count > 0 for count in failed)),
            "runs ended early as hopeless": str(
                sum(len(run["round_steps"]) < schedule.SECTION_VI.rounds for run in runs)
            ),
            "mappings explored": _spread([run["mappings_explored"] for run in runs]),
            "mappings effective at the end": _spread([run["mappings_effective"] for run in runs]),
        }

    columns = [column(result.runs) for result in results.values()]
    rows = [[name, *(column[name] for column in columns)] for name in columns[0]]
    return [["median (10th to 90th percentile)", *results], *rows]


def _spread(values: Sequence[float]) -> str:
    if not values:
        return "none"
    low, median, high = np.percentile(values, [10, 50, 90])
    return f"{median:.0f} ({low:.0f} to {high:.0f})"


def write_csv(path: Path, rows: Sequence[Sequence[Any]]) -> None:
    """Write rows as CSV. Raises FileError."""
    with written_aside(path, "w") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def verdict_as_values(verdict: Verdict) -> dict[str, Any]:
    """A verdict for numbers.json."""

    def of(figure: Figure) -> dict[str, Any]:
        return {"value": figure.value, "p10": figure.low, "p90": figure.high, "n": figure.runs}

    return {
        "id": verdict.claim["id"],
        "criterion": verdict.claim["criterion"],
        "figure": of(verdict.figure),
        "holds": verdict.holds,
        "control": of(verdict.control),
        "control_holds": verdict.control_holds,
        "by_definition": verdict.claim.get("by_definition", {}).get("part"),
    }


def without_nan(value: Any) -> Any:
    """The same values for JSON, which has no NaN: what could not be measured is null."""
    if isinstance(value, dict):
        return {str(key): without_nan(v) for key, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [without_nan(v) for v in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
