"""What happened in a trial, as columns."""

from __future__ import annotations

import csv
import difflib
import hashlib
import io
import json
import os
import stat
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from typing import IO, TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core, _npz
from ._calls import path_text, shown
from .errors import FileError, InvalidValue, MissingExtra, WrongType

if TYPE_CHECKING:
    import pandas

FORMAT = "devlearn-record"
FORMAT_VERSION = 1

# One value a step, and one value a pose: a round of n steps has n + 1. Name and dtype of each.
STEP_COLUMNS = {name: np.dtype(dtype) for name, (dtype, _) in _core.step_columns.items()}
POSE_COLUMNS = {name: np.dtype(dtype) for name, (dtype, _) in _core.pose_columns.items()}
_ROUND_FIELDS = {"round": np.int32, "steps": np.int64, "arrived": np.bool_, "began": np.int64}
_ROUNDS_DTYPE = np.dtype(list(_ROUND_FIELDS.items()))
# Files of builds that did not tell when a round began have none of the last field.
_EARLIER_ROUNDS_DTYPE = np.dtype(list(_ROUND_FIELDS.items())[:-1])


def _table() -> str:
    columns = {**_core.step_columns, **_core.pose_columns}
    columns["rounds"] = ("struct", "one entry a round: round, steps, arrived, began")
    columns["echoes"] = ("float64", "after each step: (steps, sonars) [m], or None")
    rule = f"{'=' * 19}  {'=' * 7}  {'=' * 51}"
    rows = [f"``{name}``".ljust(21) + f"{d:9}{doc}" for name, (d, doc) in columns.items()]
    return "\n    ".join([rule, "column               dtype    meaning", rule, *rows, rule])


_Earlier = tuple[_core.World, int]  # and how many steps the trial had made in it and before


