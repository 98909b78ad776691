"""Section VI of the paper, all of it: runs, claims, figures, tables and a report."""

from __future__ import annotations

import csv
import json
import math
import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from .. import _core
from ..errors import InvalidValue
from ..experiments.runs import Journal, made_folder, run_all
from ..record import provenance_of, written_aside
from . import figures, schedule
from .claims import Figure, Results, Verdict, judge
from .report import write_report
from .schedule import Measures

Say = Callable[[str], None]


def reproduce(
    output: str | os.PathLike[str],
    *,
    seeds: int = 30,
    workers: int | None = None,
    say: Say = print,
) -> dict[str, list[Verdict]]:
    """Run section VI over ``seeds`` seeds and write figures, tables, numbers and report.html.

    What is finished is kept in ``runs.jsonl``: stopped, it goes on from there. Returns the verdicts
    by preset. Raises InvalidValue for seeds outside 1 ... 1000, FileError where it cannot write.
    """
    if not 1 <= seeds <= 1000:
        raise InvalidValue("seeds", seeds, "a whole number in [1, 1000]")
    began = time.monotonic()
    folder = Path(output)
    world = _core.World.load("paper")
    journal = Journal(folder / "runs.jsonl")
    try:
        results = _run(world, range(1, seeds + 1), journal, workers, say)
    finally:
        journal.close()
    verdicts = {name: judge(result) for name, result in results.items()}

    say("drawing the figures")
    gallery = figures.Gallery(world)
    drawn = {number: gallery.draw(number) for number in figures.FIGURES}
    statistics = [
        figures.draw_rounds_over_seeds({name: result.runs for name, result in results.items()}),
        figures.draw_sigmas(results["paper"].by_sigma),
    ]
    for figure in [figure for group in drawn.values() for figure in group] + statistics:
        save_figure(folder / "figures", figure)

    say("writing tables and report")
    table = table_1(gallery, results)
    write_csv(folder / "table1.csv", table)
    summary = summarise(results, gallery.shortest)
    provenance = provenance_of(world, gallery.config, 1, None)
    provenance |= {"seed": f"1 to {seeds}", "agent": "devlearn.Learner, devlearn.RandomAgent"}
    seconds = time.monotonic() - began
    numbers = {
        "provenance": provenance,
        "seconds": seconds,
        "claims": {
            name: [_plain(verdict) for verdict in list_] for name, list_ in verdicts.items()
        },
        "shortest": gallery.shortest,
        "runs": {name: result._asdict() for name, result in results.items()},
    }
    with written_aside(folder / "numbers.json", "w") as file:
        json.dump(_finite(numbers), file, indent=1)
    write_report(
        folder / "report.html",
        verdicts,
        drawn,
        statistics,
        table,
        summary,
        provenance,
        seeds,
        seconds,
    )
    return verdicts


def draw_figure(output: str | os.PathLike[str], number: int) -> list[Path]:
    """Draw one figure of the paper (0: those beyond it), and nothing else; returns the files."""
    if number not in figures.FIGURES:
        known = ", ".join(map(str, figures.FIGURES))
        raise InvalidValue("figure", number, f"one of {known} (0: what the paper does not draw)")
    folder = Path(output) / "figures"
    return [path for drawn in figures.Gallery().draw(number) for path in save_figure(folder, drawn)]


def save_figure(folder: Path, drawn: figures.Drawn) -> list[Path]:
    """Write a figure as PNG and SVG. Raises FileError."""
    made_folder(folder)
    paths = [folder / f"{drawn.name}.{kind}" for kind in ("png", "svg")]
    for path in paths:
        # No date and no names by chance: the same figure is the same file.
        metadata = {"Date": None} if path.suffix == ".svg" else None
        salted = mpl.rc_context({"svg.hashsalt": drawn.name})
        with salted, written_aside(path, "wb") as file:
            drawn.figure.savefig(file, format=path.suffix[1:], metadata=metadata)
    return paths


# --- runs -----------------------------------------------------------------------------------------


