"""Runs what is to be compared, and writes the page."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Sequence
from itertools import islice
from pathlib import Path

from .._calls import path_text
from .._files import made_folder
from .._settings import unknown
from ..errors import InvalidValue
from ..experiments import spec as specs
from ..experiments.spec import Spec
from ..experiments.store import Results
from ..experiments.sweep import sweep
from . import ablations as ablated
from .compared import BOUND, FLOOR, Compared
from .maps import REACH
from .report import write_report

SHIPPED = Path(__file__).with_name("compare.toml")
REFERENCES = ("adaptive", "paper")
MAPPED_WORLDS, MAPPED_SEEDS = 3, 2

Say = Callable[[str], None]


def compare(
    source: str | os.PathLike[str] | None = None,
    output: str | os.PathLike[str] = "out/compare",
    *,
    seeds: str | Sequence[int] | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    references: Sequence[str] | None = None,
    maps: int = MAPPED_WORLDS,
    ablations: bool = False,
    say: Say = print,
) -> Path:
    """Compare agents and write report.html into the folder ``output``; returns its path.

    ``source`` is a sweep's TOML file (None: the one that ships), which is run into results.sqlite
    in the folder, or goes on there; or the results of a sweep that kept its rounds, which are only
    read. ``seeds`` in place of the sweep's, ``workers`` and ``scheduler`` are as in
    `devlearn.sweep`. ``references``: agents, by name, that all others are compared with, pair by
    pair (None: those of adaptive and paper that take part). ``maps``: in so many worlds, the first
    ones, for the first two seeds, it is tried from every start there is how far what was learned
    carries. ``ablations`` runs the settings of devlearn's methods, too, each alone away from its
    default; once run they stay in the page.

    Ctrl-C raises KeyboardInterrupt; what is finished is kept. Raises InvalidValue, FileError.
    """
    if type(maps) is not int or maps < 0:
        raise InvalidValue("maps", repr(maps), "a whole number, at least 0")
    file = None if source is None else Path(path_text(source))
    chosen = None if seeds is None else specs.seeds_of(seeds)
    if file is not None and _is_results(file):
        if chosen is not None:
            raise InvalidValue("seeds", seeds, "none: results are compared as they are")
        results = Results(file)
        folder = made_folder(output)
    else:
        asked = specs.read(SHIPPED if file is None else file)
        agents = {one.agent.rpartition(":")[2] for one in asked.variants}
        for name in references or ():  # before all is run; what was set follows a comma
            if name.partition(", ")[0].rpartition(":")[2] not in agents:
                raise unknown("reference", name, sorted(agents))
        folder = made_folder(output)
        results = _run(_of_seeds(asked, chosen), folder, workers, scheduler, maps, say)
    settings = folder / "ablations.sqlite"
    if ablations:
        each = _of_seeds(ablated.read(), chosen)
        say(f"{len(each)} runs, each with one setting changed")
        sweep(each, settings, workers=workers, scheduler=scheduler)
    path = folder / "report.html"
    compared = Compared(results)
    if references is None:
        compete = {one.agent for one in compared.contenders}
        references = [name for name in REFERENCES if name in compete]
    effects = Compared(Results(settings)) if settings.exists() else None
    write_report(path, compared, references, effects)
    return path


def _is_results(file: Path) -> bool:
    """By its first bytes, whatever its name is."""
    try:
        with file.open("rb") as opened:
            return opened.read(16) == b"SQLite format 3\0"
    except OSError:
        return False  # reading it as a sweep's file says what is wrong


def _of_seeds(asked: Spec, seeds: list[int] | None) -> Spec:
    if seeds is None:
        return asked
    return dataclasses.replace(asked, seeds=seeds, values={**asked.values, "seeds": seeds})


def _run(
    asked: Spec, folder: Path, workers: int | None, scheduler: str | None, maps: int, say: Say,
) -> Results:  # fmt: skip
    keep = asked.keep if asked.keep == "record" else "rounds"
    asked = dataclasses.replace(asked, keep=keep, values={**asked.values, "keep": keep})
    path = folder / "results.sqlite"
    if maps:
        some = dataclasses.replace(
            asked,
            worlds=dict(islice(asked.worlds.items(), maps)),
            variants=[one for one in asked.variants if one.agent not in (FLOOR, BOUND)],
            seeds=asked.seeds[:MAPPED_SEEDS],
            measures=[*asked.measures, REACH],
        )
        if len(some):
            say(f"{len(some)} runs with their maps")
            sweep(some, path, workers=workers, scheduler=scheduler)
    say(f"{len(asked)} runs: {len(asked.worlds)} worlds, {len(asked.variants)} agents with "
        f"settings, {len(asked.seeds)} seeds")  # fmt: skip
    return sweep(asked, path, workers=workers, scheduler=scheduler)
