"""One page of HTML that shows a record or a world: everything it needs is in it."""

from __future__ import annotations

import html
import os
import re
from pathlib import Path

from .._calls import shown
from .._core import TrialConfig, World
from ..errors import InvalidValue, WrongType
from ..record import Record, written_aside
from . import contents

MOST_STEPS = 300_000  # on a page

_PARTS = Path(__file__).with_name("parts")
# In the order in which they build on each other.
_SCRIPTS = (
    "unpack.js", "learner.js", "run.js", "geometry.js", "ground.js", "trail.js", "preferences.js",
    "stage.js", "charts.js", "panel.js", "controls.js", "player.js",
)  # fmt: skip


def page(
    what: Record | World, *, config: TrialConfig | None = None, most_steps: int = MOST_STEPS
) -> str:
    """The page, as HTML: a record to play, or a world to look at.

    It needs no network, no server and no other file. ``config`` is of a world alone (its robot,
    its SEF), by default the paper's; a record has its own. Of a record of more than ``most_steps``
    steps some rounds are shown, or some steps of each, and the page says so.

    Of the learner a page shows what the record tells: everything where the record carries it
    (``learner=True`` of a trial's phases), or begins before anything was learned. Raises
    InvalidValue, and FileError where the learner that a record carries cannot be read.
    """
    if type(most_steps) is not int or most_steps < 1:
        raise InvalidValue("most_steps", most_steps, "a whole number, at least 1")
    if isinstance(what, World):
        name, data = what.name, contents.of_world(what, config or TrialConfig())
    elif isinstance(what, Record):
        if config is not None:
            raise InvalidValue("config", "given, with a record", "none: a record has its own")
        name, data = what.world.name, contents.of_record(what, most_steps)
    else:
        raise WrongType("what", shown(what), "a Record or a World")
    parts = {
        "title": html.escape("".join(filter(str.isprintable, name)) or "World"),
        "style": _part("style.css"),
        "script": "\n".join(map(_part, _SCRIPTS)),
        "data": data,
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda place: parts[place[1]], _part("page.html"))


def write_page(
    path: str | os.PathLike[str],
    what: Record | World,
    *,
    config: TrialConfig | None = None,
    most_steps: int = MOST_STEPS,
) -> None:
    """Writes ``page(what)`` to a file. Raises FileError, and what ``page`` does."""
    text = page(what, config=config, most_steps=most_steps)
    with written_aside(path, "w") as file:
        file.write(text)


def _part(name: str) -> str:
    return (_PARTS / name).read_text(encoding="utf-8")
