"""How Sphinx writes the documentation; scripts/docs runs it."""

import ast
import csv
import re
import shutil
import sys
from pathlib import Path

from sphinx.util import logging

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ROOT / "build" / "docs-sources"
sys.path[:0] = [str(ROOT / "docs"), str(ROOT / "docs/extensions")]
from member_comments import STUB, attributes  # noqa: E402

project = "devlearn"
author = copyright = "The devlearn authors"
version = release = re.search(
    r"project\(devlearn VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
)[1]
# The sources are the whole tree's, so that links lead where they do when read as files.
root_doc = "docs/index"
include_patterns = ["*.md", "docs/**", "examples/*.md", "bench/*.md"]
exclude_patterns = [".*", "build", "out"]
extensions = [
    "myst_nb", "breathe", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "mathml", "cpp_source",
]  # fmt: skip
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
# Notebooks are run from top to bottom each time, by the package itself (scripts/docs), and an error
# in one is an error of the documentation.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_kernel_rgx_aliases = {"python3": "devlearn"}
nb_merge_streams = True
html_math_renderer = "mathml"
html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["devlearn.css"]
html_title = f"devlearn {release}"
html_copy_source = False
html_show_sphinx = False
html_show_search_summary = False  # which a page opened as a file may not read

# --- C++: the comments of the headers, as Doxygen reads them -----------------------------------
breathe_projects = {"devlearn": str(SOURCES / "xml")}
breathe_default_project = "devlearn"
breathe_show_include = False
cpp_index_common_prefix = ["devlearn::"]
suppress_warnings = ["duplicate_declaration.cpp"]  # the namespace, once a header

# --- Python: the package, its compiled module standing in as the stub that was written of it ----
autodoc_member_order = "bysource"
autodoc_mock_imports = [
    "PIL", "gymnasium", "matplotlib", "scipy", "shapely", "skimage", "tqdm", "yaml",
]  # fmt: skip
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
add_module_names = False
napoleon_use_ivar = True
default_role = "literal"  # for single backticks


def write_standin():
    """Copies the package to where it needs no compiled module, with the types a reader expects."""
    shutil.rmtree(SOURCES / "devlearn", ignore_errors=True)
    shutil.copytree(ROOT / "python" / "devlearn", SOURCES / "devlearn")
    stub = SOURCES / "devlearn" / "_core.pyi"
    text = stub.read_text(encoding="utf-8")
    for accepted, expected in (
        ("typing.SupportsFloat | typing.SupportsIndex", "float"),
        ("typing.SupportsIndex", "int"),
        ("typing.Annotated[numpy.typing.ArrayLike, numpy.float64]", "numpy.typing.ArrayLike"),
        ("import devlearn._types\nimport devlearn.record\n", ""),  # which import this
        ("devlearn._types.", "devlearn."),
        ("devlearn.record.Record", "devlearn.Record"),
    ):
        text = text.replace(accepted, expected)
    build = f'\n__version__ = "{release}"\nbox2d_version = commit = ""\n'
    stub.with_suffix(".py").write_text(text + build, encoding="utf-8")
    stub.unlink()


def write_parameters():
    """Writes a table of each configuration's fields, for docs/reference/parameters.rst."""
    docs = attributes()
    for cls in ast.parse(STUB.read_text(encoding="utf-8")).body:
        methods = {item.name: item for item in getattr(cls, "body", []) if hasattr(item, "name")}
        if "fields" not in methods:
            continue
        arguments = methods["__init__"].args
        with (SOURCES / f"{cls.name}.csv").open("w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(["field", "symbol", "default", "range", "meaning"])
            for argument, default in zip(arguments.args[1:], arguments.defaults):
                name, text = argument.arg, docs[cls.name][argument.arg]
                told = re.fullmatch(r"(?:(\S+): )?(.*); (.*)\.", text)
                symbol, meaning, allowed = told.groups("")
                rows.writerow([f"``{name}``", symbol, ast.unparse(default), allowed, meaning])


def as_rst(lines):
    """A docstring as reStructuredText, in which code that stands alone is announced."""
    return re.sub(r"(?m)^(\S.*)(?<!:)\n\n(?= )", r"\1\n\n::\n\n", "\n".join(lines)).split("\n")


def edit_docstring(app, what, name, documented, options, lines):
    """Refuses (with -W) a public name without a docstring."""
    if not any(lines):
        logging.getLogger(__name__).warning("%s has no docstring", name)
    if what in ("attribute", "property") and lines:
        # "eta: what it is": what stands before a colon is its symbol, no type to be linked to.
        lines[0] = re.sub(r"^([A-Za-z_]+): ", r"``\1``, ", lines[0])
    lines[:] = as_rst(lines)


def setup(app):
    """Called by Sphinx."""
    write_standin()
    write_parameters()
    sys.path.insert(0, str(SOURCES))
    app.connect("autodoc-process-docstring", edit_docstring, priority=400)
