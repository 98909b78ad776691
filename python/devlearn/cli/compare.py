"""``devlearn compare``: agents side by side, as one page."""

from __future__ import annotations

import argparse
from typing import Any

from .console import say, warn

_DESCRIPTION = """\
Runs agents in the same worlds, by the same seeds and limits, and writes one
page that needs nothing else, report.html. Stopped by Ctrl-C or a kill, the
same command goes on."""
_EPILOG = """\
examples:
  devlearn compare                              what ships: ten minutes on two cores
  devlearn compare --seeds 1-100                the same of more seeds; goes on from there
  devlearn compare sweep.toml --output DIR      a sweep of one's own, as devlearn sweep takes
  devlearn compare results.sqlite --output DIR  what a sweep left that kept its rounds
  devlearn compare --ablations                  and what each setting of the method does
  devlearn compare --search --output DIR        search the textbook agents' settings anew
"""


def add_to(verbs: Any) -> None:
    """Adds the verb to the command line's."""
    parser = verbs.add_parser(
        "compare",
        help="compare agents, and write a report",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "file", nargs="?", help="a sweep in TOML, or the results of one (default: what ships)"
    )
    parser.add_argument(
        "--output", default="out/compare", metavar="DIR",
        help="folder to write (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument("--seeds", metavar="SEEDS", help="in place of the sweep's, such as 1-100")
    parser.add_argument(
        "--reference", action="append", metavar="AGENT",
        help="compare with this one pair by pair; more than once for several "
        "(default: adaptive and paper)",
    )  # fmt: skip
    parser.add_argument(
        "--maps", type=int, default=3, metavar="N",
        help="try from every start in the first N worlds (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--ablations", action="store_true", help="run devlearn's settings, too, each alone"
    )
    parser.add_argument(
        "--search", action="store_true", help="search settings, and write settings.toml instead"
    )
    parser.add_argument(
        "--workers", type=int, metavar="N", help="how many processes (default: one a core)"
    )
    parser.add_argument(
        "--scheduler", metavar="ADDRESS", help="of a Dask cluster, in place of processes here"
    )
    parser.set_defaults(verb=_main)


def _main(options: argparse.Namespace) -> int:
    from ..errors import InvalidValue

    if options.search and (options.file or options.seeds or options.ablations):
        raise InvalidValue("--search", "with what is to be compared", "alone")
    try:
        if options.search:
            from ..comparison.search import search

            search(options.output, workers=options.workers, scheduler=options.scheduler, say=say)
            say(f"written: {options.output}/settings.toml")
            return 0
        from ..comparison.compare import compare

        path = compare(
            options.file,
            options.output,
            seeds=options.seeds,
            workers=options.workers,
            scheduler=options.scheduler,
            references=options.reference,
            maps=options.maps,
            ablations=options.ablations,
            say=say,
        )
    except KeyboardInterrupt:
        warn(f"what is finished is kept in {options.output}; the same command goes on from there")
        raise
    say(f"report: {path}")
    return 0
