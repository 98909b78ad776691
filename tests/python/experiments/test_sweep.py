"""Sweeps: the same wherever they run, through failures, deaths and stops."""

import concurrent.futures
import contextlib
import io
import multiprocessing
import os
import re
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import pandas
import parties
import pytest
from conftest import refused
from devlearn import Results, cli, sweep
from devlearn.experiments import job, pools, spec

SMALL = {
    "worlds": ["paper", "similar:3"],
    "agents": ["paper", "adaptive", "RandomAgent"],
    "seeds": "1-4",
    "free": [100],
    "rounds": 5,
    "step_limit": 80,
    "keep": "rounds",
}
BRIEF = {"worlds": ["empty"], "free": [], "rounds": 2, "step_limit": 30}


def outcome(results):
    """What must not depend on where and when it was made."""
    frame = results.to_pandas().sort_values(["world", "label", "seed"])
    kept = [c for c in frame if not c.startswith("run")]
    return frame[kept].reset_index(drop=True)


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    return outcome(sweep(SMALL, tmp_path_factory.mktemp("alone") / "r.sqlite", workers=1))


def test_results_do_not_depend_on_the_number_of_workers(tmp_path, alone):
    pandas.testing.assert_frame_equal(
        outcome(sweep(SMALL, tmp_path / "r.sqlite", workers=2)), alone, check_exact=True
    )


def test_any_executor_of_concurrent_futures_may_run_them(tmp_path, alone):
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        results = sweep(SMALL, tmp_path / "r.sqlite", executor=executor, workers=2)
    pandas.testing.assert_frame_equal(outcome(results), alone, check_exact=True)


def test_an_executor_that_lost_its_workers_ends_the_sweep_with_what_is_finished(tmp_path):
    asked = {**BRIEF, "agents": ["parties:Deadly"], "seeds": "1-3"}
    asked["settings"] = {"parties:Deadly": {"told": str(tmp_path / "told")}}
    path = tmp_path / "r.sqlite"
    with concurrent.futures.ProcessPoolExecutor(1) as executor:
        with pytest.raises(concurrent.futures.BrokenExecutor, match="what was finished is kept"):
            sweep(asked, path, executor=executor, workers=1)
    assert len(Results(path)) <= 2


def test_a_run_that_raises_is_kept_with_its_traceback_and_the_sweep_goes_on(tmp_path):
    asked = {**BRIEF, "agents": ["parties:Raises", "paper"], "seeds": "1-4"}
    frame = sweep(asked, tmp_path / "r.sqlite", workers=2).to_pandas()
    failed = frame[frame["error"].notna()]
    assert set(zip(failed["agent"], failed["seed"])) == {
        ("parties:Raises", 2),
        ("parties:Raises", 4),
    }
    assert all("RuntimeError: no motion for seed" in text for text in failed["error"])
    assert failed["steps"].isna().all()
    assert (frame["steps"].notna() == frame["error"].isna()).all()


def test_runs_that_failed_are_made_again_only_where_that_is_asked_for(tmp_path):
    path, told = tmp_path / "r.sqlite", tmp_path / "repaired"
    asked = {**BRIEF, "agents": ["parties:Repaired"], "seeds": "1-3"}
    asked["settings"] = {"parties:Repaired": {"told": str(told)}}
    assert len(sweep(asked, path, workers=1).failed) == 3
    told.touch()
    assert len(sweep(asked, path, workers=1).failed) == 3
    frame = sweep(asked, path, workers=1, retry_failed=True).to_pandas()
    assert len(frame) == 3 and frame["error"].isna().all() and frame["steps"].notna().all()


def test_a_job_that_ends_its_workers_is_given_up_after_three_and_no_other_is(tmp_path):
    told = tmp_path / "told"
    asked = {**BRIEF, "agents": ["parties:Deadly"], "seeds": "1-8"}
    asked["settings"] = {"parties:Deadly": {"told": str(told)}}
    frame = sweep(asked, tmp_path / "r.sqlite", workers=2).to_pandas()
    assert told.read_text() == "died\n" * 3
    assert frame.loc[frame["error"].notna(), "seed"].tolist() == [3]
    assert "its worker died at each of 3 tries" in frame.set_index("seed").loc[3, "error"]
    assert sorted(frame["seed"]) == [*range(1, 9)]


