"""Results of a sweep in one SQLite file: written by one process, read by any number meanwhile.

docs/results-format.md says what stands in it.
"""

from __future__ import annotations

import json
import operator
import os
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import numpy as np
import numpy.typing as npt

from .. import _core
from .. import _markup as markup
from .._calls import path_text, shown
from .._files import code_version, locked
from ..errors import FileError, InvalidValue, MissingExtra, WrongType
from ..record import Record
from .job import Job, Row, canonical, unpacked, world_hash
from .measures import MEASURES
from .schedule import Schedule
from .spec import Spec, Together

if TYPE_CHECKING:
    import pandas

APPLICATION = 0x64766C6E  # "dvln"
SCHEMA = 1
WANTED = "results of a sweep by devlearn"
_MOST_SHOWN = 40  # rows in a notebook

# Columns of `runs` beside what says which run it is and the measures; those that differ from
# machine to machine begin with run_.
_OF_RUN = {"run_seconds": "REAL", "run_host": "TEXT", "run_finished": "TEXT"}
_TABLES = f"""
CREATE TABLE meta (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE worlds (
  id INTEGER PRIMARY KEY, name TEXT NOT NULL, hash TEXT NOT NULL, json TEXT NOT NULL,
  quoted TEXT NOT NULL, UNIQUE (name, hash));
CREATE TABLE variants (
  id INTEGER PRIMARY KEY, agent TEXT NOT NULL, label TEXT NOT NULL, settings TEXT NOT NULL,
  trial TEXT NOT NULL, schedule TEXT NOT NULL, quoted TEXT NOT NULL UNIQUE);
CREATE TABLE runs (
  id INTEGER PRIMARY KEY,
  world INTEGER NOT NULL REFERENCES worlds, variant INTEGER NOT NULL REFERENCES variants,
  seed INTEGER NOT NULL, own TEXT NOT NULL, shortest INTEGER,
  {", ".join(f'"{name}" REAL' for name in MEASURES)},
  error TEXT, {", ".join(f"{name} {kind}" for name, kind in _OF_RUN.items())},
  UNIQUE (world, variant, seed));
CREATE TABLE kept (run INTEGER PRIMARY KEY REFERENCES runs, rounds BLOB, record BLOB);
"""
_COMMAND = (
    "'devlearn sweep --run ''' || replace("
    "'{' || w.quoted || ',' || v.quoted || ',\"seed\":' || r.seed || ',\"measures\":' || r.own"
    " || '}', '''', '''\"''\"''') || ''''"
)


_ROWS = (
    "SELECT s.*, w.hash, v.quoted FROM results s JOIN runs r ON r.id = s.run "
    "JOIN worlds w ON w.id = r.world JOIN variants v ON v.id = r.variant"
)


def _quoted(job: Job) -> str:
    """A variant as it is found, and as a command has it."""
    return canonical(job.variant())[1:-1]


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """What SQLite raises, as FileError."""
    try:
        yield
    except sqlite3.Error as error:
        allowed = {
            "full": "room on the disk; the runs before are kept, and the same sweep goes on",
            "locked": "a file that nobody else writes to",
            "busy": "a file that nobody else writes to",
            "readonly": "a file that can be written",
            "malformed": f"{WANTED}, undamaged",
        }
        wanted = next((text for word, text in allowed.items() if word in str(error)), WANTED)
        raise FileError(str(path), "", error, wanted) from error


def _opened(path: Path, *, write: bool) -> sqlite3.Connection:
    """A connection to results, checked to be such. Raises FileError."""
    mode = "rw" if os.access(path, os.W_OK) else "ro"
    if mode == "ro" and not path.with_name(path.name + "-wal").exists():
        mode = "ro&immutable=1"  # a reader, too, would write what it shares with a writer
    with _told(path):
        connection = sqlite3.connect(
            f"file://{quote(os.fsencode(path.absolute()))}?mode={mode}",
            uri=True,
            isolation_level=None,
            check_same_thread=False,
        )
    try:
        with _told(path):
            [application] = connection.execute("PRAGMA application_id").fetchone()
            [schema] = connection.execute("PRAGMA user_version").fetchone()
        if application != APPLICATION:
            raise FileError(str(path), "", "another application's file", WANTED)
        if schema != SCHEMA:
            raise FileError(str(path), "schema", schema, f"{SCHEMA}, this devlearn's")
        with _told(path):
            connection.execute("SELECT count(*) FROM meta").fetchone()
            if not write:
                connection.execute("PRAGMA query_only = ON")
    except BaseException:
        connection.close()
        raise
    return connection


