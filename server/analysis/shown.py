"""Faces of an export by their id, or estimates by their trial: only those that are asked for become numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from ..services.errors import InvalidError
from ..services.participation.recorded_export import matrix

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from emogen_client import Export
    from emogen_core.face.rig import Rig

    Floats = NDArray[np.float64]


class Shown:
    """Some of the faces of an export.

    Args:
        export: what was recorded.
        rig: the face model.
        wanted: ids of the faces, or of trials.
        name: of the table, faces or estimates.
        key: the column of its ids.
    """

    def __init__(self, export: Export, rig: Rig, wanted: Iterable[str], name: str = "faces", key: str = "face") -> None:
        table = export.arrow(name)
        table = table.filter(pc.is_in(table[key], pa.array(sorted(set(wanted)), pa.string())))
        self._rig, self._table = rig, table
        self._place = {one: at for at, one in enumerate(table[key].to_pylist())}
        self._weights = matrix(table, "weight_", rig.shape_names)

    def genes(self, faces: Sequence[str]) -> Floats:
        """Return the (n, G) genes of faces.

        Raises:
            InvalidError: one is not in the table.
        """
        return matrix(self._table.take(self._at(faces)), "gene_", self._rig.gene_names)

    def __contains__(self, face: object) -> bool:
        """Return whether one is in the table."""
        return face in self._place

    def weights(self, faces: Sequence[str]) -> Floats:
        """Return the (n, K) weights of faces.

        Raises:
            InvalidError: one is not in the table.
        """
        return np.asarray(self._weights[self._at(faces)])

    def _at(self, faces: Sequence[str]) -> NDArray[np.intp]:
        missing = [face for face in faces if face not in self._place]
        if missing:
            raise InvalidError(f"faces: expected every face that a trial names, got none called {missing[0]}.")
        return np.array([self._place[face] for face in faces], np.intp)
