"""The guides' programs run as they stand, and references leave nothing out."""

import json
import math
import re
import runpy
import shutil
import sqlite3
import subprocess
from pathlib import Path

import devlearn
import numpy as np
import pytest
from devlearn.experiments import statistics
from devlearn.experiments.measures import MEASURES
from PIL import Image

ROOT = Path(__file__).parents[2]
GUIDE = (ROOT / "docs" / "embedding.md").read_text(encoding="utf-8")
HEADERS = sorted(path.name for path in ROOT.glob("cpp/*/include/devlearn/*.hpp"))
# The robot that the guide's programs speak of.
ROBOT = """
#include <cstdint>
double evaluate();
bool running();
std::int64_t situation();
void execute(int motion);
double estimate(), cost();
int safe(int motion);
"""
# What a piece within the loop finds around it.
LOOP = """
#include <cstdio>
#include <devlearn/learner.hpp>
void loop(devlearn::Learner& learner, int bearing, int speed, int loaded, double smf) {
"""


PROGRAMS = [
    ROBOT + (block if "#include" in block else LOOP + block + "}\n")
    for block in re.findall(r"```cpp\n(.*?)```", GUIDE, re.DOTALL)
]


@pytest.mark.parametrize("program", PROGRAMS)
def test_the_programs_of_the_guide_compile_against_core(tmp_path, program):
    compiler = shutil.which("g++") or shutil.which("c++")
    if compiler is None:
        pytest.fail("no C++ compiler at hand")
    source = tmp_path / "guide.cpp"
    source.write_text(program)
    eigen = subprocess.run(
        ["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True
    )
    include = ["-I", ROOT / "cpp/core/include", *eigen.stdout.split()]
    command = [compiler, "-std=c++17", "-fsyntax-only", *include, source]
    subprocess.run(command, check=True)


def test_every_header_of_core_is_read_by_a_program_without_exceptions_and_types(tmp_path):
    headers = sorted(ROOT.glob("cpp/core/include/devlearn/**/*.hpp"))
    source = tmp_path / "program.cpp"
    source.write_text(
        "".join(f"#include <{h.relative_to(ROOT / 'cpp/core/include')}>\n" for h in headers)
        + "int main() {\n"
        "  devlearn::Learner learner;\n"
        "  learner.choose(3);\n"
        "  devlearn::LearnerConfig().validate();\n"
        "  return devlearn::to_pose(Eigen::Isometry2d::Identity()).heading > 0;\n"
        "}\n"
    )
    eigen = subprocess.run(
        ["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True
    )
    options = ["-std=c++17", "-fno-exceptions", "-fno-rtti", "-Wall", "-Wextra", "-Werror"]
    include = ["-I", ROOT / "cpp/core/include", *eigen.stdout.replace("-I", "-isystem").split()]
    subprocess.run(["g++", *options, "-fsyntax-only", *include, source], check=True)


@pytest.mark.parametrize("header", ["learner", "situation", "snapshot", "eigen", "error"])
def test_an_older_standard_is_told_what_is_missing(tmp_path, header):
    source = tmp_path / "program.cpp"
    source.write_text(f"#include <devlearn/{header}.hpp>\nint main() {{}}\n")
    eigen = subprocess.run(
        ["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True
    )
    include = ["-I", ROOT / "cpp/core/include", *eigen.stdout.split()]
    compiled = subprocess.run(
        ["g++", "-std=c++14", "-fsyntax-only", *include, source], capture_output=True, text=True
    )
    first = next(line for line in compiled.stderr.splitlines() if " error: " in line)
    assert "devlearn needs C++17 or later: compile with -std=c++17" in first


def test_the_least_cmake_is_one_wherever_it_is_named():
    presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
    least = presets["cmakeMinimumRequired"]
    reads = {1: 19, 2: 20, 3: 21, 4: 23, 5: 24, 6: 25}  # formats of presets, from which CMake 3 on
    assert reads[presets["version"]] <= least["minor"]
    named = {f"{least['major']}.{least['minor']}"}
    files = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    for name in files.stdout.splitlines():
        if name.endswith(("CMakeLists.txt", ".cmake")):
            text = (ROOT / name).read_text(encoding="utf-8")
            named.update(re.findall(r"^cmake_minimum_required\(VERSION (.+)\)", text, re.MULTILINE))
    for name in ("docs/install.md", "docs/stability.md"):
        said = re.findall(r"CMake (\d+\.\d+)", (ROOT / name).read_text(encoding="utf-8"))
        assert said, name
        named.update(said)
    assert named == {"3.22"}


def test_every_header_is_in_the_reference():
    reference = (ROOT / "docs/reference/cpp.rst").read_text(encoding="utf-8")
    assert sorted(re.findall(r"^\.\. doxygenfile:: (\S+)", reference, re.MULTILINE)) == HEADERS


def test_every_example_is_in_both_languages_in_the_list_and_in_the_reference():
    examples = ROOT / "examples"
    reference = (ROOT / "docs/reference/examples.rst").read_text(encoding="utf-8")
    listed = (examples / "README.md").read_text(encoding="utf-8")
    stems = {path.stem for path in examples.glob("*.cpp")}
    assert stems == {path.stem for path in examples.glob("*.py")}
    assert stems == set(re.findall(r"^\| `(\d\d_\w+)`", listed, re.MULTILINE))
    assert set(re.findall(r"/examples/(\d\d_\w+)\.\w+$", reference, re.MULTILINE)) == stems


METHOD = (ROOT / "docs/method.md").read_text(encoding="utf-8")


def run_python_of(guide):
    """The names that a guide's programs leave behind, run one after the other."""
    names = {"__name__": "__main__"}
    for code in re.findall(r"```python\n(.*?)```", guide, re.DOTALL):
        exec(code, names)
    return names


def test_the_method_has_every_equation_beside_code():
    sections = re.split(r"^### Eq. ", METHOD, flags=re.MULTILINE)[1:]
    told = []
    for section in sections:
        first, last = re.match(r"(\d+)(?: (?:and|to) (\d+))?:", section).groups()
        told += range(int(first), int(last or first) + 1)
        assert "$$" in section and "```{cpp-source} cpp/" in section
    assert told == list(range(1, 18))


def test_every_function_that_the_method_quotes_is_there_once():
    lines_of = runpy.run_path(str(ROOT / "docs/cpp_function.py"))["lines_of"]
    for path, name in re.findall(r"^```{cpp-source} (\S+) (\S+)$", METHOD, re.MULTILINE):
        text = (ROOT / path).read_text(encoding="utf-8")
        first, last = lines_of(text, name)
        quoted = text.split("\n")[first - 1 : last]
        assert any(f"{name}(" in line for line in quoted)
        assert quoted[-1].endswith("}")
        assert "\n".join(quoted).count("{") == "\n".join(quoted).count("}")
    for wrong in ("MotorMemory::lost", "normal"):
        with pytest.raises(ValueError, match=f"0 definitions of {wrong}"):
            lines_of((ROOT / "cpp/core/src/motor_memory.cpp").read_text(encoding="utf-8"), wrong)


def test_the_python_of_the_method_gives_what_its_equations_say():
    names = run_python_of(METHOD)
    turn = math.radians(60)
    assert names["pose"] == pytest.approx(
        (1 + 0.05 * math.cos(turn), 1 + 0.05 * math.sin(turn), 60)
    )
    assert (names["right"] - names["left"]) / 0.1 * 0.5 == pytest.approx(turn)
    assert names["near"] - names["far"] == pytest.approx(0.3 * (2**2 - 1**2))
    assert names["extended"].orientation == [1 / 2, 1 / 2]
    assert (names["extended"].effective, names["extended"].ineffective) == ([2, 3], [0])
    d = 1 - math.exp(-0.05 * 4)
    o = [(0.5 + 0.5 * d) / (1 + 0.5 * d), 0.5 / (1 + 0.5 * d)]
    assert names["oriented"].orientation == pytest.approx(o)
    assert (names["abandoned"].effective, names["abandoned"].ineffective) == ([2], [0, 3])


def test_who_cites_finds_the_version_and_the_papers_doi_the_same_everywhere():
    citing = (ROOT / "docs/citing.md").read_text(encoding="utf-8")
    cff = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"{{{devlearn.__version__}}}" in citing
    (doi,) = re.findall(r"doi: (\S+)", cff)
    assert f"{{{doi}}}" in citing and f"doi.org/{doi}" in (ROOT / "docs/index.md").read_text()


def test_each_recipe_runs_and_does_what_it_is_for(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = run_python_of((ROOT / "docs/howto.md").read_text(encoding="utf-8"))
    assert sorted(names["table"]["label"]) == ["adaptive"] * 3 + ["paper"] * 3
    assert len(names["steps"]) == 1000 and (tmp_path / "steps.csv").exists()
    assert len(names["found"].rounds) == 10 and names["found"].rounds["arrived"].any()
    own = names["record_of_own"]
    assert math.hypot(own.x[1] - own.x[0], own.y[1] - own.y[0]) == pytest.approx(0.2 * 0.5)
    assert [names["again"].best(error) for error in (1, 2, 3)] == [0, 0, 0]
    assert names["room"].target == (4.0, 2.0)
    assert names["records"][0] != names["records"][1]
    assert names["resumed"].robot.world == names["trial"].robot.world


def test_what_helps_against_failures_runs_and_helps(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = run_python_of((ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8"))
    assert names["exhausted"] > names["exploring"] > 0
    assert names["abandoned"] > 0
    careless = devlearn.Trial(devlearn.World.load("paper"), seed=1).free_learning(2000)
    assert 0 < names["safe"].collided.sum() < careless.collided.sum() / 3


def test_the_guide_to_watching_runs_as_it_stands(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = run_python_of((ROOT / "docs/live.md").read_text(encoding="utf-8"))
    assert names["live"].failed is None
    assert names["live"].steps == len(names["free"]) + len(names["paths"])
    assert (tmp_path / "run.rrd").stat().st_size > 100_000


GALLERY = sorted((ROOT / "docs/gallery").glob("*.py"))


def test_the_gallery_shows_every_picture_and_its_program():
    page = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")
    named = [program.stem for program in GALLERY]
    assert sorted(re.findall(r"\]\(gallery/(\w+)\.png\)", page)) == named
    assert sorted(re.findall(r"^```{literalinclude} gallery/(\w+)\.py$", page, re.M)) == named


@pytest.mark.parametrize("program", GALLERY, ids=lambda program: program.stem)
def test_a_program_of_the_gallery_draws_the_picture_that_is_shown(program, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(program))
    drawn = tmp_path / f"{program.stem}.png"
    runpy.run_path(str(ROOT / "docs/images/draw.py"))["save_small"](drawn, drawn)
    pictures = (drawn, program.with_suffix(".png"))
    ours, shown = (np.asarray(Image.open(each).convert("L"), dtype=float) for each in pictures)
    assert ours.shape == shown.shape
    assert np.abs(ours - shown).mean() < 1.0  # of 255: letters may differ with matplotlib


ADAPTIVE = (ROOT / "docs/adaptive.md").read_text(encoding="utf-8")


def test_the_adaptive_guides_code_runs_and_finds_a_habit():
    (code,) = re.findall(r"```python\n(.*?)```", ADAPTIVE, re.DOTALL)
    names = {}
    exec(code, names)
    assert names["paths"].rounds["arrived"].all()
    assert names["trial"].learner.habit_cost is not None


def test_the_adaptive_guide_tells_of_every_setting():
    settings = ADAPTIVE[ADAPTIVE.index("## Settings") : ADAPTIVE.index("## What costs time")]
    rows = set(re.findall(r"`(\w+)`", settings))
    assert set(devlearn.AdaptiveConfig.fields()) - {"motion_count"} <= rows


def test_the_format_tells_of_every_entry_and_array_of_an_adaptive_learner():
    bytes_ = devlearn.AdaptiveLearner(devlearn.AdaptiveConfig(curious_every=1)).to_bytes()
    size = int.from_bytes(bytes_[:8], "little")
    header = json.loads(bytes_[8 : 8 + size])
    text = (ROOT / "docs/snapshot-format.md").read_text(encoding="utf-8")
    section = text[text.index("## An adaptive learner") : text.index("## A trial")]
    told = set(re.findall(r"`([\w.]+)`", section))
    of_all = {"format", "format_version", "devlearn", "commit", "checksum"}
    named = {*header.pop("__metadata__"), *header} - of_all
    assert {
        name for name in named if not name.startswith(("home.", "falling.", "hope.", "path."))
    } <= told
    assert {name.split(".")[1] for name in named if name.startswith("hope.")} <= told
    assert {name.replace("path.", "habit.") for name in named if name.startswith("path.")} <= told


def test_the_guide_to_environments_of_others_runs_as_it_stands(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    guide = (ROOT / "docs/other_environments.md").read_text(encoding="utf-8")
    names = {}
    for code in re.findall(r"```python\n(.*?)```", guide, re.DOTALL):
        exec(code, names)
    assert names["episodes"]["return"][-20:].tolist() == [1.0] * 20
    assert names["episodes"]["steps"][-1] == 6
    assert devlearn.envs.LearnerOn(
        names["pendulum"], devlearn.RandomAgent(), situations=lambda _: 0
    )


SWEEPS = (ROOT / "docs/sweeps.md").read_text(encoding="utf-8")


def test_the_guide_to_sweeps_runs_as_it_stands(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, measure = re.findall(r"```python\n(.*?)```", SWEEPS, re.DOTALL)
    names = {"__name__": "__main__"}
    exec(code, names)
    assert len(names["table"]) == 18
    (tmp_path / "my_module.py").write_text(measure)
    spec = {"worlds": ["empty"], "agents": ["paper"], "seeds": "1", "free": [], "rounds": 2}
    own = {**spec, "measures": ["my_module:straight_share"]}
    table = devlearn.sweep(own, "own.sqlite", workers=1).to_pandas()
    assert 0 < table["my_module:straight_share"][0] < 1


def test_the_guide_to_sweeps_tells_of_every_key_and_every_measure():
    schema = json.loads((ROOT / "python/devlearn/sweep.schema.json").read_text(encoding="utf-8"))
    (toml,) = re.findall(r"```toml\n(.*?)```", SWEEPS, re.DOTALL)
    told = {"trial" if k == "[trial]" else k for k in rows_of(SWEEPS, "## What is run")}
    assert told - {"[settings.NAME]"} | {"settings"} == set(schema["properties"])
    assert set(re.findall(r"^(\w+) =", toml.partition("[trial]")[0], re.MULTILINE)) <= told
    assert set(rows_of(SWEEPS, "## What is measured")) == set(MEASURES)


def test_the_format_of_results_tells_of_every_table_and_column(tmp_path):
    text = (ROOT / "docs/results-format.md").read_text(encoding="utf-8")
    spec = {"worlds": ["empty"], "agents": ["paper"], "seeds": "1", "free": [], "rounds": 1}
    results = devlearn.sweep(spec, tmp_path / "results.sqlite", workers=1)
    columns = set(results.to_pandas()) - set(MEASURES)
    assert set(rows_of(text, "## What to read")) == columns
    with sqlite3.connect(results.path) as connection:
        tables = {
            name: [column for _, column, *_ in connection.execute(f"PRAGMA table_info({name})")]
            for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")
        }
    told = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", text.split("## Where it stands")[1], re.M))
    assert set(told) == set(tables)
    for name, there in tables.items():
        assert set(there) - set(MEASURES) <= set(re.findall(r"`(\w+)`", told[name])), name
    assert results.meta.keys() <= set(re.findall(r"`(\w+)`", told["meta"]))


def rows_of(text, title):
    """What stands in code in the first cells of the table under a title."""
    section = text[text.index(title) + len(title) :].partition("\n## ")[0]
    first = [line.split("|")[1] for line in section.splitlines() if line.startswith("| ")]
    return re.findall(r"`([^`]+)`", " ".join(first))


STATISTICS = (ROOT / "docs/statistics.md").read_text(encoding="utf-8")


def test_the_code_of_the_guide_to_statistics_runs_and_what_it_names_is_there(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", STATISTICS, re.DOTALL)
    exec(code, {})
    assert capsys.readouterr().out.count("Estimate(value=") == 2
    table = STATISTICS[STATISTICS.index("| what is asked") : STATISTICS.index("Below, n is")]
    named = set(re.findall(r"`(\w+)", table))
    assert named >= {"bootstrap", "estimate_share"}
    assert {name for name in named if not hasattr(statistics, name)} == set()
