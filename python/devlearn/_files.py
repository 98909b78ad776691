"""Folders that are written to, and the package's own files."""

from __future__ import annotations

import fcntl
import hashlib
import os
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
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


LOCK = ".devlearn-lock"


@contextmanager
def owned_folder(path: str | os.PathLike[str]) -> Iterator[Path]:
    """The folder, made where it is missing, for this process alone while the context lasts.

    Raises FileError, saying who has it, where another process does.
    """
    folder = made_folder(path)
    allowed = "a folder that nobody else writes to: wait for it, or choose another --output"
    with locked(folder / LOCK, str(folder), allowed):
        yield folder


@contextmanager
def locked(lock: Path, owned: str, allowed: str) -> Iterator[None]:
    """For this process alone while the context lasts: what the lock, a file, stands for.

    The lock is the system's and ends with its process, however that ends. Raises FileError of
    ``owned``, saying who has it, where another process does.
    """
    while True:
        try:
            held = os.open(lock, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o666)
        except OSError as error:
            raise FileError(str(lock), "", error.strerror, "a file that can be made") from error
        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            owner = os.pread(held, 200, 0).decode(errors="replace") or "another process"
            os.close(held)
            raise FileError(owned, "", f"in use by {owner}", allowed) from error
        except OSError:  # a file system without locks: as good as it can be had there
            break
        # Whoever had it may have removed the file between our opening and our locking it.
        if _is_same_file(held, lock):
            break
        os.close(held)
    try:
        since = time.strftime("%Y-%m-%d %H:%M:%S")
        os.truncate(held, 0)
        os.write(held, f"process {os.getpid()} on {socket.gethostname()} since {since}".encode())
        yield
    finally:
        lock.unlink(missing_ok=True)
        os.close(held)


def _is_same_file(held: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(held), os.lstat(path))
    except FileNotFoundError:
        return False


def code_version() -> str:
    """A hash of what results depend on: the same wherever this version of devlearn is installed.

    Compiled code differs from machine to machine, and is known by its commit; where it was built
    from changed sources, by itself.
    """
    package = Path(__file__).parent
    files = sorted(package.rglob("*.py"), key=lambda file: file.relative_to(package).parts)
    if _core.commit == "unknown" or _core.commit.endswith("-dirty"):
        files.append(Path(_core.__file__))
    digest = hashlib.sha256(f"{_core.__version__} {_core.commit}".encode())
    for file in files:
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]
