"""Section VI of the paper, all of it: runs, claims, figures, tables and a report."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from pathlib import Path

from .. import _core
from .._files import owned_folder
from .._worlds import worlds
from ..errors import FileError, InvalidValue
from ..experiments import store
from ..experiments.spec import Together
from ..experiments.sweep import sweep
from ..record import provenance_of, written_aside
from . import beyond, figures, schedule, sweeps
from .claims import Results, Verdict, judge
from .figures import save_figure
from .measures import Measures
from .report import write_report
from .tables import summarise, table_1, verdict_as_values, without_nan, write_csv

RUNS = "runs.sqlite"
Say = Callable[[str], None]


def reproduce(
    output: str | os.PathLike[str],
    *,
    seeds: int = 30,
    workers: int | None = None,
    say: Say = print,
) -> dict[str, list[Verdict]]:
    """Run section VI over ``seeds`` seeds and write figures, tables, numbers and report.html.

    What is finished is kept in ``runs.sqlite``, the results of a sweep: stopped, it goes on from
    there. Such a file of other code, or damaged, is moved aside, and all is run again. Returns the
    verdicts by preset. Raises InvalidValue for seeds outside 1 ... 1000, FileError where it cannot
    write or another process does.
    """
    if not 1 <= seeds <= 1000:
        raise InvalidValue("seeds", seeds, "a whole number in [1, 1000]")
    with owned_folder(output) as folder:
        return _reproduce(folder, seeds, workers, say)


def _reproduce(folder: Path, seeds: int, workers: int | None, say: Say) -> dict[str, list[Verdict]]:
    began = time.monotonic()
    world = _core.World.load("paper")
    results, everywhere, shortest = _run(folder / RUNS, seeds, workers, say)
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
    path: Path, seeds: int, workers: int | None, say: Say
) -> tuple[dict[str, Results], dict[str, dict[str, list[Measures]]], dict[str, int]]:
    """All runs, in one sweep: section VI's by preset, those beyond it, and their shortest paths."""
    _make_room(path, say)
    numbers = range(1, seeds + 1)
    by_preset = {name: sweeps.planned(name, numbers) for name in schedule.READINGS}
    further = beyond.planned(worlds(), numbers[: beyond.MOST_SEEDS])
    planned = [spec for plan in by_preset.values() for spec in plan.all()]
    asked = Together([*planned, *further.values()])
    say(f"{len(asked)} runs of section VI, and of two presets in every world")
    file = sweep(asked, path, workers=workers, retry_failed=True)
    errors = [row["error"] for row in file.rows(asked.jobs()) if row["error"]]
    if errors:
        raise RuntimeError(f"{len(errors)} runs failed, the first by\n{errors[0]}")
    results = {name: sweeps.results(plan, file) for name, plan in by_preset.items()}
    return results, *beyond.results(further, file)


def _make_room(path: Path, say: Say) -> None:
    """Moves a file aside with which the runs cannot go on."""
    if not path.is_file():
        return
    try:
        file = store.Results(path)
        file.check()
        if file.current:
            return
        end, why = ".other", f"{path}: runs of devlearn {file.meta['devlearn']}, of other code"
    except FileError as error:
        end, why = ".damaged", str(error)
    say(f"{why}; it is kept as {store.set_aside(path, end)}, and all is run again")
