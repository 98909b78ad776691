"""Whole experiments of the paper over one and two workers: prints runs a second, as JSON.

many_runs.py SECONDS: how long the faster of the two passes shall take at least
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from devlearn import World
from devlearn.experiments.runs import Journal, run_all
from devlearn.paper.jobs import execute, job
from devlearn.paper.schedule import preset


def began(job: Mapping[str, Any]) -> dict[str, Any]:
    """When a worker gets to its first job, by the clock that all processes share."""
    return {"at": time.monotonic()}


def timed(function: Any, jobs: list[dict[str, Any]], workers: int) -> tuple[float, Any]:
    """Seconds that the jobs take over so many workers, start and end included; and what came."""
    with tempfile.TemporaryDirectory() as folder:
        journal = Journal(Path(folder) / "runs.jsonl")
        start = time.monotonic()
        results = run_all(function, jobs, journal, workers=workers)
        taken = time.monotonic() - start
        journal.close()
    return taken, results


def main() -> None:
    """Measures."""
    seconds = float(sys.argv[1])
    start = time.monotonic()
    _, starts = timed(began, [{"n": n} for n in range(2)], 2)
    start_up = max(result["at"] for result in starts) - start

    world, config = World.load("paper"), preset("paper")
    jobs = [job(world, config, seed) for seed in range(1, 5)]
    one = timed(execute, jobs, 1)[0] / len(jobs)
    count = max(4, 2 * int(1.1 * seconds / one))
    jobs = [job(world, config, seed) for seed in range(1, count + 1)]
    rates = {
        f"runs/per_second_{workers}": count / timed(execute, jobs, workers)[0] for workers in (2, 1)
    }
    print(json.dumps({"runs/start_up": start_up, **rates}))


if __name__ == "__main__":
    main()
