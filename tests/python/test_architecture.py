"""What an import brings along, and the hygiene of the tree."""

import ast
import re
import shutil
import subprocess
import sys
from pathlib import Path

import devlearn
import pytest

SOURCE = Path(__file__).resolve().parents[2]
PACKAGE = SOURCE / "python" / "devlearn"


def test_core_draws_and_computes_with_its_own_functions_only():
    owned = re.compile(
        r"\bstd::(exp|sin|cos|tan|atan2|pow|log|uniform_\w+_distribution|mt19937\w*|shuffle"
        r"|random_device)\b"
    )
    files = [path for path in (SOURCE / "cpp/core").rglob("*") if path.suffix in {".cpp", ".hpp"}]
    assert files
    found = {
        (path.name, match[0])
        for path in files
        for match in owned.finditer(re.sub(r"//.*", "", path.read_text(encoding="utf-8")))
    }
    assert found == set()


def modules_after(statement):
    """Names of all modules loaded once a fresh interpreter ran the statement."""
    code = f"import sys\n{statement}\nprint(*sys.modules, sep='\\n')"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(run.stdout.split())


def test_importing_devlearn_loads_no_plotting():
    loaded = modules_after("import devlearn; devlearn.Trial, devlearn.Record")
    assert "devlearn._core" in loaded
    assert not {name for name in loaded if name.split(".")[0] in {"matplotlib", "PIL"}}


def test_the_help_of_the_command_line_loads_nothing_that_it_does_not_need():
    loaded = modules_after(
        "import contextlib, io\n"
        "from devlearn.cli import main\n"
        "with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):\n"
        "    main(['--help'])"
    )
    others = {"numpy", "matplotlib", "multiprocessing"}
    assert not {name for name in loaded if name.split(".")[0] in others}
    assert {name for name in loaded if name.startswith("devlearn.")} == {
        "devlearn.cli",
        "devlearn.cli.reproduce",
        "devlearn.cli.compare",
        "devlearn.cli.console",
        "devlearn.cli.film",
        "devlearn.cli.run",
        "devlearn.cli.sweep",
        "devlearn.cli.view",
        "devlearn.cli.world",
        "devlearn.errors",
    }


def test_every_public_name_is_there_when_asked_for_and_no_other():
    names = "', '".join(devlearn.__all__)
    modules_after(f"from devlearn import *\nassert {{'{names}'}} <= set(globals())")
    modules_after(f"import devlearn\nassert {{'{names}'}} <= set(dir(devlearn))")
    with pytest.raises(AttributeError, match="no attribute 'Robots'"):
        devlearn.Robots  # noqa: B018


def test_plots_only_read():
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in PACKAGE.glob("plots/*.py")]
    assert trees
    imported, called = set(), set()
    for node in (node for tree in trees for node in ast.walk(tree)):
        if isinstance(node, ast.ImportFrom):
            imported |= {alias.name for alias in node.names} | {(node.module or "").split(".")[-1]}
        elif isinstance(node, ast.Import):
            imported |= {alias.name for alias in node.names}
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            called.add(node.func.attr)
    assert not imported & {"Trial", "experiments", "paper", "cli"}
    running = {"free_learning", "path_learning", "learn", "update", "choose", "begin_round"}
    assert not called & running


def tracked_files():
    """What git tracks; of a source distribution, which has no git, all but what was made in it."""
    git = shutil.which("git")
    listed = git and subprocess.run([git, "ls-files", "-z"], cwd=SOURCE, capture_output=True)
    if listed and listed.stdout:
        return [SOURCE / name for name in listed.stdout.decode().split("\0") if name]
    made = {"build", "dist", "out", "__pycache__"}
    return [
        path
        for path in SOURCE.rglob("*")
        if path.is_file()
        and not any(part in made or part[0] == "." for part in path.relative_to(SOURCE).parts)
    ]


def text_of(path):
    try:
        return path.read_text(encoding="utf-8")
    except (UnicodeDecodeError, OSError):
        return ""  # a picture, a link, or removed


def test_no_file_names_a_path_of_somebody_s_machine():
    path_of_a_machine = re.compile(r"(?<![\w.:/-])/(home|root|work|Users)/\w")
    found = {
        (path.relative_to(SOURCE).as_posix(), match[0])
        for path in tracked_files()
        for match in path_of_a_machine.finditer(text_of(path))
    }
    assert found == set()


def test_every_link_between_documents_leads_somewhere():
    broken = {
        (path.name, target)
        for path in tracked_files()
        if path.suffix == ".md"
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text_of(path))
        if ":" not in target and not (path.parent / target).exists()
    }
    assert broken == set()


def imported_by(path):
    """What a file of the package imports: modules of others by name, its own from devlearn on."""
    package = ("devlearn", *path.relative_to(PACKAGE).parts[:-1])
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level:
            module = [*package[: len(package) + 1 - node.level], *filter(None, [node.module])]
            yield from (".".join([*module, alias.name]) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module


# What the rooms of the package may know of each other, and who alone needs an extra's packages.
ROOMS = {
    "analysis": set(),
    "plots": {"analysis"},
    "experiments": set(),
    "paper": {"analysis", "plots", "experiments"},
    "comparison": {"analysis", "plots", "experiments"},
    "maps": set(),
    "cli": {"analysis", "plots", "experiments", "paper", "comparison", "maps", "viewer"},
    "envs": {"plots"},
    "viewer": {"analysis", "plots"},
}
EXTRAS = {
    "matplotlib": "plots",
    "jinja2": "_pages.py",
    "tqdm": "experiments",
    "scipy": "experiments",
    "distributed": "experiments",
    "gymnasium": "envs",
    "imageio_ffmpeg": "viewer",
    "rerun": "viewer",
    "pyarrow": "viewer",
    "PIL": "maps",
    "shapely": "maps",
    "skimage": "maps",
    "yaml": "maps",
}


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_of_the_package_knows_only_those_before_it(room):
    files = list(PACKAGE.glob(f"{room}/*.py"))
    assert files
    others = "|".join(set(ROOMS) - {room})
    known = {
        match[1]
        for path in files
        for name in imported_by(path)
        if (match := re.match(rf"devlearn\.({others})\b", name))
    }
    assert known <= ROOMS[room]


@pytest.mark.parametrize("package", EXTRAS)
def test_the_packages_of_an_extra_are_imported_in_one_room(package):
    users = {
        path.relative_to(PACKAGE).parts[0]
        for path in PACKAGE.rglob("*.py")
        if any(name.split(".")[0] == package for name in imported_by(path))
    }
    assert users == {EXTRAS[package]}
