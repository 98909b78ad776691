"""Quotes a function from the C++ sources when the documentation is built.

    ```{cpp-source} cpp/core/src/motor_memory.cpp MotorMemory::extend
    ```

It is found by its name, with the comment above it. One that is not there any more, or that has an
overload beside it, is an error.
"""

from pathlib import Path

from cpp_function import lines_of
from sphinx.directives.code import LiteralInclude

ROOT = Path(__file__).resolve().parents[2]


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
