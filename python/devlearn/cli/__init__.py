"""The command line: a module a verb.

These modules import nothing of the package before they are called: --help should not wait for it.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence

from . import reproduce, run


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns its exit code: 0, 1 for a refusal, 130 after Ctrl-C."""
    options = _parser().parse_args(arguments)
    from ..errors import InvalidValue, MissingExtra

    try:
        code = int(options.verb(options))
        sys.stdout.flush()
        return code
    except BrokenPipeError:  # who read the output has left, as `head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (InvalidValue, MissingExtra, OSError) as error:
        print(f"devlearn: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("devlearn: stopped", file=sys.stderr)
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="devlearn",
        description="Sensorimotor developmental learning from orientation and curiosity "
        "(Zhang et al., 2020).",
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version and leave")
    verbs = parser.add_subparsers(required=True, metavar="VERB")
    for verb in (reproduce, run):
        verb.add_to(verbs)
    return parser


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from .._core import __version__, commit

        print(f"devlearn {__version__} ({commit})")
        parser.exit()
