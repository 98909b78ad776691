"""Sweeps over processes: their results, their journal, and how they end."""

import io
import json
import multiprocessing
import os
import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest
from devlearn import FileError
from devlearn.experiments import runs
from devlearn.experiments.contenders import preset
from devlearn.experiments.runs import Journal, run_all
from devlearn.paper.jobs import execute, job

SOON = 10.0  # [s] what should happen at once, on a busy machine


@pytest.fixture
def journal(tmp_path):
    opened = Journal(tmp_path / "runs.jsonl")
    yield opened
    opened.close()


def square(job):
    """Leaves a line in a log each time it is executed; may wait for lines there, or for a file."""
    log, until = Path(job["log"]), Path(job.get("until", "/"))
    while not until.exists() or ("after" in job and len(executed(log.parent)) < job["after"]):
        time.sleep(0.02)
    if job.get("fail"):
        time.sleep(0.3)  # let the others' results come in
        raise RuntimeError(f"no square of {job['n']}")
    with log.open("a") as file:
        file.write(f"{job['n']}\n")
    return {"square": job["n"] ** 2}


def squares(tmp_path, count, **more):
    return [{"n": n, "log": str(tmp_path / "log")} | more for n in range(count)]


def executed(tmp_path):
    log = tmp_path / "log"
    return sorted(map(int, log.read_text().split())) if log.exists() else []


def eventually(condition, seconds=SOON):
    deadline = time.monotonic() + seconds
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.02)
    return condition()


# --- results --------------------------------------------------------------------------------------


def test_results_do_not_depend_on_the_number_of_workers_to_the_bit(paper, tmp_path):
    config = preset("paper")
    jobs = [job(paper, config, seed, rounds=2, shortest=113) for seed in (1, 2, 3)]
    texts = []
    for workers in (1, 2, 3):
        journal = Journal(tmp_path / f"{workers}.jsonl")
        texts.append(json.dumps(run_all(execute, jobs, journal, workers=workers)))
        journal.close()
    assert texts[0] == texts[1] == texts[2]
    assert len({json.dumps(result) for result in json.loads(texts[0])}) == 3


def test_results_come_in_the_order_of_the_jobs(journal, tmp_path):
    jobs = squares(tmp_path, 6)
    jobs[0]["after"] = 3
    results = run_all(square, jobs, journal, workers=2)
    assert [result["square"] for result in results] == [0, 1, 4, 9, 16, 25]
    assert (tmp_path / "log").read_text().split()[0] != "0"  # they did not finish in this order


def test_no_jobs_have_no_results(journal):
    assert run_all(square, [], journal) == []


def test_equal_jobs_have_equal_results(journal, tmp_path):
    jobs = squares(tmp_path, 2) * 2
    assert [r["square"] for r in run_all(square, jobs, journal, workers=1)] == [0, 1, 0, 1]


def threads(job):
    """How many threads linear algebra may take here."""
    return {"threads": os.environ.get("OMP_NUM_THREADS")}


@pytest.mark.parametrize(("given", "inherited"), [(None, "1"), ("3", "3")])
def test_workers_share_the_cores_unless_told_otherwise(journal, monkeypatch, given, inherited):
    if given is None:
        monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    else:
        monkeypatch.setenv("OMP_NUM_THREADS", given)
    results = run_all(threads, [{"n": n} for n in range(4)], journal, workers=2)
    assert {result["threads"] for result in results} == {inherited}
    assert os.environ.get("OMP_NUM_THREADS") == given


# --- the journal ----------------------------------------------------------------------------------


def test_a_stopped_sweep_goes_on_without_repeating(tmp_path):
    jobs = squares(tmp_path, 5)
    for part in (jobs[:3], jobs):
        journal = Journal(tmp_path / "runs.jsonl")
        results = run_all(square, part, journal, workers=1)
        journal.close()
    assert [result["square"] for result in results] == [0, 1, 4, 9, 16]
    assert executed(tmp_path) == [0, 1, 2, 3, 4]


def test_a_result_from_the_journal_is_the_result_as_it_was(paper, tmp_path):
    jobs = [job(paper, preset("paper"), 1, rounds=1)]
    texts = []
    for _ in range(2):
        journal = Journal(tmp_path / "runs.jsonl")
        texts.append(json.dumps(run_all(execute, jobs, journal, workers=1)))
        journal.close()
    assert texts[0] == texts[1]
    assert len((tmp_path / "runs.jsonl").read_text().splitlines()) == 1


