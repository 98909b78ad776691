"""Saving survives kills and broken disks: strace ends or fails a save at each system call."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time

import devlearn
import numpy as np
import pytest

# How many runs are killed at a random moment.
KILLS = int(os.environ.get("DEVLEARN_KILLS", "12"))

# Saves a learner that differs from the one in the file, and says "saving" first and what it
# refused, if anything.
SAVER = """
import sys, devlearn
learner = devlearn.Learner(seed=2)
for situation in range(50):
    learner.update(situation, 1, 1.0)
print("saving", flush=True)
try:
    learner.save(sys.argv[1])
except devlearn.FileError as error:
    print(error.value)
"""


def strace(folder, *options):
    """Runs the saver with its calls on files in the folder traced: the calls, and the process."""
    if shutil.which("strace") is None:
        pytest.fail("strace is not at hand; on Debian: scripts/setup --dev")
    trace = folder.parent / "trace"
    target = folder / "learner"
    paths = [target, folder / "learner.devlearn-tmp", folder]
    run = subprocess.run(
        ["strace", "-f", "-y", "-o", trace, *(f"-P{path}" for path in paths), *options,
         sys.executable, "-c", SAVER, target],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    if "saving" not in run.stdout:
        pytest.fail(f"strace cannot follow a process here (is ptrace forbidden?): {run.stderr}")
    lines = [re.sub(r"^\d+ +", "", line) for line in trace.read_text().splitlines()]
    return [line for line in lines if re.match(r"\w+\(", line)], run


@pytest.fixture
def folder(tmp_path):
    """A folder that holds the snapshot of a learner, and nothing else."""
    folder = tmp_path / "saved"
    folder.mkdir()
    devlearn.Learner(seed=1).save(folder / "learner")
    return folder


@pytest.fixture(scope="module")
def calls(tmp_path_factory):
    """The system calls of an undisturbed save."""
    folder = tmp_path_factory.mktemp("traced") / "saved"
    folder.mkdir()
    devlearn.Learner(seed=1).save(folder / "learner")
    return strace(folder)[0]


def seed_in(folder):
    return devlearn.Learner.load(folder / "learner").seed


def name(call):
    return call.split("(")[0]


def test_a_save_writes_flushes_renames_and_flushes_the_folder_in_this_order(calls):
    kinds = ("write", "fsync", "rename")
    order = [call for call in calls if name(call) in kinds]
    assert len(order) > 4
    *writes, flush, rename, flush_folder = order
    assert {name(call) for call in writes} == {"write"}
    assert all("learner.devlearn-tmp>" in call for call in writes)
    assert name(flush) == "fsync"
    assert "learner.devlearn-tmp>" in flush
    assert name(rename) == "rename"
    assert re.search(r'learner\.devlearn-tmp", ".*/learner"', rename)
    assert name(flush_folder) == "fsync"
    assert "saved>" in flush_folder
    assert all(call.endswith("= 0") for call in (flush, rename, flush_folder))


def numbered(calls):
    """Each call as its name and its number among those of that name."""
    counts = {}
    for call in calls:
        counts[name(call)] = counts.get(name(call), 0) + 1
        yield name(call), counts[name(call)]


def test_a_kill_at_any_call_of_a_save_leaves_a_whole_file(folder, calls):
    renamed = False
    for call, number in numbered(calls):
        _, run = strace(folder, "-e", f"inject={call}:signal=SIGKILL:when={number}")
        assert run.returncode in (-signal.SIGKILL, 128 + signal.SIGKILL), (call, number)
        assert seed_in(folder) == (2 if renamed else 1), (call, number)
        renamed = renamed or call == "rename"
        if renamed:
            devlearn.Learner(seed=1).save(folder / "learner")
    assert renamed
    # What the kills left on the side is gone after the next save.
    devlearn.Learner(seed=3).save(folder / "learner")
    assert [path.name for path in folder.iterdir()] == ["learner"]


@pytest.mark.parametrize("error", ["ENOSPC", "EIO"])
def test_a_disk_that_fails_at_any_call_of_a_save_is_an_error_and_the_file_is_whole(
    folder, calls, error
):
    refused = set()
    for call, number in numbered(calls):
        _, run = strace(folder, "-e", f"inject={call}:error={error}:when={number}")
        assert run.returncode == 0, run.stderr
        saved = run.stdout == "saving\n"
        if not saved:
            refused.add(call)
            assert run.stdout in (
                "saving\nNo space left on device\n", "saving\nInput/output error\n"
            )  # fmt: skip
        folder_unflushed = call == "fsync" and number == 2
        assert seed_in(folder) == (2 if saved or folder_unflushed else 1), (call, number)
        names = {path.name for path in folder.iterdir()} - {"learner"}
        # One that cannot be locked may be another saver's, and is not removed.
        assert names == ({"learner.devlearn-tmp"} if call == "flock" else set()), (call, number)
        devlearn.Learner(seed=1).save(folder / "learner")
    assert refused >= {"openat", "ftruncate", "write", "fsync", "rename"}


# --- devlearn run ---------------------------------------------------------------------------------

RUN = ["run", "paper", "--steps", "3000", "--rounds", "15", "--step-limit", "200", "--seed", "3",
       "--save-every", "200", "--echoes"]  # fmt: skip


def start(folder):
    """A run, as if matplotlib were not installed: pictures take most of the time."""
    shim = folder.parent / "shim" / "matplotlib"
    shim.mkdir(parents=True, exist_ok=True)
    (shim / "__init__.py").write_text("raise ModuleNotFoundError(\"No module named 'matplotlib'\")")
    path = os.pathsep.join([str(shim.parent), os.environ.get("PYTHONPATH", "")])
    return subprocess.Popen(
        [sys.executable, "-m", "devlearn", *RUN, "--output", folder],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        env=os.environ | {"PYTHONPATH": path},
    )  # fmt: skip


def written(folder):
    names = ("free_1", "free_2", "paths")
    records = {name: devlearn.Record.load(folder / f"{name}.npz") for name in names}
    return {
        (name, column): (getattr(record, column).tobytes(), record.provenance)
        for name, record in records.items()
        for column in ("round", "situation", "motion", "kind", "sef", "smf", "smf_used", "event",
                       "reduced", "explored_count", "x", "y", "heading", "rounds", "echoes")
    }  # fmt: skip


def life(folder, random):
    """One life of a run, killed at a random moment after a save: whether it was still at work."""
    state = folder / "state.safetensors"

    def version():
        try:
            return state.stat().st_ino
        except FileNotFoundError:  # not yet, or no longer
            return None

    before, run = version(), start(folder)
    while run.poll() is None and version() == before:
        time.sleep(0.001)
    moment = time.monotonic() + random.uniform(0.0, 0.1)
    while run.poll() is None and time.monotonic() < moment:
        time.sleep(0.001)
    run.kill()
    errors = run.communicate()[1]
    assert run.returncode in (0, -signal.SIGKILL), errors
    assert errors == "" or errors.startswith("no figures")
    return state.exists()


def test_runs_killed_at_random_moments_go_on_to_the_history_of_an_unbroken_one(tmp_path):
    random = np.random.default_rng(1)
    unbroken = start(tmp_path / "unbroken")
    assert unbroken.communicate()[1].startswith("no figures")
    expected = written(tmp_path / "unbroken")
    assert not (tmp_path / "unbroken" / "state.safetensors").exists()

    kills = runs = 0
    while kills < KILLS:
        folder = tmp_path / f"killed{runs}"
        while life(folder, random):
            kills += 1
        runs += 1
        assert written(folder) == expected
        assert not list(folder.glob("state*"))
