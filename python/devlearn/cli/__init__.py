"""The command line: ``devlearn reproduce`` and ``devlearn run``."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .._core import Trial, TrialConfig
    from ..record import Record

_RUN_DESCRIPTION = """\
One experiment: two rounds of free learning, then path learning by rounds until
the target is reached. Prints what came of it and writes the records, a table
of the rounds and, with matplotlib, a picture. Its state is saved as it goes:
stopped by Ctrl-C or a kill, it goes on from there when called again."""
_RUN_EPILOG = """\
examples:
  devlearn run paper
  devlearn run office --seed 7 --rounds 200 --output out/office
  devlearn run my_world.json --preset step5 --set learner.sigma=0.5
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; returns its exit code: 0, 1 for a refusal, 130 after Ctrl-C."""
    options = _parser().parse_args(arguments)
    # Not before: --help should not wait for them.
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

    reproduce = verbs.add_parser(
        "reproduce",
        help="run all of the paper's section VI and write a report",
        description="Runs the paper's section VI over many seeds, for both readings of the method, "
        "and writes report.html, the figures, Table 1 and all numbers. Stopped with Ctrl-C, it "
        "goes on from there when called again.",
    )
    reproduce.add_argument(
        "--figure", type=int, metavar="N", help="draw only this figure of the paper (0: the extras)"
    )
    reproduce.add_argument(
        "--seeds", type=int, default=30, metavar="N", help="how many seeds (default: %(default)s)"
    )
    reproduce.add_argument(
        "--workers", type=int, metavar="N", help="how many processes (default: one a core)"
    )
    reproduce.add_argument(
        "--output", default="out/reproduce", metavar="DIR",
        help="folder to write (default: %(default)s)",
    )  # fmt: skip
    reproduce.set_defaults(verb=_reproduce)

    run = verbs.add_parser(
        "run",
        help="run one experiment in any world",
        description=_RUN_DESCRIPTION,
        epilog=_RUN_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    run.add_argument("world", help=f"a world file, or one that ships: {', '.join(_shipped())}")
    run.add_argument("--preset", default="paper", metavar="NAME", help="paper (default) or step5")
    run.add_argument("--config", metavar="FILE", help="a TrialConfig as JSON, instead of a preset")
    run.add_argument(
        "--set", action="append", default=[], metavar="FIELD=VALUE",
        help="change one field of it, such as learner.sigma=0.5; as often as you like",
    )  # fmt: skip
    run.add_argument(
        "--seed", type=int, default=1, metavar="N", help="of all draws (default: %(default)s)"
    )
    run.add_argument(
        "--steps", type=int, default=10_000, metavar="N",
        help="steps of each of the two rounds of free learning (default: %(default)s)",
    )  # fmt: skip
    run.add_argument(
        "--rounds", type=int, default=100, metavar="N",
        help="rounds of path learning (default: %(default)s)",
    )  # fmt: skip
    run.add_argument(
        "--step-limit", type=int, default=10_000, metavar="N",
        help="steps after which a round of path learning has failed (default: %(default)s)",
    )  # fmt: skip
    run.add_argument(
        "--save-every", type=int, metavar="N",
        help="save the state every N steps (default: every ten seconds or so)",
    )  # fmt: skip
    run.add_argument("--echoes", action="store_true", help="record the sonars' echoes, too")
    run.add_argument("--csv", action="store_true", help="write the records as CSV, too")
    run.add_argument(
        "--output", default="out/run", metavar="DIR", help="folder to write (default: %(default)s)"
    )
    run.set_defaults(verb=_run)
    return parser


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from .._core import __version__, commit

        print(f"devlearn {__version__} ({commit})")
        parser.exit()


def _shipped() -> list[str]:
    return sorted(path.stem for path in (Path(__file__).parents[1] / "worlds").glob("*.json"))


def _reproduce(options: argparse.Namespace) -> int:
    from ..errors import InvalidValue

    if options.workers is not None and options.workers < 1:
        raise InvalidValue("--workers", options.workers, "at least 1")
    from ..paper import reproduce as reproduction

    if options.figure is not None:
        for path in reproduction.draw_figure(options.output, options.figure):
            print(path)
        return 0
    try:
        verdicts = reproduction.reproduce(
            options.output, seeds=options.seeds, workers=options.workers, say=_say
        )
    except KeyboardInterrupt:
        print(f"what is finished is kept in {options.output}; the same command goes on from there",
              file=sys.stderr)  # fmt: skip
        raise
    for preset, judged in verdicts.items():
        held = sum(verdict.holds for verdict in judged)
        print(f"preset {preset}: {held} of {len(judged)} claims hold")
        for verdict in judged:
            criterion = verdict.claim["criterion"]
            print(
                f"  {'holds   ' if verdict.holds else 'does not'}  {verdict.claim['id']:28} "
                f"{verdict.figure.value:10.4g}  {criterion['op']} {criterion['bound']:<6g}  "
                f"control {verdict.control.value:10.4g}"
                f"{'  (holds, too)' if verdict.control_holds else ''}"
            )
    print(f"report: {Path(options.output) / 'report.html'}")
    return 0


def _say(text: str) -> None:
    print(text, flush=True)


def _run(options: argparse.Namespace) -> int:
    from .. import _core
    from ..errors import InvalidValue
    from ..experiments.runs import made_folder
    from ..paper import measures, schedule, survival
    from ..record import written_aside

    # At once, not when they are needed.
    limits = {"steps": (0, 40), "rounds": (0, 30), "step_limit": (1, 40), "save_every": (1, 40)}
    for name, (least, power) in limits.items():
        value = getattr(options, name)
        if value is None or least <= value <= 2**power:
            continue
        allowed = f"at least {least}" if value < least else f"a whole number up to 2^{power}"
        raise InvalidValue("--" + name.replace("_", "-"), value, allowed)
    world = _core.World.load(options.world)
    config = schedule.preset(options.preset)
    if options.config is not None:
        config = _read_config(options.config)
    config = _changed(config, options.set)

    _core.Trial(world, config, options.seed)  # refuses what cannot run
    folder = made_folder(options.output)
    plan = survival.Plan(options.steps, options.rounds, options.step_limit, options.echoes)
    try:
        trial, whole = survival.run_to_the_end(
            folder, world, config, options.seed, plan, options.save_every
        )
    except KeyboardInterrupt:
        print(f"what is finished is kept in {folder}; the same command goes on from there",
              file=sys.stderr)  # fmt: skip
        raise
    records = {
        "free_1": whole.part(slice(0, 1)),
        "free_2": whole.part(slice(1, 2)),
        "paths": whole.part(slice(2, None)),
    }
    for name, record in records.items():
        record.save(folder / f"{name}.npz")
        if options.csv:
            record.to_csv(folder / f"{name}.csv")
    paths = records["paths"]

    print(f"world {world.name or options.world}, seed {options.seed}")
    for i, name in enumerate(("free_1", "free_2"), 1):
        record = records[name]
        arrival = measures.first_arrival(record) if len(record) else None
        reached = "the target was never reached"
        if arrival is not None:
            reached = f"target reached at step {arrival}"
        print(f"free learning, round {i}: {reached}")
    steps, arrived = paths.rounds["steps"], paths.rounds["arrived"]
    if len(steps):
        settled = measures.settled_round(paths)
        print(
            f"path learning: {arrived.sum()} of {len(steps)} rounds arrived; "
            f"first {steps[0]} steps, last {steps[-1]}; "
            + ("not settled" if settled is None else f"settled from round {settled} on")
        )
    with written_aside(folder / "rounds.csv", "w") as file:
        file.write("round,steps,arrived\n")
        file.writelines(f"{r['round']},{r['steps']},{int(r['arrived'])}\n" for r in paths.rounds)
    _draw(folder, trial, paths)
    survival.forget(folder)
    print(f"written: {folder}{os.sep}")
    return 0


def _draw(folder: Path, trial: Trial, paths: Record) -> None:
    from ..errors import MissingExtra

    try:
        from ..paper.figures import draw_run
        from ..paper.reproduce import save_figure
    except MissingExtra as error:
        print(f"no figures: {error}", file=sys.stderr)
        return
    save_figure(folder, draw_run(trial, paths))


def _read_config(path: str) -> TrialConfig:
    from .._core import TrialConfig
    from ..errors import FileError, InvalidValue

    allowed = "a TrialConfig as JSON"
    try:
        fields = json.loads(Path(path).read_text(encoding="utf-8"))
        return TrialConfig.from_dict(fields)
    except InvalidValue as error:
        raise FileError(path, error.quantity, error.value, error.allowed) from error
    except TypeError as error:
        raise FileError(path, "", "a value of another type", allowed) from error
    except OSError as error:
        raise FileError(path, "", error.strerror, allowed) from error
    except (ValueError, RecursionError) as error:
        raise FileError(path, "", error, allowed) from error


def _changed(config: TrialConfig, changes: Sequence[str]) -> TrialConfig:
    from ..errors import InvalidValue

    fields = config.to_dict()
    for change in changes:
        name, equals, text = change.partition("=")
        *outer, last = name.split(".")
        place: Any = fields
        for part in outer:
            place = place.get(part) if isinstance(place, dict) else None
        if not equals or not isinstance(place, dict) or last not in place:
            known = ", ".join(_names(config.to_dict()))
            raise InvalidValue("--set", repr(change), f"FIELD=VALUE, where FIELD is one of {known}")
        try:
            place[last] = json.loads(text)
        except ValueError:
            place[last] = text
    try:
        return config.from_dict(fields)
    except TypeError as error:
        allowed = "a value of each field's type, such as 0.5, true or [1, 2]"
        raise InvalidValue("--set", repr(" ".join(changes)), allowed) from error


def _names(fields: Mapping[str, Any], outer: str = "") -> Iterator[str]:
    for name, value in fields.items():
        if isinstance(value, dict):
            yield from _names(value, f"{outer}{name}.")
        else:
            yield outer + name
