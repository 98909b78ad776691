"""The embedding guide's programs compile as they stand, and the reference leaves out no header."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

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
