"""``devlearn world``: worlds to look at, to check, from maps and by chance."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .console import say, warn
from .run import add_world

if TYPE_CHECKING:
    from .._core import World
    from ..maps import MapImport

_MOST_GAPS = 5  # that are said one by one

_EPILOG = """\
examples:
  devlearn world show office --output office.png
  devlearn world check my_world.json
  devlearn world import map.yaml --output lab.json
  devlearn world import map.yaml --output lab.json --start -3.5,0.5,90 --target 4,-1.2
  devlearn world random rooms --seed 7 --difficulty 0.8 --output rooms.json
"""


def add_to(verbs: Any) -> None:
    """Adds the verb to the command line's."""
    parser = verbs.add_parser(
        "world",
        help="look at worlds, check them, make them",
        description="Draws a world, says whether a robot can use it, makes one of a robot's map "
        "or by chance.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    tasks = parser.add_subparsers(required=True, metavar="TASK")
    _add_show(tasks)
    _add_check(tasks)
    _add_import(tasks)
    _add_random(tasks)


# --- show -----------------------------------------------------------------------------------------


def _add_show(tasks: Any) -> None:
    parser = tasks.add_parser(
        "show", help="draw a world", description="Draws a world with robot, sonars and target."
    )
    add_world(parser)
    _add_radius(parser)
    parser.add_argument(
        "--output", default="world.png", metavar="FILE",
        help="picture to write, .png, .svg or .pdf (default: %(default)s)",
    )  # fmt: skip
    parser.set_defaults(verb=_show)


def _show(options: argparse.Namespace) -> int:
    from .. import plots
    from .._core import RobotDef, World

    world, robot = World.load(options.world), RobotDef(radius=options.radius)
    fits = world.clearance(world.start.x, world.start.y, walls_count=True) >= robot.radius
    plots.save(plots.plot_world(world, robot=robot, sonar=fits), options.output)
    say(f"written: {options.output}")
    return 0


# --- check ----------------------------------------------------------------------------------------


def _add_check(tasks: Any) -> None:
    parser = tasks.add_parser(
        "check",
        help="say whether a robot can use a world",
        description="Says what a world is made of, whether the robot's body fits at the start, "
        "whether it can get to the target, and how many steps that takes; and which gaps are "
        "too narrow for it. Ends with 1 where a robot cannot use the world.",
    )
    add_world(parser)
    _add_radius(parser)
    parser.set_defaults(verb=_check)


def _check(options: argparse.Namespace) -> int:
    from .. import _core
    from ..analysis import Rooms
    from ..errors import InvalidValue

    world = _core.World.load(options.world)
    robot = _core.Robot(world, _core.RobotDef(radius=options.radius))
    for line in _told(world):
        say(line)
    try:
        reached = _core.may_reach_target(robot)
    except InvalidValue as error:
        warn(f"devlearn: no room for the body: {error}")
        return 1
    rooms = Rooms(world, options.radius)
    if reached:
        path = _core.shortest_path(robot)
        reached = path.lower_bound is not None
        if path.exact and reached:
            say(f"shortest path: {path.steps} steps")
        elif path.steps is not None:
            say(f"shortest path: {path.lower_bound} to {path.steps} steps")
        elif reached:
            say(f"shortest path: at least {path.lower_bound} steps, if there is one")
    say(
        f"room for the body: {rooms.area_of_start:.3g} m^2 around the start"
        + (f" of {rooms.area:.3g} m^2 in {rooms.count} rooms" if rooms.count > 1 else "")
    )
    gaps = rooms.gaps()
    for gap in gaps[:_MOST_GAPS]:
        say(
            f"gap: about {gap.width:.2g} m wide at {_point(gap.place)}, the body is "
            f"{2 * options.radius:g} m"
        )
    if len(gaps) > _MOST_GAPS:
        say(f"and {len(gaps) - _MOST_GAPS} more gaps, none wider")
    if not reached:
        nearest = rooms.nearest_to_target()
        far = "the robot cannot leave the start"
        if nearest is not None:
            far = f"the robot gets as near as {nearest[0]:.3g} m to it, at {_point(nearest[1])}"
        warn(
            f"devlearn: no way leads from the start {_point(world.start)} to the target "
            f"{_point(world.target)}: {far}"
        )
        return 1
    return 0


def _told(world: World) -> Iterator[str]:
    x, y = world.origin
    yield f"world {world.name or 'without a name'}: {world.width:g} m x {world.height:g} m"
    yield f"arena: {_point((x, y))} to {_point((x + world.width, y + world.height))}"
    yield f"obstacles: {len(world.obstacles)}"
    if world.movers:
        yield f"movers: {len(world.movers)}"
    yield f"start: {_point(world.start)}, heading {world.start.heading:g} degrees"
    yield f"target: {_point(world.target)}"


def _point(place: Any) -> str:
    return f"({place[0]:.4g}, {place[1]:.4g})"


# --- import ---------------------------------------------------------------------------------------


def _add_import(tasks: Any) -> None:
    parser = tasks.add_parser(
        "import",
        help="make a world of a robot's map",
        description="Makes a world of a map of ROS's map_server: a YAML with a PGM or PNG. The "
        "map's frame is kept. Needs the extra maps.",
    )
    # A place begins with a minus where a map's frame has it so.
    parser._negative_number_matcher = re.compile(r"-\.?\d")
    parser.add_argument("map", help="the map's YAML")
    parser.add_argument(
        "--output", default="world.json", metavar="FILE",
        help="to write, .json (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--start", metavar="X,Y,HEADING", help="in metres and degrees (default: drawn)"
    )
    parser.add_argument("--target", metavar="X,Y", help="in metres (default: drawn)")
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="of the draws (default: %(default)s)"
    )
    parser.add_argument(
        "--unknown", default="occupied", metavar="HOW",
        help="take unknown space as occupied, as free, or as occupied along its border with "
        "free space (occupied, free, border; default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--tolerance", type=float, metavar="M",
        help="by how much outlines may be simplified [m] (default: half a cell)",
    )  # fmt: skip
    _add_radius(parser)
    parser.set_defaults(verb=_import)


