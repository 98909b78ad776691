"""Jobs on a Dask cluster: the one file that knows of Dask. See docs/clusters.md."""

from __future__ import annotations

import asyncio
import functools
import itertools
import logging
import pickle
import threading
import time
import uuid
from collections.abc import Callable, Coroutine, Sequence
from concurrent.futures import BrokenExecutor, Future
from contextlib import suppress
from typing import Any, TypeVar

from .. import _core
from .._files import code_version
from ..errors import InvalidValue, MissingExtra
from .job import Job, Row
from .pools import execute_all

try:
    from distributed import Client, KilledWorker, Security
    from distributed.comm.core import connect
except ModuleNotFoundError as error:
    raise MissingExtra("a sweep on a Dask cluster", "distributed", "cluster") from error

T = TypeVar("T")

ANSWER = 5.0
"""Seconds within which a scheduler answers, if there is one."""
LOOK = 1.0
"""Seconds between two looks at how many workers there are."""
LONGEST_PAUSE = 30.0
"""Seconds between two tries to reach a scheduler that is gone, at the most."""
BATCHES_A_SECOND = 100
"""So many the scheduler and this process are to handle, at the most."""
_LOGS = ("distributed.batched", "distributed.client", "distributed.comm", "distributed.core")


@functools.cache
def code() -> str:
    """Which devlearn this process has, as it was when first asked."""
    return f"devlearn {_core.__version__} (commit {_core.commit}, code {code_version()})"


def execute_as(wanted: str, jobs: bytes) -> list[Row]:
    """What a worker does, if it has this devlearn."""
    if code() != wanted:
        raise RuntimeError(f"a worker has {code()}; wanted is {wanted}")
    return execute_all(pickle.loads(jobs))


# What is sent is text and bytes alone: a worker without devlearn would end at the sight of a name
# of it, where it can say so now; and the scheduler needs none.
_CODE = f"__import__({__name__!r}, fromlist=['cluster']).code()"
_ROWS = f"__import__({__name__!r}, fromlist=['cluster']).execute_as(wanted, jobs)"