def _columns(connection: sqlite3.Connection) -> list[str]:
    """The measures that `runs` holds, one's own among them."""
    names = [name for _, name, *_ in connection.execute("PRAGMA table_info(runs)")]
    around = ("id", "world", "variant", "seed", "own", "shortest", "error", *_OF_RUN)
    return [name for name in names if name not in around or name in MEASURES]


class Results:
    """What a sweep left, or leaves: a file that may be read while it grows.

    ``len(results)`` is how many runs are in it. All calls raise FileError for what is no such file.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path_text(path))
        """The file."""
        if not self.path.is_file():
            raise FileError(str(self.path), "", "no such file", WANTED)
        len(self)

    def __len__(self) -> int:
        return int(self._all("SELECT count(*) FROM runs")[0][0])

    def __repr__(self) -> str:
        return f"<devlearn.Results: {len(self)} runs in {str(self.path)!r}>"

    def _repr_html_(self) -> str:
        """For notebooks: of each agent in each world its runs, and medians of a few measures."""
        groups: dict[tuple[str, str], list[tuple[Any, ...]]] = {}
        measures = ("first_arrival", "last_ratio", "failed_share")
        for world, label, *rest in self._all(
            f"SELECT world, label, error IS NOT NULL, {', '.join(measures)} FROM results"
        ):
            groups.setdefault((world, label), []).append(tuple(rest))
        rows = []
        for (world, label), runs in [*groups.items()][:_MOST_SHOWN]:
            failed, *values = zip(*runs)
            known = ([value for value in of if value is not None] for of in values)
            medians = (float(np.median(of)) if of else None for of in known)
            rows.append([world, label, len(runs), sum(failed), *medians])
        head = ("world", "agent", "runs", "failed by an error", *measures)
        left = len(groups) - len(rows)
        return (
            markup.paragraph(f"{markup.counted(len(self), 'run')} in {self.path}; medians:")
            + markup.table(head, rows)
            + (markup.paragraph(f"and {left} more agents in worlds") if left else "")
        )

    @property
    def meta(self) -> dict[str, str]:
        """devlearn's version and commit, Box2D's version, and ``spec``, as JSON: the last sweep."""
        return dict(self._all("SELECT name, value FROM meta"))

    @property
    def current(self) -> bool:
        """Whether it is of this version of devlearn, so that a sweep may go on with it."""
        return self.meta.get("code", code_version()) == code_version()

    @property
    def measures(self) -> list[str]:
        """The names of the measures, those of one's own among them."""
        with self._reading() as connection:
            return _columns(connection)

    def to_pandas(self) -> pandas.DataFrame:
        """A row a run, in the order of worlds, agents and seeds. Needs pandas.

        Columns: ``run``, its number in the file; ``world``, ``agent``, ``label`` (the agent and
        what was set), ``settings``, ``trial`` and ``schedule`` (JSON), ``seed``, ``shortest``,
        every measure (inf: never; NaN: it has no value), ``error`` (a traceback, where the run
        failed), ``command`` (makes the run alone), and, different from machine to machine,
        ``run_seconds``, ``run_host``, ``run_finished``.
        """
        try:
            import pandas
        except ModuleNotFoundError as error:
            raise MissingExtra("Results.to_pandas", "pandas", "experiments") from error
        with self._reading() as connection:
            frame = pandas.read_sql_query(
                "SELECT results.* FROM results JOIN runs r ON r.id = run "
                "ORDER BY r.world, r.variant, r.seed",
                connection,
            )
        for name in MEASURES:
            frame[name] = frame[name].astype(float)
        frame.attrs["provenance"] = self.meta
        return frame

    def rows(self, jobs: Iterable[Job]) -> list[dict[str, Any]]:
        """The row of each of these runs, by the names of the columns of `to_pandas`.

        Measures of one's own are what they gave. Raises InvalidValue for a run that is not there.
        """
        with self._reading() as connection:
            connection.row_factory = sqlite3.Row
            rows = [dict(row) for row in connection.execute(_ROWS)]
            own = [name for name in _columns(connection) if name not in MEASURES]
        found = {(r["world"], r.pop("hash"), r.pop("quoted"), r["seed"]): r for r in rows}
        asked = []
        for job in jobs:
            place = job.world, world_hash(job.world_json), _quoted(job), job.seed
            if place not in found:
                told = f"{job.label}, seed {job.seed}, in {job.world}"
                raise InvalidValue("run", told, f"one of the {len(found)} in {self.path}")
            row = dict(found[place])
            row |= {name: json.loads(row[name]) for name in own if isinstance(row[name], str)}
            asked.append(row)
        return asked

    def check(self) -> None:
        """Reads all of the file. Raises FileError where it is damaged."""
        for [told] in self._all("PRAGMA quick_check(1)"):
            if told != "ok":
                raise FileError(str(self.path), "", told, f"{WANTED}, undamaged")

    @property
    def failed(self) -> list[tuple[int, str]]:
        """The runs that failed, each with its traceback."""
        return self._all("SELECT id, error FROM runs WHERE error IS NOT NULL ORDER BY id")

    def job(self, run: int) -> Job:
        """What makes this run again, equal to the bit. Raises InvalidValue for no such run."""
        found = self._all(
            "SELECT w.name, w.json, '{' || v.quoted || '}', r.seed, v.label, r.own FROM runs r "
            "JOIN worlds w ON w.id = r.world JOIN variants v ON v.id = r.variant WHERE r.id = ?",
            _number(run),
        )
        if not found:
            raise InvalidValue("run", run, f"one of the {len(self)} in {self.path}")
        world, text, variant, seed, label, own = found[0]
        values = json.loads(variant)
        agent, settings, trial = (values.pop(name) for name in ("agent", "settings", "trial"))
        schedule = Schedule(**values)
        return Job(
            world, text, agent, settings, trial, schedule, seed, label, tuple(json.loads(own))
        )

    def rounds(self, run: int) -> npt.NDArray[np.void]:
        """The rounds of a run, as `devlearn.Tally.rounds`. Raises InvalidValue where not kept."""
        content = self._kept("rounds", run)
        try:
            return unpacked(content)
        except (zlib.error, ValueError) as error:
            raise FileError(str(self.path), f"rounds of run {run}", error, WANTED) from error

    def record(self, run: int) -> Record:
        """The Record of a run. Raises InvalidValue where it was not kept."""
        return Record.from_bytes(self._kept("record", run))

    @property
    def with_rounds(self) -> set[int]:
        """The runs of which the rounds were kept."""
        return {run for (run,) in self._all("SELECT run FROM kept WHERE rounds IS NOT NULL")}

    def _kept(self, what: str, run: int) -> bytes:
        found = self._all(f"SELECT {what} FROM kept WHERE run = ?", _number(run))
        if not found or found[0][0] is None:
            raise InvalidValue("run", run, f"one of which the {what} was kept")
        return bytes(found[0][0])

    def _all(self, query: str, *values: Any) -> list[Any]:
        with self._reading() as connection:
            return connection.execute(query, values).fetchall()

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection]:
        # Not for long: whoever is the last to close the file makes one of it and its log.
        with closing(_opened(self.path, write=False)) as connection, _told(self.path):
            yield connection


