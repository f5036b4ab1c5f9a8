"""Accessors of glTF 2.0 as arrays: strides, sparse ones, whole numbers that mean fractions (chapters 3.6 and 5.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
MAX_COUNT = 2_000_000


class Accessors:
    """The accessors of one document over its buffers; ``name`` is that of the file, for messages."""

    def __init__(self, document: dict[str, Any], buffers: Sequence[bytes], name: str) -> None:
        self._accessors = document.get("accessors", [])
        self._views = document.get("bufferViews", [])
        self._buffers = buffers
        self._name = name

    def read(self, index: int, kind: str) -> NDArray[Any]:
        """Return an accessor as (count, width) array; normalised whole numbers become fractions.

        Args:
            index: of the accessor.
            kind: the type that it must have, as ``VEC3``.

        Raises:
            InvalidInputError: there is none, it is of another type or too long, or reaches out of its buffer.
        """
        accessor = self._item(self._accessors, index, "accessor")
        count, component = accessor["count"], accessor["componentType"]
        if accessor["type"] != kind or component not in COMPONENTS or not 0 <= count <= MAX_COUNT:
            found = f"{accessor['type']} of {component}, {count} long"
            raise InvalidInputError(
                f"{self._name}: accessor {index}: {expected(f'{kind}, at most {MAX_COUNT}', found)}"
            )
        values = self._elements(accessor, count, component, WIDTHS[kind])
        if "sparse" in accessor:
            self._substitute(values, accessor["sparse"], component)
        return _fractions(values) if accessor.get("normalized") else values

    def _elements(self, place: dict[str, Any], count: int, component: int, width: int) -> NDArray[Any]:
        """Return a copy of the elements that a view holds from an offset on; zeros where there is no view."""
        dtype = np.dtype(COMPONENTS[component])
        if "bufferView" not in place:
            return np.zeros((count, width), dtype)
        view = self._item(self._views, place["bufferView"], "bufferView")
        buffer = self._item(self._buffers, view["buffer"], "buffer")
        start, own = view.get("byteOffset", 0), place.get("byteOffset", 0)
        stride = view.get("byteStride", dtype.itemsize * width)
        end = own + stride * (count - 1) + dtype.itemsize * width if count else own
        self._check_range(min(start, own, stride - 1), end, view["byteLength"], "a bufferView")
        self._check_range(start, start + view["byteLength"], len(buffer), "a buffer")
        return np.ndarray((count, width), dtype, buffer, start + own, (stride, dtype.itemsize)).copy()

    def _substitute(self, values: NDArray[Any], sparse: dict[str, Any], component: int) -> None:
        count, where, what = sparse["count"], sparse["indices"], sparse["values"]
        self._check_range(0, count, len(values), "a sparse accessor")
        rows = self._elements(where, count, where["componentType"], 1)[:, 0]
        if len(rows):
            self._check_range(0, int(rows.max()) + 1, len(values), "a sparse accessor")
        values[rows] = self._elements(what, count, component, values.shape[1])

    def _check_range(self, low: int, end: int, length: int, what: str) -> None:
        if low < 0 or end > length:
            raise InvalidInputError(f"{self._name}: {what}: {expected(f'a range within {length}', (low, end))}")

    def _item(self, items: Sequence[Any], index: int, what: str) -> Any:
        if not 0 <= index < len(items):
            raise InvalidInputError(f"{self._name}: {what}: {expected(f'a number below {len(items)}', index)}")
        return items[index]


def _fractions(values: NDArray[Any]) -> NDArray[np.float64]:
    """Return normalised integers as fractions of their largest; the lowest of signed ones counts as -1."""
    if values.dtype.kind == "f":
        return values.astype(np.float64)
    return np.maximum(values / np.iinfo(values.dtype).max, -1)
