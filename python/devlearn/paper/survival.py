"""``devlearn run`` that survives: its state is saved as it goes, and it goes on from there."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .. import _core
from .._files import code_fingerprint
from ..errors import FileError
from ..record import Record, provenance_of
from .schedule import Schedule

STATE = "state.safetensors"  # a trial's snapshot, with the record so far
AT_ONCE = 1000  # steps between two looks at the clock and for Ctrl-C
SECONDS = 10.0  # between two saves
SHARE = 0.05  # of the time at most that saving may take


def run_to_the_end(
    folder: Path,
    world: _core.World,
    config: _core.TrialConfig,
    seed: int,
    schedule: Schedule,
    echoes: bool = False,
    save_every: int | None = None,
) -> tuple[_core.Trial, Record]:
    """Runs the schedule, from the state in ``folder`` where there is one.

    The state is saved there every ``save_every`` steps; by default every ten seconds, and less
    often where that would take more than a twentieth of the time. Ctrl-C saves it and raises
    KeyboardInterrupt. The history is the same however often it was stopped. Raises FileError where
    the state is that of another run.
    """
    state = folder / STATE
    trial = _core.Trial(world, config, seed)
    whence = provenance_of(world, config, seed, trial.agent) | {
        "code": code_fingerprint(),
        "run": {**schedule.to_dict(), "echoes": echoes},
    }
    parts: list[Record] = []
    done = None
    if state.exists():
        done = Record.load(state)
        _require_same(state, done.provenance, whence)
        trial = _core.Trial.load(state)
        parts = [done]

    unsaved, saved, cost = 0, time.monotonic(), 0.0
    with _ctrl_c_noted() as asked:
        for part in schedule.parts(trial, done, min(AT_ONCE, save_every or AT_ONCE), echoes=echoes):
            parts.append(part)
            unsaved += len(part)
            since = time.monotonic() - saved
            due = unsaved >= save_every if save_every else since >= max(SECONDS, cost / SHARE)
            if due or asked.is_set():
                began = time.monotonic()
                joined = Record.concatenate(parts)
                joined.provenance = whence
                trial.save(state, joined)
                parts = [joined]
                unsaved, saved = 0, time.monotonic()
                cost = saved - began
            if asked.is_set():
                raise KeyboardInterrupt
    whole = Record.concatenate(parts)
    whole.provenance = {k: v for k, v in whence.items() if k not in ("run", "code")}
    return trial, whole


def _require_same(state: Path, found: Mapping[str, Any], expected: Mapping[str, Any]) -> None:
    before, now = dict(_flat(found)), dict(_flat(expected))
    for name, value in now.items():
        if before.get(name) != value:
            if name == "code":
                name, before[name], value = (
                    "devlearn",
                    "another build",
                    "the one that began the run",
                )
            raise FileError(
                str(state),
                name,
                f"an unfinished run with {before.get(name)}",
                f"{value}; finish that run with its own options, remove the file, or choose "
                "another --output",
            )


def _flat(values: Mapping[str, Any], outer: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in values.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{outer}{name}.")
        elif name != "json":  # a world's text, which its hash stands for
            yield outer + name, value


@contextmanager
def _ctrl_c_noted() -> Iterator[threading.Event]:
    """Ctrl-C as an event, so that it never falls between a step and its record."""
    asked = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield asked  # where Python raises no KeyboardInterrupt
        return
    before = signal.signal(signal.SIGINT, lambda *_: asked.set())
    try:
        yield asked
    finally:
        signal.signal(signal.SIGINT, before)


def forget(folder: str | os.PathLike[str]) -> None:
    """Removes the state of a run that is finished and written, and what a kill left beside it."""
    for left in sorted(Path(folder).glob(STATE + "*"), reverse=True):  # the state last
        left.unlink()
