"""Many runs, each kept as it is finished: ``devlearn.sweep``."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any, Union

from .._calls import path_text, shown
from .._files import made_folder
from ..errors import InvalidValue, MissingExtra
from . import spec as specs
from .pools import Borrowed, Done, Here, Pool, Processes, run_all
from .store import Results, Store

try:
    from tqdm import tqdm
except ModuleNotFoundError as error:
    raise MissingExtra("devlearn.sweep", "tqdm", "experiments") from error

_MOST_WORKERS = 4096


Asked = Union[Mapping[str, Any], str, "os.PathLike[str]", specs.Spec]


def sweep(
    spec: Asked | Sequence[Asked] | specs.Together,
    output: str | os.PathLike[str],
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    patience: float = 600.0,
    executor: Executor | None = None,
    retry_failed: bool = False,
    progress: bool | None = None,
) -> Results:
    """Run worlds x agents x settings x seeds, and keep what each run came to in ``output``.

    ``spec`` is a dict, or a TOML file, as docs/sweeps.md tells, or a list of several. Runs that are
    in the file are not made again: stopped, the same call goes on. Each run is the same wherever it
    is made.

    Parameters: workers, processes of this machine (None: one a core; 1: this process alone), or
    scheduler, the address of a Dask cluster's, which is waited for when it is gone, for
    ``patience`` seconds, or executor, any of concurrent.futures, with so many ``workers``;
    retry_failed: whether runs that failed are made again; progress: None where somebody watches.

    A run that fails is kept with its traceback, and the sweep goes on. Ctrl-C raises
    KeyboardInterrupt; what is finished is kept. Raises InvalidValue for what the spec cannot mean,
    FileError for a file that is none, is damaged, is in use by another, or cannot be written.
    """
    asked = _asked(spec)
    path = Path(path_text(output))
    if "\0" in str(path) or not path.name or os.path.isdir(path):
        raise InvalidValue("output", repr(str(path)), "a file, such as results.sqlite")
    if os.path.exists(path) and not os.path.isfile(path):
        raise InvalidValue("output", str(path), "a file, no device or pipe")
    _require_place(workers, scheduler, patience, executor)
    made_folder(path.parent)
    with Store(path, asked, retry_failed=retry_failed) as store:
        missing = sum(1 for _ in store.missing(asked.jobs()))
        done = len(asked) - missing
        hidden = None if progress is None else not progress
        with tqdm(desc="runs", total=len(asked), initial=done, unit="run", disable=hidden) as bar:

            def keep(finished: Done) -> None:
                store.add(finished)
                bar.update(len(finished))

            pool = _pool(workers, scheduler, patience, executor, missing)
            run_all(store.missing(asked.jobs()), missing, pool, keep)
    return Results(path)


def _asked(spec: Asked | Sequence[Asked] | specs.Together) -> specs.Spec | specs.Together:
    if isinstance(spec, (specs.Spec, specs.Together)):
        return spec
    if isinstance(spec, Sequence) and not isinstance(spec, str):
        each = [one if isinstance(one, specs.Spec) else specs.read(one) for one in spec]
        return specs.Together(each)
    return specs.read(spec)


def _require_place(
    workers: int | None, scheduler: str | None, patience: float, executor: Executor | None
) -> None:
    if workers is not None and (type(workers) is not int or not 1 <= workers <= _MOST_WORKERS):
        raise InvalidValue("workers", shown(workers), f"a whole number in [1, {_MOST_WORKERS}]")
    if scheduler is not None:
        if not isinstance(scheduler, str) or not scheduler:
            raise InvalidValue("scheduler", shown(scheduler), "an address: tcp://HOST:PORT")
        if executor is not None or workers is not None:
            raise InvalidValue("scheduler", scheduler, "none beside workers or an executor")
        if not isinstance(patience, (int, float)) or not 0 <= patience < math.inf:
            raise InvalidValue("patience", shown(patience), "seconds, from 0 on")
    if executor is not None and not isinstance(executor, Executor):
        raise InvalidValue("executor", shown(executor), "one of concurrent.futures")


def _pool(
    workers: int | None,
    scheduler: str | None,
    patience: float,
    executor: Executor | None,
    missing: int,
) -> Pool:
    if scheduler is not None and missing:
        from .cluster import Cluster

        return Cluster(scheduler, patience, lambda line: tqdm.write(line, file=sys.stderr))
    workers = workers or os.cpu_count() or 1
    if executor is not None:
        return Borrowed(executor, workers)
    if workers == 1 or missing < 2:
        return Here()
    return Processes(min(workers, missing))
