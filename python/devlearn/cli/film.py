"""``devlearn film``: a record's rounds as a film."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from .console import passing, say, warn

_EPILOG = """\
examples:
  devlearn film out/run/paths.npz paths.mp4
  devlearn film out/run/paths.npz paths.gif --rounds 1,10,last --width 480
  devlearn film out/run/free_1.npz --output free.webp --speed 100
"""


def add_to(verbs: Any) -> None:
    """Adds the verb to the command line's."""
    parser = verbs.add_parser(
        "film",
        help="make a film of a record",
        description="Makes a film of a record's rounds: the robot with its sonars, its path by "
        "kind of step, what it touches, what moves, and the steps by round. Needs the extra films.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "record", help="a record (.npz), a folder of devlearn run, or a trial's snapshot with one"
    )
    parser.add_argument(
        "film", nargs="?", metavar="FILM", help="to write: .gif, .mp4 or .webp (default: film.gif)"
    )
    parser.add_argument("--output", metavar="FILM", help="the same")
    parser.add_argument(
        "--rounds", metavar="WHICH",
        help="counted from 1, such as 1-3,50,last, or all (default: up to eight, from the first to "
        "the last)",
    )  # fmt: skip
    parser.add_argument(
        "--seconds", type=float, metavar="S",
        help="of the film; each round has the same share (default: 10)",
    )  # fmt: skip
    parser.add_argument(
        "--speed", type=float, metavar="X",
        help="instead: all rounds X times faster than the robot",
    )  # fmt: skip
    parser.add_argument(
        "--width", type=int, default=640, metavar="PIXELS",
        help="of the film, 240 to 2160 (default: %(default)s); its height follows",
    )  # fmt: skip
    parser.set_defaults(verb=_main)


def _main(options: argparse.Namespace) -> int:
    from .._core import World
    from ..errors import FileError, InvalidValue
    from ..record import Record
    from ..viewer.film import animate, format_of
    from .view import recorded

    if options.film is not None and options.output is not None:
        raise InvalidValue("--output", options.output, f"no second name beside {options.film}")
    name = options.output or options.film or "film.gif"
    format_of(name)  # refuses what cannot be written before anything is read
    there = Path(options.record).exists()
    record = recorded([options.record]) if there else Record.load(options.record)
    if isinstance(record, World):
        raise FileError(options.record, "", "a world", "a record: devlearn run makes one")
    film = animate(
        record,
        rounds=options.rounds,
        seconds=options.seconds,
        speed=options.speed,
        width=options.width,
    )
    if film.every > 1:
        warn(f"devlearn: so many steps that about every {film.every}th of them is drawn")
    try:
        film.save(name, progress=lambda frame, all_: passing(f"frame {frame} of {all_}"))
    finally:
        passing("")
    width, height = film.size
    which = ", ".join(map(str, film.rounds[:12])) + (", ..." if len(film.rounds) > 12 else "")
    say(f"rounds {which} of {len(record.rounds)}; {film.seconds:g} s, {width} x {height} pixels")
    say(f"written: {name}")
    return 0
