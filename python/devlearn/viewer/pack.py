"""What a page shows, as few bytes: a header of JSON and columns of numbers, deflated."""

from __future__ import annotations

import base64
import json
import math
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

Numbers = npt.NDArray[Any]


class Packer:
    """Columns, and the header that tells of them; ``unpack.js`` reads both."""

    def __init__(self) -> None:
        self._columns: list[dict[str, Any]] = []
        self._content: list[bytes] = []

    def floats(self, name: str, values: npt.ArrayLike, width: int = 8) -> None:
        """Floats of so many bytes, 4 or 8, as they are."""
        column = np.ascontiguousarray(values, dtype=f"<f{width}")
        self._add(name, column.size, width, 0, column.tobytes())

    def whole(self, name: str, values: npt.ArrayLike, stride: int = 1) -> None:
        """Whole numbers in [0, 2^32 - 1], each as what it adds to the one ``stride`` before it."""
        column = np.ascontiguousarray(values).ravel()
        most = int(column.max(initial=0))
        width = 1 if most < 2**8 else 2 if most < 2**16 else 4
        self._changes(name, column.astype(f"<u{width}"), stride, {})

    def parts(
        self, name: str, values: npt.ArrayLike, low: float, high: float, stride: int = 1
    ) -> None:
        """Numbers in [low, high], to within 1/131070 of that; others, too, become some of these."""
        wide = max(high - low, np.finfo(float).tiny)
        share = np.nan_to_num((np.asarray(values) - low) / wide)
        parts = np.rint(65535 * np.clip(share, 0, 1))
        self._changes(name, parts.ravel().astype("<u2"), stride, {"low": low, "high": high})

    def _changes(self, name: str, column: Numbers, stride: int, told: Mapping[str, float]) -> None:
        change = column.copy()
        change[stride:] -= column[:-stride]  # wraps, as unsigned numbers do
        width = column.itemsize
        planes = change.view(np.uint8).reshape(-1, width).T
        self._add(name, column.size, width, stride, planes.tobytes(), told)

    def _add(
        self, name: str, count: int, width: int, stride: int, content: bytes,
        told: Mapping[str, float] | None = None,
    ) -> None:  # fmt: skip
        about = {"name": name, "count": count, "width": width, "stride": stride}
        self._columns.append({**about, **(told or {})})
        self._content.append(content)

    def text(self, header: Mapping[str, Any]) -> str:
        """Header and columns as base64. What is not finite in the header becomes null."""
        told = json.dumps(_finite({**header, "columns": self._columns}), allow_nan=False).encode()
        packer = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
        packed = [packer.compress(len(told).to_bytes(4, "little") + told)]
        packed += [packer.compress(content) for content in self._content]
        return base64.b64encode(b"".join([*packed, packer.flush()])).decode()


def _finite(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {str(name): _finite(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(inner) for inner in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
