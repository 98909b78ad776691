"""A trial that is watched while it learns: which of its steps are sent, and when."""

from __future__ import annotations

import contextlib
import os
import socket
import subprocess
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any, NamedTuple
from urllib.parse import urlsplit

import numpy as np
import numpy.typing as npt

from .._calls import path_text, shown
from .._core import Trial
from ..errors import FileError, InvalidValue, WrongType
from ..record import Record
from .steps import Shown

if TYPE_CHECKING:
    from .stream import Stream

SHARE = 0.2  # of the time of the run that showing it may take (joining a phase's pieces: as much),
ALLOWANCE = 0.2  # and so many seconds more
BETWEEN = 0.25  # seconds from batch to batch
IN_FULL = 100_000  # steps that are shown whatever their pace, and of further ones
A_SECOND = 1000  # so many in a second
LEAST = 1000  # steps of a batch that are always shown
TOGETHER = 20_000  # that records of a batch have at most which are sent as one
MOST_WORDS = 100  # of one sort in the log, in a batch

_FIRST_COST = 3e-6  # of showing a step [s], before it is measured
_START = 20.0  # in which a viewer that was started must listen [s]


class Word(NamedTuple):
    """A line of the log."""

    step: int
    round: int
    level: str
    text: str


class Live:
    """What ``devlearn.view`` gives: a trial's phases, shown while they run.

    ``run``, ``free_learning``, ``path_learning`` and ``finish_round`` are the trial's own, with
    their options but ``progress``, and give the same record to the bit. ``send`` shows records of
    phases that were called otherwise. As a context manager it closes at the end.

    Showing takes at most a fifth of the time that the trial takes, and a fifth of a second. Where
    steps come faster than that allows, or faster than anyone can look (100 000, and then 1000 a
    second), some rounds are shown whole, or some steps of each, and the log says so; what rounds
    came to is always shown. Where the viewer is gone or the disk is full, the trial goes on, and
    ``failed`` says why.
    """

    def __init__(self, trial: Trial, stream: Stream) -> None:
        self.trial = trial
        """The trial that is shown."""
        self.failed: Exception | None = None
        """Why nothing is shown any more, or None."""
        self.steps = self.steps_shown = 0
        """How many steps there were to show, and how many were."""
        self._stream: Stream | None = stream
        self._world = trial.world.hash
        self._closed = False
        self._pending: list[Record] = []
        self._words: list[Word] = []
        self._phase: str | None = None
        self._open: npt.NDArray[np.void] | None = None  # the round that may go on
        self._thinned = 1, 1
        self._began = self._last = time.perf_counter()
        self._spent, self._cost, self._credit = 0.0, _FIRST_COST, float(IN_FULL)

    def __enter__(self) -> Live:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    # --- the trial's phases -----------------------------------------------------------------------

    def run(self, steps: int, **options: Any) -> Record:
        """As ``Trial.run``."""
        return self._piecewise(self.trial.run, self.trial.run, steps, options)

    def free_learning(self, steps: int, **options: Any) -> Record:
        """As ``Trial.free_learning``."""
        trial = self.trial
        return self._piecewise(trial.free_learning, trial.run, steps, options, "free learning")

    def finish_round(self, steps: int, **options: Any) -> Record:
        """As ``Trial.finish_round``."""
        trial = self.trial
        return self._piecewise(trial.finish_round, trial.finish_round, steps, options)

    def path_learning(self, rounds: int, step_limit: int = 10_000, **options: Any) -> Record:
        """As ``Trial.path_learning``."""
        return self._shown(self._rounds(rounds, step_limit, _Pieces(options)), "path learning")

    def _piecewise(
        self, begin: _Phase, go_on: _Phase, steps: int, options: dict[str, Any],
        phase: str | None = None,
    ) -> Record:  # fmt: skip
        return self._shown(self._pieces(begin, go_on, steps, _Pieces(options)), phase)

    def _pieces(self, begin: _Phase, go_on: _Phase, left: int, pieces: _Pieces) -> Iterator[Record]:
        yield (piece := pieces.of(begin, left))
        while (left := left - _steps_in(piece)) > 0 and not pieces.ended:
            if go_on == self.trial.finish_round and self.trial.arrived:
                return
            yield (piece := pieces.of(go_on, left))

    def _rounds(self, to_come: int, step_limit: int, pieces: _Pieces) -> Iterator[Record]:
        trial = self.trial
        while True:
            before = trial.round
            yield (piece := pieces.of(trial.path_learning, to_come, step_limit))
            left = step_limit - int(piece.rounds["steps"][-1]) if len(piece.rounds) else 0
            if left > 0 and not trial.arrived and not pieces.ended:
                yield from self._pieces(trial.finish_round, trial.finish_round, left, pieces)
            if (to_come := to_come - (trial.round - before)) <= 0 or pieces.ended:
                return

    def _shown(self, pieces: Iterator[Record], phase: str | None) -> Record:
        """Shows them, and gives all as one; where they are interrupted, the trial keeps them."""
        made: list[Record] = []
        before = self.trial.interrupted
        try:
            for piece in pieces:
                made.append(piece)
                self.send(piece, phase)
        except BaseException:
            finished = self.trial.interrupted
            if finished is not None and finished is not before:
                made.append(finished)
                self.send(finished, phase)
            if made:
                self.trial.interrupted = _joined(made)
            raise
        return _joined(made)

    # --- showing ----------------------------------------------------------------------------------

    def send(self, record: Record, phase: str | None = None) -> None:
        """Shows a record of the trial that follows those before; ``phase``: its name in the log.

        It may be shown with later ones: batches are a quarter of a second apart. Raises
        InvalidValue once this is closed, and for a record that does not tell when it began;
        WrongType.
        """
        if not isinstance(record, Record):
            raise WrongType("record", shown(record), "a Record, as the phases of a Trial give")
        if self._closed:
            raise InvalidValue("Live", "closed", "one that is open")
        if self._stream is None or len(record.rounds) == 0:
            return
        first = record.rounds[0]
        if first["began"] < 0:
            raise InvalidValue(
                "record.rounds.began", first["began"], "a number of steps, which is not known"
            )
        if self._pending and not _alike(self._pending[-1], record):
            self._send_pending()
        if phase not in (None, self._phase):
            self._phase = phase
            self._words.append(Word(int(first["began"]), int(first["round"]), "INFO", str(phase)))
        self._pending.append(record)
        if time.perf_counter() - self._last >= BETWEEN and self._spare() > 0:
            self._send_pending()

    def close(self) -> None:
        """Shows what is left, and makes the file whole."""
        if self._closed:
            return
        self._closed = True
        self._send_pending(last=True)
        if self._stream is not None:
            self._stream.close()
            self._stream = None

    def _spare(self) -> float:
        """Seconds that showing may still take."""
        run = time.perf_counter() - self._began - self._spent
        return ALLOWANCE + SHARE * run - self._spent

    def _send_pending(self, last: bool = False) -> None:
        if self._stream is None:
            return
        began = time.perf_counter()
        self._credit = min(IN_FULL, self._credit + A_SECOND * (began - self._last))
        most = max(LEAST, int(min(self._credit, self._spare() / self._cost)))
        pending, self._pending = self._pending, []
        try:
            total, count = sum(map(len, pending)), 0
            for record in _grouped(pending):
                share = most * len(record) // max(total, 1)
                count += self._send_batch(self._stream, record, max(LEAST, share))
            if last:
                self._send_end(self._stream)
            self._stream.flush()
        except Exception as error:
            self._give_up(error)
            count = 0
        self._last = time.perf_counter()
        self._spent += self._last - began
        self._credit -= count
        if count >= LEAST:
            self._cost = (self._cost + (self._last - began) / count) / 2

    def _send_batch(self, stream: Stream, record: Record, most: int) -> int:
        """Sends a record, and of its steps at most so many; gives how many."""
        count = 0
        if (name := record.provenance["world"]["hash"]) != self._world:
            self._world = name
            began, number = record.rounds[["began", "round"]][0].item()
            stream.change_world(record.world, began, number)
        self._end_rounds(stream, record.rounds)
        if not record.rounds_only:
            view = Shown.of(record, most)
            count = len(view.steps)
            self._say_what_is_left_out(record, view)
            stream.steps(record, view)
            self._words += _happened(record)
            self.steps += len(record)
            self.steps_shown += count
        words, self._words = self._words, []
        stream.say(sorted(words, key=lambda word: word.step))
        return count

    def _end_rounds(self, stream: Stream, rounds: npt.NDArray[np.void]) -> None:
        """Shows rounds that ended; the last may go on in the next batch."""
        if self._open is not None:
            rounds = np.concatenate([self._open, rounds])
            was, now = rounds[:2]
            if was["round"] == now["round"] and was["began"] + was["steps"] == now["began"]:
                now["began"] = was["began"]
                now["steps"] += was["steps"]
                now["arrived"] |= was["arrived"]
                rounds = rounds[1:]
        self._open = rounds[-1:]
        self._show_rounds(stream, rounds[:-1])

    def _show_rounds(self, stream: Stream, rounds: npt.NDArray[np.void]) -> None:
        stream.rounds(rounds)

        def word(i: int) -> Word:
            number, steps, arrived, began = rounds[i].item()
            told = f"{steps} steps, arrived" if arrived else f"not arrived in {steps} steps"
            level = "INFO" if arrived else "WARN"
            return Word(began + steps, number, level, f"round {number}: {told}")

        self._words += _some_of("rounds", np.arange(len(rounds)), word)

    def _say_what_is_left_out(self, record: Record, view: Shown) -> None:
        thinned = view.every_entry, view.every
        if thinned == self._thinned:
            return
        self._thinned = thinned
        began, number = record.rounds[["began", "round"]][0].item()
        told = "from here on all steps are shown"
        if view.thinned:
            told = f"from here on of {thinned[0]} rounds one is shown" * (thinned[0] > 1)
            told += ", " * all(every > 1 for every in thinned)
            told += f"of {thinned[1]} steps one is shown" * (thinned[1] > 1)
        self._words.append(Word(began, number, "INFO", told))

    def _send_end(self, stream: Stream) -> None:
        """The last round, and how much of all was shown."""
        if self._open is None:
            return
        self._show_rounds(stream, self._open)
        number, steps, _, began = self._open[0].item()
        told = f"the end: {self.steps_shown} of {self.steps} steps are shown"
        stream.say([*self._words, Word(began + steps, number, "INFO", told)])

    def _give_up(self, error: Exception) -> None:
        self.failed, self._stream = error, None
        warnings.warn(f"nothing is shown any more: {error}", RuntimeWarning, stacklevel=4)


