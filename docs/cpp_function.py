"""Finds a function in the C++ sources; the documentation quotes it."""

import re


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
