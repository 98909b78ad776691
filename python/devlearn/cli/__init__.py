"""The command line: a module a verb.

These modules import nothing of the package before they are called: --help should not wait for it.
"""

from __future__ import annotations

import argparse
import signal
from collections.abc import Sequence

from . import compare, console, film, reproduce, run, sweep, view, world


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns its exit code.

    0 where all that was asked for is written, whether or not anybody could read what is said of it;
    1 for a refusal; 2 for a line that cannot be read; 130 after Ctrl-C, 143 after SIGTERM.
    """
    console.prepare()
    try:
        options = _parser().parse_args(arguments)
        from ..errors import InvalidValue, MissingExtra

        try:
            return int(options.verb(options))
        except (InvalidValue, MissingExtra, OSError) as error:
            console.warn(f"devlearn: {error}")
            return 1
    except (KeyboardInterrupt, ImportError) as error:
        stop = _stop_behind(error)
        if stop is None:
            raise
        console.warn("devlearn: stopped")
        return 128 + (stop.args[0] if stop.args else signal.SIGINT)


def _stop_behind(error: BaseException | None) -> KeyboardInterrupt | None:
    """Ctrl-C while a compiled module was being imported comes as an ImportError."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__
    return error


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="devlearn",
        description="Sensorimotor developmental learning from orientation and curiosity "
        "(Zhang et al., 2020).",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and leave")
    verbs = parser.add_subparsers(required=True, metavar="VERB")
    for verb in (reproduce, run, view, film, sweep, compare, world):
        verb.add_to(verbs)
    return parser


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from .._core import __version__, commit

        print(f"devlearn {__version__} ({commit})")
        parser.exit()