_BESIDE = ("-wal", "-shm")


def set_aside(path: Path, end: str) -> Path:
    """Renames results, with what SQLite keeps beside them; returns their new name."""
    aside = path.with_name(path.name + end)
    for beside in (*_BESIDE, ""):
        file, to = (p.with_name(p.name + beside) for p in (path, aside))
        if file.exists():
            os.replace(file, to)
        else:
            to.unlink(missing_ok=True)
    return aside


class Store:
    """The one writer of results: a context. Each finished run is kept at once.

    A kill of the process loses no run that was added, a power cut what came in the last moments.
    """

    def __init__(
        self, path: str | os.PathLike[str], spec: Spec | Together, *, retry_failed: bool = False
    ) -> None:
        """Makes the file, or goes on with it; ``retry_failed``: runs that failed are missing.

        Raises FileError: it cannot be written, is none of devlearn's, of another schema, in use by
        another writer, or holds runs of another version.
        """
        self.path = Path(path_text(path))
        self._file = Path(os.path.realpath(self.path))  # one, by whichever links it is named
        self._spec = spec
        self._retry_failed = retry_failed
        self._stack = ExitStack()

    def __enter__(self) -> Store:
        with ExitStack() as stack:
            stack.enter_context(
                locked(
                    self._file.with_name(self._file.name + ".lock"), str(self.path),
                    "a file that nobody else writes to: wait for it, or choose another --output",
                )
            )  # fmt: skip
            if not self._file.exists() or self._file.stat().st_size == 0:
                self._make()
            self._connection = _opened(self.path, write=True)
            stack.callback(self._connection.close)
            with _told(self.path):
                self._begin()
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def _make(self) -> None:
        # To the side first: what is there under its name is whole.
        aside = self._file.with_name(self._file.name + ".new")
        aside.unlink(missing_ok=True)
        with _told(self.path):
            connection = sqlite3.connect(aside, isolation_level=None)
            try:
                connection.execute(f"PRAGMA application_id = {APPLICATION}")
                connection.execute(f"PRAGMA user_version = {SCHEMA}")
                connection.execute("PRAGMA journal_mode = WAL")
                connection.executescript(f"BEGIN; {_TABLES} COMMIT;")
            finally:
                connection.close()
        # A log that some other file of this name left behind would be taken for this one's.
        for beside in _BESIDE:
            self._file.with_name(self._file.name + beside).unlink(missing_ok=True)
        os.replace(aside, self._file)

    def _begin(self) -> None:
        execute = self._connection.execute
        execute("PRAGMA synchronous = NORMAL")
        execute("BEGIN IMMEDIATE")
        known = dict(execute("SELECT name, value FROM meta"))
        code = {"devlearn": _core.__version__, "commit": _core.commit, "code": code_version()}
        if known.get("code", code["code"]) != code["code"]:
            raise FileError(
                str(self.path), "", f"runs of devlearn {known['devlearn']} ({known['commit']})",
                f"a new file, or one of this code, {code['devlearn']} ({code['commit']}); "
                "choose another --output",
            )  # fmt: skip
        hashes = dict(execute("SELECT name, hash FROM worlds"))
        for name, text in self._spec.worlds.items():
            if hashes.get(name, world_hash(text)) != world_hash(text):
                raise FileError(
                    str(self.path), "worlds", f"{name}, which has changed since",
                    "the same world under a name; choose another name or --output",
                )  # fmt: skip
        meta = {**code, "box2d": _core.box2d_version, "spec": canonical(self._spec.values)}
        self._connection.executemany("INSERT OR REPLACE INTO meta VALUES (?, ?)", meta.items())
        columns = _columns(self._connection)
        for name in self._spec.measures:
            if name not in columns:
                execute(f"ALTER TABLE runs ADD COLUMN {_named(name)}")
        execute("DROP VIEW IF EXISTS results")
        execute(self._view())
        self._worlds = {
            name: self._id(
                "worlds",
                ("name", "hash"),
                name=name,
                hash=world_hash(text),
                json=text,
                quoted=canonical({"world": name, "world_hash": world_hash(text)})[1:-1],
            )
            for name, text in self._spec.worlds.items()
        }
        self._variants: dict[str, int] = {}
        for job in self._spec.one_of_each():
            self._variant(job)  # in the spec's order, whichever is finished first
        execute("COMMIT")
        self._found = {
            (world, variant, seed): (set(json.loads(own)), rounds, record)
            for world, variant, seed, own, rounds, record in execute(
                "SELECT world, variant, seed, own, rounds IS NOT NULL, record IS NOT NULL "
                "FROM runs LEFT JOIN kept ON run = id WHERE error IS NULL OR NOT ?",
                [self._retry_failed],
            )
        }

    def _view(self) -> str:
        columns = ["r.shortest", *(f"r.{_named(name)}" for name in _columns(self._connection))]
        columns += ["r.error", f"{_COMMAND} AS command", *(f"r.{name}" for name in _OF_RUN)]
        return (
            "CREATE VIEW results AS SELECT r.id AS run, w.name AS world, v.agent, v.label, "
            f"v.settings, v.trial, v.schedule, r.seed, {', '.join(columns)} FROM runs r "
            "JOIN worlds w ON w.id = r.world JOIN variants v ON v.id = r.variant "
            "ORDER BY r.world, r.variant, r.seed"
        )

    def _id(self, table: str, key: Sequence[str], **values: Any) -> int:
        """The number of an entry, found by its key, made where it is missing."""
        names = ", ".join(values)
        marks = ", ".join("?" * len(values))
        self._connection.execute(
            f"INSERT OR IGNORE INTO {table} ({names}) VALUES ({marks})", [*values.values()]
        )
        same = " AND ".join(f"{name} = ?" for name in key)
        found = self._connection.execute(
            f"SELECT id FROM {table} WHERE {same}", [values[name] for name in key]
        )
        return int(found.fetchone()[0])

    def _variant(self, job: Job) -> int:
        quoted = _quoted(job)
        if quoted not in self._variants:
            self._variants[quoted] = self._id(
                "variants",
                ("quoted",),
                agent=job.agent,
                label=job.label,
                settings=canonical(job.settings),
                trial=canonical(job.trial),
                schedule=canonical(job.schedule.to_dict()),
                quoted=quoted,
            )
        return self._variants[quoted]

    def _place(self, job: Job) -> tuple[int, int, int]:
        return self._worlds[job.world], self._variant(job), job.seed

    def missing(self, jobs: Iterable[Job]) -> Iterator[Job]:
        """Those of the jobs that are not in the file, with all that they ask for."""
        for job in jobs:
            own, rounds, record = self._found.get(self._place(job), (None, False, False))
            kept = {"nothing": True, "rounds": rounds, "record": record}[job.keep]
            if own is None or not kept or not own.issuperset(job.measures):
                yield job

    def add(self, done: Iterable[tuple[Job, Row]]) -> None:
        """Keeps runs, all of them or none. Raises FileError."""
        with _told(self.path):
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                for job, row in done:
                    self._add(job, row)
            except BaseException:
                if self._connection.in_transaction:  # SQLite may have rolled back itself
                    self._connection.execute("ROLLBACK")
                raise
            self._connection.execute("COMMIT")

    def _add(self, job: Job, row: Row) -> None:
        place = self._place(job)
        own = self._found.get(place, (set(), 0, 0))[0] | set(job.measures)
        values = {
            **dict(zip(("world", "variant", "seed"), place)),
            "own": canonical(sorted(own)),
            "shortest": row.shortest,
            **row.measures,
            "error": row.error,
            "run_seconds": row.seconds,
            "run_host": row.host,
            "run_finished": row.finished,
        }
        names = ", ".join(map(_named, values))
        again = ", ".join(f"{_named(name)} = excluded.{_named(name)}" for name in values)
        self._connection.execute(
            f"INSERT INTO runs ({names}) VALUES ({', '.join('?' * len(values))}) "
            f"ON CONFLICT (world, variant, seed) DO UPDATE SET {again}",
            [*values.values()],
        )
        if row.rounds is not None:
            self._connection.execute(
                "INSERT OR REPLACE INTO kept SELECT id, ?, ? FROM runs "
                "WHERE world = ? AND variant = ? AND seed = ?",
                [row.rounds, row.record, *place],
            )
        self._found[place] = (own, row.rounds is not None, row.record is not None)


def _number(run: int) -> int:
    """A run's number, numpy's too, as SQLite holds it."""
    try:
        number = operator.index(run)
    except TypeError as error:
        raise WrongType("run", shown(run), "a whole number") from error
    if not 0 <= number < 2**63:
        raise InvalidValue("run", number, "in [0, 2^63)")
    return number


def _named(column: str) -> str:
    """A name as SQL takes it."""
    return '"' + column.replace('"', '""') + '"'
