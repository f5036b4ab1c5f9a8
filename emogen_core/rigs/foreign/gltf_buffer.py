"""The buffer of a glTF file that is being written: arrays go in, accessors come out, aligned to four bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963

# The largest 16-bit index would mean a restart.
_SHORT = 65535


class Buffer:
    """Bytes, the views on them and the accessors of these."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: NDArray[Any], kind: str, *, bounds: bool = False) -> int:
        """Add (n,) or (n, width) numbers as floats of vertices, with min and max if asked; return the accessor."""
        floats = values.astype("<f4")
        accessor = {
            "bufferView": self._view(floats, ARRAY_BUFFER),
            "componentType": FLOAT,
            "count": len(floats),
            "type": kind,
        }
        return self._accessor(accessor | (_bounds(floats) if bounds else {}))

    def add_indices(self, triangles: NDArray[np.int64]) -> int:
        """Add (t, 3) triangles; return the accessor."""
        values, component = _indices(triangles.ravel())
        view = self._view(values, ELEMENT_ARRAY_BUFFER)
        return self._accessor({"bufferView": view, "componentType": component, "count": len(values), "type": "SCALAR"})

    def add_sparse(self, offsets: NDArray[np.float32]) -> int:
        """Add (n, 3) offsets, of which only the rows that are not zero are kept; return the accessor."""
        floats = offsets.astype("<f4")
        rows = np.flatnonzero(floats.any(axis=1))
        # A sparse accessor has at least one row.
        rows = rows if len(rows) else np.zeros(1, np.int64)
        index, component = _indices(rows)
        sparse = {
            "count": len(rows),
            "indices": {"bufferView": self._view(index), "componentType": component},
            "values": {"bufferView": self._view(floats[rows])},
        }
        accessor = {"componentType": FLOAT, "count": len(floats), "type": "VEC3", "sparse": sparse}
        return self._accessor(accessor | _bounds(floats))

    def _accessor(self, accessor: dict[str, Any]) -> int:
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def _view(self, values: NDArray[Any], target: int | None = None) -> int:
        self.data += b"\0" * (-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": values.nbytes}
        self.views.append(view if target is None else view | {"target": target})
        self.data += values.tobytes()
        return len(self.views) - 1


def _indices(values: NDArray[np.int64]) -> tuple[NDArray[Any], int]:
    short = values.max(initial=0) < _SHORT
    return values.astype("<u2" if short else "<u4"), UNSIGNED_SHORT if short else UNSIGNED_INT


def _bounds(values: NDArray[Any]) -> dict[str, list[float]]:
    return {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