def _import(options: argparse.Namespace) -> int:
    from ..maps import import_ros_map

    _require_output(options.output)
    made = import_ros_map(
        options.map,
        start=_numbers("--start", options.start, "X,Y,HEADING"),
        target=_numbers("--target", options.target, "X,Y"),
        unknown=options.unknown,
        tolerance=options.tolerance,
        seed=options.seed,
        radius=options.radius,
    )
    made.world.save(options.output)
    for line in _made(made):
        say(line)
    say(f"written: {options.output}")
    return 0


def _made(made: MapImport) -> Iterator[str]:
    yield (
        f"cells: {made.columns} x {made.rows} of {made.resolution:g} m; {made.free} free, "
        f"{made.occupied} occupied, {made.unknown} unknown"
    )
    yield (
        f"outlines: {made.outlines} with {made.holes} holes, {made.corners} corners; within "
        f"{made.error:.3g} m of those traced, {made.error_of_cells:.3g} m of the cells"
    )
    yield f"free: {made.free_area:.4g} m^2"
    yield from _told(made.world)


def _numbers(option: str, text: str | None, wanted: str) -> list[float] | None:
    from ..errors import InvalidValue

    if text is None:
        return None
    try:
        numbers = [float(number) for number in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != wanted.count(",") + 1:
        raise InvalidValue(option, repr(text), f"{wanted}, numbers with commas between them")
    return numbers


# --- random ---------------------------------------------------------------------------------------


def _add_random(tasks: Any) -> None:
    parser = tasks.add_parser(
        "random",
        help="draw a world by chance",
        description="Draws a world of 5 m x 5 m in which there is a way, the same for the same "
        "kind, seed and difficulty.",
    )
    parser.add_argument("kind", help="similar, clutter, corridors, rooms or traps")
    parser.add_argument(
        "--seed", type=int, default=1, metavar="N", help="of all draws (default: %(default)s)"
    )
    parser.add_argument(
        "--difficulty", type=float, default=0.5, metavar="D",
        help="from 0 to 1 (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--output", default="world.json", metavar="FILE",
        help="to write, .json (default: %(default)s)",
    )  # fmt: skip
    parser.set_defaults(verb=_random)


def _random(options: argparse.Namespace) -> int:
    from .._core import World

    _require_output(options.output)
    world = World.random(options.kind, options.seed, difficulty=options.difficulty)
    world.save(options.output)
    for line in _told(world):
        say(line)
    say(f"written: {options.output}")
    return 0


# --- what several take ----------------------------------------------------------------------------


def _require_output(path: str) -> None:
    """Refuses, before any work, a file that is not meant, such as the map, or no folder."""
    from ..errors import FileError, InvalidValue

    if not path.lower().endswith(".json"):
        raise InvalidValue("--output", repr(path), "a name that ends in .json")
    if not Path(path).parent.is_dir():
        raise FileError(path, "", "no such folder", "a file in a folder that is there")


def _add_radius(parser: Any) -> None:
    parser.add_argument(
        "--radius", type=float, default=0.1, metavar="M",
        help="of the robot's body [m] (default: %(default)s)",
    )  # fmt: skip
