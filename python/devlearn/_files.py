"""Folders that are written to, and the package's own files."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

from . import _core
from .errors import FileError


def made_folder(path: str | os.PathLike[str]) -> Path:
    """The folder, made where it is missing. Raises FileError where nothing can be put into it."""
    folder = Path(path)
    allowed = "a folder that can be made and written to"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(str(folder), "", error.strerror, allowed) from error
    if not os.access(folder, os.W_OK | os.X_OK):
        raise FileError(str(folder), "", "no permission to write", allowed)
    return folder


def code_fingerprint() -> str:
    """A hash of all code that a result depends on."""
    digest = hashlib.sha256()
    package = Path(__file__).parent
    for file in [Path(_core.__file__), *sorted(package.rglob("*.py"))]:
        digest.update(file.read_bytes())
    return digest.hexdigest()
