"""Figures of several plots, and their files."""

from __future__ import annotations

from collections.abc import Sequence
from typing import IO, Any

import matplotlib as mpl
from matplotlib.figure import Figure as Figure

from .style import COLUMN

WIDE = 7.2  # two journal columns [inches]


def panels(
    rows: int,
    columns: int,
    *,
    width: float | None = None,
    height: float = 3.4,
    projections: Sequence[str | None] = (),
) -> tuple[Figure, list[Any]]:
    """A figure [inches] and its axes, row by row; ``projections`` of the first of them."""
    width = width or (WIDE if columns > 1 else COLUMN)
    figure = Figure(figsize=(width, height), layout="constrained")
    count = rows * columns
    kinds = [*projections, *[None] * (count - len(projections))]
    axes = [
        figure.add_subplot(rows, columns, i, projection=kind) for i, kind in enumerate(kinds, 1)
    ]
    return figure, axes


def shared_legend(figure: Figure, axes: Sequence[Any]) -> None:
    """One legend below all panels, without the counts, which are not the same in all."""
    entries: dict[str, Any] = {}
    for ax in axes:
        for handle, label in zip(*ax.get_legend_handles_labels()):
            entries.setdefault(label.split(" (")[0], handle)
    figure.legend(entries.values(), entries.keys(), loc="outside lower center", ncols=len(entries))


def write_picture(figure: Figure, file: IO[bytes], kind: str, name: str) -> None:
    """As "png" or "svg"; the same figure under the same name is the same file, whenever made."""
    metadata = {"Date": None} if kind == "svg" else None
    with mpl.rc_context({"svg.hashsalt": name}):
        figure.savefig(file, format=kind, metadata=metadata)
