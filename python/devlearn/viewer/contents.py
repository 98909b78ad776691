"""What is on a page: of a world, and of a record in it."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from .._core import Circle, Event, Kind, MoverWalk, Rectangle, TrialConfig, World
from ..analysis import sef_field
from ..record import Record
from .learners import pack_learner
from .pack import Packer
from .steps import Shown, pack_steps

_FIELD_POINTS = 161  # of SEF, along the longer side
_WORLD_TIME = 600.0  # for which a world's movers are shown without a record [s]
_MOST_LEGS = 5000  # of walks


def of_world(world: World, config: TrialConfig) -> str:
    """The world alone, packed."""
    packer = Packer()
    header = _place(packer, world, config, world, (0.0, _WORLD_TIME if world.movers else 0.0))
    return packer.text({**header, "shows": "world"})


def of_record(record: Record, most_steps: int) -> str:
    """A record and its world, packed; of a longer record so many steps or about as many rounds.

    Raises InvalidValue where it tells no world, FileError where its learner cannot be read.
    """
    packer = Packer()
    header = _place(packer, record.world, record.config, record, _times(record))
    header |= {"shows": "rounds", "provenance": _provenance(record)}
    notes: list[str] = header["notes"]
    entries = np.arange(0, len(record.rounds), -(-max(1, len(record.rounds)) // most_steps))
    if record.rounds_only:
        notes.append("This record holds rounds only: where the robot went was not kept.")
    elif len(record.rounds) == 0:
        notes.append("This record holds no rounds: nothing was run.")
    else:
        shown = Shown.of(record, most_steps)
        entries = shown.entries
        header |= {"shows": "steps", "total": len(record)}
        header |= pack_steps(packer, record, shown)
        header |= pack_learner(packer, record, shown, notes)
    header["allRounds"] = len(record.rounds)
    header["allArrived"] = int(record.rounds["arrived"].sum())
    rounds = record.rounds[entries]
    packer.whole("roundNumber", rounds["round"])
    packer.whole("roundSteps", rounds["steps"])
    packer.whole("roundArrived", rounds["arrived"])
    packer.floats("roundBegan", rounds["began"])
    return packer.text(header)


# --- the place ------------------------------------------------------------------------------------


def _place(
    packer: Packer, world: World, config: TrialConfig, source: World | Record,
    times: tuple[float, float],
) -> dict[str, Any]:  # fmt: skip
    """The world, the robot, and SEF as ground."""
    notes: list[str] = []
    shown = json.loads(world.to_json())
    shown["arena"].setdefault("origin", [0, 0])
    for mover in shown.get("movers", []):
        if "walk" in mover:
            mover["walk"]["from"] = int(times[0] // mover["walk"]["leg_time"])
            mover["walk"]["waypoints"] = []
    for leg_time in {m.course.leg_time for m in world.movers if isinstance(m.course, MoverWalk)}:
        legs = range(int(times[0] // leg_time), int(times[1] // leg_time) + 2)
        if len(legs) > _MOST_LEGS:
            notes.append(f"Walks are shown for {_MOST_LEGS * leg_time:g} s; then they stand.")
        for leg in legs[:_MOST_LEGS]:
            for mover, shape in zip(shown["movers"], world.movers_at(leg * leg_time)):
                walks = mover.get("walk", {}).get("leg_time") == leg_time
                if walks and isinstance(shape, (Circle, Rectangle)):
                    mover["walk"]["waypoints"].append(list(shape.center))
    if isinstance(source, Record) and "evaluation" in source.provenance:
        notes.append("SEF is the trial's own, which the record does not hold: it is no ground.")
    else:
        still = world
        if world.movers:
            standing = {name: told for name, told in shown.items() if name != "movers"}
            still = World.from_json(json.dumps(standing))
        field = sef_field(still, config.evaluation, config.walls_count, _FIELD_POINTS)
        packer.parts("field", field.sef, field.floor, max(field.floor, float(field.sef.max())))
        shown["field"] = {"columns": len(field.x), "rows": len(field.y)}
        if world.movers:
            notes.append("The ground is SEF by what stands still.")
    return {
        "world": shown,
        "robot": config.robot.to_dict(),
        "sonarAngles": config.robot.sonar_angles(),
        "goalRadius": config.goal_radius,
        "notes": notes,
        "times": times,
        "kinds": [kind.name.lower() for kind in sorted(Kind)],
        "events": [event.name.lower() for event in sorted(Event)],
    }


def _times(record: Record) -> tuple[float, float]:
    """The world's time at the record's first pose and at its last [s]; 0 where it is not known."""
    began, steps = record.rounds["began"], record.rounds["steps"]
    if not len(began) or began.min() < 0:
        return 0.0, 0.0
    sample_time = record.config.robot.sample_time
    return float(began.min()) * sample_time, float((began + steps).max()) * sample_time


def _provenance(record: Record) -> dict[str, Any]:
    told = record.provenance
    names = ("devlearn", "commit", "seed", "agent", "evaluation", "situations")
    return {
        **{name: told[name] for name in names if name in told},
        "hash": told["world"].get("hash", ""),
    }
