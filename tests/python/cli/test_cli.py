"""The command line end to end: what it makes, and how it refuses."""

import csv
import io
import json
import os
import re
import shlex
import shutil
import signal
import sqlite3
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import devlearn
import numpy as np
import pytest
from conftest import differences, refusal
from devlearn import Record, Results, Trial, TrialConfig, World, _core, cli
from devlearn.experiments import pools, store
from devlearn.experiments.job import Row
from devlearn.experiments.schedule import Schedule
from devlearn.paper import measures, reproduce, schedule, survival, tables
from devlearn.paper.claims import claims

SHORT = ["--steps", "300", "--rounds", "3", "--step-limit", "200"]
PNG = b"\x89PNG\r\n\x1a\n"


def command(*arguments, **environment):
    """Runs devlearn as its own process."""
    return subprocess.run(
        [sys.executable, "-m", "devlearn", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=120,
        env=os.environ | {name: str(value) for name, value in environment.items()},
    )


@pytest.fixture
def without(tmp_path):
    """Makes an environment in which these packages are not installed."""

    def environment(*packages):
        for package in packages:
            shim = tmp_path / "shim" / package
            shim.mkdir(parents=True)
            (shim / "__init__.py").write_text("raise ModuleNotFoundError('hidden')")
        return {"PYTHONPATH": str(tmp_path / "shim")}

    return environment


# --- in general -----------------------------------------------------------------------------------


def test_the_version_is_the_librarys():
    done = command("--version")
    assert done.returncode == 0
    assert done.stdout == f"devlearn {devlearn.__version__} ({_core.commit})\n"


@pytest.mark.parametrize(
    "module", ["devlearn.cli", "argparse", "devlearn._core", "numpy", "matplotlib"]
)
def test_ctrl_c_during_any_import_ends_it_without_a_traceback(tmp_path, module):
    (tmp_path / "sitecustomize.py").write_text(
        "import os, signal, sys\n"
        "class Finder:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        f"        if name == {module!r}:\n"
        "            sys.meta_path.remove(self)\n"
        "            os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.meta_path.insert(0, Finder())\n"
    )
    out = tmp_path / "out"
    done = command(
        "run", "empty", "--steps", 5, "--rounds", 1, "--output", out, PYTHONPATH=tmp_path
    )
    assert done.returncode in (130, -signal.SIGINT)
    assert done.stderr in ("", "devlearn: stopped\n")


@pytest.mark.parametrize("arguments", [["--help"], ["run", "--help"], ["reproduce", "--help"]])
def test_help_fits_and_names_every_option_with_what_it_does(arguments, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit) as left:
        cli.main(arguments)
    assert left.value.code == 0
    text = capsys.readouterr().out
    assert max(map(len, text.splitlines())) <= 80
    options = re.search(r"options:\n(.+?)(\n\n|\Z)", text, re.DOTALL)[1]
    for option in re.findall(r"\[(--[a-z-]+)", text):
        assert re.search(rf"{option}( \S+)?\s+\S", options), option


def test_help_of_run_names_the_worlds_that_ship(capsys):
    with pytest.raises(SystemExit):
        cli.main(["run", "--help"])
    text = capsys.readouterr().out
    assert all(world in text for world in devlearn.worlds())


@pytest.mark.parametrize("arguments", [[], ["nothing"], ["run"], ["run", "paper", "--steps", "x"]])
def test_a_line_that_cannot_be_read_is_a_usage_error(arguments, capsys):
    with pytest.raises(SystemExit) as left:
        cli.main(arguments)
    assert left.value.code == 2
    assert "usage: devlearn" in capsys.readouterr().err


@pytest.mark.parametrize("line", ["import devlearn", "from devlearn.cli import main; main([])"])
def test_matplotlib_is_not_imported_before_it_is_needed(line):
    code = f"""
import sys
try:
    {line}
except SystemExit:
    pass
sys.exit("matplotlib" in sys.modules)
"""
    assert subprocess.run([sys.executable, "-c", code], stderr=subprocess.DEVNULL).returncode == 0


# --- run ------------------------------------------------------------------------------------------


def test_run_writes_the_records_that_a_trial_makes(tmp_path):
    folder = tmp_path / "a" / "b"
    done = command("run", "u_trap", *SHORT, "--seed", 7, "--output", folder, "--echoes", "--csv")
    assert (done.returncode, done.stderr) == (0, "")
    trial = devlearn.Trial(World.load("u_trap"), TrialConfig.paper(), 7)
    expected = {
        "free_1": trial.free_learning(300, echoes=True),
        "free_2": trial.free_learning(300, echoes=True),
        "paths": trial.path_learning(3, 200, echoes=True),
    }
    for name, record in expected.items():
        written = Record.load(folder / f"{name}.npz")
        for column in ("round", "situation", "motion", "sef", "x", "echoes", "rounds"):
            assert np.array_equal(getattr(written, column), getattr(record, column)), column
        assert len((folder / f"{name}.csv").read_text().splitlines()) == 1 + len(record)
        assert written.provenance["seed"] == 7
    with (folder / "rounds.csv").open() as file:
        rows = list(csv.reader(file))
    rounds = expected["paths"].rounds
    assert rows[0] == ["round", "steps", "arrived", "began"]
    assert rows[1][3] == "600"  # after free learning
    assert [[int(v) for v in row] for row in rows[1:]] == [
        [int(r[name]) for name in rows[0]] for r in rounds
    ]
    assert (folder / "overview.png").read_bytes().startswith(PNG)
    assert f"written: {folder}" in done.stdout


def test_run_says_what_came_of_it(tmp_path, capsys):
    world = World(3, 3, (1.5, 1.5, 0), (2.2, 1.5), name="next door")
    world.save(tmp_path / "own.json")
    line = ["run", str(tmp_path / "own.json"), "--steps", "900", "--rounds", "44"]
    assert cli.main([*line, "--output", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    records = {n: Record.load(tmp_path / f"{n}.npz") for n in ("free_1", "free_2", "paths")}
    first, second = (measures.first_arrival(records[n]) for n in ("free_1", "free_2"))
    steps = records["paths"].rounds["steps"]
    settled = measures.settled_round(records["paths"])
    assert err == ""
    assert out.splitlines() == [
        "world next door, seed 1",
        f"free learning, round 1: target reached at step {first}",
        f"free learning, round 2: target reached at step {second}",
        f"path learning: 44 of 44 rounds arrived; first {steps[0]} steps, last {steps[-1]}; "
        + ("not settled" if settled is None else f"settled from round {settled} on"),
        f"written: {tmp_path}{os.sep}",
    ]


def test_the_same_command_makes_the_same_history(tmp_path, monkeypatch):
    monkeypatch.setattr(cli.run, "_draw", lambda *_: None)
    for name in ("a", "b"):
        assert cli.main(["run", "paper", *SHORT, "--output", str(tmp_path / name)]) == 0
    a, b = (Record.load(tmp_path / name / "paths.npz") for name in ("a", "b"))
    assert a.motion.tobytes() == b.motion.tobytes()
    assert a.provenance == b.provenance


def run_config(tmp_path, *options):
    """The configuration of a run with these options."""
    line = ["run", "empty", *SHORT, "--output", str(tmp_path / "out"), "--overwrite", *options]
    assert cli.main(line) == 0
    return Record.load(tmp_path / "out" / "paths.npz").config


def test_presets_files_and_single_fields_make_the_configuration(tmp_path, monkeypatch):
    monkeypatch.setattr(cli.run, "_draw", lambda *_: None)
    assert run_config(tmp_path) == TrialConfig.paper()
    assert run_config(tmp_path, "--preset", "step5") == TrialConfig.step5()
    own = TrialConfig.step5().replace(cell_size=0.5)
    (tmp_path / "config.json").write_text(json.dumps(own.to_dict()))
    file = ["--config", str(tmp_path / "config.json")]
    assert run_config(tmp_path, *file) == own
    changed = run_config(
        tmp_path, *file, "--set", "learner.sigma=0.7", "--set", "walls_count=true",
        "--set", "clearance_source=sonar",
    )  # fmt: skip
    learner = own.learner.replace(sigma=0.7)
    assert changed == own.replace(learner=learner, walls_count=True, clearance_source="sonar")


@pytest.mark.parametrize(("options", "rounds"), [([], 20), (["--hopeless", "0"], 25)])
def test_a_run_that_is_hopeless_ends_early_and_says_so(tmp_path, capsys, options, rounds):
    line = ["run", "empty", "--steps", "9", "--rounds", "25", "--step-limit", "2", *options]
    assert cli.main([*line, "--output", str(tmp_path)]) == 0
    assert len(Record.load(tmp_path / "paths.npz").rounds) == rounds
    early = "ended early: the last 20 rounds never arrived (--hopeless)\n"
    assert (early in capsys.readouterr().out) == (rounds < 25)


@pytest.mark.parametrize("steps", [0, 50])
@pytest.mark.parametrize("rounds", [0, 1])
def test_no_steps_and_no_rounds_are_a_run_of_nothing(tmp_path, capsys, steps, rounds):
    line = ["run", "empty", "--steps", steps, "--rounds", rounds, "--step-limit", 5]
    assert cli.main([*map(str, line), "--output", str(tmp_path)]) == 0
    assert len(Record.load(tmp_path / "free_2.npz")) == steps
    assert len(Record.load(tmp_path / "paths.npz")) == 5 * rounds
    assert ("target was never reached" in capsys.readouterr().out) == (steps > 0)


def test_run_needs_no_package_of_an_extra(tmp_path, without):
    extras = without("matplotlib", "tqdm", "jinja2")
    done = command("run", "paper", *SHORT, "--output", tmp_path / "out", **extras)
    assert done.returncode == 0
    assert len(Record.load(tmp_path / "out" / "paths.npz").rounds) == 3
    assert re.fullmatch(r"no figures: .* -m pip install 'matplotlib>=.*'\n", done.stderr)
    assert not list((tmp_path / "out").glob("overview.*"))


LONG = ["run", "paper", "--steps", "3000", "--rounds", "40", "--step-limit", "500"]


def stopped_by_ctrl_c(line, monkeypatch, rounds):
    """Runs a line until that round has begun, and then sends Ctrl-C once."""

    parts = Schedule.parts

    def stopped(self, trial, *arguments, **more):
        for part in parts(self, trial, *arguments, **more):
            if trial.round == rounds:
                os.kill(os.getpid(), signal.SIGINT)
            yield part

    with monkeypatch.context() as patch:
        patch.setattr(Schedule, "parts", stopped)
        assert cli.main(line) == 130


def test_ctrl_c_while_the_files_are_written_loses_nothing_of_what_was_run(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(cli.run, "_draw", lambda *_: None)
    monkeypatch.setattr(survival, "WORTH_KEEPING", 0.0)
    line = [*LONG, "--output", str(tmp_path / "stopped")]
    with monkeypatch.context() as patch:
        patch.setattr(Record, "save", lambda *_: os.kill(os.getpid(), signal.SIGINT))
        assert cli.main(line) == 130
    assert "the same command goes on from there" in capsys.readouterr().err

    def never(*_, **__):
        raise AssertionError("it was run again")

    with monkeypatch.context() as patch:
        for phase in ("run", "path_learning", "finish_round"):
            patch.setattr(Trial, phase, never)
        assert cli.main(line) == 0
    assert cli.main([*LONG, "--output", str(tmp_path / "whole")]) == 0
    for name in ("free_1.npz", "free_2.npz", "paths.npz"):
        assert Record.load(tmp_path / "stopped" / name) == Record.load(tmp_path / "whole" / name)


def test_a_run_stopped_by_ctrl_c_goes_on_when_called_again(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cli.run, "_draw", lambda *_: None)
    line = [*LONG, "--echoes", "--output", str(tmp_path / "stopped")]
    state = tmp_path / "stopped" / "state.safetensors"
    steps = 0
    for rounds in (1, 2, 9):
        stopped_by_ctrl_c(line, monkeypatch, rounds)
        assert capsys.readouterr().err == (
            f"what is finished is kept in {tmp_path / 'stopped'}; "
            "the same command goes on from there\ndevlearn: stopped\n"
        )
        record = Record.load(state)
        assert steps < len(record)
        assert len(record.rounds) == rounds
        assert devlearn.Trial.load(state).round == rounds
        steps = len(record)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert cli.main(line) == 0
    assert not state.exists()
    assert cli.main([*LONG, "--echoes", "--output", str(tmp_path / "unbroken")]) == 0
    for name in ("free_1", "free_2", "paths"):
        a, b = (Record.load(tmp_path / n / f"{name}.npz") for n in ("stopped", "unbroken"))
        assert differences(a, b) == []
        assert a.provenance == b.provenance


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--seed", "2"], "seed: got an unfinished run with 1; expected 2; finish that run"),
        (
            ["--steps", "2999"],
            "run.free: got an unfinished run with [3000, 3000]; expected [2999",
        ),
        (["--hopeless", "7"], "run.hopeless: got an unfinished run with 20; expected 7; finish"),
        (["--echoes"], "run.echoes: got an unfinished run with False; expected True; finish"),
        (["--set", "learner.sigma=0.5"], "config.learner.sigma: got an unfinished run with 0.3"),
        (["--preset", "step5"], "config.learner.on_negative: got an unfinished run with abandon"),
    ],
)
def test_run_refuses_to_go_on_with_another_run(tmp_path, monkeypatch, capsys, options, says):
    stopped_by_ctrl_c([*LONG, "--output", str(tmp_path)], monkeypatch, 2)
    capsys.readouterr()
    before = (tmp_path / "state.safetensors").read_bytes()
    line = refusal(capsys, *LONG, *options, "--output", tmp_path)
    assert says in line
    assert "finish that run with its own options, choose another --output, or --over" in line
    assert (tmp_path / "state.safetensors").read_bytes() == before


def test_run_refuses_to_go_on_in_another_world_or_with_other_code(tmp_path, monkeypatch, capsys):
    stopped_by_ctrl_c([*LONG, "--output", str(tmp_path)], monkeypatch, 2)
    capsys.readouterr()
    line = ["run", "office", *LONG[2:], "--output", tmp_path]
    assert "world.name: got an unfinished run with" in refusal(capsys, *line)
    monkeypatch.setattr(survival, "code_version", lambda: "other code")
    assert "an unfinished run with another build" in refusal(capsys, *LONG, "--output", tmp_path)


def test_run_refuses_a_state_that_is_damaged(tmp_path, monkeypatch, capsys):
    state = tmp_path / "state.safetensors"
    stopped_by_ctrl_c([*LONG, "--output", str(tmp_path)], monkeypatch, 2)
    capsys.readouterr()
    state.write_bytes(state.read_bytes()[:-1])
    assert str(state) in refusal(capsys, *LONG, "--output", tmp_path)


def test_a_reader_who_leaves_is_no_error_of_ours(tmp_path):
    run = subprocess.Popen(
        [sys.executable, "-m", "devlearn", "run", "empty", *SHORT, "--output", tmp_path],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    run.stdout.close()
    assert run.stderr.read() == ""
    assert run.wait(60) == 0
    assert Record.load(tmp_path / "paths.npz").provenance["seed"] == 1


# --- what is refused ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--steps", -1], "Schedule.free: got -1; expected a whole number in [0, 2^40]"),
        (["--rounds", -1], "Schedule.rounds: got -1; expected a whole number in [0, 2^30]"),
        (["--step-limit", 0], "Schedule.step_limit: got 0; expected a whole number in [1, 2^40]"),
        (["--hopeless", -1], "Schedule.hopeless: got -1; expected a whole number in [0, 2^30]"),
        (["--save-every", 0], "--save-every: got 0; expected a whole number in [1, 2^40]"),
        (["--steps", 10**30], "expected a whole number"),
        (["--seed", -1], "seed: got -1; expected"),
        (["--seed", 2**64], "seed: got 18446744073709551616; expected"),
        (["--preset", "step6"], "preset: got 'step6'; expected 'paper' or 'step5'"),
        (["--set", "learner.sigma=NaN"], "LearnerConfig.sigma: got nan; expected"),
        (["--set", "learner.sigma=1e999"], "LearnerConfig.sigma: got inf; expected"),
        (["--set", "evaluation.a1=-Infinity"], "StateEvaluation.a1: got -inf; expected"),
        (["--set", "learner.sigma=many"], "--set: got 'learner.sigma=many'; expected in (0, 1)"),
        (["--set", "learner.sigma="], "--set: got 'learner.sigma='; expected in (0, 1)"),
        (["--set", "learner=3"], "--set: got 'learner=3'; expected FIELD=VALUE"),
        (["--set", 'learner={"eta": 0.1, "eta": 0.2}'], "FIELD is one of learner.motion_count"),
        (["--set", "clearance_source=3"], "expected 'geometric' or 'sonar'"),
        (["--set", "clearance_source=echo"], "got 'echo'; expected 'geometric' or 'sonar'"),
        (["--set", "robot.sonar_count=2.5"], "expected a whole number in [0, 720]"),
        (["--set", "robot.sonar_count=true"], "expected a whole number in [0, 720]"),
        (["--set", "goal_radius=true"], "expected in (0, 100] m"),
        (["--set", "walls_count=1"], "got 'walls_count=1'; expected true or false"),
        (["--set", "walls_count=null"], "expected true or false"),
        (["--set", "learner.eta=" + "[" * 10**5], "expected in (0, 1)"),
        (["--set", "learner.sigma"], "FIELD is one of learner.motion_count, learner.eta, "),
        (["--set", "sigma=0.5"], "--set: got 'sigma=0.5'; expected FIELD=VALUE, where FIELD is"),
        (["--set", "learner.sigma.x=1"], "expected FIELD=VALUE"),
        (["--set", "="], "expected FIELD=VALUE"),
        (["--set", ""], "expected FIELD=VALUE"),
        (["--set", "learner.motion_count=3"], "got 3; expected 5"),
    ],
)
def test_run_refuses_in_one_line_what_cannot_run(tmp_path, capsys, options, says):
    line = refusal(capsys, "run", "paper", "--output", tmp_path / "out", *options)
    assert says in line
    assert list(tmp_path.glob("out/*")) == []  # before anything was run


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"{bad", "line 1, column 2"),
        (b"\xff\xfe", "line 1, column 1"),
        (b"\xef\xbb\xbf{}", "a byte order mark"),
        (b"{}\0", "a byte of zero"),
        (b"", "line 1, column 1"),
        (b"[1]", "expected an object"),
        (b"NaN", "expected JSON text in UTF-8"),
        (b'{"learner": {"sigma": "x"}}', 'learner.sigma: got "x"; expected in (0, 1)'),
        (b'{"learner": {"sigma": 7}}', "learner.sigma: got 7; expected in (0, 1)"),
        (b'{"learner": {"sigma": 0.1, "sigma": 0.1}}', "learner.sigma: got the field again"),
        (b'{"heading_bins": true}', "heading_bins: got true; expected a whole number in [1, 3600]"),
        (b'{"walls_count": 1}', "walls_count: got 1; expected true or false"),
        (b'{"nope": 1}', "nope: got an unknown field; expected one of learner, "),
        (b"[" * 100_000, "expected at most 4 levels"),
    ],
)
def test_run_refuses_a_configuration_by_its_file(tmp_path, capsys, content, says):
    file = tmp_path / "config.json"
    file.write_bytes(content)
    line = refusal(capsys, "run", "paper", "--config", file, "--output", tmp_path / "out")
    assert line.startswith(f"devlearn: {file}: ")
    assert says in line
    assert not (tmp_path / "out").exists()


