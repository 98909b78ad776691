"""How worlds, robots, records, trials and learners show themselves in notebooks.

Their ``_repr_svg_`` and ``_repr_html_``, which Jupyter and its like ask for. By numpy alone, in
milliseconds, at most some tens of kB: what is more is thinned, and the picture says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .. import _markup as markup
from .._colours import BLUE, BY_KIND, GREEN, INK, OBSTACLE, VERMILLION
from .._core import (
    AdaptiveExplanation,
    AdaptiveLearner,
    ChoiceTrace,
    Circle,
    Explanation,
    Kind,
    Learner,
    Polyline,
    Rectangle,
    Robot,
    RobotDef,
    Trial,
    World,
)
from .._markup import PIXEL, Frame, Lines, counted, element, number
from ..analysis.outlines import corners, course
from ..record import Record

_SIDE = 360  # of an arena's longer side [pixels]
_MOST_POINTS = 5000  # of outlines
_MOST_STEPS = 2000  # of a path
_MOST_ROUNDS = 360  # points of a chart
_MOST_DRAWN = 360  # motions
_MOST_ROWS = 12  # of a table
_MOST_NAMED = 12  # motions with a number

_WIDTHS = {  # of lines [units]
    Kind.UNSTATED: 8,
    Kind.HELD: 22,
    Kind.HABIT: 14,
    Kind.DEVIATION: 22,
    Kind.EXPLORE: 22,
    Kind.EXHAUSTED: 14,
    Kind.EXPLOIT: 10,
}
_KINDS = {kind: (colour, _WIDTHS[kind]) for kind, colour in BY_KIND.items()}


# --- worlds ---------------------------------------------------------------------------------------


def world_svg(world: World) -> str:
    """A world with its start and target."""
    frame, ground, thinned = _ground(world)
    body = _body(frame, RobotDef().radius, world.start)
    return markup.picture(
        f"world {world.name}",
        (frame.height, ground + body),
        _gap(),
        *markup.caption(_told_of(world), thinned),
        width=_width(frame),
    )


def _told_of(world: World) -> str:
    name = markup.shortened(world.name, 30) or "a world"
    size = f"{number(world.width)} m \u00d7 {number(world.height)} m"
    movers = f", {counted(len(world.movers), 'mover')}" if world.movers else ""
    return f"{name}: {size}, {counted(len(world.obstacles), 'obstacle')}{movers}"


def _gap() -> tuple[int, str]:
    return 6 * PIXEL, ""


def _width(frame: Frame) -> int:
    """Room for lines of text, too, however narrow an arena is."""
    return max(frame.width, _SIDE * PIXEL)


def _ground(world: World, time: float = 0.0) -> tuple[Frame, str, str]:
    """Where the arena lies; its walls, obstacles and target; what is to be said of thinning.

    Movers are where they are at ``time`` [s]; dashed is where their centres go.
    """
    frame = Frame.around(world.origin, (world.width, world.height), _SIDE)
    shapes = [*world.obstacles, *world.movers_at(time)]
    rings = [ring for shape in shapes for ring in _rings(shape)]
    walls = [shape.points for shape in shapes if isinstance(shape, Polyline)]
    solid, coarse = Lines.of(frame, rings).thinned(_MOST_POINTS)
    thin, coarser = Lines.of(frame, walls).thinned(_MOST_POINTS)
    outline = {"stroke": BLUE, "stroke_width": 7, "stroke_linejoin": "round"}
    courses = Lines.of(frame, [course(mover) for mover in world.movers])
    ways, coarsest = courses.thinned(_MOST_POINTS)
    ground = markup.clipped(
        frame,
        element(
            "path", d=solid.path(closed=True), fill=OBSTACLE, stroke_linecap="round", **outline
        ),
        element("path", d=thin.path(), fill="none", stroke_linecap="round", **outline),
        element("path", d=ways.path(), fill="none", stroke_dasharray="40 20", **outline),
    )
    x, y = frame.at(world.target)[0].tolist()
    star = element(
        "path",
        d=f"M{x} {y - 70}l17 46 49 2-38 31 13 47-41-27-41 27 13-47-38-31 49-2z",
        fill=VERMILLION,
        stroke="white",
        stroke_width=5,
    )
    wall = element("rect", width=frame.width, height=frame.height, fill="none", stroke=INK,
                   stroke_width=16)  # fmt: skip
    grid = max(coarse, coarser, coarsest)
    told = f"Thinned to a grid of {number(grid / frame.scale)} m." if grid > 1 else ""
    return frame, ground + wall + star, told


_ROUND = np.linspace(0.0, 2 * math.pi, 32, endpoint=False)
_CIRCLE = np.column_stack([np.cos(_ROUND), np.sin(_ROUND)])


def _rings(shape: Any) -> Iterable[npt.NDArray[np.float64]]:
    """The outline, counter-clockwise, and the holes, clockwise, so that nothing fills them [m]."""
    if isinstance(shape, Circle):
        yield np.array(shape.center) + shape.radius * _CIRCLE
    elif isinstance(shape, Rectangle):
        yield corners(shape)
    elif not isinstance(shape, Polyline):
        for turn_to, points in ((1, shape.corners), *((-1, hole) for hole in shape.holes)):
            x, y = (ring := np.array(points, dtype=float)).T
            area = np.dot(x - x[0], np.roll(y, -1) - np.roll(y, 1))
            yield ring[:: turn_to if area > 0 else -turn_to]


def _body(frame: Frame, radius: float, pose: Sequence[float]) -> str:
    """The robot with its heading; where it would be hardly seen, larger than it is."""
    x, y = frame.at(pose[:2])[0].tolist()
    r = max(round(radius * frame.scale), 3 * PIXEL)
    angle = math.radians(pose[2])
    ahead = f"M{x} {y}l{round(r * math.cos(angle))} {round(-r * math.sin(angle))}"
    return element(
        "g",
        element("circle", cx=x, cy=y, r=r, fill=GREEN, stroke=INK, stroke_width=7),
        element("path", d=ahead, stroke="white", stroke_width=14),
    )


# --- robots ---------------------------------------------------------------------------------------


def robot_svg(robot: Robot) -> str:
    """A robot at its world's start, with what its sonars hear there; and its motions."""
    world, body, pose = robot.world, robot.definition, robot.world.start
    frame, ground, thinned = _ground(world)
    rays, echoes = [], []
    for angle, echo in zip(body.sonar_angles(), robot.sonar(pose).tolist()):
        direction = math.radians(pose.heading + angle)
        reach = np.array([[body.radius], [body.radius + echo]])
        rays.append(np.array(pose[:2]) + reach * [math.cos(direction), math.sin(direction)])
        if echo < body.sonar_range:
            echoes.append(rays[-1][1:])
    heard = element("path", d=Lines.of(frame, rays).path(), fill="none", stroke=INK, stroke_width=7)
    met = element("path", d=Lines.of(frame, echoes).path(), stroke=INK, stroke_width=30,
                  stroke_linecap="round")  # fmt: skip
    drawn = ground + markup.clipped(frame, heard, met) + _body(frame, body.radius, pose)
    return markup.picture(
        f"robot in world {world.name}",
        (frame.height, drawn),
        _gap(),
        *markup.caption(f"At the start of {_told_of(world)}.", thinned),
        *_motions(body),
        width=_width(frame),
    )


