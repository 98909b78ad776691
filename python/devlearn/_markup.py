"""Pieces of HTML and SVG for notebooks: safe text, tables, and pictures of what lies in an arena.

Pictures are in whole units, ten to a pixel: an SVG of whole numbers is short.
"""

from __future__ import annotations

import html
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

PIXEL = 10
_ROW, _LETTERS = 16 * PIXEL, 11 * PIXEL  # of text
_PAPER, _INK = "#FFFFFF", "#222222"

# No XML may hold these, or they turn around what stands beside them.
_UNSHOWABLE = re.compile(
    "[\x00-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]"
)


def shortened(value: object, most: int = 60) -> str:
    """A text without what cannot be shown, of ``most`` letters at most."""
    told = str(value)
    told = told if len(told) <= most else told[: most - 1] + "\u2026"
    return _UNSHOWABLE.sub("\ufffd", told)


def number(value: float | None) -> str:
    """A number for people: thousands apart, floats to four digits; a dash for None and NaN."""
    if value is None or math.isnan(value):
        return "\u2013"
    if math.isinf(value):
        return "\u221e" if value > 0 else "-\u221e"
    if value == int(value) and abs(value) < 1e15:
        return f"{int(value):,}".replace(",", "\u2009")
    return f"{value:.4g}"


def counted(count: int, one: str, many: str = "") -> str:
    """``3 rounds``, ``1 round``."""
    return f"{number(count)} {one if count == 1 else many or one + 's'}"


def element(name: str, *inside: str, **attributes: object) -> str:
    """An element around what is markup already; ``_`` in the names of attributes stands for ``-``.

    Attributes that are None are left out.
    """
    told = "".join(
        f' {key.replace("_", "-")}="{html.escape(str(value))}"'
        for key, value in attributes.items()
        if value is not None
    )
    return f"<{name}{told}>{''.join(inside)}</{name}>" if inside else f"<{name}{told}/>"


