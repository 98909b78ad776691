"""Figures of several plots, and their files."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from typing import IO, Any

import matplotlib as mpl
from matplotlib.axes import Axes as Axes
from matplotlib.figure import Figure as Figure
from matplotlib.figure import SubFigure

from ..errors import InvalidValue
from ..record import written_aside
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


def save(axes: Axes, path: str | os.PathLike[str]) -> None:
    """Write the figure that these axes are in, as the end of its name says: png, svg or pdf.

    To the side first, then renamed. Raises InvalidValue for any other ending, FileError.
    """
    name = os.fsdecode(path)
    kind = name.rpartition(".")[2].lower()
    if kind not in ("png", "svg", "pdf"):
        raise InvalidValue("path", repr(name), "a name that ends in .png, .svg or .pdf")
    with written_aside(path, "wb") as file:
        write_picture(figure_of(axes), file, kind, os.path.basename(name))


def figure_of(axes: Axes) -> Figure:
    """The whole figure that these axes are in."""
    figure = axes.figure
    while isinstance(figure, SubFigure):
        figure = figure.figure
    return figure


def png(axes: Axes) -> bytes:
    """The figure that these axes are in, as a PNG file has it."""
    content = io.BytesIO()
    write_picture(figure_of(axes), content, "png", "")
    return content.getvalue()


def write_picture(figure: Figure, file: IO[bytes], kind: str, name: str) -> None:
    """As "png", "svg" or "pdf"; the same figure and name give the same file, whenever made."""
    metadata = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind)
    with mpl.rc_context({"svg.hashsalt": name}):
        figure.savefig(file, format=kind, metadata=metadata)