def test_run_refuses_files_that_are_not_there_or_no_files(tmp_path, capsys):
    missing = tmp_path / "missing.json"
    assert "no such file" in refusal(capsys, "run", missing)
    assert all(name in refusal(capsys, "run", "papre") for name in ("papre", *devlearn.worlds()))
    assert "irectory" in refusal(capsys, "run", tmp_path)
    assert "No such file" in refusal(capsys, "run", "paper", "--config", missing)
    assert "irectory" in refusal(capsys, "run", "paper", "--config", tmp_path)


@pytest.mark.parametrize("content", ["{bad", "", "[]", "{}", '{"format": 3}'])
def test_run_refuses_a_file_that_is_no_world(tmp_path, capsys, content):
    file = tmp_path / "world.json"
    file.write_text(content)
    assert refusal(capsys, "run", file).startswith(f"devlearn: {file}: ")


@pytest.mark.parametrize(
    "verb", [["run", "paper", *SHORT], ["reproduce", "--seeds", 1], ["reproduce", "--figure", 2]]
)
def test_a_folder_that_cannot_be_made_is_refused_at_once(tmp_path, capsys, verb):
    (tmp_path / "file").write_text("")
    for output in (tmp_path / "file", tmp_path / "file" / "below"):
        line = refusal(capsys, *verb, "--output", output)
        assert line.startswith(f"devlearn: {output}")
        assert "expected a folder that can be made and written to" in line


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--seeds", 0], "seeds: got 0; expected a whole number in [1, 1000]"),
        (["--seeds", 1001], "seeds: got 1001; expected"),
        (["--workers", 0], "--workers: got 0; expected at least 1"),
        (["--figure", 3], "figure: got 3; expected one of 2, 4, 6, 7, 8, 9, 10, 11, 12, 0"),
        (["--figure", -1], "figure: got -1; expected one of"),
    ],
)
def test_reproduce_refuses_in_one_line_what_cannot_be(tmp_path, capsys, options, says):
    assert says in refusal(capsys, "reproduce", "--output", tmp_path / "out", *options)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("package", ["matplotlib", "tqdm", "jinja2"])
