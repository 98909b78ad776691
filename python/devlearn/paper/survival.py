"""``devlearn run`` that survives: its state is saved as it goes, and it goes on from there."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from .. import _core
from ..errors import FileError
from ..experiments.runs import code_fingerprint
from ..record import Record, provenance_of

STATE = "state.safetensors"  # a trial's snapshot, with the record so far
AT_ONCE = 1000  # steps between two looks at the clock and for Ctrl-C
SECONDS = 10.0  # between two saves
SHARE = 0.05  # of the time at most that saving may take


class Plan(NamedTuple):
    """What is run: two rounds of free learning of ``steps``, then ``rounds`` of path learning."""

    steps: int
    rounds: int
    step_limit: int
    echoes: bool


def run_to_the_end(
    folder: Path,
    world: _core.World,
    config: _core.TrialConfig,
    seed: int,
    plan: Plan,
    save_every: int | None = None,
) -> tuple[_core.Trial, Record]:
    """Runs the plan, from the state in ``folder`` where there is one.

    The state is saved there every ``save_every`` steps; by default every ten seconds, and less
    often where that would take more than a twentieth of the time. Ctrl-C saves it and raises
    KeyboardInterrupt. The history is the same however often it was stopped. Raises FileError where
    the state is that of another run.
    """
    state = folder / STATE
    trial = _core.Trial(world, config, seed)
    whence = provenance_of(world, config, seed, trial.agent) | {
        "run": plan._asdict(),
        "code": code_fingerprint(),
    }
    parts: list[Record] = []
    taken = 0  # steps of the present round
    if state.exists():
        parts = [Record.load(state)]
        _require_same(state, parts[0].provenance, whence)
        trial = _core.Trial.load(state)
        taken = int(parts[0].rounds["steps"][-1])

    unsaved, saved, cost = 0, time.monotonic(), 0.0
    with _ctrl_c_noted() as asked:
        while (
            part := _advance(trial, plan, taken, min(AT_ONCE, save_every or AT_ONCE))
        ) is not None:
            goes_on = parts and part.rounds["round"][0] == parts[-1].rounds["round"][-1]
            taken = len(part) + (taken if goes_on else 0)
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


def _advance(trial: _core.Trial, plan: Plan, taken: int, most: int) -> Record | None:
    """The run's next steps, of one round; None at its end."""
    free = trial.round <= 2
    over = taken >= (plan.steps if free else plan.step_limit) or (trial.arrived and not free)
    if trial.round == 0 or over:
        if trial.round >= 2 + plan.rounds:
            return None
        trial.begin_round()
        free, taken = trial.round <= 2, 0
    if free:
        return trial.run(min(most, plan.steps - taken), echoes=plan.echoes)
    return trial.finish_round(min(most, plan.step_limit - taken), echoes=plan.echoes)


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
