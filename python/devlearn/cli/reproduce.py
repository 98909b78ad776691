"""``devlearn reproduce``: all of section VI, and a report."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from .console import say, warn


def add_to(verbs: Any) -> None:
    """Adds the verb to the command line's."""
    parser = verbs.add_parser(
        "reproduce",
        help="run all of the paper's section VI and write a report",
        description="Runs the paper's section VI over many seeds, for both readings of the method, "
        "and writes report.html, the figures, Table 1 and all numbers. Stopped with Ctrl-C, it "
        "goes on from there when called again.",
    )
    parser.add_argument(
        "--figure", type=int, metavar="N", help="draw only this figure of the paper (0: the extras)"
    )
    parser.add_argument(
        "--seeds", type=int, default=30, metavar="N", help="how many seeds (default: %(default)s)"
    )
    parser.add_argument(
        "--workers", type=int, metavar="N", help="how many processes (default: one a core)"
    )
    parser.add_argument(
        "--output", default="out/reproduce", metavar="DIR",
        help="folder to write (default: %(default)s)",
    )  # fmt: skip
    parser.set_defaults(verb=_main)


def _main(options: argparse.Namespace) -> int:
    from ..errors import InvalidValue

    if options.workers is not None and options.workers < 1:
        raise InvalidValue("--workers", options.workers, "at least 1")

    if options.figure is not None:
        from ..paper.figures import draw_figure

        for path in draw_figure(options.output, options.figure):
            say(path)
        return 0
    from ..paper import reproduce as reproduction

    try:
        verdicts = reproduction.reproduce(
            options.output, seeds=options.seeds, workers=options.workers, say=say
        )
    except KeyboardInterrupt:
        warn(f"what is finished is kept in {options.output}; the same command goes on from there")
        raise
    for preset, judged in verdicts.items():
        held = sum(verdict.holds for verdict in judged)
        say(f"preset {preset}: {held} of {len(judged)} claims hold")
        for verdict in judged:
            fixed = verdict.claim.get("by_definition", {}).get("part")
            criterion = verdict.claim["criterion"]
            say(
                f"  {'holds   ' if verdict.holds else 'does not'}  {verdict.claim['id']:28} "
                f"{verdict.figure.value:10.4g}  {criterion['op']} {criterion['bound']:<6g}  "
                f"control {verdict.control.value:10.4g}"
                f"{'  (holds, too)' if verdict.control_holds else ''}"
                f"{f'  ({fixed}: by definition)' if fixed else ''}"
            )
    say(f"report: {Path(options.output) / 'report.html'}")
    return 0
