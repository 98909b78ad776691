"""Fields of a configuration by dotted names, such as ``robot.speed``."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, TypeVar

from ._calls import shown
from .errors import InvalidValue, WrongType


def unknown(quantity: str, name: object, known: Iterable[str]) -> InvalidValue:
    """The refusal of a name that is none of the known ones; says which may have been meant."""
    names = list(known)
    near = difflib.get_close_matches(str(name), names, 1)
    meant = f"{near[0]!r}, or another of " if near else "one of "
    return InvalidValue(quantity, shown(name), meant + ", ".join(names) if names else "none")


def field_names(fields: Mapping[str, Any], outer: str = "") -> Iterator[str]:
    """The names of all fields of a configuration, which is given by its to_dict()."""
    for name, value in fields.items():
        if isinstance(value, dict):
            yield from field_names(value, f"{outer}{name}.")
    # `kind` says which class a dict stands for, and is no field of it.
    yield from (outer + n for n, v in fields.items() if not isinstance(v, dict) and n != "kind")


Config = TypeVar("Config")


def changed(config: Config, changes: Mapping[str, Any], owner: str = "") -> Config:
    """The same configuration with some fields changed, by their dotted names.

    ``owner`` is what they are fields of, to be named where one is refused.

    Raises InvalidValue for a field that there is not and a value out of its range, WrongType for
    one of another type.
    """
    whole: Any = config
    fields = whole.to_dict()
    known = list(field_names(fields))
    for name, value in changes.items():
        if name not in known:
            raise unknown(owner or "field", name, known)
        *outer, last = name.split(".")
        place, of = fields, whole
        for part in outer:
            place, of = place[part], getattr(of, part)
        field = of.fields()[last]
        place[last] = value
        try:
            if isinstance(value, bool) and not isinstance(field["default"], bool):
                raise TypeError  # to Python true is a number, too
            of.from_dict({last: value})
        except TypeError as error:
            raise WrongType(
                f"{owner}.{name}" if owner else name, shown(value), field["range"]
            ) from error
        except InvalidValue:
            pass  # it may be right with the others
    return whole.from_dict(fields)  # type: ignore[no-any-return]