def _run(
    world: _core.World, seeds: Sequence[int], journal: Journal, workers: int | None, say: Say
) -> dict[str, Results]:
    similar = [schedule.similar_world(seed) for seed in seeds]

    def measured(jobs: list[dict[str, Any]], what: str) -> list[Measures]:
        say(f"{what}: {len(jobs)} runs")
        return run_all(schedule.execute, jobs, journal, workers=workers, what=what)

    results = {}
    for name in schedule.PRESETS:
        config = schedule.preset(name)
        starts = schedule.new_starts(world, config)
        shortest = len(_core.shortest_path(_core.Robot(world, config.robot))) - 1

        def jobs(
            config: _core.TrialConfig,
            seeds: Sequence[int],
            shortest: int = shortest,
            **more: Any,
        ) -> list[dict[str, Any]]:
            return [schedule.job(world, config, s, shortest=shortest, **more) for s in seeds]

        runs = measured(jobs(config, seeds, starts=starts), f"{name}: main runs")
        by_sigma = {}
        for sigma in schedule.SIGMAS[name]:
            if sigma == config.learner.sigma:
                by_sigma[sigma] = runs
                continue
            other = config.replace(learner=config.learner.replace(sigma=sigma))
            by_sigma[sigma] = measured(jobs(other, seeds), f"{name}: sigma {sigma:g}")
        reseeded = measured(
            jobs(config, [seed + schedule.RESEEDED for seed in seeds]), f"{name}: other seeds"
        )
        in_similar = measured(
            [
                schedule.job(w, config, seed, rounds=schedule.SIMILAR_ROUNDS)
                for w, seed in zip(similar, seeds)
            ],
            f"{name}: similar worlds",
        )
        # Random motions learn nothing, so they are the same control for both presets.
        plain = schedule.preset("paper")
        random = measured(
            jobs(plain, seeds, agent="random", rounds=schedule.CONTROL_ROUNDS),
            "control: random motions",
        )
        random_in_similar = measured(
            [
                schedule.job(w, plain, s, agent="random", rounds=schedule.SIMILAR_CONTROL_ROUNDS)
                for w, s in zip(similar, seeds)
            ],
            "control: random motions in similar worlds",
        )
        results[name] = Results(runs, random, in_similar, random_in_similar, by_sigma, reseeded)
    return results


# --- tables and numbers ---------------------------------------------------------------------------


def table_1(gallery: figures.Gallery, results: dict[str, Results]) -> list[list[Any]]:
    """Table 1 of the paper beside one settled run and the spread of all; a header row first."""
    one = gallery.settled[0].paths.rounds
    rows: list[list[Any]] = [
        ["round", "paper", f"seed {gallery.settled[0].trial.seed}"]
        + [f"{name} {what}" for name in results for what in ("p10", "median", "p90")]
    ]
    steps = {
        name: np.array([figures.padded(run["round_steps"]) for run in result.runs])
        for name, result in results.items()
    }
    for number, paper in figures.PAPER_TABLE_1.items():
        row: list[Any] = [number, paper, int(one["steps"][one["round"] == number][0])]
        for of_preset in steps.values():
            row += [
                round(float(v), 1) for v in np.percentile(of_preset[:, number - 3], [10, 50, 90])
            ]
        rows.append(row)
    return rows


def summarise(results: dict[str, Results], shortest: int) -> list[list[str]]:
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
                sum(len(run["round_steps"]) < schedule.PATH_ROUNDS for run in runs)
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


def _plain(verdict: Verdict) -> dict[str, Any]:
    def of(figure: Figure) -> dict[str, Any]:
        return {"value": figure.value, "p10": figure.low, "p90": figure.high, "n": figure.runs}

    return {
        "id": verdict.claim["id"],
        "criterion": verdict.claim["criterion"],
        "figure": of(verdict.figure),
        "holds": verdict.holds,
        "control": of(verdict.control),
        "control_holds": verdict.control_holds,
    }


def _finite(value: Any) -> Any:
    """JSON has no NaN: what could not be measured is null."""
    if isinstance(value, dict):
        return {str(key): _finite(v) for key, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(v) for v in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
