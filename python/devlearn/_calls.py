"""What is wrong with a call that fits no signature of the compiled module."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from .errors import WrongType

_NOT_HERE = object()
_MOST = 160  # letters of a value that are shown

# What makes an object of a class that many give something else for.
_MADE_BY = {"World": "World.load(name)", "Robot": "Robot(world)", "Trial": "Trial(world)"}


class Argument(NamedTuple):
    """Of a signature: its name, the text of its type, and how it may be given."""

    name: str
    kind: str
    optional: bool = False
    by_name: bool = False


def path_text(path: object) -> str:
    """A path as text. Raises WrongType for what is none."""
    if not isinstance(path, (str, bytes, os.PathLike)):
        raise WrongType("path", shown(path), "text, bytes or an os.PathLike")
    return os.fsdecode(path)


def explain(
    message: str, values: tuple[Any, ...], named: Mapping[str, Any], owner: str = ""
) -> None:
    """Raises WrongType for what is wrong; returns where the message is of something else.

    ``message`` is pybind11's, with all signatures; ``values`` and ``named`` are what was given;
    ``owner`` is the class of a static method, which the message leaves out.
    """
    head, _, rest = message.partition("\n")
    if " arguments. The following argument types are supported" not in head:
        return
    made = "incompatible constructor arguments" in head
    name = "" if made else head.partition("(")[0]
    if owner:
        name = f"{owner}.{name}"
    signatures = [name + s for s in re.findall(r"^    \d+\. (.+)$", rest, re.MULTILINE)]
    faults = [_fault(signature, made, values, named) for signature in signatures]
    # Of several signatures, that which is wrong the latest is the one that was meant.
    found = max((fault for fault in faults if fault is not None), default=None, key=lambda f: f[0])
    if found is None:
        called, taken = _parsed(signatures[0], made)
        # What is being made is not to be looked at yet.
        given = values[1:] if made else values
        listed = ", ".join([*map(shown, given), *(f"{n}={shown(v)}" for n, v in named.items())])
        raise WrongType(called, f"({listed})", ", ".join(f"{a.name}: {a.kind}" for a in taken))
    _, quantity, value, wanted = found
    raise WrongType(quantity, value, wanted)


def _fault(
    signature: str, made: bool, values: tuple[Any, ...], named: Mapping[str, Any]
) -> tuple[int, str, str, str] | None:
    called, taken = _parsed(signature, made)
    if called.startswith("object.") and values:
        called = f"{type(values[0]).__name__}.{called[len('object.') :]}"
    names = [argument.name for argument in taken]
    given = values if not made and "self" not in signature.partition(",")[0] else values[1:]
    placed = [argument.name for argument in taken if not argument.by_name]
    if len(given) > len(placed):
        listed = f"at most {len(placed)}: {', '.join(placed)}" if placed else "none"
        return 0, called, f"{len(given)} arguments", listed
    for name, value in named.items():
        if name not in names:
            return 0, f"{called}.{name}", shown(value), _instead(name, called, names)
        if name in names[: len(given)]:
            return 0, f"{called}.{name}", "two values", "one"
    bound = dict(zip(names, given)) | dict(named)
    for place, argument in enumerate(taken):
        value = bound.get(argument.name, _NOT_HERE)
        if value is _NOT_HERE and argument.optional:
            continue
        if value is _NOT_HERE or not _fits(value, argument):
            got = "nothing" if value is _NOT_HERE else shown(value)
            return place + 1, f"{called}.{argument.name}", got, _wanted(argument)
    return None


def _parsed(signature: str, made: bool) -> tuple[str, list[Argument]]:
    name, _, rest = signature.partition("(")
    arguments, by_name = [], False
    for text in _split(rest[: _closing(rest)], ","):
        argument, _, kind = text.partition(":")
        if argument.strip() in ("*", "/"):
            by_name = argument.strip() == "*"
            continue
        parts = [*_split(kind, "="), "object"]
        arguments.append(Argument(argument.strip(), parts[0].strip(), len(parts) > 2, by_name))
    if made:
        return name.rpartition(".")[2], arguments
    if arguments and arguments[0].name == "self":
        owner = arguments.pop(0)
        name = f"{owner.kind.rpartition('.')[2]}.{name}"
    return name, arguments


def _closing(text: str) -> int:
    depth = 0
    for place, letter in enumerate(text):
        depth += (letter in "([{") - (letter in ")]}")
        if depth < 0:
            return place
    return len(text)


def _split(text: str, by: str) -> list[str]:
    """The parts between ``by`` that stand in no brackets and no quotes."""
    parts, depth, quote = [""], 0, ""
    for letter in text:
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        depth += 0 if quote else (letter in "([{") - (letter in ")]}")
        if letter == by and depth == 0 and not quote:
            parts.append("")
        else:
            parts[-1] += letter
    return [part for part in parts if part.strip()]


# --- types, by the text that signatures have for them ---------------------------------------------


def _options(kind: str) -> Iterator[str]:
    for option in _split(kind, "|"):
        yield option.strip()


def _fits(value: object, argument: Argument) -> bool:
    return any(_fits_one(value, option, argument) for option in _options(argument.kind))


def _fits_one(value: object, kind: str, argument: Argument) -> bool:
    if kind in ("typing.SupportsFloat", "float"):
        return hasattr(value, "__float__") and not isinstance(value, np.ndarray)
    if kind in ("typing.SupportsIndex", "typing.SupportsInt", "int"):
        return hasattr(value, "__index__") and not isinstance(value, np.ndarray)
    if kind == "bool":
        return isinstance(value, (bool, np.bool_))
    if kind == "None":
        return value is None
    if kind in ("str", "bytes", "dict"):
        return isinstance(value, {"str": str, "bytes": bytes, "dict": dict}[kind])
    if kind.startswith("collections.abc.Callable"):
        return callable(value)
    if kind.startswith("collections.abc.Sequence["):
        return _is_sequence(value, kind[len("collections.abc.Sequence[") : -1], argument)
    if kind.startswith("devlearn."):
        return type(value).__name__ == kind.rpartition(".")[2] or any(
            base.__name__ == kind.rpartition(".")[2] for base in type(value).__mro__
        )
    if "ArrayLike" in kind or "NDArray" in kind:
        try:
            return np.asarray(value).dtype.kind in "biuf"
        except (TypeError, ValueError):
            return False
    return True


def _is_sequence(value: object, element: str, argument: Argument) -> bool:
    if isinstance(value, (str, bytes)) or not isinstance(value, (Sequence, np.ndarray)):
        return False
    numbers = _numbers(argument)
    if element == "float" and numbers and len(value) != numbers:
        return False
    return all(_fits(one, _one_of(argument, element)) for one in value)


def _one_of(argument: Argument, kind: str) -> Argument:
    one = {"holes": "corners", "corners": "corner", "points": "corner"}
    return Argument(one.get(argument.name, ""), kind)


def _numbers(argument: Argument) -> int:
    """How many numbers a point or a pose is."""
    return {
        "pose": 3,
        "start": 3,
        "target": 2,
        "center": 2,
        "origin": 2,
        "size": 2,
        "corner": 2,
    }.get(argument.name, 0)


def _wanted(argument: Argument) -> str:
    options = list(dict.fromkeys(_in_words(o, argument) for o in _options(argument.kind)))
    return " or ".join(options)


def _in_words(kind: str, argument: Argument) -> str:
    words = {
        "typing.SupportsFloat": "a number",
        "typing.SupportsInt": "a whole number",
        "float": "a number",
        "int": "a whole number",
        "bool": "True or False",
        "str": "a str",
        "bytes": "bytes",
        "dict": "a dict",
        "None": "None",
        "numpy.ndarray": "an array",
    }
    if kind == "typing.SupportsIndex":
        return "a number" if "typing.SupportsFloat" in argument.kind else "a whole number"
    if kind in words:
        return words[kind]
    if kind in ("object", "typing.Any"):
        return "a path" if argument.name == "path" else "a value"
    if kind.startswith("collections.abc.Sequence[float"):
        numbers = _numbers(argument)
        return {
            2: "two numbers, x and y",
            3: "three numbers: x, y [m] and heading [degrees]",
        }.get(numbers, "numbers")
    if kind.startswith("collections.abc.Sequence["):
        inner = _one_of(argument, kind[len("collections.abc.Sequence[") : -1])
        return f"a list, each {_wanted(inner)}"
    if kind.startswith("collections.abc.Callable"):
        return "a function"
    if kind.startswith("devlearn."):
        name = kind.rpartition(".")[2]
        hint = f", as {_MADE_BY[name]} makes" if name in _MADE_BY else ""
        return f"{'an' if name[0] in 'AEIOU' else 'a'} {name}{hint}"
    if "ArrayLike" in kind or "NDArray" in kind:
        return "numbers" if "bool" not in kind else "bools"
    return kind


def _instead(name: str, called: str, names: list[str]) -> str:
    from . import _core

    for other in (_core.LearnerConfig, _core.StateEvaluation, _core.RobotDef, _core.TrialConfig):
        if name in other.fields() and other.__name__ != called:
            return (
                f"no argument of this name, which is a field of {other.__name__}; {_listed(names)}"
            )
    return f"no argument of this name; {_listed(names)}"


def _listed(names: list[str]) -> str:
    return f"there are {', '.join(names)}" if names else "there are none"


def shown(value: object) -> str:
    """A value as it may stand in a message."""
    try:
        text = repr(value)
    except Exception:  # a repr of the caller's
        text = f"a {type(value).__name__}"
    return text if len(text) <= _MOST else text[:_MOST] + "..."
