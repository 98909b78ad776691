"""A folder is one run's at a time, and tells what it holds; what is resumed is checked."""

import json
import os
import re
import signal
import subprocess
import sys
import time

import pytest
from conftest import differences, refusal
from devlearn import FileError, Record, Rectangle, Trial, World, cli
from devlearn._files import LOCK, owned_folder
from devlearn.experiments.contenders import preset
from devlearn.experiments.schedule import Schedule
from devlearn.paper import survival

SHORT = ["run", "empty", "--steps", "300", "--rounds", "3", "--step-limit", "200"]
LONG = ["run", "paper", "--steps", "60000", "--rounds", "20", "--save-every", "1000"]


@pytest.fixture(autouse=True)
def no_pictures(monkeypatch):
    monkeypatch.setattr(cli.run, "_draw", lambda *_: None)


def started(*arguments, **more):
    return subprocess.Popen(
        [sys.executable, "-m", "devlearn", *map(str, arguments)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more,
    )  # fmt: skip


def until(condition):
    deadline = time.monotonic() + 30
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_the_second_of_two_runs_in_a_folder_is_told_who_has_it_and_the_first_is_undisturbed(
    tmp_path,
):
    shared, alone = tmp_path / "shared", tmp_path / "alone"
    first = started(*LONG, "--output", shared)
    until((shared / "state.safetensors").exists)
    second = started(*LONG, "--output", shared)
    out, err = second.communicate(timeout=60)
    assert (second.returncode, out) == (1, "")
    assert f"{shared}: got in use by process {first.pid} on " in err
    assert "choose another --output" in err
    assert first.wait(60) == 0
    assert started(*LONG, "--output", alone).wait(60) == 0
    for name in ("free_1", "free_2", "paths"):
        a, b = (Record.load(folder / f"{name}.npz") for folder in (shared, alone))
        assert differences(a, b) == []
    assert not (shared / LOCK).exists()


def test_a_killed_owner_owns_nothing_any_more(tmp_path):
    run = started(*LONG, "--output", tmp_path)
    until((tmp_path / "state.safetensors").exists)
    run.kill()
    run.wait()
    assert (tmp_path / LOCK).exists()
    with owned_folder(tmp_path):
        pass
    assert not (tmp_path / LOCK).exists()


def test_a_folder_is_owned_by_one_at_a_time_in_one_process_too(tmp_path):
    with owned_folder(tmp_path / "deep" / "folder") as folder:
        with pytest.raises(FileError, match=f"in use by process {os.getpid()} on "):
            with owned_folder(folder):
                pass
    with owned_folder(folder):
        pass


def test_a_lock_is_not_written_through_a_link(tmp_path):
    victim = tmp_path / "victim"
    victim.write_text("mine")
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / LOCK).symlink_to(victim)
    with pytest.raises(FileError):
        with owned_folder(tmp_path / "run"):
            pass
    assert victim.read_text() == "mine"


def test_a_folder_with_another_finished_run_asks_for_overwrite(tmp_path, capsys):
    line = [*SHORT, "--output", tmp_path]
    assert cli.main(list(map(str, line))) == 0
    about = json.loads((tmp_path / "run.json").read_text())
    assert (about["finished"], about["seed"], about["world"]["name"]) == (True, 1, "empty")
    capsys.readouterr()
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    said = refusal(capsys, *line, "--seed", 2)
    assert "run.json: seed: got a finished run with 1; expected 2; choose another --output" in said
    assert "--overwrite" in said
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    # The same run again is the same files again.
    assert cli.main(list(map(str, line))) == 0
    assert cli.main([*map(str, line), "--seed", "2", "--overwrite"]) == 0
    assert Record.load(tmp_path / "paths.npz").provenance["seed"] == 2


def test_files_of_a_run_that_nobody_knows_of_are_not_overwritten(tmp_path, capsys):
    (tmp_path / "paths.npz").write_bytes(b"mine")
    said = refusal(capsys, *SHORT, "--output", tmp_path)
    assert "paths.npz: got a file of some other run" in said
    assert (tmp_path / "paths.npz").read_bytes() == b"mine"
    assert cli.main([*SHORT, "--output", str(tmp_path), "--overwrite"]) == 0


def test_another_run_is_refused_before_the_first_one_has_saved_anything(tmp_path, capsys):
    run = started("run", "paper", "--steps", 10**9, "--output", tmp_path)
    until((tmp_path / "run.json").exists)
    run.kill()
    run.wait()
    assert not (tmp_path / "state.safetensors").exists()
    said = refusal(capsys, "run", "paper", "--steps", 300, "--output", tmp_path)
    assert "run.free: got an unfinished run with [1000000000, 1000000000]" in said


def test_what_a_user_keeps_beside_the_state_stays(tmp_path):
    for name in ("state.safetensors.backup", "state.safetensors.1", "notes.txt"):
        (tmp_path / name).write_text("mine")
    assert cli.main([*SHORT, "--output", str(tmp_path)]) == 0
    for name in ("state.safetensors.backup", "state.safetensors.1", "notes.txt"):
        assert (tmp_path / name).read_text() == "mine"


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"finished": 1}', "[" * 10**5])
def test_a_description_that_is_none_is_refused(tmp_path, capsys, content):
    (tmp_path / "run.json").write_text(content)
    assert "no description of a run" in refusal(capsys, *SHORT, "--output", tmp_path)


# --- a state is one whole ------------------------------------------------------------------------


@pytest.fixture
def saved(tmp_path):
    """A folder with a state in it, and what describes its run."""
    config, world = preset("paper"), World.load("paper")
    planned = Schedule((3000, 0), 3)
    whence = survival.begin(tmp_path, world, config, 1, planned.to_dict())
    trial = Trial(world, config, 1)
    record = trial.free_learning(1000)
    record.provenance = whence
    return tmp_path, trial, record, (world, config, 1, planned, whence)


