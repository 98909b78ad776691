"""The report: one HTML file that needs nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from .. import _pages
from ..record import written_aside
from . import schedule
from .claims import Verdict
from .figures import Drawn


def write_report(
    path: Path,
    verdicts: Mapping[str, Sequence[Verdict]],
    drawn: Mapping[int, Sequence[Drawn]],
    statistics: Sequence[Drawn],
    table_1: Sequence[Sequence[Any]],
    summary: Sequence[Sequence[Any]],
    presets: tuple[Drawn, Sequence[Sequence[Any]]],
    provenance: Mapping[str, Any],
    seeds: int,
    seconds: float,
) -> None:
    """Write the report to one file, with the pictures that are in ``figures`` beside it.

    ``verdicts`` by preset, ``drawn`` by the paper's number, ``presets`` of every world: picture and
    table. Raises FileError.
    """

    def data_uri(figure: Drawn) -> str:
        return _pages.data_uri((path.parent / "figures" / f"{figure.name}.png").read_bytes())

    environment = _pages.environment(Path(__file__).parent)
    environment.filters |= {
        "data_uri": data_uri,
        "width": lambda figure: round(figure.figure.get_figwidth() * 120),
        "figure": lambda value: value if isinstance(value, str) else f"{value:.4g}",
    }
    page = environment.get_template("report.html").render(
        verdicts=verdicts,
        rows=[list(zip(verdicts, row)) for row in zip(*verdicts.values())],
        drawn=drawn,
        statistics=statistics,
        table_1=table_1,
        summary=summary,
        presets=presets,
        provenance=provenance,
        schedule=schedule.SECTION_VI,
        seeds=seeds,
        seconds=seconds,
    )
    with written_aside(path, "w") as file:
        file.write(page)