def test_reproduce_without_a_package_says_by_which_command_to_have_it(tmp_path, without, package):
    done = command("reproduce", "--output", tmp_path / "out", **without(package))
    assert done.returncode == 1
    said = re.fullmatch(
        rf"devlearn: .* needs {package}, which is not installed; to have it: (.*)\n", done.stderr
    )
    assert said
    # It works: here, where all is installed, pip finds nothing left to do.
    words = shlex.split(said[1])
    assert words[0] == sys.executable
    assert any(word.startswith(f"{package}>=") for word in words)
    pip = subprocess.run([*words, "--dry-run", "--no-index"], capture_output=True, text=True)
    assert pip.returncode == 0, pip.stderr
    assert "Would install" not in pip.stdout
    assert not (tmp_path / "out").exists()


def test_one_figure_needs_the_extra_for_plots_only(tmp_path, without):
    extras = without("tqdm", "jinja2")
    done = command("reproduce", "--figure", 2, "--output", tmp_path, **extras)
    assert (done.returncode, done.stderr) == (0, "")


# --- reproduce ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small():
    """Section VI in small: every run is short, and counts as settled."""
    from devlearn.paper import figures

    with pytest.MonkeyPatch.context() as patch:
        for name, value in {
            "SECTION_VI": Schedule((3000, 3000), rounds=6, step_limit=2500),
            "CONTROL_ROUNDS": 1, "SIMILAR_ROUNDS": 2, "SIMILAR_CONTROL_ROUNDS": 1,
            "NEW_START_ROUNDS": 4,
        }.items():  # fmt: skip
            patch.setattr(schedule, name, value)
        patch.setattr(measures, "settled_round", lambda record: int(record.rounds["round"][-1]))
        patch.setattr(tables, "PAPER_TABLE_1", {4: 194, 8: 149})
        patch.setattr(measures, "SETTLED_ROUNDS", 1)
        patch.setattr(store, "code_version", lambda: "this code")  # whoever edits it meanwhile
        yield figures.Gallery()


