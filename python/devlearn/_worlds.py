from __future__ import annotations

import os
from pathlib import Path

from ._calls import path_text
from .errors import FileError

_FOLDER = Path(__file__).parent / "worlds"


def worlds() -> list[str]:
    """Names of the worlds that ship, for ``World.load``."""
    return sorted(path.stem for path in _FOLDER.glob("*.json"))


def path_of(path_or_name: str | os.PathLike[str]) -> str:
    """The file that a path, or the name of a world that ships, stands for."""
    text = path_text(path_or_name)
    if text in worlds() and not os.path.isfile(text):
        return str(_FOLDER / f"{text}.json")
    if text.endswith((".yaml", ".yml")):
        raise FileError(
            text,
            "",
            "a YAML",
            "a world in JSON: World.from_ros_map, or devlearn world import, makes one of a map",
        )
    if os.path.exists(text):
        return text
    raise FileError(text, "", "no such file", f"a world file, or one of {', '.join(worlds())}")
