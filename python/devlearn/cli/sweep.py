"""``devlearn sweep``: many runs, into one file."""

from __future__ import annotations

import argparse
from typing import Any

from .console import say, warn

_DESCRIPTION = """\
Runs worlds x agents x settings x seeds, as a TOML file says, and keeps what
each came to in one SQLite file. Stopped by Ctrl-C or a kill, the same command
does only what is missing."""
_EPILOG = """\
a sweep, such as sweep.toml:
  worlds = ["paper", "my_world.json", "similar:10-19"]
  agents = ["paper", "adaptive", "QLearning", "my_module:MyAgent"]
  seeds = "1-100"
  rounds = 600
  [settings.paper]
  sigma = [0.1, 0.3]

examples:
  devlearn sweep sweep.toml --output results.sqlite
  devlearn sweep sweep.toml --output results.sqlite --scheduler tcp://10.0.0.1:8786
"""


def add_to(verbs: Any) -> None:
    """Adds the verb to the command line's."""
    parser = verbs.add_parser(
        "sweep",
        help="run worlds x agents x settings x seeds into one file",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("file", nargs="?", help="what to run, in TOML")
    parser.add_argument(
        "--output", default="results.sqlite", metavar="FILE",
        help="the file of results (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--workers", type=int, metavar="N", help="how many processes (default: one a core)"
    )
    parser.add_argument(
        "--scheduler", metavar="ADDRESS", help="of a Dask cluster, in place of processes here"
    )
    parser.add_argument("--retry-failed", action="store_true", help="make runs again that failed")
    parser.add_argument(
        "--patience", type=float, default=600.0, metavar="SECONDS",
        help="how long to wait for a scheduler that is gone (default: %(default)g)",
    )  # fmt: skip
    parser.add_argument(
        "--run", metavar="JSON", help="make this run alone, as the command of a row has it"
    )
    parser.add_argument("--record", metavar="FILE", help="with --run: write its record here")
    parser.set_defaults(verb=_main)


def _main(options: argparse.Namespace) -> int:
    from ..errors import InvalidValue

    if (options.file is None) == (options.run is None):
        raise InvalidValue("FILE", options.file or "nothing", "a sweep in TOML, or --run")
    if options.run is not None:
        return _one(options)
    from ..experiments import spec
    from ..experiments.sweep import sweep

    asked = spec.read(options.file)
    say(
        f"runs: {len(asked)} (worlds {len(asked.worlds)} x agents with settings "
        f"{len(asked.variants)} x seeds {len(asked.seeds)})"
    )
    try:
        results = sweep(
            asked,
            options.output,
            workers=options.workers,
            scheduler=options.scheduler,
            patience=options.patience,
            retry_failed=options.retry_failed,
        )
    except KeyboardInterrupt:
        warn(f"what is finished is kept in {options.output}; the same command goes on from there")
        raise
    failed = results.failed
    say(f"written: {options.output}")
    if failed:
        warn(f"devlearn: {len(failed)} runs failed; the first, run {failed[0][0]}:")
        warn(failed[0][1].rstrip())
    return 0


def _one(options: argparse.Namespace) -> int:
    from ..experiments import job, spec

    asked = spec.of_command(options.run)
    row = job.execute(asked)
    if row.error is not None:
        warn(row.error.rstrip())
        return 1
    for name, value in row.measures.items():
        say(f"{name:18} {value}")
    if options.record is not None:
        from ..record import written_aside

        with written_aside(options.record, "wb") as file:
            file.write(row.record)
        say(f"written: {options.record}")
    return 0
