"""Records in npz files: what is read is checked before anything large is unpacked."""

from __future__ import annotations

import json
import os
import stat
import zipfile
from collections.abc import Mapping
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from .errors import FileError

LONGEST_HEADER = 2**26  # letters: a world of a million corners has fewer
WHAT = "a record saved by devlearn"


def open_regular(name: str, what: str) -> IO[bytes]:
    """A regular file, opened to be read; pipes and devices may never end. Raises FileError."""
    try:
        descriptor = os.open(name, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
    except FileNotFoundError as error:
        raise FileError(name, "", "no such file", what) from error
    except (OSError, ValueError) as error:
        raise FileError(name, "", getattr(error, "strerror", None) or error, what) from error
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise FileError(name, "", "not a regular file", what)
    return os.fdopen(descriptor, "rb")


class Columns:
    """The arrays of an npz file, whose types and shapes are known before they are unpacked."""

    def __init__(self, file: IO[bytes], name: str, known: Mapping[str, Any]) -> None:
        """``known``: the arrays that may be in it. Raises FileError for any other."""
        self._name = name
        try:
            self._zip = zipfile.ZipFile(file)
        except (zipfile.BadZipFile, NotImplementedError, ValueError, OSError) as error:
            raise FileError(name, "", f"unreadable: {error}", WHAT) from error
        self._members: dict[str, zipfile.ZipInfo] = {}
        for info in self._zip.infolist():
            column = info.filename[:-4] if info.filename.endswith(".npy") else info.filename
            if column not in known or info.filename != column + ".npy":
                self.refuse(ascii(column)[1:-1], "an unknown column", ", ".join(known))
            if column in self._members or info.orig_filename != info.filename:
                self.refuse(column, "a second column of this name", "one")
            self._members[column] = info

    def __contains__(self, column: object) -> bool:
        return column in self._members

    def refuse(self, field: str, value: object, allowed: str) -> None:
        """Raises FileError."""
        raise FileError(self._name, field, value, allowed)

    def length(self, column: str) -> int:
        """How long an array is, by what stands before its values."""
        with self._open(column) as stream:
            dtype, shape = self._described(column, stream)
            if len(shape) != 1:
                self.refuse(column, f"{dtype} of shape {shape}", "an array of one dimension")
            return shape[0]

    def fields(self, column: str) -> tuple[str, ...]:
        """The names of the fields that each value of an array has."""
        with self._open(column) as stream:
            dtype, _ = self._described(column, stream)
            return dtype.names or ()

    def text(self, column: str) -> str:
        """A text, which stands in an array without dimensions."""
        with self._open(column) as stream:
            dtype, shape = self._described(column, stream)
            length = dtype.itemsize // 4
            if dtype.kind != "U" or shape != () or length > LONGEST_HEADER:
                self.refuse(
                    column, f"{dtype} of shape {shape}", f"a text of up to {LONGEST_HEADER} letters"
                )
            return str(self._values(column, stream, dtype, shape)[()])

    def array(
        self, column: str, dtype: np.dtype[Any], shape: tuple[int | None, ...]
    ) -> npt.NDArray[Any]:
        """An array of this type and shape; None: any length. In whichever byte order."""
        with self._open(column) as stream:
            found, lengths = self._described(column, stream)
            fits = len(lengths) == len(shape) and all(
                s in (None, n) for s, n in zip(shape, lengths)
            )
            if found.newbyteorder("=") != dtype or not fits:
                wanted = "(" + ", ".join("any" if n is None else str(n) for n in shape) + ")"
                self.refuse(column, f"{found} of shape {lengths}", f"{dtype} of shape {wanted}")
            return self._values(column, stream, found, lengths).astype(dtype, copy=False)

    def _open(self, column: str) -> IO[bytes]:
        if column not in self._members:
            self.refuse(column, "no such column", "one")
        try:
            return self._zip.open(self._members[column])
        except Exception as error:  # encrypted, packed in another way, or no zip after all
            raise FileError(self._name, column, f"unreadable: {error}", WHAT) from error

    def _described(self, column: str, stream: IO[bytes]) -> tuple[np.dtype[Any], tuple[int, ...]]:
        try:
            version = np.lib.format.read_magic(stream)
            read = {
                (1, 0): np.lib.format.read_array_header_1_0,
                (2, 0): np.lib.format.read_array_header_2_0,
            }[version]
            shape, in_columns, dtype = read(stream)
        except Exception as error:  # zlib, struct, tokenize and numpy each have their own
            raise FileError(self._name, column, "no numpy array", WHAT) from error
        if dtype.hasobject or (in_columns and len(shape) > 1):
            self.refuse(column, f"{dtype}, row after row: {not in_columns}", "plain values in rows")
        return dtype, shape

    def _values(
        self, column: str, stream: IO[bytes], dtype: np.dtype[Any], shape: tuple[int, ...]
    ) -> npt.NDArray[Any]:
        count = int(np.prod(shape, dtype=object))
        size = count * dtype.itemsize
        # What the directory says of its size is what unpacking is held to, too.
        if not size <= self._members[column].file_size <= size + 2**16:
            self.refuse(column, f"{self._members[column].file_size} bytes", f"about {size}")
        try:
            content = stream.read(size + 1)
        except Exception as error:  # zlib and zipfile have their own
            raise FileError(self._name, column, f"unreadable: {error}", WHAT) from error
        if len(content) != size:
            self.refuse(column, f"{len(content)} bytes", f"{size}, as its shape says")
        return np.frombuffer(bytearray(content), dtype, count).reshape(shape)


def json_object(text: str, name: str, field: str) -> dict[str, Any]:
    """An object of JSON that says everything once. Raises FileError."""

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        values = dict(pairs)
        if len(values) < len(pairs):
            raise ValueError("a name twice in one object")
        return values

    try:
        found = json.loads(text, object_pairs_hook=once)
    except (ValueError, RecursionError) as error:
        raise FileError(name, field, f"unreadable: {error}", "an object of JSON") from error
    if not isinstance(found, dict):
        raise FileError(name, field, type(found).__name__, "an object of JSON")
    return found
