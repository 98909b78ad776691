"""Quotes a function from the C++ sources when the documentation is built.

    ```{cpp-source} cpp/core/src/motor_memory.cpp MotorMemory::extend
    ```

It is found by its name, with the comment above it. One that is not there any more, or that has an
overload beside it, is an error.
"""

import re
from pathlib import Path

from sphinx.directives.code import LiteralInclude

ROOT = Path(__file__).resolve().parents[2]


def lines_of(text, name):
    """The first and last line of a function's definition, from 1, as clang-format sets it."""
    definition = re.compile(rf"^( *)[\w:<>&*, ]*(?<![\w:]){re.escape(name)}\([^;{{]*\{{", re.M)
    found = list(definition.finditer(text))
    if len(found) != 1:
        raise ValueError(f"{len(found)} definitions of {name}")
    lines = text.split("\n")
    first = last = text.count("\n", 0, found[0].start(1))
    opened = text.count("\n", 0, found[0].end() - 1)
    while first > 0 and re.match(r" *(//|template <)", lines[first - 1]):
        first -= 1
    last = opened
    if not lines[opened].endswith("}"):
        last = lines.index(found[0][1] + "}", opened)
    return first + 1, last + 1


class CppSource(LiteralInclude):
    """literalinclude of a file and the name of a function in it."""

    required_arguments = 2
    final_argument_whitespace = False

    def run(self):
        path, name = self.arguments
        try:
            first, last = lines_of((ROOT / path).read_text(encoding="utf-8"), name)
        except (OSError, ValueError) as error:
            raise self.error(f"cpp-source: {path}: {error}") from error
        self.arguments = [f"/{path}"]
        self.options |= {"lines": f"{first}-{last}", "language": "cpp", "caption": path}
        self.options["dedent"] = None
        return super().run()


def setup(app):
    """Called by Sphinx."""
    app.add_directive("cpp-source", CppSource)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
