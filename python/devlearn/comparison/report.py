"""The page: one HTML file that needs nothing else."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .. import _pages
from ..errors import InvalidValue
from ..experiments.measures import MEASURES
from ..record import written_aside
from . import figures, tables
from .ablations import effects
from .compared import Compared, Contender
from .findings import findings
from .worst import can_be_made_again, worst_run

_SHIPPED_FIRST = 7  # worlds that are shown at once; more are unfolded


def write_report(
    path: Path, compared: Compared, references: Sequence[str], ablations: Compared | None = None
) -> None:
    """Write the page, the same bytes for the same results. Raises InvalidValue, FileError."""
    against = _named(compared, references)
    environment = _pages.environment(Path(__file__).parent)
    environment.filters["data_uri"] = lambda picture: _pages.data_uri(picture.png)
    made_again = can_be_made_again(compared.results)
    worst = [worst_run(compared, one) for one in compared.learners] if made_again else []
    page = environment.get_template("report.html").render(
        compared=compared,
        n=figures.of_seeds(compared),
        swatches=figures.swatches(compared.contenders),
        overview=tables.over_all_worlds(compared),
        findings=findings(compared, against),
        references=against,
        learning=[*figures.learning(compared)],
        first=_SHIPPED_FIRST,
        profiles=[*figures.profiles(compared)],
        improvements=[*figures.improvements(compared, against)],
        wastes=[*figures.wastes(compared)],
        by_world=[(one, tables.by_world(compared, one)) for one in MEASURES.values()],
        generalisation=[*figures.generalisation(compared)],
        failures=tables.failures(compared),
        errors=_errors(compared),
        made_again=made_again,
        worst=[figures.worst(run) for run in worst if run is not None],
        effects=[*effects(ablations)] if ablations is not None else [],
        settings=[(one, _settings(one)) for one in compared.contenders],
        provenance=_provenance(compared),
    )
    with written_aside(path, "w") as file:
        file.write(page)


def _named(compared: Compared, names: Sequence[str]) -> list[Contender]:
    """The contenders of these names, or the first one of an agent of the name."""
    found = []
    for name in names:
        named = [one for one in compared.contenders if name in (one.name, one.agent)]
        if not named:
            known = ", ".join(one.name for one in compared.contenders)
            raise InvalidValue("reference", repr(name), f"one of {known}")
        found.append(named[0])
    return found


def _errors(compared: Compared) -> list[tuple[str, str, int, str]]:
    """Of the runs that ended by an error: who, where, the seed, the last line of the traceback."""
    frame = compared.frame[compared.frame["error"].notna()]
    return [
        (row.contender, row.world, int(row.seed), row.error.strip().splitlines()[-1])
        for row in frame.itertuples()
    ]


def _settings(one: Contender) -> str:
    """What was set, and how it was run."""
    chosen = {**one.settings, **one.trial}
    told = ", ".join(f"{name} = {json.dumps(value)}" for name, value in chosen.items())
    return told or "defaults"


def _provenance(compared: Compared) -> dict[str, Any]:
    meta, frame = compared.results.meta, compared.frame
    return {
        "devlearn": meta["devlearn"],
        "commit": meta["commit"],
        "box2d": meta["box2d"],
        "results": compared.results.path.name,
        "runs": len(frame),
        "processor_seconds": round(float(frame["run_seconds"].sum()), 1),
        "hosts": sorted(set(frame["run_host"])),
        "finished": [frame["run_finished"].min(), frame["run_finished"].max()],
        "spec": json.loads(meta["spec"]),
    }