class Record:  # noqa: D101 - made of the columns
    __doc__ = f"""What happened in a trial: numpy columns of one value a step or a pose.

    {_table()}

    A round of n steps has n + 1 poses, from where it began to where it ended.
    A run with ``rounds_only`` leaves the step and pose columns empty; ``rounds`` tells the steps.
    ``began`` is how many steps the trial had made before the entry; -1: the file does not say.

    ``provenance`` tells where it came from: version, commit, Box2D's version, world and its hash,
    configuration, seed and agent; ``evaluation`` and ``situations`` by name, where they are one's
    own; where the trial's world was changed, ``earlier_worlds``, each with ``steps``, the number
    made by then.

    ``learner`` is a snapshot of the learner as it was before the first step, as its ``to_bytes``
    gave it, where a phase was asked for it (``learner=True``); else None.
    """

    round: npt.NDArray[np.int32]
    situation: npt.NDArray[np.int64]
    true_situation: npt.NDArray[np.int64]
    motion: npt.NDArray[np.int32]
    kind: npt.NDArray[np.uint8]
    sef: npt.NDArray[np.float64]
    smf: npt.NDArray[np.float64]
    smf_used: npt.NDArray[np.float64]
    collided: npt.NDArray[np.bool_]
    arrived: npt.NDArray[np.bool_]
    goal_distance: npt.NDArray[np.float64]
    clearance: npt.NDArray[np.float64]
    cost: npt.NDArray[np.float64]
    value: npt.NDArray[np.float64]
    event: npt.NDArray[np.uint8]
    reduced: npt.NDArray[np.int32]
    explored_count: npt.NDArray[np.int64]
    effective_count: npt.NDArray[np.int64]
    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    heading: npt.NDArray[np.float64]
    rounds: npt.NDArray[np.void]
    echoes: npt.NDArray[np.float64] | None
    learner: bytes | None
    _origin: tuple[_core.World, _core.TrialConfig, int, type, Mapping[str, str], list[_Earlier]]

    def __init__(
        self,
        columns: Mapping[str, npt.NDArray[Any]],
        provenance: Mapping[str, Any],
        learner: bytes | None = None,
    ) -> None:
        """From the columns above and a provenance; raises InvalidValue where they do not fit."""
        _check(columns)
        _check_provenance(provenance)
        if not isinstance(learner, (bytes, type(None))):
            raise WrongType("learner", shown(learner), "what to_bytes of a learner gives, or None")
        self._take(columns)
        self.learner = learner
        self.provenance = dict(provenance)

    def _take(self, columns: Mapping[str, npt.NDArray[Any]]) -> None:
        for name in (*STEP_COLUMNS, *POSE_COLUMNS):
            setattr(self, name, columns[name])
        self.rounds = np.empty(len(columns["rounds"]), _ROUNDS_DTYPE)  # without padding
        self.rounds["began"] = -1  # not known, unless they say
        for field in columns["rounds"].dtype.names or ():
            self.rounds[field] = columns["rounds"][field]
        self.echoes = columns.get("echoes")

    @classmethod
    def _of_trial(
        cls,
        columns: Mapping[str, npt.NDArray[Any]],
        world: _core.World,
        config: _core.TrialConfig,
        seed: int,
        agent: object,
        own: Mapping[str, str],
        earlier: list[_Earlier],
        learner: bytes | None,
    ) -> Record:
        record = cls.__new__(cls)
        record._take(columns)  # which fit, as the trial made them
        record.learner = learner
        record._origin = world, config, seed, type(agent), own, earlier
        return record

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """Where it came from, as plain values."""
        # When it is asked for: of many a phase it never is.
        world, config, seed, agent, own, earlier = self._origin
        told = _provenance(world, config, seed, agent) | dict(own)
        if earlier:
            told["earlier_worlds"] = [_world(was) | {"steps": steps} for was, steps in earlier]
        return told

    @classmethod
    def concatenate(cls, records: Sequence[Record]) -> Record:
        """Records of one trial, one after the other; provenance and learner are the first's.

        Where one goes on with the round and from the pose that the one before ended with, that
        round becomes one, as if it had never been stopped.

        Raises InvalidValue for no records, where only some hold echoes, or for records of different
        worlds.
        """
        if not records:
            raise InvalidValue("records", "none", "at least one")
        echoes = [record.echoes for record in records if record.echoes is not None]
        if 0 < len(echoes) < len(records):
            raise InvalidValue("records", "echoes in some only", "echoes in all or in none")
        worlds = {record.provenance.get("world", {}).get("hash") for record in records}
        if len(worlds) > 1:
            raise InvalidValue("records", f"of {len(worlds)} worlds", "of one world")
        columns = {n: np.concatenate([getattr(r, n) for r in records]) for n in STEP_COLUMNS}
        if echoes:
            columns["echoes"] = np.concatenate(echoes)
        rounds = np.concatenate([record.rounds for record in records])
        # The first and the last pose of each record; where a record begins among these and rounds.
        ends = {
            n: np.concatenate([part for r in records for part in (r[n][:1], r[n][-1:])])
            for n in POSE_COLUMNS
        }
        entries = np.cumsum([0, *(len(record.rounds) for record in records)]).tolist()
        firsts = np.cumsum([0, *(2 * (len(record.x) > 0) for record in records)]).tolist()
        goes_on = {
            (entry, pose)
            for entry, pose in zip(entries, firsts)
            if 0 < entry < len(rounds)
            and rounds["round"][entry] == rounds["round"][entry - 1]
            and all(np.array_equal(p[pose : pose + 1], p[pose - 1 : pose]) for p in ends.values())
        }
        for entry, _ in sorted(goes_on, reverse=True):
            rounds["steps"][entry - 1] += rounds["steps"][entry]
            rounds["arrived"][entry - 1] |= rounds["arrived"][entry]
        columns["rounds"] = np.delete(rounds, [entry for entry, _ in goes_on])
        twice = {pose for _, pose in goes_on if pose > 0}  # but for records of rounds only
        for n in POSE_COLUMNS:
            parts = [r[n][int(first in twice) :] for r, first in zip(records, firsts)]
            columns[n] = np.concatenate(parts)
        return cls(columns, records[0].provenance, records[0].learner)

    def __len__(self) -> int:
        """How many steps."""
        return len(self.situation)

    def __iter__(self) -> Iterator[str]:
        """The names of its columns: those of steps, of poses, ``rounds``, ``echoes`` if there."""
        yield from (*STEP_COLUMNS, *POSE_COLUMNS, "rounds")
        if self.echoes is not None:
            yield "echoes"

    def __contains__(self, name: object) -> bool:
        return name in tuple(self)

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        """The column of this name. Raises KeyError, saying which there are."""
        if name not in self:
            near = difflib.get_close_matches(str(name), self, 1)
            meant = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(self)}"
            raise KeyError(f"no column {name!r}; {meant}")
        column: npt.NDArray[Any] = getattr(self, name)
        return column

    def __eq__(self, other: object) -> bool:
        """Whether provenance, learner and all columns are the same, value by value."""
        if not isinstance(other, Record):
            return NotImplemented
        return (
            self.provenance == other.provenance
            and self.learner == other.learner
            and tuple(self) == tuple(other)
            and all(_same(self[name], other[name]) for name in self)
        )

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        arrived = int(np.count_nonzero(self.rounds["arrived"]))
        world = self.provenance.get("world", {}).get("name", "?")
        return (
            f"<devlearn.Record: {len(self)} steps in {len(self.rounds)} rounds, "
            f"{arrived} arrived, world {world!r}>"
        )

    def _repr_svg_(self) -> str:
        from .viewer.display import record_svg

        return record_svg(self)

    @property
    def world(self) -> _core.World:
        """The world it happened in. Raises InvalidValue where its provenance does not say."""
        if "json" not in self.provenance.get("world", {}):
            raise InvalidValue(
                "record.provenance", "no world", "one that tells of world and config"
            )
        return _core.World.from_json(self.provenance["world"]["json"])

    @property
    def config(self) -> _core.TrialConfig:
        """The configuration it happened under. Raises InvalidValue likewise."""
        if "config" not in self.provenance:
            raise InvalidValue(
                "record.provenance", "no config", "one that tells of world and config"
            )
        return _core.TrialConfig.from_dict(self.provenance["config"])

    @property
    def rounds_only(self) -> bool:
        """Whether it holds rounds without their steps and poses."""
        return _holds_rounds_only(self.rounds, self.x)

    def steps_of(self, i: int) -> slice:
        """Where the steps of entry ``i`` of ``rounds`` stand in the step columns.

        Raises InvalidValue for a record of rounds only.
        """
        i = self._entry(i)
        start, stop = self.offsets()[i : i + 2].tolist()
        return slice(start, stop)

    def offsets(self) -> npt.NDArray[np.int64]:
        """Where the steps of each entry of ``rounds`` begin, and where those of the last end.

        One more than there are entries. Raises InvalidValue for a record of rounds only.
        """
        self._require_steps()
        return np.concatenate([[0], np.cumsum(self.rounds["steps"], dtype=np.int64)])

    def path(self, i: int = 0) -> npt.NDArray[np.float64]:
        """Poses of entry ``i`` of ``rounds``, its start first: (steps + 1, 3) [m, m, degrees]."""
        steps = self.steps_of(i)
        poses = slice(steps.start + self._entry(i), steps.stop + self._entry(i) + 1)
        return np.column_stack([self.x[poses], self.y[poses], self.heading[poses]])

    def times(self, i: int = 0) -> npt.NDArray[np.float64]:
        """When the poses of ``path(i)`` were, in the world's time [s]: (steps + 1,).

        Raises InvalidValue for a record of rounds only, or where the file does not say.
        """
        steps = self.steps_of(i)
        began = int(self.rounds["began"][i])
        if began < 0:
            raise InvalidValue(
                "record.rounds.began", began, "a number of steps, which is not known"
            )
        return (began + np.arange(steps.stop - steps.start + 1)) * self.config.robot.sample_time

    def part(self, entries: slice) -> Record:
        """The record of some entries of ``rounds`` alone, such as ``slice(2, None)``.

        It carries the learner where it begins where this one does; ``analysis.Replay`` tells the
        learner of later steps. Raises InvalidValue for a record of rounds only.
        """
        first, last, stride = entries.indices(len(self.rounds))
        if stride != 1:
            raise InvalidValue("entries", entries, "a slice of neighbours")
        last = max(first, last)
        start, stop = self.offsets()[[first, last]].tolist()
        columns = {name: getattr(self, name)[start:stop] for name in STEP_COLUMNS}
        columns |= {n: getattr(self, n)[start + first : stop + last] for n in POSE_COLUMNS}
        columns["rounds"] = self.rounds[first:last]
        if self.echoes is not None:
            columns["echoes"] = self.echoes[start:stop]
        return Record(columns, self.provenance, self.learner if start == 0 else None)

    def _require_steps(self) -> None:
        if self.rounds_only:
            raise InvalidValue("record", "rounds only", "one that holds steps")

    def _entry(self, i: int) -> int:
        count = len(self.rounds)
        if count == 0:
            raise InvalidValue("record", "no rounds", "one that holds rounds")
        if isinstance(i, (bool, np.bool_)) or not hasattr(i, "__index__"):
            raise WrongType("round entry", shown(i), "a whole number")
        if not -count <= i < count:
            raise InvalidValue("round entry", i, f"in [{-count}, {count - 1}]")
        return i % count

    # --- files ----------------------------------------------------------------------------------

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything to an npz file (no pickles): to the side first, then renamed."""
        with written_aside(path, "wb") as file:
            file.write(self.to_bytes())

    def to_bytes(self) -> bytes:
        """What ``save`` writes."""
        columns = {name: getattr(self, name) for name in (*STEP_COLUMNS, *POSE_COLUMNS, "rounds")}
        if self.echoes is not None:
            columns["echoes"] = self.echoes
        if self.learner is not None:
            columns["learner"] = np.frombuffer(self.learner, np.uint8)
        header = {"format": FORMAT, "version": FORMAT_VERSION, "provenance": self.provenance}
        content = io.BytesIO()
        np.savez_compressed(content, header=np.array(json.dumps(header)), **columns)
        return content.getvalue()

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Record:
        """Read what ``save`` wrote, or the record in a trial's snapshot. Raises FileError."""
        name = path_text(path)
        with _npz.open_regular(name, _npz.WHAT) as file:
            if file.read(9)[8:] == b"{":  # where a snapshot's header begins
                return cls._of_snapshot(file, name)
            file.seek(0)
            return cls._of_npz(file, name)

    @classmethod
    def from_bytes(cls, content: bytes) -> Record:
        """Read what ``to_bytes`` wrote. Raises FileError."""
        return cls._of_npz(io.BytesIO(content), "record")

    @classmethod
    def _of_npz(cls, file: IO[bytes], name: str) -> Record:
        columns, provenance, learner = cls._in_npz(file, name)
        try:
            record = cls(columns, provenance, learner)
            _core.require_record(record)
        except InvalidValue as error:
            field = error.quantity.removeprefix("record.")
            raise FileError(name, field, error.value, error.allowed) from error
        return record

    @staticmethod
    def _in_npz(
        file: IO[bytes], name: str
    ) -> tuple[dict[str, npt.NDArray[Any]], Any, bytes | None]:
        names = ("header", *STEP_COLUMNS, *POSE_COLUMNS, "rounds", "echoes", "learner")
        found = _npz.Columns(file, name, dict.fromkeys(names))
        header = _npz.json_object(found.text("header"), name, "header")
        if header.get("format") != FORMAT:
            raise FileError(name, "format", header.get("format"), FORMAT)
        version = header.get("version")
        if type(version) is not int or version < 1:
            raise FileError(name, "version", version, f"in [1, {FORMAT_VERSION}]")
        if version > FORMAT_VERSION:
            raise FileError(
                name, "version", version, f"at most {FORMAT_VERSION}; a newer devlearn wrote it"
            )
        # How long each column is follows from the rounds; a record of rounds only has none.
        told = "began" in found.fields("rounds")
        rounds = found.array("rounds", _ROUNDS_DTYPE if told else _EARLIER_ROUNDS_DTYPE, (None,))
        steps, poses = sum(rounds["steps"].tolist()), len(rounds)
        if len(rounds) > 0 and found.length("x") == 0:
            steps, poses = 0, 0
        columns = {
            n: np.full(steps, np.nan if dtype.kind == "f" else -1, dtype)
            if n in _core.later_columns and n not in found
            else found.array(n, dtype, (steps,))
            for n, dtype in STEP_COLUMNS.items()
        }
        columns |= {n: found.array(n, dtype, (steps + poses,)) for n, dtype in POSE_COLUMNS.items()}
        columns["rounds"] = rounds
        if "echoes" in found:
            columns["echoes"] = found.array("echoes", np.dtype(np.float64), (steps, None))
        learner = None
        if "learner" in found:
            learner = found.array("learner", np.dtype(np.uint8), (None,)).tobytes()
        return columns, header.get("provenance"), learner

    @classmethod
    def _of_snapshot(cls, file: IO[bytes], name: str) -> Record:
        columns, world, config, seed, note = _core.record_in_snapshot(name)
        try:
            provenance = json.loads(note)
        except (ValueError, RecursionError):
            provenance = None
        if not isinstance(provenance, dict):
            # Saved by C++, where records have no provenance: the trial's then.
            file.seek(0)
            size = int.from_bytes(file.read(8), "little")
            header = json.loads(file.read(size))
            entries = header["__metadata__"]
            provenance = provenance_of(world, config, seed, None)
            provenance |= {k: entries[k] for k in ("devlearn", "commit", "box2d", "agent")}
            own = {k: entries.get(f"own.{k}") for k in ("evaluation", "situations")}
            provenance |= {k: name for k, name in own.items() if name is not None}
            provenance |= _earlier_in(entries)
            if "own.sef_table" in header:
                provenance["evaluation"] = "table"
        return cls(columns, provenance)

    def _by_step(self) -> dict[str, npt.NDArray[Any]]:
        """A row a step: the step columns, the pose after it, and the echoes if recorded."""
        self._require_steps()
        after = np.ones(len(self.x), dtype=bool)
        after[np.cumsum(self.rounds["steps"] + 1) - self.rounds["steps"] - 1] = False
        columns = {name: getattr(self, name) for name in STEP_COLUMNS}
        columns |= {name: getattr(self, name)[after] for name in POSE_COLUMNS}
        if self.echoes is not None:
            columns |= {f"echo_{i}": column for i, column in enumerate(self.echoes.T)}
        return columns

    def to_pandas(self) -> pandas.DataFrame:
        """A row a step: the step columns, the pose after it, and the echoes if recorded.

        Kinds and events are categories by name, ``attrs["provenance"]`` tells where it came from.
        Raises InvalidValue for a record of rounds only, MissingExtra where pandas is missing.
        """
        try:
            import pandas
        except ModuleNotFoundError as error:
            raise MissingExtra("Record.to_pandas", "pandas", "experiments") from error
        frame = pandas.DataFrame(self._by_step())
        for name, members in (("kind", _core.Kind), ("event", _core.Event)):
            names = [member.name.lower() for member in members]
            frame[name] = pandas.Categorical.from_codes(frame[name], names)
        frame.attrs["provenance"] = self.provenance
        return frame

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write one row a step: the step columns, the pose after it, and the echoes if recorded.

        The first line names the columns, so that ``pandas.read_csv(path)`` and
        ``numpy.genfromtxt(path, delimiter=",", names=True)`` read it; truth is 0 or 1, kinds and
        events are their numbers. The provenance goes into a file beside it, of the same name with
        ``.json`` after it; there is none beside a device or a link. Raises InvalidValue for a
        record of rounds only, FileError.
        """
        columns = self._by_step()
        lists = [
            (column.astype(np.int8) if column.dtype == np.bool_ else column).tolist()
            for column in columns.values()
        ]
        with written_aside(path, "w") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(zip(*lists))
        if stat.S_ISREG(os.lstat(path).st_mode):
            with written_aside(os.fsdecode(path) + ".json", "w") as file:
                json.dump(self.provenance, file, indent=1)
                file.write("\n")


def _same(a: npt.NDArray[Any], b: npt.NDArray[Any]) -> bool:
    return np.array_equal(a, b, equal_nan=a.dtype == np.float64)


def provenance_of(
    world: _core.World, config: _core.TrialConfig, seed: int, agent: object
) -> dict[str, Any]:
    """Where a result comes from, as plain values."""
    return _provenance(world, config, seed, type(agent))


def _provenance(
    world: _core.World, config: _core.TrialConfig, seed: int, agent: type
) -> dict[str, Any]:
    return {
        "devlearn": _core.__version__,
        "commit": _core.commit,
        "box2d": _core.box2d_version,
        "world": _world(world),
        "config": config.to_dict(),
        "seed": seed,
        "agent": f"{agent.__module__}.{agent.__qualname__}",
    }


def _world(world: _core.World) -> dict[str, Any]:
    text = world.to_json()
    digest = hashlib.sha256(text.encode()).hexdigest()  # world.hash, without the text made twice
    return {"name": world.name, "hash": digest, "json": text}


def _earlier_in(entries: Mapping[str, str]) -> dict[str, Any]:
    """What a snapshot's entries tell of earlier worlds."""
    names = [f"earlier_world.{i}" for i in range(len(entries))]
    worlds = [
        _world(_core.World.from_json(entries[name])) | {"steps": int(entries[f"{name}.steps"])}
        for name in names
        if name in entries
    ]
    return {"earlier_worlds": worlds} if worlds else {}


