"""``devlearn run``: one experiment in any world."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .console import say, warn

if TYPE_CHECKING:
    from .._core import RobotDef, Trial, TrialConfig
    from ..experiments.schedule import Schedule
    from ..paper.schedule import Run
    from ..record import Record

_DESCRIPTION = """\
One experiment: two rounds of free learning, then path learning by rounds until
the target is reached. Prints what came of it and writes the records, a table
of the rounds of path learning (rounds.csv: round, steps, arrived, and began,
how many steps were made before it) and, with matplotlib, a picture. Its state
is saved as it goes: stopped by Ctrl-C or a kill, it goes on from there when
called again."""
_EPILOG = """\
examples:
  devlearn run paper
  devlearn run office --seed 7 --rounds 200 --output out/office
  devlearn run my_world.json --preset step5 --set learner.sigma=0.5
"""

PHASES = ("free_1", "free_2", "paths")
"""The records that a run leaves in its folder, without their endings."""


def add_to(verbs: Any) -> None:
    """Adds the verb to the command line's."""
    parser = verbs.add_parser(
        "run",
        help="run one experiment in any world",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_world(parser)
    parser.add_argument(
        "--preset", default="paper", metavar="NAME", help="paper (default), step5 or adaptive"
    )
    parser.add_argument(
        "--config", metavar="FILE", help="a TrialConfig as JSON, instead of a preset"
    )
    parser.add_argument("--robot", metavar="FILE", help="a robot as JSON, instead of the paper's")
    parser.add_argument(
        "--set", action="append", default=[], metavar="FIELD=VALUE",
        help="change one field of it, such as learner.sigma=0.5; as often as you like",
    )  # fmt: skip
    parser.add_argument(
        "--seed", type=int, default=1, metavar="N", help="of all draws (default: %(default)s)"
    )
    parser.add_argument(
        "--steps", type=int, default=10_000, metavar="N",
        help="steps of each of the two rounds of free learning (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--rounds", type=int, default=100, metavar="N",
        help="rounds of path learning (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--step-limit", type=int, default=10_000, metavar="N",
        help="steps after which a round of path learning has failed (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--hopeless", type=int, default=20, metavar="N",
        help="end early once the last N rounds of path learning all failed; 0: never "
        "(default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--save-every", type=int, metavar="N",
        help="save the state every N steps (default: every ten seconds or so)",
    )  # fmt: skip
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--view", action="store_true",
        help="show it while it learns, in a viewer of Rerun's (needs the extra live and a display)",
    )  # fmt: skip
    where.add_argument(
        "--view-to", metavar="FILE|ADDRESS",
        help="likewise into a file, .rrd, which rerun opens, or to a viewer that runs "
        "(rerun+http://127.0.0.1:9876/proxy)",
    )  # fmt: skip
    parser.add_argument("--echoes", action="store_true", help="record the sonars' echoes, too")
    parser.add_argument("--csv", action="store_true", help="write the records as CSV, too")
    parser.add_argument(
        "--output", default="out/run", metavar="DIR", help="folder to write (default: %(default)s)"
    )
    parser.add_argument(
        "--overwrite", action="store_true", help="even where the folder holds another run"
    )
    parser.set_defaults(verb=_main)


def add_world(parser: argparse.ArgumentParser) -> None:
    """Adds the world that a verb is about."""
    shipped = sorted(path.stem for path in (Path(__file__).parents[1] / "worlds").glob("*.json"))
    parser.add_argument("world", help=f"a world file, or one that ships: {', '.join(shipped)}")


def _main(options: argparse.Namespace) -> int:
    from .. import _core
    from .._files import owned_folder
    from ..errors import InvalidValue
    from ..experiments.contenders import preset
    from ..experiments.schedule import Schedule

    if options.save_every is not None and not 1 <= options.save_every <= 2**40:
        raise InvalidValue("--save-every", options.save_every, "a whole number in [1, 2^40]")
    free, rounds = (options.steps, options.steps), options.rounds
    planned = Schedule(free, rounds, options.step_limit, options.hopeless)
    world = _core.World.load(options.world)
    config = preset(options.preset)
    if options.config is not None:
        config = _core.load_config(options.config)
    if options.robot is not None:
        config = _with_robot(config, _core.RobotDef.load(options.robot))
    config = _changed(config, options.set)
    trial = _core.Trial(world, config, options.seed)  # refuses what cannot run
    if not _core.may_reach_target(_core.Robot(world, config.robot), goal_radius=config.goal_radius):
        warn(
            "devlearn: nothing leads this robot from the start to the target; it never will arrive"
        )
    with owned_folder(options.output) as folder:
        made = _made(folder, trial, planned, options)
    for line in _told(made, world.name or options.world, planned):
        say(line)
    say(f"written: {folder}{os.sep}")
    return 0