@pytest.fixture(scope="module")
def reproduced(small, tmp_path_factory):
    """The folder of a whole ``devlearn reproduce``, and what it printed."""
    folder = tmp_path_factory.mktemp("reproduced")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stdout", io.StringIO())
        line = ["reproduce", "--seeds", "1", "--workers", "1", "--output", str(folder)]
        assert cli.main(line) == 0
        return folder, sys.stdout.getvalue()


def assert_drawn(path):
    """A picture with something in it, as PNG and as SVG."""
    import matplotlib.image

    assert path.with_suffix(".png").read_bytes().startswith(PNG)
    pixels = matplotlib.image.imread(path.with_suffix(".png"))
    assert min(pixels.shape[:2]) > 200
    assert 0.01 < np.mean(pixels[:, :, :3].min(axis=2) < 0.9) < 0.95  # neither blank nor black
    root = ElementTree.parse(path.with_suffix(".svg")).getroot()
    assert root.tag.endswith("svg")
    assert len(list(root.iter("{http://www.w3.org/2000/svg}path"))) > 20


NAMES = {
    2: ["fig02_world"], 4: ["fig04_sef"], 6: ["fig06_free_learning"], 7: ["fig07_counts"],
    8: ["fig08_episodes"], 9: ["fig09_second_round"],
    10: ["fig10_path_optimisation", "fig10_rounds"], 11: ["fig11_habits"],
    12: ["fig12_new_starts"], 0: ["preferences", "kinds"],
}  # fmt: skip


