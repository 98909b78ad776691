"""Many independent runs over processes: journalled, so that a stopped sweep goes on."""

from __future__ import annotations

import hashlib
import itertools
import json
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .._files import code_version, made_folder
from ..errors import FileError, MissingExtra

try:
    from tqdm import tqdm
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.experiments.runs", "tqdm", "experiments") from error

Job = Mapping[str, Any]
Result = dict[str, Any]


class Journal:
    """Finished runs in a file of JSON lines, found again by what was run and by which code.

    For one process at a time. Each line has a checksum: what is damaged is run again.
    """

    def __init__(self, path: Path) -> None:
        """Opens or makes it. Raises FileError."""
        self._path = path
        self._code = code_version()
        self._found: dict[str, Result] = {}
        self._flushed = 0.0
        self.damaged = 0
        """How many lines were no whole entries."""
        made_folder(path.parent)
        try:
            if path.exists():
                self._read(path.read_bytes())
            self._file = path.open("ab")
        except OSError as error:
            raise FileError(str(path), "", error.strerror, "a file that can be written") from error

    def _read(self, content: bytes) -> None:
        # The last line may have been cut off by a kill; a fresh one must not be glued to it.
        whole = content[: content.rfind(b"\n") + 1]
        if len(whole) < len(content):
            os.truncate(self._path, len(whole))
        for line in whole.splitlines():
            try:
                entry = json.loads(line)
                key, result, checksum = entry["key"], entry["result"], entry["checksum"]
            except (ValueError, KeyError, TypeError, RecursionError):
                key, result, checksum = None, None, None
            if isinstance(key, str) and isinstance(result, dict) and checksum == _sum(key, result):
                self._found[key] = result
            else:
                self.damaged += 1

    def key(self, job: Job) -> str:
        """What a job is found by."""
        text = json.dumps([self._code, job], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()

    def find(self, job: Job) -> Result | None:
        """The result of a finished job, or None."""
        return self._found.get(self.key(job))

    def add(self, job: Job, result: Result) -> None:
        """Keeps a result, at once in the file and within a second on the disk."""
        key = self.key(job)
        self._found[key] = result
        entry = {"key": key, "result": result, "checksum": _sum(key, result)}
        self._file.write(json.dumps(entry).encode() + b"\n")
        self._file.flush()
        # A kill of the process loses nothing of it, a power cut what came in the last second.
        if time.monotonic() - self._flushed > 1.0:
            os.fsync(self._file.fileno())
            self._flushed = time.monotonic()

    def close(self) -> None:
        """Closes the file, all of it on the disk."""
        if not self._file.closed:
            os.fsync(self._file.fileno())
            self._file.close()


def _sum(key: str, result: Result) -> str:
    return hashlib.sha256(json.dumps([key, result], sort_keys=True).encode()).hexdigest()[:16]


def run_all(
    function: Callable[[Job], Result],
    jobs: Sequence[Job],
    journal: Journal,
    *,
    workers: int | None = None,
    what: str = "runs",
) -> list[Result]:
    """``function`` of every job, over processes; results in the order of the jobs.

    Jobs in the journal are not run again. Results do not depend on the number of workers (default:
    one a core). Ctrl-C stops the workers and raises KeyboardInterrupt; what is finished is in the
    journal.
    """
    results = [journal.find(job) for job in jobs]
    missing = [i for i, result in enumerate(results) if result is None]
    done = len(jobs) - len(missing)
    # Where nobody watches, it is silent.
    with tqdm(desc=what, total=len(jobs), initial=done, unit="run", disable=None) as progress:
        for i, result in _completed(function, jobs, missing, workers or os.cpu_count() or 1):
            journal.add(jobs[i], result)
            results[i] = result
            progress.update()
    return [result for result in results if result is not None]


@contextmanager
def _interrupts_held() -> Iterator[None]:
    # Ctrl-C reaches every process of a terminal; the parent alone decides what becomes of it.
    # Processes started meanwhile hold it for good, from their first instruction on.
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _one_thread_each() -> Iterator[None]:
    # Workers fill the cores as they are. In each, numpy's linear algebra would start a thread for
    # every core when imported, and these spin for as long as all else in its start takes.
    if "OMP_NUM_THREADS" in os.environ:
        yield
        return
    os.environ["OMP_NUM_THREADS"] = "1"
    try:
        yield
    finally:
        os.environ.pop("OMP_NUM_THREADS", None)


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None

    def watch() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _completed(
    function: Callable[[Job], Result], jobs: Sequence[Job], which: Iterable[int], workers: int
) -> Iterator[tuple[int, Result]]:
    remaining = list(which)
    if workers == 1 or len(remaining) < 2:
        for i in remaining:
            yield i, function(jobs[i])
        return
    # Processes, not threads: Python code of jobs would take turns. Spawned, so that they inherit
    # nothing.
    context = multiprocessing.get_context("spawn")
    executor = ProcessPoolExecutor(
        min(workers, len(remaining)), mp_context=context, initializer=_end_with_parent
    )
    others = multiprocessing.active_children()
    try:
        # Few at a time: what is queued need not be undone when someone stops.
        running: dict[Future[Result], int] = {}
        queue = iter(remaining)
        while True:
            with _interrupts_held(), _one_thread_each():
                for i in itertools.islice(queue, 2 * workers - len(running)):
                    running[executor.submit(function, jobs[i])] = i
            if not running:
                break
            done = wait(running, return_when=FIRST_COMPLETED).done
            # One that failed ends it all, so after those that are there to be kept.
            for future in sorted(done, key=lambda future: future.exception() is not None):
                yield running.pop(future), future.result()
    except BaseException:
        for process in multiprocessing.active_children():
            if process not in others:
                process.terminate()
        executor.shutdown(wait=False, cancel_futures=True)
        raise
    executor.shutdown()