def robot_def_svg(body: RobotDef) -> str:
    """A robot's body from above, heading up, with the directions of its motions and sonars."""
    return markup.picture("robot", *_motions(body), width=_SIDE * PIXEL)


def _motions(body: RobotDef) -> list[tuple[int, str]]:
    radius, middle = 30 * PIXEL, np.array([_SIDE // 2, 75]) * PIXEL
    angles = body.steering_angles

    def towards(angles: Sequence[float], *reach: int) -> npt.NDArray[np.int64]:
        """Places at distances from the middle, heading up: (angles, reach, 2)."""
        turn = np.radians(angles)[:, None, None]
        away = np.array(reach)[None, :, None] * np.concatenate([np.sin(turn), np.cos(turn)], axis=2)
        ends: npt.NDArray[np.int64] = np.rint(middle - away).astype(np.int64)
        return ends

    def marks(angles: Sequence[float], length: int, **how: object) -> str:
        ends = towards(angles, radius, radius + length)
        lines = Lines(ends.reshape(-1, 2), np.repeat(np.arange(len(ends)), 2))
        return element("path", d=lines.path(), fill="none", **how)

    drawn = marks(body.sonar_angles(), 12 * PIXEL, stroke=BLUE, stroke_width=6)
    drawn += marks(angles[:_MOST_DRAWN], 20 * PIXEL, stroke=VERMILLION, stroke_width=12)
    few = angles[:_MOST_NAMED]
    if len(angles) == len(few):
        for motion, (x, y) in enumerate(towards(few, radius + 30 * PIXEL)[:, 0].tolist()):
            drawn += markup.words(x, y + 4 * PIXEL, str(motion), text_anchor="middle")
    x, y = middle.tolist()
    drawn += element("circle", cx=x, cy=y, r=radius, fill=GREEN, stroke=INK, stroke_width=7)
    drawn += element("path", stroke="white", stroke_width=20, d=f"M{x} {y}v-{radius}")
    step = f"{number(body.speed * body.sample_time)} m in {number(body.sample_time)} s"
    turns = ", ".join(map(number, few)) + (", \u2026" if len(angles) > len(few) else "")
    first = f", the first {_MOST_DRAWN} drawn" if len(angles) > _MOST_DRAWN else ""
    return [
        (2 * y, drawn),
        *markup.caption(
            f"Radius {number(body.radius)} m; a step: {step}.",
            f"{counted(len(angles), 'motion')} (orange{first}), a turn each [degrees]: {turns}",
            f"{counted(body.sonar_count, 'sonar')} (blue) of {number(body.sonar_range)} m"
            if body.sonar_count
            else "",
        ),
    ]


# --- records --------------------------------------------------------------------------------------


def record_svg(record: Record) -> str:
    """The path of a record's last round in its world, and the steps of its rounds."""
    arrived = int(np.count_nonzero(record.rounds["arrived"]))
    many = record.rounds_only
    steps = int(record.rounds["steps"].sum()) if many else len(record)
    told = f"{counted(steps, 'step')} in {counted(len(record.rounds), 'round')}, "
    told += f"{number(arrived)} arrived"
    rows = [] if many or not len(record.rounds) else _path(record)
    return markup.picture(
        f"record: {told}",
        *markup.caption(told),
        *(_chart(record.rounds) if len(record.rounds) > 1 else ()),
        *rows,
        *markup.caption("It holds rounds only, so there is no path." if many else ""),
        width=_SIDE * PIXEL,
    )


def _path(record: Record) -> list[tuple[int, str]]:
    entry = len(record.rounds) - 1
    path, kinds = record.path(entry), record.kind[record.steps_of(entry)]
    name, steps, arrived = record.rounds[["round", "steps", "arrived"]][entry]
    told = f"Round {number(name)}: {counted(steps, 'step')}, "
    told += "arrived" if arrived else "not arrived"
    told += f"; the last {number(_MOST_STEPS)} are drawn." if steps > _MOST_STEPS else "."
    if "json" not in record.provenance.get("world", {}):
        return markup.caption(told, "The record does not say in which world, so there is no path.")
    known = "config" in record.provenance
    radius = record.config.robot.radius if known else RobotDef().radius
    movers = known and record.rounds["began"][entry] >= 0
    frame, ground, thinned = _ground(record.world, record.times(entry)[0] if movers else 0.0)
    drawn = path[-_MOST_STEPS - 1 :, :2]
    why = kinds[-_MOST_STEPS:]
    # A piece of the path goes on as long as the kind is the same.
    begins = np.flatnonzero(np.diff(why, prepend=-1))
    pieces = [drawn[a : b + 1] for a, b in zip(begins, [*begins[1:], len(why)])]
    lines = [
        element(
            "path",
            d=Lines.of(frame, [p for p, a in zip(pieces, begins) if why[a] == kind]).path(),
            fill="none",
            stroke=colour,
            stroke_width=width,
            stroke_linejoin="round",
            stroke_linecap="round",
        )
        for kind, (colour, width) in _KINDS.items()
        if (why == kind).any()
    ]
    marks = _body(frame, radius, path[0])
    shown = markup.clipped(frame, *lines)
    counts = {kind: int((kinds == kind).sum()) for kind in _KINDS}
    return [
        *markup.caption(told),
        (frame.height, ground + shown + marks),
        _gap(),
        *_legend([(kind, count) for kind, count in counts.items() if count]),
        *markup.caption(_told_of(record.world), thinned),
    ]


def _legend(counts: Sequence[tuple[Kind, int]]) -> list[tuple[int, str]]:
    """Which line is which, and of how many steps; three a row."""
    rows = []
    for row in (counts[i : i + 3] for i in range(0, len(counts), 3)):
        drawn = ""
        for i, (kind, count) in enumerate(row):
            colour, width = _KINDS[kind]
            x, name = i * 120 * PIXEL, f"{kind.name.lower()} ({number(count)})"
            drawn += element("path", d=f"M{x} 80h160", stroke=colour, stroke_width=width)
            drawn += markup.words(x + 20 * PIXEL, 11 * PIXEL, name)
        rows.append((16 * PIXEL, drawn))
    return rows


def _chart(rounds: npt.NDArray[np.void]) -> list[tuple[int, str]]:
    """Steps of each round, on a logarithmic scale; of too many rounds medians of neighbours."""
    each = -(-len(rounds) // _MOST_ROUNDS)
    groups = [rounds["steps"][i : i + each] for i in range(0, len(rounds), each)]
    steps = np.maximum([np.median(group) for group in groups], 1)
    failed = [not rounds["arrived"][i : i + each].all() for i in range(0, len(rounds), each)]
    low, high = float(steps.min()), float(steps.max())
    left, height = 50 * PIXEL, 80 * PIXEL
    x = left + np.linspace(0, _SIDE * PIXEL - left, len(steps))
    share = np.log(steps / low) / (math.log(high / low) or 1.0)
    points = np.rint(np.column_stack([x, 100 + (height - 100) * (1 - share)])).astype(np.int64)
    line = Lines(points, np.zeros(len(points), np.int64))
    dots = Lines(points[failed], np.arange(sum(failed)))
    right = {"text_anchor": "end"}
    drawn = [
        element("path", d=f"M{left} {height + 40}H{_SIDE * PIXEL}", stroke=INK, stroke_width=5),
        element("path", d=line.path(), fill="none", stroke=BLUE, stroke_width=12),
        element("path", d=dots.path(), fill="none", stroke=VERMILLION,
                stroke_width=50, stroke_linecap="round"),
        markup.words(left - 60, 140, number(high), **right),
        markup.words(left - 60, height + 40, number(low), **right) if high > low else "",
    ]  # fmt: skip
    what = f"Steps of each round ({number(rounds['round'][0])} to {number(rounds['round'][-1])})"
    what += f", medians of {number(each)}" if each > 1 else ""
    what += "; orange: some did not arrive." if any(failed) else "."
    return [(height + 8 * PIXEL, "".join(drawn)), *markup.caption(what)]


# --- trials and learners --------------------------------------------------------------------------


def trial_html(trial: Trial) -> str:
    """Where a trial stands: what it is made of, and a picture of the robot where it is."""
    world, config = trial.world, trial.config
    frame, ground, thinned = _ground(world, trial.time)
    picture = markup.picture(
        f"trial in world {world.name}",
        (frame.height, ground + _body(frame, config.robot.radius, trial.pose)),
        _gap(),
        *markup.caption(_told_of(world), thinned),
        width=_width(frame),
    )
    x, y, heading = (number(value) for value in trial.pose)
    told: dict[str, str | float] = {
        "agent": _agent(trial),
        "seed": trial.seed,
        "round": trial.round,
        "steps so far": round(trial.time / config.robot.sample_time),
        "robot at": f"({x}, {y}) m, heading {heading} degrees",
        "at the target": "yes" if trial.arrived else "no",
    }
    return markup.facts(told) + picture


def _agent(trial: Trial) -> str:
    try:
        return repr(trial.agent)
    except Exception:  # a repr of the caller's
        return type(trial.agent).__name__


def learner_html(learner: Learner) -> str:
    """What a learner holds: its counts, and the situations that it learned in most."""
    memory = learner.memory()
    of = np.repeat(np.arange(len(memory.situation)), memory.effective_count)
    learned = np.bincount(of, memory.times_learned, minlength=len(memory.situation))
    most = np.argsort(-learned, kind="stable")[:_MOST_ROWS]
    config = learner.config
    told: dict[str, str | float] = {
        "motions": config.motion_count,
        "situations experienced": learner.situations_experienced,
        "mappings explored (NUM_RM)": learner.explored_count,
        "of these effective (NUM_M)": learner.effective_count,
        "sigma, eta": f"{number(config.sigma)}, {number(config.eta)}",
        "on_negative, when_exhausted": f"{config.on_negative}, {config.when_exhausted}",
    }
    rows = []
    for i in most.tolist():
        situation = int(memory.situation[i])
        lists = learner.situation(situation)
        effective = [
            f"{motion} (o {orientation:.3g}, n {times})"
            for motion, orientation, times in zip(
                lists.effective[:_MOST_NAMED], lists.orientation, lists.times_learned
            )
        ]
        rows.append((str(situation), _listed(effective, len(lists.effective)),
                     _listed(lists.ineffective), _listed(lists.unexplored)))  # fmt: skip
    head = ("situation", "effective: orientation, times learned", "ineffective", "not tried")
    return _with_situations(told, head, rows, learner.situations_experienced, "learned in most")


def adaptive_html(learner: AdaptiveLearner) -> str:
    """What an adaptive learner holds: its counts, and the situations that it met last."""
    config, habit = learner.config, learner.habit_cost
    told: dict[str, str | float] = {
        "motions": config.motion_count,
        "situations met": learner.situations_experienced,
        "mappings explored (NUM_RM)": learner.explored_count,
        "of these effective (NUM_M)": learner.effective_count,
        "outcomes remembered": learner.outcomes,
        "optimism": f"{number(learner.optimism)} (began with {number(config.optimism)})",
        "the habit costs": "there is none yet" if habit is None else habit,
    }
    rows = []
    for situation in learner.situations()[: -_MOST_ROWS - 1 : -1].tolist():
        lists = learner.situation(situation)
        effective = [
            f"{motion} (q {lists.losses[motion]:.4g}, n {lists.times[motion]})"
            for motion in lists.effective[:_MOST_NAMED]
        ]
        rows.append((str(situation), lists.expected_loss, lists.first_estimate,
                     _listed(effective, len(lists.effective)), _listed(lists.ineffective),
                     _listed(lists.unexplored)))  # fmt: skip
    head = (
        "situation",
        "E",
        "estimate",
        "effective: loss, times tried",
        "ineffective",
        "not tried",
    )
    return _with_situations(told, head, rows, learner.situations_experienced, "met last")


def _with_situations(
    told: dict[str, str | float], head: Sequence[str], rows: Sequence[Any], of: int, which: str
) -> str:
    if not rows:
        return markup.facts(told)
    shown = f"The {number(len(rows))} of {counted(of, 'situation')} {which}:"
    return markup.facts(told) + markup.paragraph(shown) + markup.table(head, rows)


def _listed(values: Sequence[object], of: int | None = None) -> str:
    """The first of them, and how many more there are."""
    of = len(values) if of is None else of
    more = f", and {number(of - _MOST_NAMED)} more" if of > _MOST_NAMED else ""
    return ", ".join(map(str, values[:_MOST_NAMED])) + more


# --- explanations ---------------------------------------------------------------------------------


def explanation_html(explanation: Explanation) -> str:
    """Why motions are chosen: the probabilities of step 3, and a row a motion."""
    memory = explanation.memory
    place = {motion: i for i, motion in enumerate(memory.effective)}
    of = (memory.orientation, memory.times_learned, explanation.curiosity, explanation.op_plain,
          explanation.op_curious)  # fmt: skip
    nothing = [""] * len(of)

    def row(motion: int, name: str) -> list[object]:
        i = place.get(motion)
        each = nothing if i is None else [values[i] for values in of]
        return [str(motion), name, explanation.probability[motion], *each]

    head = ("motion", "list", "probability", "orientation", "learned", "curiosity", "op",
            "op curious")  # fmt: skip
    told = ", ".join(
        f"{name} {number(getattr(explanation, name))}"
        for name in ("explore", "exploit", "exhausted")
    )
    return markup.paragraph(f"Situation {explanation.situation}: {told}") + _motion_table(
        head, row, memory, explanation.probability, explanation.allowed
    )


def trace_html(trace: ChoiceTrace) -> str:
    """Why one choice came out as it did."""
    motion, kind = trace.choice
    told = f"Motion {motion}, {kind.name.lower()}"
    told += f"; curious about motion {trace.curious}" if trace.curious >= 0 else ""
    return markup.paragraph(told) + explanation_html(trace.explanation)


def adaptive_explanation_html(explanation: AdaptiveExplanation) -> str:
    """Why an adaptive learner chooses: what the choice goes by, and a row a motion."""
    memory = explanation.memory
    told = [
        f"Situation {explanation.situation}: E {number(memory.expected_loss)}, "
        f"estimate at the first meeting {number(memory.first_estimate)}"
    ]
    by = (
        "a draw is to decide"
        if explanation.kind == Kind.UNSTATED
        else explanation.kind.name.lower()
    )
    told.append(f"Motion {explanation.motion}, {by}" if explanation.motion >= 0 else by)
    for name in ("held", "habit", "deviation"):
        if (motion := getattr(explanation, name)) >= 0:
            told.append(f"{name}: motion {motion}")

    def row(motion: int, name: str) -> list[object]:
        return [str(motion), name, memory.losses[motion], memory.times[motion],
                explanation.probability[motion]]  # fmt: skip

    head = ("motion", "list", "loss q", "tried", "by values")
    return markup.paragraph(*told) + _motion_table(
        head, row, memory, explanation.probability, explanation.allowed
    )


def _motion_table(
    head: Sequence[str],
    row: Any,
    memory: Any,
    probability: Sequence[float],
    allowed: Sequence[bool],
) -> str:
    """A row a motion; of too many motions the most probable ones."""
    lists = {m: n for n in ("effective", "ineffective", "unexplored") for m in getattr(memory, n)}
    order = np.argsort(-np.array(probability), kind="stable").tolist()
    shown = order if len(order) > 2 * _MOST_ROWS else sorted(order)
    shown = shown[: 2 * _MOST_ROWS]
    rows = [
        row(motion, lists[motion] + ("" if allowed[motion] else ", not allowed"))
        for motion in shown
    ]
    left = len(order) - len(shown)
    more = markup.paragraph(f"and {counted(left, 'less probable motion')}") if left else ""
    return markup.table(head, rows) + more