def test_one_figure_is_drawn_by_its_number_and_nothing_else(tmp_path):
    done = command("reproduce", "--figure", 7, "--output", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    files = [tmp_path / "figures" / f"fig07_counts.{kind}" for kind in ("png", "svg")]
    assert done.stdout.split() == list(map(str, files))
    assert sorted(path for path in tmp_path.rglob("*") if path.is_file()) == files
    assert_drawn(files[0])


@pytest.mark.parametrize("number", NAMES)
def test_every_number_draws_its_figures(small, tmp_path, capsys, monkeypatch, number):
    from devlearn.paper import figures

    monkeypatch.setattr(figures, "Gallery", lambda: small)  # whose runs are made once
    monkeypatch.setattr(figures, "save_figure", lambda folder, drawn: [folder / drawn.name])
    assert cli.main(["reproduce", "--figure", str(number), "--output", str(tmp_path)]) == 0
    printed = [Path(line) for line in capsys.readouterr().out.splitlines()]
    assert {path.parent for path in printed} == {tmp_path / "figures"}
    names, more = [path.name for path in printed], len(NAMES[number])
    assert names[:more] == NAMES[number]
    assert all(re.fullmatch("fig08_episode_[abcd]", name) for name in names[more:])


def test_a_figure_drawn_again_is_the_same_file(small, tmp_path, monkeypatch):
    from devlearn.paper import figures

    monkeypatch.setattr(figures, "Gallery", lambda: small)
    for name in "ab":
        assert cli.main(["reproduce", "--figure", "7", "--output", str(tmp_path / name)]) == 0
    for kind in ("png", "svg"):
        a, b = (tmp_path / n / "figures" / f"fig07_counts.{kind}" for n in "ab")
        assert a.read_bytes() == b.read_bytes()


def test_reproduce_draws_every_figure_as_png_and_svg(reproduced):
    folder, _ = reproduced
    written = {path.stem for path in (folder / "figures").iterdir()}
    expected = {name for names in NAMES.values() for name in names}
    expected |= {"beyond_presets", "rounds_over_seeds", "sigmas"}
    assert written >= expected
    assert all(re.fullmatch("fig08_episode_[abcd]", name) for name in written - expected)
    for name in written:
        assert_drawn(folder / "figures" / f"{name}.png")


def no_constant(name):
    raise AssertionError(f"{name} is not JSON")


def test_the_numbers_are_json_and_say_what_the_claims_came_to(reproduced):
    folder, out = reproduced
    text = (folder / "numbers.json").read_text()
    numbers = json.loads(text, parse_constant=no_constant)
    assert list(numbers["claims"]) == ["paper", "step5"]
    for name, judged in numbers["claims"].items():
        assert [claim["id"] for claim in judged] == [claim["id"] for claim in claims()]
        held = sum(claim["holds"] for claim in judged)
        assert f"preset {name}: {held} of {len(judged)} claims hold" in out
        (run,) = numbers["runs"][name]["runs"]
        values = {claim["id"]: claim["figure"]["value"] for claim in judged}
        assert values["arrives_sooner"] == run["arrives_sooner"]
        assert values["wanders_less"] == run["wanders_less"]
        assert len(run["round_steps"]) == 6
    assert list(numbers["runs"]["paper"]["by_sigma"]) == ["0.1", "0.3", "0.5", "0.7", "0.9"]
    assert numbers["provenance"]["seed"] == "1 to 1"
    assert numbers["provenance"]["devlearn"] == devlearn.__version__


def test_table_1_stands_beside_the_papers(reproduced):
    folder, _ = reproduced
    with (folder / "table1.csv").open() as file:
        head, *rows = csv.reader(file)
    assert head[:3] == ["round", "paper", "seed 1"]
    assert head[3:6] == ["paper p10", "paper median", "paper p90"]
    assert [row[:2] for row in rows] == [["4", "194"], ["8", "149"]]
    numbers = json.loads((folder / "numbers.json").read_text())
    for column, name in ((4, "paper"), (7, "step5")):
        (run,) = numbers["runs"][name]["runs"]
        assert [float(row[column]) for row in rows] == [run["round_steps"][r - 3] for r in (4, 8)]


def test_the_report_needs_nothing_but_itself(reproduced):
    folder, _ = reproduced
    page = (folder / "report.html").read_text(encoding="utf-8")
    pictures = re.findall(r'<img src="data:image/png;base64,([^"]+)"', page)
    assert len(pictures) == len(list((folder / "figures").glob("*.png")))
    outside = [at for at in re.findall(r'(?:src|href)\s*=\s*"?([^">]{0,20})', page)
               if not at.startswith(("data:", "#"))]  # fmt: skip
    assert outside == []
    assert not re.search(r"https?://|<script|<link|@import|url\(", page)


def test_the_report_tells_each_claim_with_its_control(reproduced):
    from markupsafe import escape

    folder, out = reproduced
    page = (folder / "report.html").read_text(encoding="utf-8")
    flat = " ".join(page.split())
    for claim in claims():
        for field in ("claim", "measure", "control"):
            assert str(escape(claim[field])) in flat, claim["id"]
        if "by_definition" in claim:
            part, reason = claim["by_definition"].values()
            assert str(escape(f"By definition, the {part}: {reason}")) in flat
            assert re.search(rf"{claim['id']} .*\({part}: by definition\)", out)
    marked = sum("by_definition" in claim for claim in claims())
    assert flat.count('<span class="spread">by definition</span>') == 2 * marked
    for held in re.findall(r"preset \w+: (\d+ of \d+ claims hold)", out):
        assert held in flat
    assert "nan" not in re.sub(r"base64,[^\"]+", "", page).lower().split()
    assert f"report: {folder / 'report.html'}" in out


def test_reproducing_again_runs_nothing_again(reproduced, quick, monkeypatch, capsys):
    folder, _ = reproduced
    before = json.loads((folder / "numbers.json").read_text())
    runs = finished_in(folder)
    # 16 less the controls that both presets share; and both presets in every world, less the
    # paper's in its own.
    assert len(runs) == 14 + 2 * len(devlearn.worlds()) - 1

    def never(job):
        raise AssertionError("run again")

    monkeypatch.setattr(pools, "execute", never)
    assert cli.main(quick(folder)) == 0
    assert finished_in(folder) == runs
    after = json.loads((folder / "numbers.json").read_text())
    assert after["claims"] == before["claims"]
    assert after["runs"] == before["runs"]
    assert after["beyond"] == before["beyond"]


def test_what_was_reproduced_is_the_results_of_a_sweep(reproduced):
    folder, _ = reproduced
    frame = Results(folder / "runs.sqlite").to_pandas()
    assert frame["error"].isna().all()
    assert set(frame["agent"]) == {"paper", "step5", "adaptive", "RandomAgent"}
    [main] = frame.query("world == 'paper' and label == 'paper' and seed == 1").to_dict("records")
    [run] = json.loads((folder / "numbers.json").read_text())["runs"]["paper"]["runs"]
    assert main["steps"] == sum(run["round_steps"]) + 2 * 3000


def test_reproduce_that_is_stopped_says_how_to_go_on(quick, tmp_path, monkeypatch, capsys):
    count = 0

    def stopped(job):
        nonlocal count
        count += 1
        if count == 3:
            raise KeyboardInterrupt
        return execute(job)

    execute = pools.execute
    monkeypatch.setattr(pools, "execute", stopped)
    assert cli.main(quick(tmp_path)) == 130
    err = capsys.readouterr().err
    assert f"kept in {tmp_path}; the same command goes on from there" in err
    assert "Traceback" not in err
    before = finished_in(tmp_path)
    assert len(before) == 2
    assert cli.main(quick(tmp_path)) == 0
    assert finished_in(tmp_path)[:2] == before
    assert count == 3 + len(finished_in(tmp_path)) - 2


def of_other_code(path):
    with sqlite3.connect(path) as connection:
        connection.execute("UPDATE meta SET value = 'other' WHERE name IN ('code', 'devlearn')")


def without_an_end(path):
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])