def paragraph(*lines: str) -> str:
    """Lines of text."""
    return element("p", "<br/>".join(html.escape(shortened(line, 400)) for line in lines))


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table of HTML; numbers stand to the right, and text is made safe."""

    def cell(kind: str, value: object) -> str:
        if isinstance(value, (int, float, np.number)) or value is None:
            return element(
                kind, number(None if value is None else float(value)), style="text-align: right"
            )
        return element(kind, html.escape(shortened(value, 120)), style="text-align: left")

    above = element("thead", element("tr", *(cell("th", name) for name in head))) if head else ""
    body = (element("tr", *(cell("td", value) for value in row)) for row in rows)
    return element("table", above, element("tbody", *body))


def facts(told: Mapping[str, str | float]) -> str:
    """A table of names and what they are."""
    texts = (value if isinstance(value, str) else number(value) for value in told.values())
    return table((), zip(told, texts))


# --- SVG ------------------------------------------------------------------------------------------


class Frame(NamedTuple):
    """Where an arena lies in a picture."""

    x: float
    """Its left border [m]."""
    y: float
    """Its lower border [m]."""
    width: int
    height: int
    scale: float
    """Units a metre."""

    @classmethod
    def around(cls, origin: Sequence[float], size: tuple[float, float], most: int) -> Frame:
        """Of an arena with this corner and size [m], its longer side ``most`` pixels long."""
        scale = most * PIXEL / max(size)
        width, height = (max(PIXEL, round(side * scale)) for side in size)
        return cls(origin[0], origin[1], width, height, scale)

    def at(self, points: npt.ArrayLike) -> npt.NDArray[np.int64]:
        """Points (x, y) [m] as whole units, to the right and down: (n, 2)."""
        x, y = np.asarray(points, dtype=float).reshape(-1, 2).T
        placed = np.column_stack([x - self.x, self.height / self.scale - (y - self.y)])
        return np.rint(placed * self.scale).astype(np.int64)


class Lines(NamedTuple):
    """Several lines through whole points."""

    points: npt.NDArray[np.int64]
    """(n, 2)"""
    line: npt.NDArray[np.int64]
    """To which line each point belongs, ascending: (n,)."""

    @classmethod
    def of(cls, frame: Frame, lines: Sequence[npt.ArrayLike]) -> Lines:
        """Lines given one by one, (n, 2) each [m]."""
        arrays = [np.empty((0, 2)), *(np.asarray(line) for line in lines)]
        lengths = [len(line) for line in arrays]
        return cls(frame.at(np.concatenate(arrays)), np.repeat(np.arange(len(arrays)), lengths))

    def thinned(self, most: int) -> tuple[Lines, int]:
        """Of ``most`` points at most, on the finest grid on which they are; and its width.

        The grid's width doubles from one unit on; points that fall together are one, and so are
        lines that became the same point. None is left out.
        """
        lines, grid = self._on(1), 1
        while len(lines.points) > most:
            grid *= 2
            lines = lines._on(grid)
        return lines, grid

    def _on(self, grid: int) -> Lines:
        points = np.rint(self.points / grid).astype(np.int64) * grid
        lines = Lines(points, self.line)
        lines = lines._only(np.concatenate([[True], lines._moves().any(axis=1)])[: len(points)])
        moves = lines._moves()
        before, after = moves[:-1], moves[1:]
        same = (lines.line[:-2] == lines.line[2:]) if len(moves) > 1 else np.empty(0, bool)
        straight = before[:, 0] * after[:, 1] == before[:, 1] * after[:, 0]
        straight &= (before * after).sum(axis=1) > 0
        keep = np.ones(len(lines.points), bool)
        keep[1:-1] = ~(same & straight)
        lines = lines._only(keep)
        alone = np.bincount(lines.line, minlength=1)[lines.line] == 1
        _, first = np.unique(lines.points[alone], axis=0, return_index=True)
        keep = ~alone
        keep[np.flatnonzero(alone)[first]] = True
        return lines._only(keep)

    def _moves(self) -> npt.NDArray[np.int64]:
        """From point to point, one more where another line begins: (n - 1, 3)."""
        moves = np.diff(self.points, axis=0)
        return np.column_stack([moves, np.diff(self.line)])

    def _only(self, keep: npt.NDArray[np.bool_]) -> Lines:
        return Lines(self.points[keep], self.line[keep])

    def path(self, closed: bool = False) -> str:
        """The ``d`` of a path; a line of one point is a dot, where its ends are round."""
        begins = np.flatnonzero(np.diff(self.line, prepend=-1))
        moves = np.diff(self.points, axis=0)
        pieces = []
        for begin, end in zip(begins.tolist(), [*begins[1:].tolist(), len(self.points)]):
            x, y = self.points[begin].tolist()
            way = " ".join(map(str, moves[begin : end - 1].ravel().tolist())).replace(" -", "-")
            pieces.append(f"M{x} {y}" + (f"l{way}" if way else "h0") + ("z" if closed else ""))
        return "".join(pieces)


def words(x: int, y: int, told: str, **how: object) -> str:
    """A line of text whose letters stand on y [units]."""
    style = {"font_size": _LETTERS, "fill": _INK, **how}
    return element("text", html.escape(shortened(told, 200)), x=x, y=y, **style)


def picture(title: str, *rows: tuple[int, str], width: int) -> str:
    """An SVG of rows, each so high [units] and drawn from its own (0, 0) on, under each other.

    On paper, for a notebook may be dark; nothing in it has an id, for a page may hold several.
    """
    edge = 8 * PIXEL
    drawn, y = [], edge
    for height, row in rows:
        drawn.append(element("g", row, transform=f"translate({edge} {y})"))
        y += height
    wide, high = width + 2 * edge, y + edge
    return element(
        "svg",
        element("title", html.escape(shortened(title, 200))),
        element("rect", width=wide, height=high, fill=_PAPER),
        *drawn,
        xmlns="http://www.w3.org/2000/svg",
        width=wide // PIXEL,
        height=high // PIXEL,
        viewBox=f"0 0 {wide} {high}",
        role="img",
        font_family="sans-serif",
    )


def caption(*lines: str) -> list[tuple[int, str]]:
    """Rows of text for a picture; empty ones are left out."""
    return [(_ROW, words(0, _LETTERS, line)) for line in lines if line]


def clipped(frame: Frame, *inside: str) -> str:
    """What is drawn of an arena, and nothing beyond its walls."""
    return element("svg", *inside, width=frame.width, height=frame.height)
