"""What Rerun is sent of a trial: its entities, their columns, and how they are laid out."""

from __future__ import annotations

import json
import uuid
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .._colours import BLUE, BY_KIND, GREEN, GREY, INK, PURPLE, VERMILLION
from .._core import Trial, World
from ..analysis.outlines import circle, course, outlines
from ..errors import MissingExtra
from ..record import Record, provenance_of
from .steps import Shown

try:
    import pyarrow
    import rerun
    from rerun import blueprint
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.view", "rerun-sdk", "live") from error

if TYPE_CHECKING:
    from .live import Word

Array = npt.NDArray[Any]

APPLICATION = "devlearn"
PATH_STEPS = 2000  # of the path that are seen at once
_MOST_MOMENTS = 200  # in a batch at which what moves is shown
_SECONDS = 10.0  # in which what is sent must arrive
_FINE, _BROAD = rerun.Radius.ui_points(0.8), rerun.Radius.ui_points(1.5)
_PATHS = {kind: f"world/path/{kind.name.lower()}" for kind in BY_KIND}


class Moments(NamedTuple):
    """When: how many steps the trial had made, and the round; (n,) each."""

    step: npt.NDArray[np.int64]
    round: npt.NDArray[np.int64]


class Stream:
    """Recordings of Rerun's: into a file, to a viewer, or both. Raises what Rerun raises.

    Parameters: the trial that is shown; a file's path, and a viewer's address, of which one may be
    None.
    """

    def __init__(self, trial: Trial, path: str | None, address: str | None) -> None:
        self._world, self._config = trial.world, trial.config
        sinks: list[Any] = [] if path is None else [rerun.FileSink(path)]
        sinks += [] if address is None else [rerun.GrpcSink(address)]
        self._recordings = [_opened(sink, trial.world) for sink in sinks]
        whence = provenance_of(trial.world, trial.config, trial.seed, trial.agent)
        world = whence["world"]
        name = f"{world['name'] or 'world'}, seed {trial.seed}"
        for recording in self._recordings:
            recording.send_recording_name(name)
        about = json.dumps({**whence, "world": {**world, "json": "..."}}, indent=1)
        text = f"# {name}\n\n```json\n{about}\n```\n"
        self._log("about", rerun.TextDocument(text, media_type="text/markdown"))
        self._name_series()
        self._give_looks()
        self.change_world(trial.world, 0, 0)

    def flush(self) -> None:
        """Waits until what was sent is in the file and at the viewer.

        Where it is not, that one is sent nothing more, which is a RuntimeWarning while the other is
        there; raises what Rerun raises where there is none.
        """
        for recording in self._recordings[:]:
            try:
                recording.flush(timeout_sec=_SECONDS)
            except Exception as error:
                self._recordings.remove(recording)
                if not self._recordings:
                    raise
                warnings.warn(f"shown in one place less: {error}", RuntimeWarning, stacklevel=5)

    def close(self) -> None:
        """The file is whole then."""
        for recording in self._recordings:
            recording.disconnect()

    # --- what stands still ------------------------------------------------------------------------

    def _name_series(self) -> None:
        for entity, names, colours in (
            ("evaluation", ["SEF", "SMF used"], [BLUE, PURPLE]),
            ("mappings", ["explored", "effective"], [BLUE, VERMILLION]),
            ("rounds/arrived", ["steps of a round that arrived"], [BLUE]),
        ):
            self._log(entity, rerun.SeriesLines(names=names, colors=_rgba(*colours)))
        failed = "steps of one that did not"
        look = rerun.SeriesPoints(names=failed, colors=_rgba(VERMILLION), markers="cross")
        self._log("rounds/failed", look)

    def _give_looks(self) -> None:
        # Rerun's y points down. The data are as they are: all of the world is turned over.
        self._log("world", rerun.Transform3D(scale=[1, -1, 1]))
        looks = {
            "world/walls": (INK, _BROAD), "world/obstacles": (BLUE, _FINE),
            "world/courses": (GREY, _FINE), "world/movers": (BLUE, _BROAD),
        }  # fmt: skip
        looks.update((_PATHS[kind], (colour, _BROAD)) for kind, colour in BY_KIND.items())
        for entity, (colour, width) in looks.items():
            self._log(entity, rerun.LineStrips2D.from_fields(colors=_rgba(colour), radii=width))
        radius = self._config.robot.radius
        look = rerun.Points2D.from_fields(colors=_rgba(VERMILLION), radii=radius / 4)
        self._log("world/touches", look)
        body = [circle(radius), np.array([[0, 0], [radius, 0]])]
        self._log("world/robot", rerun.LineStrips2D(body, colors=_rgba(GREEN), radii=_BROAD))

    def change_world(self, world: World, step: int, round: int) -> None:
        """The world from a step on."""
        self._world, at = world, Moments(np.array([step]), np.array([round]))
        x, y = world.origin
        right, top = x + world.width, y + world.height
        walls = np.array([[x, y], [right, y], [right, top], [x, top], [x, y]])
        still = [line for obstacle in world.obstacles for line in outlines(obstacle)]
        self._draw("world/walls", at, [walls])
        self._draw("world/obstacles", at, still)
        self._draw("world/courses", at, [course(mover) for mover in world.movers])
        places = rerun.Points2D.columns(
            positions=[world.target, world.start[:2]],
            colors=_rgba(VERMILLION, GREY),
            radii=[0.4 * self._config.robot.radius] * 2,
            labels=["target", "start"],
            show_labels=[False] * 2,
        )
        self._send("world/places", at, places.partition([2]))
        self._draw_movers(at)

    # --- what happens -----------------------------------------------------------------------------

    def steps(self, record: Record, shown: Shown) -> None:
        """Robot, path, touches, SEF, SMF and counts of the steps shown."""
        entry = np.repeat(shown.entries, shown.counts)
        made = record.rounds["began"] - record.offsets()[:-1]
        at = Moments(made[entry] + shown.steps + 1, record.rounds["round"][entry].astype(np.int64))
        after = np.arange(len(entry)) + np.repeat(np.arange(len(shown.counts)), shown.counts) + 1
        places = np.column_stack([record.x[shown.poses], record.y[shown.poses]])
        half = np.radians(record.heading[shown.poses[after]]) / 2
        turn = np.zeros((len(half), 4), np.float32)
        turn[:, 2], turn[:, 3] = np.sin(half), np.cos(half)
        self._send(
            "world/robot", at,
            rerun.Transform3D.columns(
                translation=np.pad(places[after], ((0, 0), (0, 1))), quaternion=turn
            ),
        )  # fmt: skip
        kinds = record.kind[shown.steps]
        for kind, entity in _PATHS.items():
            of_kind = np.flatnonzero(kinds == int(kind))
            ends = after[of_kind]
            lines = np.stack([places[ends - 1], places[ends]], axis=1)
            self._send(entity, _some(at, of_kind), _strips(lines.reshape(-1, 2), 2))
        touched = np.flatnonzero(record.collided[shown.steps])
        self._send(
            "world/touches", _some(at, touched),
            rerun.Points2D.columns(positions=places[after[touched]]),
        )  # fmt: skip
        for entity, columns in (
            ("evaluation", (record.sef, record.smf_used)),
            ("mappings", (record.explored_count, record.effective_count)),
        ):
            values = np.column_stack([column[shown.steps] for column in columns])
            self._send(entity, at, rerun.Scalars.columns(scalars=values.astype(float)))
        if self._world.movers and len(entry):
            every = -(-len(entry) // _MOST_MOMENTS)
            self._draw_movers(_some(at, np.arange(len(entry))[::-every][::-1]))

    def _draw_movers(self, at: Moments) -> None:
        """Movers at some moments."""
        lines, movers = [], self._world.movers
        step_time = self._config.robot.sample_time
        for step in at.step.tolist() if movers else []:
            for shape in self._world.movers_at(step * step_time):
                lines += outlines(shape)
        self._draw("world/movers", at, lines)

    def rounds(self, rounds: npt.NDArray[np.void]) -> None:
        """What rounds came to, each at its end: entries of a record's ``rounds``."""
        ends = Moments(rounds["began"] + rounds["steps"], rounds["round"].astype(np.int64))
        for name, chosen in (("arrived", rounds["arrived"]), ("failed", ~rounds["arrived"])):
            steps = rounds["steps"][chosen].astype(float)
            self._send(
                f"rounds/{name}", _some(ends, np.flatnonzero(chosen)),
                rerun.Scalars.columns(scalars=steps),
            )  # fmt: skip

    def say(self, words: Sequence[Word]) -> None:
        """Lines of the log."""
        at = Moments(np.array([w.step for w in words]), np.array([w.round for w in words]))
        texts, levels = [word.text for word in words], [word.level for word in words]
        self._send("events", at, rerun.TextLog.columns(text=texts, level=levels))

    # --- sending ----------------------------------------------------------------------------------

    def _draw(self, entity: str, at: Moments, lines: Sequence[Array]) -> None:
        """Equally many lines at each moment."""
        each = [len(lines) // len(at.step)] * len(at.step)
        self._send(entity, at, rerun.LineStrips2D.columns(strips=lines).partition(each))

    def _log(self, entity: str, what: Any) -> None:
        for recording in self._recordings:
            rerun.log(entity, what, static=True, recording=recording, strict=True)

    def _send(self, entity: str, at: Moments, columns: Any) -> None:
        if len(at.step) == 0:
            return
        when = [
            rerun.TimeColumn("step", sequence=at.step),
            rerun.TimeColumn("time", duration=at.step * self._config.robot.sample_time),
            rerun.TimeColumn("round", sequence=at.round),
        ]
        for recording in self._recordings:
            rerun.send_columns(entity, when, columns, recording=recording, strict=True)


def _opened(sink: Any, world: World) -> Any:
    recording = rerun.RecordingStream(APPLICATION, recording_id=uuid.uuid4(), send_properties=False)
    rerun.set_sinks(sink, default_blueprint=_layout(world), recording=recording)
    return recording


def _some(at: Moments, which: Array) -> Moments:
    return Moments(at.step[which], at.round[which])


def _strips(points: Array, each: int) -> Any:
    """Points (n, 2) as lines of so many points; Rerun's own conversion goes line by line."""
    kind = rerun.components.LineStrip2DBatch._ARROW_DATATYPE
    flat = pyarrow.array(np.ascontiguousarray(points, np.float32).reshape(-1))
    points = pyarrow.FixedSizeListArray.from_arrays(flat, type=kind.value_type)
    begins = pyarrow.array(np.arange(0, len(points) + 1, each, dtype=np.int32))
    return rerun.LineStrips2D.columns(
        strips=pyarrow.ListArray.from_arrays(begins, points, type=kind)
    )


def _rgba(*colours: str) -> list[int]:
    return [int(f"{colour[1:]}FF", 16) for colour in colours]


def _layout(world: World) -> Any:
    """The world and the log on the left, the series on the right."""
    margin = 0.02 * max(world.width, world.height)
    x, y = world.origin
    bounds = blueprint.VisualBounds2D(
        x_range=[x - margin, x + world.width + margin],
        y_range=[-(y + world.height) - margin, margin - y],
    )
    cursor = blueprint.TimeRangeBoundary.cursor_relative
    newest = blueprint.VisibleTimeRanges(
        [
            blueprint.VisibleTimeRange("step", start=cursor(seq=-PATH_STEPS), end=cursor(seq=0)),
            blueprint.VisibleTimeRange("round", start=cursor(seq=0), end=cursor(seq=0)),
        ]
    )
    map_ = blueprint.Spatial2DView(
        origin="/", contents="/world/**", name="World", visual_bounds=bounds,
        background=[255, 255, 255],
        overrides=dict.fromkeys([*_PATHS.values(), "world/touches"], newest),
    )  # fmt: skip
    log = blueprint.TextLogView(
        origin="/events",
        name="Events",
        columns=blueprint.TextLogColumns(
            timeline_columns=["step", "round"], text_log_columns=["loglevel", "body"]
        ),
    )
    series = [
        blueprint.TimeSeriesView(
            origin=f"/{entity}",
            name=name,
            axis_x=_all_times(),
            plot_legend=blueprint.PlotLegend(corner=corner),
        )
        for entity, name, corner in (
            ("rounds", "Steps a round", blueprint.Corner2D.RightTop),
            ("evaluation", "SEF and SMF", blueprint.Corner2D.LeftBottom),
            ("mappings", "Sensorimotor mappings", blueprint.Corner2D.LeftTop),
        )
    ]
    about = blueprint.TextDocumentView(origin="/about", name="About")
    return blueprint.Blueprint(
        blueprint.Horizontal(
            blueprint.Vertical(map_, blueprint.Tabs(log, about), row_shares=[3, 1]),
            blueprint.Vertical(*series),
            column_shares=[3, 2],
        ),
        blueprint.TimePanel(timeline="step", play_state="following", state="collapsed"),
        blueprint.BlueprintPanel(state="collapsed"),
        blueprint.SelectionPanel(state="collapsed"),
    )


def _all_times() -> Any:
    whole = blueprint.TimeRangeBoundary.infinite()
    return blueprint.TimeAxis(view_range=rerun.TimeRange(start=whole, end=whole))