def no_database(path):
    path.write_text("something else entirely")


def empty(path):
    path.write_bytes(b"")


@pytest.mark.parametrize(
    ("change", "says", "end"),
    [
        (of_other_code, "runs of devlearn other, of other code", "other"),
        (without_an_end, "malformed", "damaged"),
        (no_database, "file is not a database", "damaged"),
        (empty, "another application's file", "damaged"),
    ],
)
def test_runs_that_cannot_be_gone_on_with_are_moved_aside(reproduced, tmp_path, change, says, end):
    folder, _ = reproduced
    path, aside = tmp_path / "runs.sqlite", tmp_path / f"runs.sqlite.{end}"
    shutil.copy(folder / "runs.sqlite", path)
    change(path)
    before = path.read_bytes()
    said = []
    reproduce._make_room(path, said.append)
    assert str(path) in said[0]
    assert says in said[0]
    assert f"it is kept as {aside}, and all is run again" in said[0]
    assert aside.read_bytes() == before
    assert not path.exists()


def test_runs_of_this_code_are_gone_on_with(reproduced):
    folder, _ = reproduced
    said = []
    reproduce._make_room(folder / "runs.sqlite", said.append)
    assert said == []
    assert (folder / "runs.sqlite").exists()


def test_damaged_runs_are_made_again_to_the_same_numbers(reproduced, quick, tmp_path, capsys):
    folder, _ = reproduced
    no_database(tmp_path / "runs.sqlite")
    assert cli.main(quick(tmp_path)) == 0
    assert "runs.sqlite.damaged, and all is run again" in capsys.readouterr().out
    assert len(finished_in(tmp_path)) == len(finished_in(folder))
    numbers = [json.loads((at / "numbers.json").read_text()) for at in (folder, tmp_path)]
    assert numbers[0]["claims"] == numbers[1]["claims"]
    assert numbers[0]["beyond"] == numbers[1]["beyond"]


