"""``devlearn view``."""

import json
import re
import zlib
from base64 import b64decode

import devlearn
import pytest
from conftest import refusal
from devlearn import Trial, World
from devlearn.cli import main


def header(path):
    """The header of the data in a page."""
    text = re.search(r'<script id="data" type="text/plain">(.*?)</script>', path.read_text())[1]
    data = zlib.decompress(b64decode(text), -zlib.MAX_WBITS)
    return json.loads(data[4 : 4 + int.from_bytes(data[:4], "little")])


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    assert main(["run", "paper", "--steps", "300", "--rounds", "4", "--output", str(folder)]) == 0
    return folder


def test_a_folder_of_devlearn_run_is_one_page(run, tmp_path, capsys):
    capsys.readouterr()
    page = tmp_path / "page.html"
    assert main(["view", str(run), "--output", str(page)]) == 0
    size = page.stat().st_size / 1e6
    assert capsys.readouterr().out == f"written: {page} ({size:.2f} MB)\n"
    told = header(page)
    assert told["notes"] == []
    assert told["learner"]["known"] == 0
    paths = devlearn.Record.load(run / "paths.npz")
    assert told["total"] == 600 + len(paths)


def test_phases_in_which_nothing_was_run_are_left_out(tmp_path, capsys):
    folder, page = tmp_path / "run", tmp_path / "page.html"
    asked = ["--steps", "0", "--rounds", "3", "--output", str(folder)]
    assert main(["run", "paper", *asked]) == 0
    assert "free learning" not in capsys.readouterr().out
    assert main(["view", str(folder), "--output", str(page)]) == 0
    told = header(page)
    assert told["allRounds"] == 3
    assert told["learner"]["known"] == 0


def test_rounds_are_shown_alone_with_what_was_known_before_them(run, tmp_path):
    page = tmp_path / "page.html"
    for rounds, count in (("4:5", 2), ("5", 1), (":4", 2), ("6:", 1)):
        paths = str(run / "paths.npz")
        assert main(["view", paths, "--rounds", rounds, "--output", str(page)]) == 0
        told = header(page)
        assert next(c["count"] for c in told["columns"] if c["name"] == "roundNumber") == count
        assert told["learner"]["known"] > 0


def test_worlds_are_viewed_by_name_or_file(tmp_path):
    page, file = tmp_path / "page.html", tmp_path / "world.json"
    World.load("office").save(file)
    for world in ("office", str(file)):
        assert main(["view", world, "--output", str(page)]) == 0
        assert header(page)["world"]["name"] == "office"
    config = tmp_path / "config.json"
    config.write_text('{"robot": {"radius": 0.2}}')
    assert main(["view", "office", "--config", str(config), "--output", str(page)]) == 0
    assert header(page)["robot"]["radius"] == 0.2


def test_a_snapshot_with_its_record_is_viewed(paper, tmp_path):
    trial = Trial(paper, seed=1)
    record = trial.free_learning(100)
    trial.save(tmp_path / "trial.safetensors", record)
    page = tmp_path / "page.html"
    assert main(["view", str(tmp_path / "trial.safetensors"), "--output", str(page)]) == 0
    assert header(page)["total"] == 100


def test_what_cannot_be_viewed_is_refused_in_a_line(run, tmp_path, capsys):
    capsys.readouterr()
    output = ("--output", tmp_path / "page.html")
    assert "a world file, or one of" in refusal(capsys, "view", tmp_path / "none", *output)
    assert "no such file" in refusal(capsys, "view", tmp_path / "none.npz", *output)
    assert "a folder without records" in refusal(capsys, "view", tmp_path, *output)
    assert "--rounds" in refusal(capsys, "view", "paper", "--rounds", "1:2", *output)
    paths = run / "paths.npz"
    assert "rounds 3 to 6" in refusal(capsys, "view", paths, "--rounds", "8:", *output)
    assert "two whole numbers" in refusal(capsys, "view", paths, "--rounds", "a:b", *output)
    assert "none.json" in refusal(
        capsys, "view", paths, "--config", tmp_path / "none.json", *output
    )
    assert not (tmp_path / "page.html").exists()
    assert "ends in .html" in refusal(capsys, "view", paths, "--output", paths)
    assert "no such folder" in refusal(capsys, "view", paths, "--output", tmp_path / "a/b.html")
