"""Whole experiments of the paper as a sweep: runs a second, and what the sweep costs, as JSON.

many_runs.py SECONDS    how long each of the passes shall take at least
many_runs.py --loop FIRST LAST   runs of these seeds, one after the other: a process by itself
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import devlearn
from devlearn.experiments import job, spec
from devlearn.experiments.store import Store


def began(run: Any) -> float:
    """A measure: when a worker gets to its first run, by the clock that all processes share [s]."""
    return time.monotonic()


def asked(first: int, last: int, **more: Any) -> dict[str, Any]:
    """So many whole experiments of the paper."""
    return {"worlds": ["paper"], "agents": ["paper"], "seeds": f"{first}-{last}", **more}


def swept(count: int, workers: int, **more: Any) -> tuple[float, Any]:
    """Seconds of a sweep over so many workers, start and end included; its runs as a table."""
    folder = tempfile.TemporaryDirectory()
    start = time.monotonic()
    results = devlearn.sweep(
        asked(1, count, **more), Path(folder.name) / "runs.sqlite", workers=workers, progress=False
    )
    taken = time.monotonic() - start
    frame = results.to_pandas()
    folder.cleanup()
    return taken, frame


def by_themselves(count: int) -> float:
    """Seconds of two independent processes that do the same loop, without store or master."""
    half = count // 2
    start = time.monotonic()
    processes = [
        subprocess.Popen([sys.executable, __file__, "--loop", str(first), str(last)])
        for first, last in ((1, half), (half + 1, count))
    ]
    for process in processes:
        if process.wait():
            sys.exit("many_runs: a process failed")
    return time.monotonic() - start


def store_seconds() -> float:
    """Seconds that the store takes for a run."""
    whole = spec.read(asked(1, 500))
    jobs = [*whole.jobs()]
    row = job.execute(jobs[0])
    with tempfile.TemporaryDirectory() as folder, Store(Path(folder) / "r.sqlite", whole) as store:
        start = time.process_time()
        for one in jobs:
            store.add([(one, row)])
        return (time.process_time() - start) / len(jobs)


def main() -> None:
    """Measures."""
    if sys.argv[1] == "--loop":
        for one in spec.read(asked(int(sys.argv[2]), int(sys.argv[3]))).jobs():
            job.execute(one)
        return
    seconds = float(sys.argv[1])
    _, frame = swept(8, 1)
    each = frame["run_seconds"].median()
    start = time.monotonic()
    _, starts = swept(2, 2, rounds=1, free=[], measures=["many_runs:began"])
    count = max(4, 2 * int(1.1 * seconds / each))
    rates = {f"runs/per_second_{workers}": count / swept(count, workers)[0] for workers in (2, 1)}
    print(
        json.dumps(
            {
                "runs/start_up": starts["many_runs:began"].max() - start,
                **rates,
                "runs/per_second_of_two_processes": count / by_themselves(count),
                "runs/store_share": store_seconds() / each,
            }
        )
    )


if __name__ == "__main__":
    main()
