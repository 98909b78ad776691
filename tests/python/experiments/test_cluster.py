"""Sweeps on a Dask cluster: the same as here, whatever dies or joins on the way."""

import contextlib
import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import distributed
import pandas
import parties
import pytest
from conftest import refused
from devlearn import Results, sweep
from devlearn.experiments import cluster
from test_sweep import BRIEF, SMALL, outcome

FOLDER = Path(parties.__file__).parent
SLOW = {**BRIEF, "agents": ["parties:Slow"], "seeds": "1-30"}


def until(holds, what, seconds=30):
    """Waits for a condition."""
    deadline = time.monotonic() + seconds
    while not (found := holds()):
        assert time.monotonic() < deadline, f"in vain: {what}"
        time.sleep(0.05)
    return found


OTHER = "import devlearn.experiments.cluster as c\nc.code = lambda: 'devlearn 0.0.1'\n"
NONE = "import sys\nsys.modules['devlearn'] = None\n"


class Farm:
    """A scheduler, which has no devlearn, and its workers, each a process of its own."""

    def __init__(self, folder):
        self._folder = folder
        (folder / "none.py").write_text(NONE)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self._port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{self._port}"
        self._processes = []
        self.begin()

    def begin(self):
        self.scheduler = self._started(
            "scheduler", "--host", "127.0.0.1", "--port", str(self._port), "--no-dashboard",
            "--preload", self._folder / "none.py",
        )  # fmt: skip

    def worker(self, *more, **environment):
        own = self._folder / f"worker{len(self._processes)}"
        return self._started(
            "worker", self.address, "--nthreads", "1", "--no-dashboard", "--local-directory", own,
            "--host", "127.0.0.1", *more, **environment,
        )  # fmt: skip

    def _started(self, *command, **environment):
        log = (self._folder / f"log{len(self._processes)}").open("wb")
        paths = os.pathsep.join([str(FOLDER), *filter(None, [os.environ.get("PYTHONPATH")])])
        settings = {
            "PYTHONPATH": paths,
            "OMP_NUM_THREADS": "1",
            "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "0",
            # For so long a result is asked for of a worker that died between making and giving it.
            "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "3s",
        }
        process = subprocess.Popen(
            [sys.executable, "-m", "dask", *command],
            stdout=log, stderr=log, start_new_session=True,
            env={**os.environ, **settings, **environment},
        )  # fmt: skip
        self._processes.append(process)
        return process

    @contextlib.contextmanager
    def client(self):
        with distributed.Client(self.address, set_as_default=False) as client:
            yield client

    def stop(self):
        for process in self._processes:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@pytest.fixture
def farm(tmp_path):
    """A scheduler, to begin with."""
    farm = Farm(tmp_path)
    yield farm
    farm.stop()


@pytest.fixture(scope="module")
def shared(tmp_path_factory):
    """A scheduler and two workers, which come again when they are lost."""
    farm = Farm(tmp_path_factory.mktemp("shared"))
    farm.worker("--nworkers", "2")
    with farm.client() as client:
        client.wait_for_workers(2, 60)
    yield farm
    farm.stop()


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """What slow runs come to on this machine; how slow they are does not matter."""
    return outcome(sweep(slow(0), tmp_path_factory.mktemp("alone") / "r.sqlite", workers=1))


def slow(seconds, **more):
    return {**SLOW, "settings": {"parties:Slow": {"seconds": seconds}}, **more}


def assert_same(results, expected):
    """Every run is there, once, and equal to the bit."""
    own = ["label", "settings", "command"]  # say how slow a run is
    found = outcome(results).drop(columns=own, errors="ignore")
    pandas.testing.assert_frame_equal(
        found, expected.drop(columns=own, errors="ignore"), check_exact=True
    )


