"""What Doxygen reads of a header: the same, with a comment on each field of a Def or a Step.

What a field is stands once, in what the header says of its fields. The compiled module's docstrings
are made of that, and its stub of them; of what Python does not have, it is read from the header.
"""

import ast
import re
import sys
from pathlib import Path

STUB = Path(__file__).resolve().parents[1] / "python" / "devlearn" / "_core.pyi"


def attributes():
    """Docstrings of properties, by class and name."""
    return {
        cls.name: {
            item.name: " ".join((ast.get_docstring(item) or "").split())
            for item in cls.body
            if isinstance(item, ast.FunctionDef) and item.decorator_list and item.args.args
        }
        for cls in ast.parse(STUB.read_text(encoding="utf-8")).body
        if isinstance(cls, ast.ClassDef)
    }


def described(header):
    """What the header says of fields, by struct and name: the last text of each."""
    fields = {}
    for struct, body in re.findall(
        r"^struct (\w+) \{$(.*?)^\};$", header, re.DOTALL | re.MULTILINE
    ):
        for name, rest in re.findall(
            r'\b(?:row_)?field\("(\w+)",(.*?)\)(?=,\s*(?:later\(|row_)?field|\)?[;}])',
            body,
            re.DOTALL,
        ):
            doc = re.findall(r'"((?:[^"]|"\s+")*)"', rest)[-1]
            fields.setdefault(struct, {})[name] = re.sub(r'"\s+"', "", doc)
    return fields


def commented(header):
    """The header's lines."""
    docs, struct = described(header) | attributes(), ""
    for line in header.splitlines():
        if match := re.match(r"struct (\w+) \{|\}", line):
            struct = match[1]
        member = re.fullmatch(r"  [\w:<>]+(?:, [\w:<>]+)* (\w+)( = [^;]*|\{[^;]*\})?;", line)
        doc = member and docs.get(struct, {}).get(member[1])
        yield f"{line}  ///< {doc}" if doc else line


if __name__ == "__main__":
    print(*commented(Path(sys.argv[1]).read_text(encoding="utf-8")), sep="\n")