def test_a_run_that_fails_is_told_and_made_again(quick, tmp_path, monkeypatch):
    def failing(job):
        if job.world == "corridor":
            return Row(error="Traceback: a fault of some run")
        return execute(job)

    execute = pools.execute
    monkeypatch.setattr(pools, "execute", failing)
    with pytest.raises(RuntimeError, match=r"2 runs failed.*\n.*a fault of some run"):
        cli.main(quick(tmp_path))
    assert not (tmp_path / "report.html").exists()
    before = finished_in(tmp_path)
    monkeypatch.setattr(pools, "execute", execute)
    assert cli.main(quick(tmp_path)) == 0
    assert len(set(before) & set(finished_in(tmp_path))) == len(before) - 2


def test_files_of_the_present_folder_do_not_stand_in_for_modules(quick, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "path", [at for at in sys.path if at])
    monkeypatch.chdir(tmp_path)
    assert cli.main(quick(tmp_path / "out")) == 0
    assert "" not in sys.path


def finished_in(folder):
    """The runs of a folder, and when each was finished."""
    with sqlite3.connect(folder / "runs.sqlite") as connection:
        return connection.execute("SELECT id, run_finished, run_seconds FROM runs").fetchall()


@pytest.fixture
def quick(small, monkeypatch):
    """A whole ``devlearn reproduce`` but for the figures, which take most of the time."""
    from devlearn.paper import figures

    monkeypatch.setattr(figures, "FIGURES", {})
    monkeypatch.setattr(figures, "Gallery", lambda world: small)
    return lambda folder: ["reproduce", "--seeds", "1", "--workers", "1", "--output", str(folder)]