def started(farm, tmp_path, *more, seconds=0.1, finished=4):
    """A sweep by the command line, once some of its runs are finished."""
    file, path = tmp_path / "sweep.toml", tmp_path / "r.sqlite"
    file.write_text(
        'worlds = ["empty"]\nagents = ["parties:Slow"]\nseeds = "1-30"\nfree = []\nrounds = 2\n'
        f'step_limit = 30\n[settings."parties:Slow"]\nseconds = {seconds}\n'
    )
    process = subprocess.Popen(
        [sys.executable, "-m", "devlearn", "sweep", file, "--output", path,
         "--scheduler", farm.address, *more],
        cwd=FOLDER, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip

    def some():
        with contextlib.suppress(Exception):
            return len(Results(path)) >= finished

    until(lambda: process.poll() is not None or some(), "some runs")
    assert process.poll() is None, process.communicate()
    return process, path


def ended(process):
    """What an undisturbed sweep said."""
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 0, said
    return said


# --- undisturbed ----------------------------------------------------------------------------------


def test_a_cluster_makes_the_runs_that_one_process_makes(shared, tmp_path):
    here = sweep(SMALL, tmp_path / "here.sqlite", workers=1)
    there = sweep(SMALL, tmp_path / "there.sqlite", scheduler=shared.address)
    pandas.testing.assert_frame_equal(outcome(there), outcome(here), check_exact=True)


def test_nobody_is_asked_where_nothing_is_missing(tmp_path):
    sweep(BRIEF | {"agents": ["paper"], "seeds": "1"}, tmp_path / "r.sqlite", workers=1)
    again = sweep(
        BRIEF | {"agents": ["paper"], "seeds": "1"}, tmp_path / "r.sqlite",
        scheduler="tcp://127.0.0.1:1",
    )  # fmt: skip
    assert len(again) == 1


def test_an_agent_that_the_workers_cannot_import_is_told_of_in_its_runs(
    shared, tmp_path, monkeypatch
):
    (tmp_path / "only_here.py").write_text("from parties import Straight\n")
    monkeypatch.syspath_prepend(tmp_path)
    asked = {**BRIEF, "agents": ["only_here:Straight"], "seeds": "1-2"}
    failed = sweep(asked, tmp_path / "r.sqlite", scheduler=shared.address).failed
    assert len(failed) == 2
    assert all("only_here" in text for _, text in failed)


# --- workers --------------------------------------------------------------------------------------


def test_a_worker_that_is_killed_costs_no_run(farm, tmp_path, alone):
    workers = [farm.worker("--no-nanny") for _ in range(2)]
    process, path = started(farm, tmp_path)
    workers[0].kill()
    assert "Traceback" not in ended(process)
    assert_same(Results(path), alone)


def test_a_job_that_ends_its_workers_is_given_up_after_three_and_no_other_is(shared, tmp_path):
    told = tmp_path / "told"
    asked = {**BRIEF, "agents": ["parties:Deadly"], "seeds": "1-8"}
    asked["settings"] = {"parties:Deadly": {"told": str(told)}}
    frame = sweep(asked, tmp_path / "r.sqlite", scheduler=shared.address).to_pandas()
    assert told.read_text() == "died\n" * 3
    assert frame.loc[frame["error"].notna(), "seed"].tolist() == [3]
    assert "its worker died at each of 3 tries" in frame.set_index("seed").loc[3, "error"]
    assert sorted(frame["seed"]) == [*range(1, 9)]


def test_workers_that_join_are_given_work_and_those_that_leave_are_not(farm):
    said = []
    pool = cluster.Cluster(farm.address, 60, said.append)
    try:
        assert said == [f"no workers at {farm.address} yet; waiting for some"]
        assert pool.width == 1
        first = pool.submit([])  # waits for whoever comes
        farm.worker("--no-nanny")
        assert first.result(30) == []
        until(lambda: pool.width == 2, "the first worker")
        second = farm.worker("--no-nanny")
        until(lambda: pool.width == 4, "the second worker")
        second.kill()
        until(lambda: pool.width == 2, "one worker")
    finally:
        pool.stop()


def test_batches_take_longer_the_wider_the_cluster_so_that_its_scheduler_keeps_up(shared):
    pool = cluster.Cluster(shared.address, 60, print)
    try:
        assert pool.seconds == 0.5
        pool._threads = 1000
        assert pool.width / 2 / pool.seconds == pytest.approx(cluster.BATCHES_A_SECOND)
    finally:
        pool.stop()


@pytest.mark.parametrize(
    ("preload", "has"), [(OTHER, "got devlearn 0.0.1"), (NONE, "No module named")]
)
def test_a_worker_with_another_devlearn_or_none_is_refused_at_the_start(
    farm, tmp_path, preload, has
):
    (tmp_path / "other.py").write_text(preload)
    farm.worker("--no-nanny", "--preload", tmp_path / "other.py")
    with farm.client() as client:
        client.wait_for_workers(1, 60)
        [worker] = client.nthreads()
    with pytest.raises(cluster.InvalidValue, match=has) as refusal:
        sweep(SLOW, tmp_path / "r.sqlite", scheduler=farm.address)
    assert refusal.value.quantity == f"worker {worker}"
    assert refusal.value.allowed == f"{cluster.code()}, as here"


@pytest.mark.parametrize("preload", [OTHER, NONE])
def test_a_worker_with_another_devlearn_or_none_that_joins_ends_the_sweep(farm, tmp_path, preload):
    farm.worker("--no-nanny")
    process, path = started(farm, tmp_path, seconds=0.5, finished=1)
    (tmp_path / "other.py").write_text(preload)
    farm.worker("--no-nanny", "--preload", tmp_path / "other.py")
    said = process.communicate(timeout=60)[1]
    assert process.returncode == 1, said
    assert f"expected {cluster.code()}, as here" in said and "devlearn: worker tcp://" in said
    assert 1 <= len(Results(path)) < 30
    assert not Results(path).failed


# --- the scheduler --------------------------------------------------------------------------------


@pytest.mark.parametrize("address", ["127.0.0.1:1", "no://where", "nowhere", 3, ""])
def test_where_no_scheduler_answers_it_is_refused_within_seconds(tmp_path, address):
    began = time.monotonic()
    refused(lambda: sweep(SLOW, tmp_path / "r.sqlite", scheduler=address), "scheduler")
    assert time.monotonic() - began < 10


def test_a_scheduler_that_is_killed_and_comes_again_costs_no_run(farm, tmp_path, alone):
    farm.worker("--no-nanny")
    process, path = started(farm, tmp_path)
    farm.scheduler.kill()
    farm.scheduler.wait()
    farm.begin()
    farm.worker("--no-nanny")
    said = ended(process)
    assert said.count(f"the scheduler at {farm.address} is gone; waiting for it") == 1
    assert said.count(f"the scheduler at {farm.address} is back") == 1
    assert "Traceback" not in said and "ERROR" not in said
    assert_same(Results(path), alone)


def test_a_scheduler_that_stays_away_is_given_up_with_what_is_finished(farm, tmp_path):
    farm.worker("--no-nanny")
    process, path = started(farm, tmp_path, "--patience", "1")
    farm.scheduler.kill()
    said = process.communicate(timeout=30)[1]
    assert process.returncode == 1
    assert "gone for 1 s; expected one that comes back" in said and "Traceback" not in said
    assert 4 <= len(Results(path)) < 30


def test_a_sweep_that_waits_for_its_scheduler_stops_at_once(farm, tmp_path):
    farm.worker("--no-nanny")
    process, path = started(farm, tmp_path)
    farm.scheduler.kill()
    lines = iter(process.stderr.readline, "")  # maybe one before, of no workers yet
    assert any("is gone; waiting for it" in line for line in lines)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=10)[1]
    assert process.returncode == 130
    assert said.splitlines() == [
        f"what is finished is kept in {path}; the same command goes on from there",
        "devlearn: stopped",
    ]