@contextmanager
def written_aside(path: str | os.PathLike[str], mode: str) -> Iterator[IO[Any]]:
    """A file that takes its name only once it is whole and on the disk. Raises FileError.

    What is there and is no file, such as /dev/stdout, is written to as it is.
    """
    name = path_text(path)
    if "\0" in name:
        raise FileError(name, "", "a name that holds a null", "a file that can be written")
    content = io.BytesIO()
    file: IO[Any] = content
    if "b" not in mode:
        file = io.TextIOWrapper(content, encoding="utf-8", newline="", write_through=True)
    yield file
    file.flush()
    if not os.path.exists(name) or os.path.isfile(name):
        _core.write_file(name, content.getvalue())
        return
    try:
        with open(name, "wb") as there:
            there.write(content.getbuffer())
    except OSError as error:
        raise FileError(name, "", error.strerror, "a file that can be written") from error


def _holds_rounds_only(rounds: npt.NDArray[np.void], x: npt.NDArray[np.float64]) -> bool:
    return len(rounds) > 0 and len(x) == 0


def _check_provenance(provenance: object) -> None:
    if not isinstance(provenance, Mapping):
        raise InvalidValue("provenance", type(provenance).__name__, "a mapping")
    names = ("devlearn", "commit", "box2d", "agent", "evaluation", "situations")
    shape: dict[str, Any] = {**dict.fromkeys(names, str), "config": Mapping}
    for name, kind in {**shape, "world": Mapping}.items():
        if name in provenance and not isinstance(provenance[name], kind):
            given = type(provenance[name]).__name__
            raise InvalidValue(f"provenance.{name}", given, f"a {kind.__name__}")
    for name in ("name", "hash", "json"):
        text = provenance.get("world", {}).get(name, "")
        if not isinstance(text, str):
            raise InvalidValue(f"provenance.world.{name}", type(text).__name__, "a str")


