"""What a Dask cluster costs a sweep: the figures of docs/clusters.md, as JSON.

cluster_overhead.py [--workers N] [--seconds S] [--passes P] [--run MILLISECONDS]

A scheduler and N workers, processes of this machine, run the same runs as N processes without Dask,
in turn, P times, S seconds each. Start-up of either is left out.
"""

from __future__ import annotations

import argparse
import json
import pickle
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import contextmanager
from pathlib import Path

import psutil
from devlearn.experiments import job, pools, spec
from devlearn.experiments.cluster import Cluster
from devlearn.experiments.store import Store


def asked(count, rounds):
    """So many runs of the paper's learner."""
    return spec.read(
        {"worlds": ["paper"], "agents": ["paper"], "seeds": f"1-{count}", "free": [2000],
         "rounds": rounds, "hopeless": 0}
    )  # fmt: skip


@contextmanager
def cluster(workers):
    """A scheduler's address, and a context in which all of it takes no processor time."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    with tempfile.TemporaryDirectory() as folder:
        commands = [["scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard"]]
        commands += [
            ["worker", address, "--nthreads", "1", "--no-dashboard", "--no-nanny",
             "--local-directory", folder] for _ in range(workers)
        ]  # fmt: skip

        @contextmanager
        def suspended():
            for process in processes:
                process.send_signal(signal.SIGSTOP)
            yield
            for process in processes:
                process.send_signal(signal.SIGCONT)

        processes = [
            subprocess.Popen([sys.executable, "-m", "dask", *command], stderr=subprocess.DEVNULL)
            for command in commands
        ]
        try:
            while not answers(port):
                time.sleep(0.1)
            yield address, suspended
        finally:
            for process in processes:
                process.kill()
                process.wait()


def answers(port):
    """Whether somebody listens."""
    with socket.socket() as tried:
        return tried.connect_ex(("127.0.0.1", port)) == 0


def rounds_of(seconds):
    """So many rounds that a run takes about so long."""
    rounds = 100
    for _ in range(3):
        taken = statistics.median(job.execute(one).seconds for one in asked(9, rounds).jobs())
        rounds = max(1, round(rounds * seconds / taken))
    return rounds


class Kept:
    """A pool that goes on after ``run_all``, so that its start-up is paid once."""

    def __init__(self, pool):
        self.pool = pool
        self.submit, self.renew = pool.submit, pool.renew

    width = property(lambda self: self.pool.width)
    seconds = property(lambda self: self.pool.seconds)

    def stop(self):
        """Not yet."""


def processor_times():
    """Seconds that this process and each that it started took so far."""
    me = psutil.Process()
    processes = {"here": me}
    for child in me.children(recursive=True):
        command = child.cmdline()
        named = command[command.index("dask") + 1] if "dask" in command else "process"
        processes[f"{named} {child.pid}"] = child
    return {name: sum(process.cpu_times()[:2]) for name, process in processes.items()}


def processor_time():
    """All of it."""
    return sum(processor_times().values())


def swept(jobs, pool):
    """Seconds; and processor time of all processes over that of the runs."""
    rows = []
    began, processor = time.monotonic(), processor_time()
    pools.run_all(jobs, len(jobs), pool, lambda done: rows.extend(row for _, row in done))
    taken, processor = time.monotonic() - began, processor_time() - processor
    assert len(rows) == len(jobs) and not any(row.error for row in rows)
    return taken, processor / sum(row.seconds for row in rows)


def batches(pool, seconds, width):
    """Empty ones, so many of them under way: how many a second, and each process's ms of each."""
    running, count = set(), 0
    began, before = time.monotonic(), processor_times()
    while (taken := time.monotonic() - began) < seconds:
        running |= {pool.submit([]) for _ in range(width - len(running))}
        done, running = wait(running, return_when=FIRST_COMPLETED)
        count += len(done)
    count += len(wait(running).done)
    after = processor_times()
    return count / taken, {name: 1000 * (after[name] - before[name]) / count for name in after}


class Instant:
    """A pool whose runs take no time, but all else is done: what this process alone could take."""

    width = 2

    def __init__(self, rows):
        self._rows = rows
        self.seconds = sum(row.seconds for row in rows)

    def submit(self, jobs):
        """As over a network."""
        pickle.dumps(jobs)
        future = Future()
        rows = [self._rows[n % len(self._rows)] for n in range(len(jobs))]
        future.set_result(pickle.loads(pickle.dumps(rows)))
        return future

    def renew(self):
        """Nothing is lost."""

    def stop(self):
        """Nothing is under way."""


def runs_kept_a_second(whole, rows):
    """By run_all, in batches of about as many as ``rows``, with pickling both ways and a store."""
    jobs = [*whole.jobs()]
    pool = Instant(rows)
    with tempfile.TemporaryDirectory() as folder, Store(Path(folder) / "r.sqlite", whole) as store:
        began = time.process_time()
        pools.run_all(store.missing(jobs), len(jobs), pool, store.add)
        return len(jobs) / (time.process_time() - began)


def runs_stored_a_second(whole, row, size):
    """By a store of its own, in transactions of so many runs."""
    jobs = [*whole.jobs()]
    with tempfile.TemporaryDirectory() as folder, Store(Path(folder) / "r.sqlite", whole) as store:
        began = time.process_time()
        for first in range(0, len(jobs), size):
            store.add([(one, row) for one in jobs[first : first + size]])
        return len(jobs) / (time.process_time() - began)


def main() -> None:
    """Measures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--passes", type=int, default=5)
    parser.add_argument("--run", type=float, default=50.0)
    options = parser.parse_args()

    rounds = rounds_of(options.run / 1000)
    count = round(options.workers * options.seconds * 1000 / options.run)
    whole = asked(count, rounds)
    jobs = [*whole.jobs()]

    ratios, here, there = [], [], []
    with cluster(options.workers) as (address, suspended):
        far = Kept(Cluster(address, 60, print))
        near = Kept(pools.Processes(options.workers))
        while far.width < 2 * options.workers:
            time.sleep(0.1)
        for pool in (near, far):
            swept(jobs[: 4 * options.workers], pool)  # every worker has imported all it needs
        for n in range(options.passes):
            for side in ("here", "there")[:: 1 if n % 2 else -1]:
                if side == "here":
                    with suspended():
                        here.append(swept(jobs, near))
                else:
                    there.append(swept(jobs, far))
            ratios.append(there[-1][0] / here[-1][0])
        rate, each = batches(far, 3.0, 100)
        near.pool.stop()
        far.pool.stop()

    rows = [job.execute(one) for one in jobs[:200]]
    print(
        json.dumps(
            {
                "seconds of a run": statistics.median(row.seconds for row in rows),
                "runs": count,
                "time on the cluster over time here": statistics.median(ratios),
                "of each pass": [round(ratio, 3) for ratio in ratios],
                "processor time over that of the runs, here": statistics.median(p for _, p in here),
                "the same, on the cluster": statistics.median(p for _, p in there),
                "empty batches a second": rate,
                "processor ms of each": each,
                "bytes of batches of 1 and 10": [len(pickle.dumps(jobs[:n])) for n in (1, 10)],
                "bytes of their results": [len(pickle.dumps(rows[:n])) for n in (1, 10)],
                "runs stored a second, 1 at a time": runs_stored_a_second(whole, rows[0], 1),
                "the same, 10 at a time": runs_stored_a_second(whole, rows[0], 10),
                "runs kept a second, all counted": runs_kept_a_second(asked(20000, rounds), rows),
            },
            indent=2,
        )
    )


if __name__ == "__main__":
    main()