def test_a_worker_that_dies_once_costs_nothing(tmp_path):
    asked = {**BRIEF, "agents": ["parties:DiesOnce"], "seeds": "1-8"}
    asked["settings"] = {"parties:DiesOnce": {"told": str(tmp_path / "told")}}
    frame = sweep(asked, tmp_path / "r.sqlite", workers=2).to_pandas()
    assert (tmp_path / "told").exists()
    assert sorted(frame["seed"]) == [*range(1, 9)]
    assert frame["error"].isna().all()


SLOW = {
    **BRIEF, "agents": ["parties:Slow"], "seeds": "1-60",
    "settings": {"parties:Slow": {"seconds": 0.1}},
}  # fmt: skip


def started(tmp_path, *more):
    """A sweep by the command line, once some of its runs are finished."""
    file, path = tmp_path / "sweep.toml", tmp_path / "r.sqlite"
    file.write_text(
        'worlds = ["empty"]\nagents = ["parties:Slow"]\nseeds = "1-60"\nfree = []\nrounds = 2\n'
        'step_limit = 30\n[settings."parties:Slow"]\nseconds = 0.1\n'
    )
    process = subprocess.Popen(
        [sys.executable, "-m", "devlearn", "sweep", file, "--output", path, *more],
        cwd=Path(parties.__file__).parent, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    while process.poll() is None:
        time.sleep(0.05)
        with contextlib.suppress(OSError, sqlite3.Error):
            if len(Results(path)) >= 6:
                break
    return process, path


@pytest.mark.parametrize("workers", ["1", "2"])
def test_ctrl_c_stops_cleanly_and_the_same_command_does_what_is_missing(tmp_path, workers):
    process, path = started(tmp_path, "--workers", workers)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=20)[1]
    assert process.returncode == 130
    assert "the same command goes on from there" in said and "Traceback" not in said
    finished = Results(path).to_pandas()
    assert 6 <= len(finished) < 60
    assert not list(tmp_path.glob("r.sqlite-*")) + list(tmp_path.glob("*.lock"))
    again = sweep(SLOW, path, workers=2).to_pandas()
    assert sorted(again["seed"]) == [*range(1, 61)]
    kept = again[again["run"].isin(finished["run"])].reset_index(drop=True)
    pandas.testing.assert_frame_equal(kept, finished)


def test_a_kill_of_the_sweep_loses_no_finished_run_and_leaves_no_worker(tmp_path):
    process, path = started(tmp_path, "--workers", "2")
    process.kill()
    process.communicate()
    finished = len(Results(path))
    assert finished >= 6
    assert sorted(sweep(SLOW, path, workers=2).to_pandas()["seed"]) == [*range(1, 61)]
    deadline = time.monotonic() + 10
    while time.monotonic() < deadline and workers_of(process.pid):
        time.sleep(0.05)
    assert not workers_of(process.pid)


@pytest.mark.parametrize(("given", "inherited"), [(None, "1"), ("3", "3")])
def test_workers_share_the_cores_unless_told_otherwise(tmp_path, monkeypatch, given, inherited):
    if given is None:
        monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    else:
        monkeypatch.setenv("OMP_NUM_THREADS", given)
    asked = spec.read({**BRIEF, "agents": ["paper"], "seeds": "1-4"} | {"measures": [THREADS]})
    rows = sweep(asked, tmp_path / "r.sqlite", workers=2).rows(asked.jobs())
    assert [row[THREADS] for row in rows] == [{"threads": inherited}] * 4
    assert os.environ.get("OMP_NUM_THREADS") == given


THREADS = "parties:threads"