class Cluster:
    """A Dask cluster, which stays its owner's. See pools.Pool.

    What a lost worker had, Dask runs again. A scheduler that is lost is waited for, and what was
    under way is sent again. Dask's client lives in a thread of its own, with all that awaits it.
    """

    def __init__(self, address: str, patience: float, tell: Callable[[str], None]) -> None:
        """Reaches the scheduler. Raises InvalidValue: none answers, or a worker is refused.

        ``patience``: seconds after which a scheduler that is gone is given up; ``tell`` is given
        lines for whoever watches.
        """
        self._address = address
        self._patience = patience
        self._tell = tell
        self._threads = 0
        self._under_way: set[Future[list[Row]]] = set()
        # What it logs of a scheduler that is gone, with its tracebacks, is told in a line.
        self._levels = {name: logging.getLogger(name).level for name in _LOGS}
        for name in _LOGS:
            logging.getLogger(name).setLevel(logging.CRITICAL)
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        try:
            self._there(self._begin()).result()
        except BaseException:
            self._leave()
            raise

    @property
    def width(self) -> int:
        """See pools.Pool: what each thread of a worker works on, and its next."""
        return max(1, 2 * self._threads)

    @property
    def seconds(self) -> float:
        """See pools.Pool."""
        return max(0.5, self._threads / BATCHES_A_SECOND)

    def submit(self, jobs: Sequence[Job]) -> Future[list[Row]]:
        """See pools.Pool."""
        future = self._there(self._rows(jobs))
        self._under_way.add(future)
        future.add_done_callback(self._under_way.discard)
        return future

    def renew(self) -> None:
        """See pools.Pool: whoever has the cluster replaces workers."""

    def stop(self) -> None:
        """See pools.Pool. A batch that a worker has begun with ends, and leads nowhere."""
        with suppress(Exception):
            self._there(self._end()).result(2 * ANSWER)
        self._leave()

    def _there(self, coroutine: Coroutine[Any, Any, T]) -> Future[T]:
        return asyncio.run_coroutine_threadsafe(coroutine, self._loop)

    def _leave(self) -> None:
        with suppress(Exception):
            self._there(_all_over()).result(2 * ANSWER)
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()
        for name, level in self._levels.items():
            logging.getLogger(name).setLevel(level)

    # --- in the client's thread -------------------------------------------------------------------

    async def _begin(self) -> None:
        self._client = asyncio.ensure_future(self._connected())
        try:
            await self._client
        except InvalidValue:
            raise
        except (OSError, ValueError) as error:
            raise InvalidValue(
                "scheduler", f"{self._address} ({error})",
                f"the address of a Dask scheduler that answers within {ANSWER:g} s",
            ) from error  # fmt: skip
        self._watch = asyncio.ensure_future(self._watched())

    async def _end(self) -> None:
        for future in [*self._under_way]:
            future.cancel()
        self._watch.cancel()
        if not self._client.cancel():  # it was not waited for
            await self._client.result().close()

    async def _connected(self) -> Client:
        # A client that is still in search of its scheduler cannot be stopped; so not before.
        comm = await connect(
            self._address, timeout=ANSWER, **Security().get_connection_args("client")
        )
        await comm.close()
        client: Client = Client(
            self._address, asynchronous=True, set_as_default=False, timeout=ANSWER, name="devlearn"
        )
        try:
            await client
            await _refuse_others(client)
            await self._look(client)
        except BaseException:
            await client.close()
            raise
        if not self._threads:
            self._tell(f"no workers at {self._address} yet; waiting for some")
        return client

    async def _look(self, client: Client) -> None:
        self._threads = sum((await client.nthreads()).values())

    async def _watched(self) -> None:
        while True:
            await asyncio.sleep(LOOK)
            with suppress(Exception):  # of a scheduler that is gone, _rows tells
                await self._look(await self._client)

    async def _rows(self, jobs: Sequence[Job]) -> list[Row]:
        sent = {"wanted": code(), "jobs": pickle.dumps([*jobs])}
        while True:
            connection = self._client
            client = await connection
            future = None
            try:
                future = client.submit(eval, _ROWS, sent, key=f"runs-{uuid.uuid4().hex}")
                rows: list[Row] = await future
                return rows
            except Exception as error:
                if future is not None and future.status == "error":
                    if isinstance(error, KilledWorker):
                        raise BrokenExecutor(str(error)) from error
                    await _refuse_others(client)
                    raise
            # Else nobody knows of it any more, and there is nothing that it did.
            if self._client is connection:
                self._client = asyncio.ensure_future(self._reconnected(client))

    async def _reconnected(self, lost: Client) -> Client:
        self._tell(f"the scheduler at {self._address} is gone; waiting for it")
        self._threads = 0
        began = time.monotonic()
        await asyncio.shield(asyncio.ensure_future(_closed(lost)))  # which would swallow a stop
        for n in itertools.count():
            left = began + self._patience - time.monotonic()
            if left <= 0:
                raise InvalidValue(
                    "scheduler", f"{self._address}, gone for {self._patience:g} s",
                    "one that comes back; what was finished is kept, and the same sweep goes on",
                )  # fmt: skip
            await asyncio.sleep(min(0.25 * 2**n, LONGEST_PAUSE, left))
            with suppress(OSError):
                client = await self._connected()
                self._tell(f"the scheduler at {self._address} is back")
                return client
        raise AssertionError("never here")


async def _refuse_others(client: Client) -> None:
    """Raises InvalidValue of a worker that has not this devlearn."""
    answers = await client.run(eval, _CODE, on_error="return")
    for worker, answer in answers.items():
        if answer != code() and not isinstance(answer, OSError):  # of one that is gone meanwhile
            raise InvalidValue(f"worker {worker}", str(answer), f"{code()}, as here")


async def _closed(lost: Client) -> None:
    with suppress(Exception):
        await lost.close()


async def _all_over() -> None:
    """Waits for the end of whatever goes on."""
    others = asyncio.all_tasks() - {asyncio.current_task()}
    for task in others:
        task.cancel()
    if others:
        await asyncio.wait(others, timeout=ANSWER)
