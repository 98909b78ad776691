"""The examples of the README and of the first steps are run as they stand."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
FIRST_STEPS = (ROOT / "docs/first-steps.md").read_text(encoding="utf-8")


def blocks(language: str, text: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)


def test_every_python_example_runs_after_the_ones_before_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    examples = blocks("python", FIRST_STEPS)
    assert len(examples) >= 4
    assert blocks("python", README) == examples[:1]
    assert len(examples[0].splitlines()) <= 6
    names = {}
    for example in examples:
        exec(example, names)
    assert names["paths"].rounds["arrived"].all()
    assert names["place"] == 20
    assert len(names["record"]) == 100
    assert {path.name for path in tmp_path.iterdir()} == {"path.png", "preferences.png"}


def test_the_loop_over_a_world_of_ones_own_takes_under_ten_lines():
    (loop,) = [example for example in blocks("python", FIRST_STEPS) if "while place" in example]
    assert len(loop.splitlines()) < 10


def test_the_cpp_example_compiles_against_core_alone(tmp_path):
    compiler = shutil.which("g++") or shutil.which("c++")
    if compiler is None:
        pytest.fail("no C++ compiler at hand")
    (example,) = blocks("cpp", README)
    assert len(example.splitlines()) <= 12
    include, body = example.split("\n\n", 1)
    program = tmp_path / "readme.cpp"
    program.write_text(
        f"{include}\n#include <cstdint>\ndouble evaluate();\nstd::int64_t sense();\n"
        f"void execute(int);\nint main() {{\n{body}}}\n"
    )
    command = [compiler, "-std=c++17", "-fsyntax-only", "-I", ROOT / "cpp/core/include", program]
    subprocess.run(command, check=True)