def test_a_sweep_ends_its_own_workers_and_leaves_other_processes_alone(tmp_path):
    other = multiprocessing.get_context("spawn").Process(target=time.sleep, args=(60,))
    other.start()
    try:
        sweep({**BRIEF, "agents": ["paper"], "seeds": "1-4"}, tmp_path / "r.sqlite", workers=2)
        other.join(0.3)
        assert other.is_alive()
        deadline = time.monotonic() + 10
        while multiprocessing.active_children() != [other] and time.monotonic() < deadline:
            time.sleep(0.02)
        assert multiprocessing.active_children() == [other]
    finally:
        other.kill()
        other.join()


def workers_of(pid):
    """Processes that were spawned by one that may be no more."""
    return [
        other
        for other in filter(str.isdigit, os.listdir("/proc"))
        if other != str(pid) and f"parent_pid={pid}," in command_of(other)
    ]


def command_of(pid):
    try:
        return Path(f"/proc/{pid}/cmdline").read_text()
    except OSError:
        return ""


def test_batches_take_about_as_long_as_the_pool_wants_and_never_what_is_not_there():
    class Wide(pools.Here):
        width, seconds = 4, 1.0

    jobs = [*spec.read({**BRIEF, "agents": ["paper"], "seeds": "1-1000"}).jobs()]
    batches = pools._Batches(jobs, len(jobs), Wide())
    assert len(batches.next(False)) == 1  # nothing is known yet
    for _ in range(200):
        batches.took([job.Row(seconds=0.05)])
    sizes = []
    while batch := batches.next(True):
        sizes.append(len(batch))
    assert sizes[0] == pytest.approx(20, abs=1)
    assert sizes[-1] == 1 and sizes == sorted(sizes, reverse=True)
    assert sum(sizes) == 999


@pytest.mark.parametrize(
    ("more", "quantity"),
    [
        ({"workers": 0}, "workers"),
        ({"workers": True}, "workers"),
        ({"executor": 3}, "executor"),
        ({"executor": 3, "scheduler": "tcp://localhost:1"}, "scheduler"),
    ],
)
def test_where_it_cannot_run_is_refused(tmp_path, more, quantity):
    refused(lambda: sweep(SMALL, tmp_path / "r.sqlite", **more), quantity)


# --- progress -------------------------------------------------------------------------------------


def test_the_bar_is_silent_where_nobody_watches(tmp_path, capfd):
    sweep({**BRIEF, "agents": ["paper"], "seeds": "1-3"}, tmp_path / "r.sqlite", workers=1)
    assert capfd.readouterr() == ("", "")


