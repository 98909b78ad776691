"""What is said to people: whatever becomes of it, what was written stays written."""

from __future__ import annotations

import contextlib
import os
import sys
from typing import TextIO


def prepare() -> None:
    """Makes the streams such that nothing that is said can fail for its letters.

    A stream that was closed before leads nowhere; its number must not become a file's.
    """
    while (number := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(number)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115 - as long as the process
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")


def say(text: object) -> None:
    """A line for who asked. Where nobody can read it any more, it is dropped."""
    _write(sys.stdout, text)


def warn(text: object) -> None:
    """A line about what went wrong, or may."""
    _write(sys.stderr, text)


def passing(text: str) -> None:
    """How far things are, on a terminal: the next takes the place of this, "" leaves nothing."""
    if sys.stderr.isatty():
        _put(sys.stderr, "\r\33[K" + printable(text))


def printable(text: str) -> str:
    """The text with all that could steer a terminal written out."""
    return "".join(
        letter if letter == "\n" or letter.isprintable() else ascii(letter)[1:-1] for letter in text
    )


def _write(stream: TextIO, text: object) -> None:
    _put(stream, printable(str(text)) + "\n")


def _put(stream: TextIO, text: str) -> None:
    try:
        stream.write(text)
        stream.flush()
    except (OSError, ValueError):
        # The reader has left, as `head` does, or the disk is full. What is still in the stream
        # must not fail again when the process ends.
        with contextlib.suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, stream.fileno())
            os.close(nowhere)
