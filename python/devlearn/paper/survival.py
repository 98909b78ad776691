"""``devlearn run`` that survives: its state is saved as it goes, and it goes on from there."""

from __future__ import annotations

import json
import signal
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .. import _core
from .._files import code_version
from ..errors import FileError
from ..experiments.schedule import Schedule
from ..record import Record, provenance_of, written_aside

ABOUT = "run.json"  # which run the folder is of, and whether it is finished
STATE = "state.safetensors"  # a trial's snapshot, with the record so far
AT_ONCE = 1000  # steps between two looks at the clock and for Ctrl-C
SECONDS = 10.0  # between two saves
WORTH_KEEPING = 0.5  # seconds of work
SHARE = 0.05  # of the time at most that saving may take


def begin(
    folder: Path,
    world: _core.World,
    config: _core.TrialConfig,
    seed: int,
    planned: Mapping[str, Any],
    *,
    files: Sequence[str] = (),
    overwrite: bool = False,
) -> dict[str, Any]:
    """Writes down which run the folder is of; returns where its record comes from.

    ``planned``: the schedule and what else it is run by. Raises FileError where the folder holds
    another run, finished or not, or some of ``files`` and no word of the run that they are of;
    unless they may be overwritten.
    """
    agent = _core.Trial(world, config, seed).agent
    whence = provenance_of(world, config, seed, agent) | {
        "code": code_version(),
        "run": dict(planned),
    }
    about = folder / ABOUT
    if overwrite:
        (folder / STATE).unlink(missing_ok=True)
    elif about.exists():
        found = _read(about)
        _require_same(about, found, whence, "a finished" if found["finished"] else "an unfinished")
    elif not (folder / STATE).exists():
        for name in files:
            if (folder / name).exists():
                raise FileError(
                    str(folder / name), "", "a file of some other run",
                    "a folder without, another --output, or --overwrite",
                )  # fmt: skip
    _write(about, whence, finished=False)
    return whence


def end(folder: Path, whence: Mapping[str, Any]) -> None:
    """The run is finished and written: its state goes, and the folder says so."""
    _write(folder / ABOUT, whence, finished=True)
    (folder / STATE).unlink(missing_ok=True)


def _write(about: Path, whence: Mapping[str, Any], finished: bool) -> None:
    with written_aside(about, "w") as file:
        json.dump({"finished": finished, **whence}, file, indent=1)
        file.write("\n")


def _read(about: Path) -> dict[str, Any]:
    try:
        found = json.loads(about.read_bytes())
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict) or not isinstance(found.get("finished"), bool):
        raise FileError(
            str(about), "", "no description of a run", "what devlearn run wrote, or --overwrite"
        )
    return found


def run_to_the_end(
    folder: Path,
    world: _core.World,
    config: _core.TrialConfig,
    seed: int,
    schedule: Schedule,
    whence: Mapping[str, Any],
    echoes: bool = False,
    save_every: int | None = None,
    seen: Callable[[Record], object] = lambda part: None,
) -> tuple[_core.Trial, Record]:
    """Runs the schedule, from the state in ``folder`` where there is one.

    The state is saved there every ``save_every`` steps; by default every ten seconds, and less
    often where that would take more than a twentieth of the time. Ctrl-C or SIGTERM saves it and
    raises KeyboardInterrupt, whose argument is the signal. The history is the same however often
    it was stopped. ``seen`` is called with each part of the record, the first of which is what
    there was already. Raises FileError where the state is that of another run, or its trial and its
    record do not belong together.
    """
    state = folder / STATE
    trial = _core.Trial(world, config, seed)
    whence = dict(whence)
    parts: list[Record] = []
    done = None
    if state.exists():
        done = Record.load(state)
        _require_same(state, done.provenance, whence)
        trial = _core.Trial.load(state)
        _require_together(state, trial, done, world, config, seed)
        parts = [done]
        seen(done)

    unsaved, saved, cost = 0, time.monotonic(), 0.0
    with _stop_noted() as asked:
        for part in schedule.parts(trial, done, min(AT_ONCE, save_every or AT_ONCE), echoes=echoes):
            parts.append(part)
            seen(part)
            unsaved += len(part)
            since = time.monotonic() - saved
            due = unsaved >= save_every if save_every else since >= max(SECONDS, cost / SHARE)
            if due or asked:
                parts, cost = _save(state, trial, parts, whence)
                unsaved, saved = 0, time.monotonic()
            if asked:
                raise KeyboardInterrupt(asked[0])
        # Its files are yet to be written, and may take longer than it did.
        if unsaved and time.monotonic() - saved > WORTH_KEEPING:
            parts, _ = _save(state, trial, parts, whence)
        if asked:
            raise KeyboardInterrupt(asked[0])
    whole = Record.concatenate(parts)
    whole.provenance = {k: v for k, v in whence.items() if k not in ("run", "code")}
    return trial, whole


def _save(
    state: Path, trial: _core.Trial, parts: list[Record], whence: Mapping[str, Any]
) -> tuple[list[Record], float]:
    """Saves trial and record; the record, joined, and the seconds that it took."""
    began = time.monotonic()
    joined = Record.concatenate(parts)
    joined.provenance = dict(whence)
    trial.save(state, joined)
    return [joined], time.monotonic() - began


def _require_same(
    file: Path, found: Mapping[str, Any], expected: Mapping[str, Any], kind: str = "an unfinished"
) -> None:
    before, now = dict(_flat(found)), dict(_flat(expected))
    for name, value in now.items():
        if before.get(name) == value:
            continue
        if name == "code":
            name, before[name], value = "devlearn", "another build", "the one that began the run"
        finish = "" if kind == "a finished" else "finish that run with its own options, "
        raise FileError(
            str(file),
            name,
            f"{kind} run with {before.get(name)}",
            f"{value}; {finish}choose another --output, or --overwrite it",
        )


def _require_together(
    state: Path,
    trial: _core.Trial,
    done: Record,
    world: _core.World,
    config: _core.TrialConfig,
    seed: int,
) -> None:
    """A trial goes on from a record's end: what both say of it must agree."""
    rounds = done.rounds["round"].tolist()
    last = (done.x[-1], done.y[-1], done.heading[-1]) if len(done.x) else world.start
    learner = trial.learner
    of_trial_and_record = {
        "seed": (trial.seed, seed),
        "world": (trial.world.hash, world.hash),
        "config": (trial.config, config),
        "rounds": (rounds, list(range(1, len(rounds) + 1))),
        "round": (trial.round, rounds[-1] if rounds else 0),
        "pose": (tuple(trial.pose), tuple(last)),
        "explored_count": (
            -1 if learner is None else learner.explored_count,
            done.explored_count[-1] if len(done) else 0,
        ),
    }
    for name, (found, expected) in of_trial_and_record.items():
        if found != expected:
            raise FileError(
                str(state), name, f"{found} of a trial that is not its record's", str(expected)
            )


def _flat(values: Mapping[str, Any], outer: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{outer}{name}.")
        elif name != "json":  # a world's text, which its hash stands for
            yield outer + name, value


@contextmanager
def _stop_noted() -> Iterator[list[int]]:
    """Ctrl-C and SIGTERM as a list of signals, so that none falls between a step and its record."""
    asked: list[int] = []
    before = {}
    # Elsewhere Python raises no KeyboardInterrupt.
    if threading.current_thread() is threading.main_thread():
        for number in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(number) is not signal.SIG_IGN:  # as nohup and shells ask for
                before[number] = signal.signal(number, lambda number, _: asked.append(number))
    try:
        yield asked
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