_Phase = Callable[..., Record]


class _Pieces:
    """Calls of a trial's phases that end after a while, so that what they did can be shown.

    Parameters: the options of the phase, of which ``stop`` ends all of them.
    """

    def __init__(self, options: dict[str, Any]) -> None:
        if options.get("progress") is not None:
            raise InvalidValue("progress", "given", "None: what is shown tells of it")
        self._stop = options.pop("stop", None)
        if self._stop is not None and not hasattr(self._stop, "is_set"):
            raise WrongType(
                "stop", shown(self._stop), "a threading.Event, or what has its is_set()"
            )
        self._options, self._until = options, 0.0
        self.ended = False
        """Whether they were asked to stop."""

    def of(self, phase: _Phase, *counts: int) -> Record:
        """The next piece."""
        self._until = time.perf_counter() + BETWEEN
        piece = phase(*counts, stop=self, **self._options)
        self._options.pop("learner", None)  # as the first found it
        return piece

    def is_set(self) -> bool:
        """Whether to end it."""
        self.ended = self._stop is not None and bool(self._stop.is_set())
        return self.ended or time.perf_counter() >= self._until


def _steps_in(record: Record) -> int:
    return int(record.rounds["steps"].sum())


def _alike(one: Record, other: Record) -> bool:
    """Whether they can be one record."""
    return (
        one.rounds_only == other.rounds_only
        and (one.echoes is None) == (other.echoes is None)
        and one.provenance["world"]["hash"] == other.provenance["world"]["hash"]
    )