# --- whoever asked --------------------------------------------------------------------------------


def tasks(client):
    """What a scheduler has to do."""
    return client.run_on_scheduler(lambda dask_scheduler: len(dask_scheduler.tasks))


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_a_sweep_that_is_stopped_or_killed_leaves_no_tasks_and_goes_on_where_it_was(
    shared, tmp_path, alone, how
):
    process, path = started(shared, tmp_path)
    with shared.client() as client:
        assert tasks(client)
        process.send_signal(how)
        said = process.communicate(timeout=20)[1]
        if how == signal.SIGINT:
            assert process.returncode == 130
            assert "the same command goes on from there" in said and "Traceback" not in said
        until(lambda: not tasks(client), "a cluster with nothing to do", 10)
    finished = Results(path).to_pandas()
    assert 4 <= len(finished) < 30
    process, path = started(shared, tmp_path)
    ended(process)
    assert_same(Results(path), alone)
    pandas.testing.assert_frame_equal(Results(path).to_pandas().head(len(finished)), finished)


# --- clusters of others ---------------------------------------------------------------------------


def test_the_guide_s_job_of_slurm_starts_a_worker_of_one_thread_a_core():
    guide = (Path(__file__).parents[3] / "docs/clusters.md").read_text(encoding="utf-8")
    [script] = [code for code in re.findall(r"```python\n(.*?)```", guide, re.S) if "SLURM" in code]
    made, given, _ = script.partition("cluster.scale")
    assert given
    here = "scheduler_options={'host': '127.0.0.1', 'dashboard_address': ':0'},"
    names = {}
    exec(made.replace("SLURMCluster(", f"SLURMCluster({here}"), names)
    with names["cluster"] as cluster:
        job = cluster.job_script()
        assert f"dask_worker {cluster.scheduler_address} " in job
    assert job.startswith("#!")
    assert "#SBATCH --cpus-per-task=32" in job and "#SBATCH -t 08:00:00" in job
    assert "--nthreads 1" in job and "--nworkers 32" in job
    assert job.index("export OMP_NUM_THREADS=1") < job.index("dask_worker")
