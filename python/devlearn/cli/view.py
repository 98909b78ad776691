"""``devlearn view``: a page that plays a record, or shows a world."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .console import say
from .run import PHASES

if TYPE_CHECKING:
    from .._core import World
    from ..record import Record

_DESCRIPTION = """\
Writes one page of HTML that plays what was recorded, step by step and round by
round, and tells of any situation what the learner knows there and why it chose
as it did; or that shows a world. The page opens by a double click and needs no
network, no server and no other file."""
_EPILOG = """\
examples:
  devlearn view out/run                      # all that devlearn run recorded
  devlearn view out/run/paths.npz --rounds 1:20
  devlearn view office --output office.html
"""


def add_to(verbs: Any) -> None:
    """Adds the verb to the command line's."""
    parser = verbs.add_parser(
        "view",
        help="a page that plays a record, or shows a world",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "what", nargs="+", metavar="RECORD|WORLD",
        help="records of one trial in a row, a folder of devlearn run, a trial's snapshot with its "
        "record, a world file, or a world that ships",
    )  # fmt: skip
    parser.add_argument(
        "--rounds", metavar="A:B",
        help="rounds A to B of a record alone, by their numbers; either may be left out",
    )  # fmt: skip
    parser.add_argument(
        "--config", metavar="FILE", help="a TrialConfig as JSON: robot and SEF of a world alone"
    )
    parser.add_argument(
        "--output", default="page.html", metavar="FILE",
        help="to write, .html (default: %(default)s)",
    )  # fmt: skip
    parser.set_defaults(verb=_main)


def _main(options: argparse.Namespace) -> int:
    from .. import _core
    from ..errors import FileError, InvalidValue
    from ..viewer import write_page

    output = Path(options.output)
    if output.suffix.lower() != ".html":  # never over the record
        raise InvalidValue("--output", repr(options.output), "a name that ends in .html")
    if not output.parent.is_dir():
        raise FileError(options.output, "", "no such folder", "a file in a folder that is there")
    what = recorded(options.what)
    config = None if options.config is None else _core.load_config(options.config)
    if options.rounds is not None:
        if isinstance(what, _core.World):
            raise InvalidValue("--rounds", options.rounds, "none for a world")
        what = _part(what, options.rounds)
    write_page(options.output, what, config=config)
    say(f"written: {options.output} ({os.path.getsize(options.output) / 1e6:.2f} MB)")
    return 0


def recorded(names: list[str]) -> Record | World:
    """Records of one trial as one, folders of `devlearn run` among them; or a world."""
    from .._core import World
    from ..errors import FileError
    from ..record import Record

    files = []
    for name in names:
        phases = [Path(name) / f"{phase}.npz" for phase in PHASES]
        phases = [file for file in phases if file.exists()]
        if Path(name).is_dir() and not phases:
            raise FileError(name, "", "a folder without records", "one that devlearn run finished")
        files += phases or [Path(name)]
    if len(files) == 1 and not _holds_record(files[0]):
        return World.load(names[0])
    records = [Record.load(file) for file in files]
    made = [record for record in records if record.rounds["steps"].any()]
    return Record.concatenate(made or records)


def _holds_record(path: Path) -> bool:
    """Whether a file is a record or a snapshot; what cannot be read is for a reader to refuse."""
    try:
        with open(path, "rb") as file:
            begin = file.read(9)
    except OSError:
        return path.suffix == ".npz"
    return begin[:2] == b"PK" or begin[8:] == b"{"


def _part(record: Record, rounds: str) -> Record:
    from ..analysis import parts
    from ..errors import InvalidValue

    first, colon, last = rounds.partition(":")
    numbers = record.rounds["round"].tolist()
    try:
        low = int(first) if first else 1
        high = int(last or max(numbers, default=0)) if colon else low
    except ValueError:
        raise InvalidValue("--rounds", repr(rounds), "A:B, two whole numbers") from None
    chosen = [entry for entry, number in enumerate(numbers) if low <= number <= high]
    if not chosen:
        there = (
            f"some of the rounds {min(numbers)} to {max(numbers)}"
            if numbers
            else "no such option: there are no rounds"
        )
        raise InvalidValue("--rounds", repr(rounds), there)
    return next(parts(record, slice(chosen[0], chosen[-1] + 1)))
