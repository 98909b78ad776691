"""Where jobs are worked on: here, by the processes of this machine, or by an executor of others."""

from __future__ import annotations

import dataclasses
import itertools
import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from contextlib import contextmanager
from typing import Protocol

from ..errors import InvalidValue
from .job import Job, Row, execute

TRIES = 3
"""A job whose worker died so often has failed."""

Done = Sequence[tuple[Job, Row]]


@dataclasses.dataclass
class _Try:
    """A job, and how many workers died at it."""

    job: Job
    deaths: int = 0


def execute_all(jobs: Sequence[Job]) -> list[Row]:
    """What a worker is sent: some jobs at once, so that sending costs little beside them."""
    return [execute(job) for job in jobs]


class Pool(Protocol):
    """Whoever works on batches of jobs."""

    @property
    def width(self) -> int:
        """So many batches are with it at a time."""

    @property
    def seconds(self) -> float:
        """A batch should take so long."""

    def submit(self, jobs: Sequence[Job]) -> Future[list[Row]]:
        """Begins on a batch."""

    def renew(self) -> None:
        """Is whole again after workers were lost."""

    def stop(self) -> None:
        """Ends what is under way, and the workers."""


def run_all(jobs: Iterable[Job], count: int, pool: Pool, keep: Callable[[Done], None]) -> None:
    """Runs ``count`` jobs and hands on what came of them, as it comes.

    A batch whose worker died is run again, job by job and nothing beside it, so that the job that
    ends its workers is told from those that were with it; after three deaths it has failed. What
    stops all this, Ctrl-C too, loses what is under way, and nothing that was finished.
    """
    batches = _Batches(jobs, count, pool)
    running: dict[Future[list[Row]], Sequence[_Try]] = {}

    def kept(future: Future[list[Row]]) -> None:
        batch = running.pop(future)
        rows = future.result()
        batches.took(rows)
        keep([(tried.job, row) for tried, row in zip(batch, rows)])

    try:
        while True:
            while len(running) < batches.width and (batch := batches.next(bool(running))):
                running[_submitted(pool, batch)] = batch
            if not running:
                return
            lost = []
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                if isinstance(future.exception(), BrokenExecutor):
                    lost.append(future)
                else:
                    kept(future)
            if lost:
                # All that is under way is lost with a worker; some of it may have been finished.
                for future in wait(running).done:
                    if isinstance(future.exception(), BrokenExecutor):
                        keep(batches.lost(running.pop(future)))
                    else:
                        kept(future)
                pool.renew()
    except BaseException:
        for future in [future for future in running if future.done()]:
            if not future.cancelled() and future.exception() is None:
                kept(future)
        raise
    finally:
        pool.stop()


def _submitted(pool: Pool, batch: Sequence[_Try]) -> Future[list[Row]]:
    try:
        return pool.submit([tried.job for tried in batch])
    except BrokenExecutor as error:  # lost since the one before
        future: Future[list[Row]] = Future()
        future.set_exception(error)
        return future


class _Batches:
    """What is to be run next, in pieces of about the pool's seconds."""

    def __init__(self, jobs: Iterable[Job], count: int, pool: Pool) -> None:
        self._jobs = iter(jobs)
        self._left = count
        self._pool = pool
        self._mean = pool.seconds  # a run; one at a time until it is known
        self._suspects: deque[_Try] = deque()

    @property
    def width(self) -> int:
        return 1 if self._suspects else self._pool.width

    def next(self, others: bool) -> Sequence[_Try]:
        """The next batch; none at the end, or before those under way are back."""
        if self._suspects:
            return () if others else [self._suspects.popleft()]
        share = self._left // (2 * self._pool.width)  # so that all end together
        size = max(1, min(int(self._pool.seconds / self._mean), share))
        batch = [_Try(job) for job in itertools.islice(self._jobs, size)]
        self._left -= len(batch)
        return batch

    def took(self, rows: Sequence[Row]) -> None:
        """Of a batch that came back."""
        for row in rows:
            self._mean += 0.1 * (max(row.seconds, 1e-6) - self._mean)

    def lost(self, batch: Sequence[_Try]) -> Done:
        """Of a batch whose worker died: those that are given up."""
        given_up = []
        for tried in batch:
            tried.deaths += 1
            if tried.deaths < TRIES:
                self._suspects.append(tried)
            else:
                gone = Row(error=f"its worker died at each of {TRIES} tries")
                given_up.append((tried.job, gone))
        return given_up


# --- here -----------------------------------------------------------------------------------------


class Here:
    """This process, one job at a time."""

    width = 1
    seconds = 0.1

    def submit(self, jobs: Sequence[Job]) -> Future[list[Row]]:
        """See Pool."""
        future: Future[list[Row]] = Future()
        future.set_result(execute_all(jobs))
        return future

    def renew(self) -> None:
        """See Pool."""
        raise AssertionError("nothing here can be lost")

    def stop(self) -> None:
        """See Pool."""


# --- the processes of this machine ----------------------------------------------------------------


class Processes:
    """So many processes of this machine. Raises InvalidValue where they cannot start.

    Spawned, so that they inherit nothing; not threads, as Python code of jobs would take turns.
    """

    seconds = 0.1  # a kill of this process loses no more of each worker's time

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self.width = 2 * workers  # what is queued need not be undone when someone stops
        self._others = multiprocessing.active_children()
        self._executor = self._made()
        try:
            with _interrupts_held(), _one_thread_each():
                self._executor.submit(int).result()
        except BrokenExecutor as error:
            raise InvalidValue(
                "workers", f"{workers}, which end as they start",
                'a program that they can import: its sweep under `if __name__ == "__main__":`, '
                "or workers=1",
            ) from error  # fmt: skip

    def _made(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(
            self._workers,
            mp_context=multiprocessing.get_context("spawn"),
            initializer=_end_with_parent,
        )

    def submit(self, jobs: Sequence[Job]) -> Future[list[Row]]:
        """See Pool."""
        with _interrupts_held(), _one_thread_each():
            return self._executor.submit(execute_all, jobs)

    def renew(self) -> None:
        """See Pool."""
        self.stop()
        self._executor = self._made()

    def stop(self) -> None:
        """See Pool."""
        for process in multiprocessing.active_children():
            if process not in self._others:
                process.terminate()
        self._executor.shutdown(wait=False, cancel_futures=True)


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


# --- an executor of one's own ---------------------------------------------------------------------


class Borrowed:
    """An executor of concurrent.futures' kind, which stays its owner's."""

    seconds = 0.5

    def __init__(self, executor: Executor, workers: int) -> None:
        self._executor = executor
        self.width = 2 * workers

    def submit(self, jobs: Sequence[Job]) -> Future[list[Row]]:
        """See Pool."""
        return self._executor.submit(execute_all, jobs)

    def renew(self) -> None:
        """See Pool."""
        # It is not ours to make anew.
        raise BrokenExecutor("the executor lost its workers; what was finished is kept")

    def stop(self) -> None:
        """See Pool."""