def _joined(records: Sequence[Record]) -> Record:
    return records[0] if len(records) == 1 else Record.concatenate(records)


def _grouped(records: Iterable[Record]) -> Iterator[Record]:
    """Short ones joined, long ones by themselves: joining takes time."""
    group: list[Record] = []
    for record in records:
        if group and sum(map(len, group)) + len(record) > TOGETHER:
            yield _joined(group)
            group = []
        group.append(record)
    if group:
        yield _joined(group)


def _happened(record: Record) -> Iterator[Word]:
    """Arrivals, touches and reductions among the steps of a record."""
    offsets = record.offsets()

    def newly(column: npt.NDArray[np.bool_]) -> npt.NDArray[np.int64]:
        new = column.copy()
        new[1:] &= ~column[:-1]
        begins = offsets[:-1][record.rounds["steps"] > 0]
        new[begins] = column[begins]
        return np.flatnonzero(new)

    def words(
        sort: str, level: str, which: npt.NDArray[np.int64], text: Callable[[int, int], str]
    ) -> Iterator[Word]:
        def word(i: int) -> Word:
            entry = int(np.searchsorted(offsets, i, "right")) - 1
            step = int(record.rounds["began"][entry]) + i - int(offsets[entry]) + 1
            return Word(step, int(record.round[i]), level, text(i, i + entry + 1))

        return _some_of(sort, which, word)

    def touch(step: int, pose: int) -> str:
        return f"touches something at ({record.x[pose]:.2f}, {record.y[pose]:.2f})"

    def reduction(step: int, pose: int) -> str:
        return f"situation {record.situation[step]} loses {record.reduced[step]} of its motions"

    yield from words("arrivals", "INFO", newly(record.arrived), lambda *_: "at the target")
    yield from words("touches", "DEBUG", newly(record.collided), touch)
    yield from words("reductions", "DEBUG", np.flatnonzero(record.reduced), reduction)