def _made(
    folder: Path,
    new: Trial,
    planned: Schedule,
    options: argparse.Namespace,
) -> Run:
    """Runs, and writes all there is to write."""
    from ..analysis import parts
    from ..paper import schedule, survival
    from ..record import written_aside

    world, config = new.world, new.config
    kinds = ("npz", "csv") if options.csv else ("npz",)
    whence = survival.begin(
        folder, world, config, options.seed, {**planned.to_dict(), "echoes": options.echoes},
        files=[f"{name}.{kind}" for name in PHASES for kind in kinds] + ["rounds.csv"],
        overwrite=options.overwrite,
    )  # fmt: skip
    try:
        with _shown(new, planned, options) as seen:
            trial, whole = survival.run_to_the_end(
                folder, world, config, options.seed, planned, whence, options.echoes,
                options.save_every, seen,
            )  # fmt: skip
        made = schedule.run_of(whole, trial)
        phases = (slice(0, 1), slice(1, 2), slice(2, None))
        for name, record in zip(PHASES, parts(whole, *phases)):
            record.save(folder / f"{name}.npz")
            if options.csv:
                record.to_csv(folder / f"{name}.csv")
        with written_aside(folder / "rounds.csv", "w") as file:
            file.write("round,steps,arrived,began\n")
            file.writelines(
                f"{r['round']},{r['steps']},{int(r['arrived'])},{r['began']}\n"
                for r in made.paths.rounds
            )
        _draw(folder, made)
    except KeyboardInterrupt:
        if (folder / survival.STATE).exists():
            warn(f"what is finished is kept in {folder}; the same command goes on from there")
        raise
    survival.end(folder, whence)
    return made


@contextmanager
def _shown(
    trial: Trial, planned: Schedule, options: argparse.Namespace
) -> Iterator[Callable[[Record], object]]:
    """What shows each part of a run: nothing, unless it was asked for."""
    if not options.view and options.view_to is None:
        yield lambda part: None
        return
    from ..viewer.live import view

    to = options.view_to
    connect = to if to is not None and "://" in to else None
    path = to if connect is None else None

    def seen(part: Record) -> None:
        free = part.rounds["round"] <= len(planned.free)
        live.send(part, "free learning" if free.any() else "path learning")

    with view(trial, path, connect=connect) as live:
        yield seen
    told = f"{live.steps_shown} of {live.steps} steps and all rounds"
    if live.failed is None:
        say(f"shown: {told}" + (f": {path}" if path else ""))


def _told(made: Run, world: str, planned: Schedule) -> Iterator[str]:
    from ..paper import measures

    yield f"world {world}, seed {made.trial.seed}"
    for i, record in enumerate((made.first, made.second), 1):
        if len(record) == 0:
            continue
        arrival = measures.first_arrival(record)
        reached = "the target was never reached"
        if arrival is not None:
            reached = f"target reached at step {arrival}"
        yield f"free learning, round {i}: {reached}"
    steps, arrived = made.paths.rounds["steps"], made.paths.rounds["arrived"]
    if len(steps):
        settled = measures.settled_round(made.paths)
        yield (
            f"path learning: {arrived.sum()} of {len(steps)} rounds arrived; "
            f"first {steps[0]} steps, last {steps[-1]}; "
            + ("not settled" if settled is None else f"settled from round {settled} on")
        )
    if len(steps) < planned.rounds:
        yield f"ended early: the last {planned.hopeless} rounds never arrived (--hopeless)"


def _draw(folder: Path, made: Run) -> None:
    from ..errors import MissingExtra

    try:
        from ..paper.figures import draw_run, save_figure
    except MissingExtra as error:
        warn(f"no figures: {error}")
        return
    save_figure(folder, draw_run(made.trial, made.paths))


def _with_robot(config: TrialConfig, robot: RobotDef) -> TrialConfig:
    """Its learner has as many motions as the robot."""
    motions = len(robot.steering_angles)
    return config.replace(robot=robot, learner=config.learner.replace(motion_count=motions))


def _changed(config: TrialConfig, changes: Sequence[str]) -> TrialConfig:
    from .._settings import changed, field_names
    from ..errors import InvalidValue, WrongType

    known = list(field_names(config.to_dict()))
    values = {}
    for change in changes:
        name, equals, text = change.partition("=")
        if not equals or name not in known:
            allowed = f"FIELD=VALUE, where FIELD is one of {', '.join(known)}"
            raise InvalidValue("--set", repr(change), allowed)
        try:
            values[name] = json.loads(text)
        except (ValueError, RecursionError):
            values[name] = text
    try:
        return changed(config, values)
    except WrongType as error:
        told = next(c for c in reversed(changes) if c.startswith(f"{error.quantity}="))
        raise InvalidValue("--set", repr(told), error.allowed) from error
