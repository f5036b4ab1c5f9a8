"""Area-weighted vertex normals of a mesh that keeps its triangles: every face that is drawn needs them anew."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy import sparse

if TYPE_CHECKING:
    from numpy.typing import NDArray


class NormalField:
    """Area-weighted vertex normals: cross products, then one sparse sum, a coordinate at a time.

    Coordinates lie apart in memory: numpy works on neighbours in memory many at a time.
    """

    def __init__(self, triangles: NDArray[np.int32], vertex_count: int) -> None:
        """Take (T, 3) triangles over ``vertex_count`` vertices."""
        count = len(triangles)
        entries = np.ones(3 * count, np.float32)
        columns = np.repeat(np.arange(count, dtype=np.int32), 3)
        # All first corners, then all second ones, then all third ones.
        self._corners = np.ascontiguousarray(triangles.T, np.intp).ravel()
        self._incidence = sparse.csr_array(
            (entries, (triangles.ravel().astype(np.int32), columns)), shape=(vertex_count, count)
        )

    def __call__(self, mesh: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return (N, 3) float32 unit normals of (N, 3) vertices; zero where a vertex has no area around it."""
        place = np.ascontiguousarray(mesh.T).take(self._corners, axis=1).reshape(3, 3, -1)
        x, y, z = place[:, 1:] - place[:, :1]
        normals = np.empty((3, len(mesh)), np.float32)
        for row, (a, b) in enumerate(((y, z), (z, x), (x, y))):
            crossed = a[0] * b[1] - b[0] * a[1]
            normals[row] = self._incidence @ crossed.astype(np.float32, copy=False)
        squares = normals * normals
        normals /= np.maximum(np.sqrt(squares[0] + squares[1] + squares[2]), 1e-12)
        unit: NDArray[np.float32] = normals.T
        return unit