def _check(columns: Mapping[str, npt.NDArray[Any]]) -> None:
    names = (*STEP_COLUMNS, *POSE_COLUMNS, "rounds")
    for name in names:
        if name not in columns:
            raise InvalidValue(name, "no such column", "one of each: " + ", ".join(names))
    for name in columns:
        if name not in (*names, "echoes"):
            raise InvalidValue(name, "an unknown column", ", ".join((*names, "echoes")))
        if name == "echoes" and columns[name] is None:
            continue
        if not isinstance(columns[name], np.ndarray) or columns[name].ndim == 0:
            raise InvalidValue(name, f"a value of {type(columns[name]).__name__}", "an array")
    rounds = columns["rounds"]
    fields: Mapping[str, Any] = rounds.dtype.fields or {}
    for field, kind in _ROUND_FIELDS.items():
        untold = field == "began" and field not in fields
        if not untold and fields.get(field, (None,))[0] != kind:
            raise InvalidValue("rounds", rounds.dtype, f"fields {', '.join(_ROUND_FIELDS)}")
    steps = len(columns["situation"])
    rounds_only = _holds_rounds_only(rounds, columns["x"])
    each = rounds["steps"].ravel().tolist()  # whole numbers of Python, whose sum never wraps
    told = 0 if rounds_only else sum(each)
    if rounds.ndim != 1 or min(each, default=0) < 0 or told != steps:
        raise InvalidValue("rounds.steps", "another sum", f"{steps}, the number of steps")
    poses = 0 if rounds_only else steps + len(rounds)
    expected = dict.fromkeys(STEP_COLUMNS, steps) | dict.fromkeys(POSE_COLUMNS, poses)
    for name, dtype in (STEP_COLUMNS | POSE_COLUMNS).items():
        column = columns[name]
        if column.dtype != dtype or column.shape != (expected[name],):
            raise InvalidValue(
                name,
                f"{column.dtype} of shape {column.shape}",
                f"{np.dtype(dtype)} of shape ({expected[name]},)",
            )
    echoes = columns.get("echoes")
    if echoes is not None and (
        echoes.dtype != np.float64 or echoes.ndim != 2 or len(echoes) != steps
    ):
        raise InvalidValue(
            "echoes",
            f"{echoes.dtype} of shape {echoes.shape}",
            f"float64 of shape ({steps}, sonars)",
        )