def test_a_last_line_torn_anywhere_is_dropped_and_the_rest_kept(tmp_path):
    path = tmp_path / "runs.jsonl"
    journal = Journal(path)
    for n in range(2):
        journal.add({"n": n}, {"square": n**2})
    journal.close()
    whole = path.read_bytes()
    last = whole.splitlines(keepends=True)[1]
    for kept in range(len(last)):
        path.write_bytes(whole[: len(whole) - len(last) + kept])
        torn = Journal(path)
        assert torn.find({"n": 0}) == {"square": 0}
        assert torn.find({"n": 1}) is None
        torn.add({"n": 1}, {"square": 1})
        torn.close()
        assert path.read_bytes() == whole


@pytest.mark.parametrize(
    "garbage",
    [b"", b"garbage", b"\x00\xff\xfe", b"[]", b"{}", b"null", b"3", b'{"key": [], "result": 1}',
     b'{"key": "x"}', b'{"result": {}}', b'"key"', b"{" * 10],
)  # fmt: skip
def test_garbage_among_the_lines_is_passed_over(tmp_path, garbage):
    path = tmp_path / "runs.jsonl"
    journal = Journal(path)
    journal.add({"n": 0}, {"square": 0})
    journal.close()
    path.write_bytes(garbage + b"\n" + path.read_bytes() + garbage + b"\n")
    journal = Journal(path)
    assert journal.find({"n": 0}) == {"square": 0}
    journal.add({"n": 1}, {"square": 1})
    journal.close()
    journal = Journal(path)
    assert journal.find({"n": 1}) == {"square": 1}
    journal.close()


def test_what_other_code_made_is_not_taken_for_a_result(tmp_path, monkeypatch):
    path = tmp_path / "runs.jsonl"
    journal = Journal(path)
    journal.add({"n": 0}, {"square": 0})
    journal.close()
    with monkeypatch.context() as patch:
        patch.setattr(runs, "code_version", lambda: "of other code")
        other = Journal(path)
        assert other.find({"n": 0}) is None
        other.close()
    again = Journal(path)
    assert again.find({"n": 0}) == {"square": 0}
    again.close()


@pytest.mark.parametrize(
    "damage",
    [
        lambda line: line.replace(b'"square": 1', b'"square": 2'),
        lambda line: line.replace(b'"checksum": "', b'"checksum": "0'),
        lambda line: b'{"key": "k", "result": {"square": 1}}',
        lambda line: b'{"key": ["k"], "result": 3, "checksum": "x"}',
        lambda line: b"[1, 2]",
        lambda line: b"null",
        lambda line: b"[" * 10**5,
        lambda line: b"\xff\x00",
    ],
)
def test_a_damaged_entry_is_counted_and_run_again(tmp_path, damage):
    path = tmp_path / "runs.jsonl"
    journal = Journal(path)
    for n in range(3):
        journal.add({"n": n}, {"square": n**2})
    journal.close()
    lines = path.read_bytes().splitlines()
    assert damage(lines[1]) != lines[1]
    lines[1] = damage(lines[1])
    path.write_bytes(b"\n".join(lines) + b"\n")
    journal = Journal(path)
    assert journal.damaged == 1
    assert [journal.find({"n": n}) for n in range(3)] == [{"square": 0}, None, {"square": 4}]
    journal.close()


def test_jobs_that_differ_in_any_value_are_different(journal):
    journal.add({"n": 0, "sigma": 0.3}, {"square": 0})
    assert journal.find({"sigma": 0.3, "n": 0}) == {"square": 0}  # in whatever order
    assert journal.find({"n": 0, "sigma": 0.30000000000000004}) is None
    assert journal.find({"n": 0}) is None


def test_a_journal_that_cannot_be_written_is_refused_by_name(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "runs.jsonl").mkdir()
    for path in (tmp_path / "file" / "runs.jsonl", tmp_path / "runs.jsonl"):
        with pytest.raises(FileError) as caught:
            Journal(path)
        assert str(path).startswith(caught.value.file)


# --- how a sweep ends -----------------------------------------------------------------------------


@pytest.mark.parametrize("workers", [1, 2])
def test_a_workers_exception_comes_through_and_what_is_finished_stays(tmp_path, workers):
    jobs = squares(tmp_path, 5)
    jobs[3] |= {"fail": True, "after": 3}
    journal = Journal(tmp_path / "runs.jsonl")
    before = multiprocessing.active_children()
    with pytest.raises(RuntimeError, match="no square of 3"):
        run_all(square, jobs, journal, workers=workers)
    journal.close()
    assert eventually(lambda: multiprocessing.active_children() == before)
    journal = Journal(tmp_path / "runs.jsonl")
    assert [journal.find(job) for job in jobs[:3]] == [{"square": n**2} for n in range(3)]
    assert journal.find(jobs[3]) is None
    journal.close()