def test_a_state_whose_trial_and_record_belong_together_goes_on(saved):
    folder, trial, record, arguments = saved
    trial.save(folder / survival.STATE, record)
    _, whole = survival.run_to_the_end(folder, *arguments)
    assert len(whole) > 3000


def other_seed(trial, record):
    return Trial(trial.world, trial.config, 2), record


def other_world(trial, record):
    return Trial(World.load("office"), trial.config, 1), record


def other_config(trial, record):
    return Trial(trial.world, trial.config.replace(goal_radius=0.2), 1), record


def one_step_on(trial, record):
    trial.step()
    return trial, record


def one_round_on(trial, record):
    trial.begin_round()
    return trial, record


def elsewhere(trial, record):
    other = Trial(trial.world, trial.config, 1)
    other.free_learning(999)
    return other, record


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (other_seed, "seed: got 2 of a trial that is not its record's; expected 1"),
        (other_world, "world: got "),
        (other_config, "config: got "),
        (one_step_on, "pose: got "),
        (one_round_on, "round: got 2 of"),
        (elsewhere, "pose: got "),
    ],
)
def test_a_state_whose_trial_and_record_do_not_is_refused_by_name(saved, change, says):
    folder, trial, record, arguments = saved
    trial, record = change(trial, record)
    trial.save(folder / survival.STATE, record)
    with pytest.raises(FileError, match=re.escape(says)) as refused:
        survival.run_to_the_end(folder, *arguments)
    assert refused.value.file == str(folder / survival.STATE)


# --- signals --------------------------------------------------------------------------------------


def test_sigterm_saves_and_ends_as_ctrl_c_does(tmp_path):
    run = started("run", "paper", "--steps", 10**8, "--save-every", 1000, "--output", tmp_path)
    until((tmp_path / "state.safetensors").exists)
    run.terminate()
    out, err = run.communicate(timeout=60)
    assert (run.returncode, out) == (128 + signal.SIGTERM, "")
    assert err.endswith("devlearn: stopped\n")
    assert len(Record.load(tmp_path / "state.safetensors")) >= 1000


def test_who_has_ignored_ctrl_c_before_is_not_stopped_by_it(tmp_path):
    run = started(
        *LONG, "--output", tmp_path,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN),  # as nohup does
    )  # fmt: skip
    until((tmp_path / "state.safetensors").exists)
    run.send_signal(signal.SIGINT)
    assert run.wait(60) == 0
    assert (tmp_path / "paths.npz").exists()


# --- files first, words last ----------------------------------------------------------------------


@pytest.fixture
def strange(tmp_path):
    """A world whose name no terminal should see as it is."""
    name = "\x1b[31mΩmega\u202e \udcff".encode("utf-8", "ignore").decode()
    path = tmp_path / "strange.json"
    World(name=name, start=(1, 1, 0), target=(1.2, 1)).save(path)
    return path


FILES = {"free_1.npz", "free_2.npz", "paths.npz", "rounds.csv", "run.json"}


def written(folder):
    assert json.loads((folder / "run.json").read_text())["finished"]
    return FILES <= {path.name for path in folder.iterdir()}


@pytest.mark.parametrize("encoding", ["latin-1", "ascii", "utf-8"])
def test_a_name_that_cannot_be_printed_costs_no_file(strange, tmp_path, encoding):
    run = started(
        "run", strange, *SHORT[2:], "--output", tmp_path / "out",
        env=os.environ | {"PYTHONIOENCODING": encoding},
    )  # fmt: skip
    out, err = run.communicate(timeout=60)
    assert run.returncode == 0, err
    assert written(tmp_path / "out")
    assert "\x1b" not in out + err
    assert "\u202e" not in out + err
    assert "mega" in out


@pytest.mark.parametrize(
    "redirection", [">&-", "2>&-", ">&- 2>&-", "<&-", ">/dev/full", "2>/dev/full", "| true"]
)
def test_who_cannot_be_told_gets_the_files(tmp_path, redirection):
    line = " ".join([f"'{sys.executable}' -u -m devlearn", *SHORT, "--output", f"'{tmp_path}/out'"])
    ran = subprocess.run(
        ["bash", "-c", f"set -o pipefail; {line} {redirection}"],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    assert ran.stderr == ""
    assert written(tmp_path / "out")


def test_a_refusal_shows_no_control_characters_either(tmp_path, capsys):
    assert cli.main(["run", str(tmp_path / "\x1b[2Jnowhere.json")]) == 1
    err = capsys.readouterr().err
    assert "\x1b" not in err
    assert "\\x1b[2Jnowhere.json" in err


def test_two_reproductions_in_one_folder_are_one_at_a_time(tmp_path, capsys):
    with owned_folder(tmp_path):
        said = refusal(capsys, "reproduce", "--seeds", 1, "--output", tmp_path)
    assert f"in use by process {os.getpid()} on " in said
    assert not (tmp_path / "runs.sqlite").exists()


def test_a_target_that_nothing_leads_to_is_said_before_the_run(tmp_path, capsys):
    walled = World(obstacles=[Rectangle((2.5, 2.5), (0.1, 5.0))], start=(1, 1, 0), target=(4, 4))
    walled.save(tmp_path / "walled.json")
    line = ["run", str(tmp_path / "walled.json"), *SHORT[2:], "--output", str(tmp_path / "out")]
    assert cli.main(line) == 0
    assert "nothing leads this robot from the start to the target" in capsys.readouterr().err
    assert cli.main([*SHORT, "--output", str(tmp_path / "empty")]) == 0
    assert capsys.readouterr().err == ""
