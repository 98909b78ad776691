"""Section VI of the paper, all of it: runs, claims, figures, tables and a report."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from .. import _core
from .._files import owned_folder
from .._worlds import worlds
from ..errors import InvalidValue
from ..experiments.contenders import preset
from ..experiments.runs import Journal, run_all
from ..record import provenance_of, written_aside
from . import beyond, figures, jobs, places, schedule
from .claims import Results, Verdict, judge
from .figures import save_figure
from .measures import Measures
from .report import write_report
from .tables import summarise, table_1, verdict_as_values, without_nan, write_csv

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
    by preset. Raises InvalidValue for seeds outside 1 ... 1000, FileError where it cannot write or
    another process does.
    """
    if not 1 <= seeds <= 1000:
        raise InvalidValue("seeds", seeds, "a whole number in [1, 1000]")
    with owned_folder(output) as folder:
        return _reproduce(folder, seeds, workers, say)


def _reproduce(folder: Path, seeds: int, workers: int | None, say: Say) -> dict[str, list[Verdict]]:
    began = time.monotonic()
    world = _core.World.load("paper")
    journal = Journal(folder / "runs.jsonl")
    if journal.damaged:
        say(f"{journal.damaged} damaged entries of runs.jsonl are run again")
    try:
        results = _run(world, range(1, seeds + 1), journal, workers, say)
        everywhere, shortest = _run_beyond(seeds, journal, workers, say)
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
    presets = beyond.draw(everywhere, shortest)
    save_figure(folder / "figures", presets)
    presets_table = beyond.table(everywhere, shortest)
    write_csv(folder / "beyond.csv", presets_table)
    table = table_1(gallery.settled[0], results)
    write_csv(folder / "table1.csv", table)
    summary = summarise(results, gallery.shortest)
    provenance = provenance_of(world, gallery.config, 1, None)
    provenance |= {"seed": f"1 to {seeds}", "agent": "devlearn.Learner, devlearn.RandomAgent"}
    seconds = time.monotonic() - began
    numbers = {
        "provenance": provenance,
        "seconds": seconds,
        "claims": {name: list(map(verdict_as_values, v)) for name, v in verdicts.items()},
        "shortest": gallery.shortest,
        "runs": {name: result._asdict() for name, result in results.items()},
        "beyond": everywhere,
    }
    with written_aside(folder / "numbers.json", "w") as file:
        json.dump(without_nan(numbers), file, indent=1)
    write_report(
        folder / "report.html",
        verdicts,
        drawn,
        statistics,
        table,
        summary,
        (presets, presets_table),
        provenance,
        seeds,
        seconds,
    )
    return verdicts


# --- runs -----------------------------------------------------------------------------------------


def _run(
    world: _core.World, seeds: Sequence[int], journal: Journal, workers: int | None, say: Say
) -> dict[str, Results]:
    similar = [_core.World.random("similar", seed) for seed in seeds]

    def measured(planned: list[dict[str, Any]], what: str) -> list[Measures]:
        say(f"{what}: {len(planned)} runs")
        return run_all(jobs.execute, planned, journal, workers=workers, what=what)

    results = {}
    for name in schedule.READINGS:
        config = preset(name)
        starts = places.new_starts(world, config)
        shortest = places.shortest(world, config)

        def planned(
            config: _core.TrialConfig,
            seeds: Sequence[int],
            shortest: int = shortest,
            **more: Any,
        ) -> list[dict[str, Any]]:
            return [jobs.job(world, config, s, shortest=shortest, **more) for s in seeds]

        runs = measured(planned(config, seeds, starts=starts), f"{name}: main runs")
        by_sigma = {}
        for sigma in schedule.SIGMAS[name]:
            assert isinstance(config.learner, _core.LearnerConfig)
            if sigma == config.learner.sigma:
                by_sigma[sigma] = runs
                continue
            other = config.replace(learner=config.learner.replace(sigma=sigma))
            by_sigma[sigma] = measured(planned(other, seeds), f"{name}: sigma {sigma:g}")
        reseeded = measured(
            planned(config, [seed + schedule.RESEEDED for seed in seeds]), f"{name}: other seeds"
        )
        in_similar = measured(
            [
                jobs.job(w, config, seed, rounds=schedule.SIMILAR_ROUNDS)
                for w, seed in zip(similar, seeds)
            ],
            f"{name}: similar worlds",
        )
        # Random motions learn nothing, so they are the same control for both presets.
        plain = preset("paper")
        random = measured(
            planned(plain, seeds, agent="random", rounds=schedule.CONTROL_ROUNDS),
            "control: random motions",
        )
        random_in_similar = measured(
            [
                jobs.job(w, plain, s, agent="random", rounds=schedule.SIMILAR_CONTROL_ROUNDS)
                for w, s in zip(similar, seeds)
            ],
            "control: random motions in similar worlds",
        )
        results[name] = Results(runs, random, in_similar, random_in_similar, by_sigma, reseeded)
    return results


def _run_beyond(
    seeds: int, journal: Journal, workers: int | None, say: Say
) -> tuple[dict[str, dict[str, list[Measures]]], dict[str, int]]:
    names = worlds()
    used = range(1, min(seeds, beyond.MOST_SEEDS) + 1)
    jobs_beyond = beyond.planned(names, used)
    what = "beyond the paper: both presets in every world"
    say(f"{what}: {len(jobs_beyond)} runs")
    runs = run_all(beyond.execute, jobs_beyond, journal, workers=workers, what=what)
    return beyond.by_world(names, used, runs), beyond.shortest_of(names)