def test_a_failing_sweep_leaves_other_processes_alone(journal, tmp_path):
    other = multiprocessing.get_context("spawn").Process(target=time.sleep, args=(60,))
    other.start()
    try:
        with pytest.raises(RuntimeError):
            run_all(square, squares(tmp_path, 2, fail=True), journal, workers=2)
        other.join(0.3)
        assert other.is_alive()
    finally:
        other.kill()
        other.join()


SWEEP = """
    import sys
    sys.path.insert(0, {tests!r})
    from pathlib import Path
    from devlearn.experiments.runs import Journal, run_all
    from test_runs import square, squares

    if __name__ == "__main__":
        folder = Path({folder!r})
        jobs = squares(folder, 6)
        jobs[4]["until"] = jobs[5]["until"] = str(folder / "go on")
        try:
            results = run_all(square, jobs, Journal(folder / "runs.jsonl"), workers=2)
            print([result["square"] for result in results])
        except KeyboardInterrupt:
            sys.exit(130)
"""


def processes_of(session):
    """Ids of the live processes of a session."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, _, of = stat.read_text().rpartition(")")[2].split()[:4]
        except (OSError, ValueError):
            continue
        if int(of) == session and state != "Z":
            found.append(int(stat.parent.name))
    return found


@pytest.fixture
def script(tmp_path):
    """A sweep of six jobs, the last two of which wait for a file ``go on``."""
    path = tmp_path / "sweep.py"
    place = {"tests": str(Path(__file__).parent), "folder": str(tmp_path)}
    path.write_text(textwrap.dedent(SWEEP).format(**place))
    return path


def stopped_sweep(script, send):
    """Starts the sweep and sends it a signal when it waits.

    Gives its exit code and what it wrote to stderr.
    """
    tmp_path = script.parent
    with (tmp_path / "stderr").open("wb") as stderr:
        sweep = subprocess.Popen([sys.executable, script], stderr=stderr, start_new_session=True)
    journal = tmp_path / "runs.jsonl"
    try:
        assert eventually(lambda: journal.exists() and journal.read_bytes().count(b"\n") == 4, 60)
        send(sweep.pid)
        sweep.wait(60)
        assert eventually(lambda: processes_of(sweep.pid) == []), "processes stayed behind"
    finally:
        for process in processes_of(sweep.pid):
            os.kill(process, signal.SIGKILL)
    return sweep.returncode, (tmp_path / "stderr").read_text()


@pytest.mark.parametrize("reaches", ["the parent", "all of the terminal"])
def test_ctrl_c_keeps_what_is_finished_ends_at_once_and_the_same_command_goes_on(
    script, tmp_path, reaches
):
    kill = os.kill if reaches == "the parent" else os.killpg
    code, stderr = stopped_sweep(script, lambda pid: kill(pid, signal.SIGINT))
    assert code == 130
    assert stderr == ""
    assert executed(tmp_path) == [0, 1, 2, 3]
    (tmp_path / "go on").touch()
    again = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60)
    assert again.stdout == "[0, 1, 4, 9, 16, 25]\n"
    assert executed(tmp_path) == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_workers_end_with_their_parent_however_it_ends(script, how):
    code, _ = stopped_sweep(script, lambda pid: os.kill(pid, how))
    assert code == -how


# --- progress -------------------------------------------------------------------------------------


def test_the_bar_is_silent_where_nobody_watches(journal, tmp_path, capfd):
    run_all(square, squares(tmp_path, 3), journal, workers=1)
    assert capfd.readouterr() == ("", "")


def test_the_bar_counts_what_is_done_and_begins_with_what_was_found(tmp_path, monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    journal = Journal(tmp_path / "runs.jsonl")
    jobs = squares(tmp_path, 4)
    run_all(square, jobs[:2], journal, workers=1)
    monkeypatch.setattr(sys, "stderr", Terminal())
    run_all(square, jobs, journal, workers=1, what="squares")
    journal.close()
    shown = sys.stderr.getvalue().split("\r")[1:]
    assert re.match(r"squares: +50%.* 2/4 ", shown[0])
    assert re.match(r"squares: +100%.* 4/4 .*\n$", shown[-1])