def test_the_bar_counts_what_is_done_and_begins_with_what_was_found(tmp_path, monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    path, asked = tmp_path / "r.sqlite", {**BRIEF, "agents": ["paper"]}
    sweep({**asked, "seeds": "1-2"}, path, workers=1)
    monkeypatch.setattr(sys, "stderr", Terminal())
    sweep([{**asked, "seeds": "1-4"}, {**asked, "seeds": "3-4"}], path, workers=1)
    shown = sys.stderr.getvalue().split("\r")[1:]
    assert re.match(r"runs: +50%.* 2/4 ", shown[0])
    assert re.match(r"runs: +100%.* 4/4 .*\n$", shown[-1])


def test_a_program_that_its_workers_cannot_import_is_told_how_to_be(tmp_path):
    program = tmp_path / "program.py"
    asked = {**BRIEF, "agents": ["paper"], "seeds": "1-4"}
    program.write_text(f"import devlearn\ndevlearn.sweep({asked!r}, 'r.sqlite', workers=2)\n")
    run = subprocess.run(
        [sys.executable, program], cwd=tmp_path, capture_output=True, text=True, timeout=60
    )
    assert run.returncode != 0
    assert "InvalidValue: workers: got 2, which end as they start; expected a program" in run.stderr
    assert len(Results(tmp_path / "r.sqlite")) == 0


# --- the command line -----------------------------------------------------------------------------


def test_the_command_line_runs_a_file_and_tells_of_failures(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("s.toml").write_text(
        'worlds = ["empty"]\nagents = ["parties:Raises"]\nseeds = "1-4"\nfree = []\n'
        "rounds = 2\nstep_limit = 30\n"
    )
    assert cli.main(["sweep", "s.toml", "--workers", "1"]) == 0
    said = capsys.readouterr()
    assert said.out.startswith("runs: 4 (worlds 1 x agents with settings 1 x seeds 4)")
    assert "2 runs failed; the first, run 2:" in said.err and "no motion for seed 2" in said.err
    assert len(Results("results.sqlite")) == 4


def test_a_run_by_its_command_writes_its_record(tmp_path, capsys):
    results = sweep({**BRIEF, "agents": ["paper"], "seeds": "1"}, tmp_path / "r.sqlite")
    command = results.to_pandas()["command"][0].removeprefix("devlearn sweep --run ")
    file = tmp_path / "one.npz"
    assert cli.main(["sweep", "--run", command.strip("'"), "--record", str(file)]) == 0
    from devlearn import Record

    assert len(Record.load(file)) == results.to_pandas()["steps"][0]
    assert "written: " in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ([], "a sweep in TOML, or --run"),
        (["--run", "{"], "unreadable"),
        (["--run", "[]"], "the JSON of a row's command"),
        (["--run", '{"wrld": 1}'], "'world', or another of"),
        (["--run", '{"world": "paper", "agent": "papr", "seed": 1}'], "'paper', or another of"),
        (
            ["--run", '{"world": "paper", "agent": "paper", "seed": 1, "world_hash": "0"}'],
            "paper is not what it was",
        ),
    ],
)
def test_the_command_line_refuses_what_it_cannot_run(capsys, arguments, says):
    assert cli.main(["sweep", *arguments]) == 1
    assert says in capsys.readouterr().err


def test_an_agent_that_changes_its_settings_changes_no_other_run(tmp_path):
    asked = {**BRIEF, "agents": ["parties:Changes"], "seeds": "1-2"}
    asked["settings"] = {"parties:Changes": {"motions": [[7]]}}
    frame = sweep(asked, tmp_path / "r.sqlite", workers=1).to_pandas()
    assert frame["settings"].tolist() == ['{"motions":[7]}'] * 2
    assert len(sweep(asked, tmp_path / "r.sqlite", workers=1)) == 2


def test_whatever_an_agent_raises_is_kept(tmp_path):
    asked = {**BRIEF, "agents": ["parties:RaisesBare", "paper"], "seeds": "1-2"}
    frame = sweep(asked, tmp_path / "r.sqlite", workers=1).to_pandas()
    assert all("\\udc80 is half a letter" in text for text in frame["error"].dropna())
    assert frame["error"].notna().tolist() == [True, True, False, False]


@pytest.mark.parametrize("name", ["a?b%41#c d.sqlite", "\udcff.sqlite"])
def test_results_may_have_any_name_that_a_file_may_have(tmp_path, name):
    asked = {**BRIEF, "agents": ["paper"], "seeds": "1"}
    assert len(sweep(asked, tmp_path / name, workers=1)) == 1
    assert len(sweep(asked, f"/{tmp_path / name}", workers=1)) == 1
    assert (tmp_path / name).is_file()


def test_a_pipe_is_no_file_of_results(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    asked = {**BRIEF, "agents": ["paper"], "seeds": "1"}
    refused(lambda: sweep(asked, tmp_path / "pipe"), "output")
    assert (tmp_path / "pipe").is_fifo()


@pytest.mark.parametrize("changed", [{"seeds": "9" * 5000}, {"worlds": ["similar:" + "9" * 40]}])
def test_numbers_longer_than_any_seed_are_refused(changed):
    refused(lambda: spec.read({**BRIEF, "agents": ["paper"], "seeds": "1", **changed}))


@pytest.mark.parametrize("key", ["settings", "trial"])
def test_a_command_whose_settings_are_no_table_is_refused(key):
    refused(
        lambda: spec.of_command(f'{{"world":"empty","agent":"paper","seed":1,"{key}":null}}'), key
    )