def _some_of(
    sort: str, found: npt.NDArray[np.int64], word: Callable[[int], Word]
) -> Iterator[Word]:
    """As many as are told of a batch, and how many there are besides."""
    yield from map(word, found[:MOST_WORDS].tolist())
    if len(found) > MOST_WORDS:
        last = word(int(found[-1]))
        told = f"and {len(found) - MOST_WORDS} more {sort}"
        yield Word(last.step, last.round, "INFO", told)


# --- where it is shown ----------------------------------------------------------------------------


def view(
    trial: Trial, path: str | os.PathLike[str] | None = None, *, connect: str | None = None
) -> Live:
    """Shows a trial while it learns, through Rerun (extra ``live``).

        with devlearn.view(trial, "run.rrd") as live:
            free = live.free_learning(10_000)
            paths = live.path_learning(rounds=300)

    Parameters
    ----------
    path
        A file to write, .rrd; what is there is replaced. ``rerun run.rrd`` opens it.
    connect
        The address of a viewer that runs, such as "rerun+http://127.0.0.1:9876/proxy".

    With neither a viewer is started, which this machine alone can reach. Raises InvalidValue where
    there is no display for it, no viewer at the address, or the name does not end in .rrd;
    FileError; WrongType; MissingExtra.
    """
    from .stream import Stream  # and with it Rerun

    if not isinstance(trial, Trial):
        raise WrongType("trial", shown(trial), "a Trial")
    name = None if path is None else _writable(path)
    address = None if connect is None else _listening(connect)
    if name is None and address is None:
        address = _started()
    return Live(trial, Stream(trial, name, address))


def _writable(path: str | os.PathLike[str]) -> str:
    name = path_text(path)
    if not name.lower().endswith(".rrd"):  # never over a record
        raise InvalidValue("path", shown(name), "a name that ends in .rrd")
    try:
        open(name, "wb").close()
    except (OSError, ValueError) as error:
        told = getattr(error, "strerror", None) or str(error)
        raise FileError(name, "", told, "a file that can be written") from error
    return name


def _listening(address: str) -> str:
    allowed = 'the address of a viewer that runs, such as "rerun+http://127.0.0.1:9876/proxy"'
    if not isinstance(address, str):
        raise WrongType("connect", shown(address), allowed)
    try:
        parts = urlsplit(address)
        host, port = parts.hostname, parts.port or 9876
        if parts.scheme not in ("rerun", "rerun+http", "rerun+https") or host is None:
            raise ValueError
        socket.create_connection((host, port), timeout=2.0).close()
    except ValueError:
        raise InvalidValue("connect", shown(address), allowed) from None
    except OSError as error:
        told = f"{address}, where nobody listens ({error})"
        raise InvalidValue("connect", told, allowed) from error
    return address


def _started() -> str:
    """Starts a viewer that listens to this machine alone; gives its address."""
    instead = (
        "a file to look at elsewhere: view(trial, 'run.rrd'), or devlearn run --view-to run.rrd"
    )
    if sys.platform == "linux" and not any(map(os.getenv, ("DISPLAY", "WAYLAND_DISPLAY"))):
        raise InvalidValue("view", "no display to show a viewer on", instead)
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    process = subprocess.Popen(
        [sys.executable, "-m", "rerun_cli", "--bind", "127.0.0.1", "--port", str(port),
         "--expect-data-soon"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,  # stays when this ends, and Ctrl-C is not its own
    )  # fmt: skip
    end = time.monotonic() + _START
    while process.poll() is None and time.monotonic() < end:
        with contextlib.suppress(OSError):
            socket.create_connection(("127.0.0.1", port), timeout=1.0).close()
            return f"rerun+http://127.0.0.1:{port}/proxy"
        time.sleep(0.05)
    process.kill()
    raise InvalidValue("view", "a viewer of Rerun's that does not start here", instead)
