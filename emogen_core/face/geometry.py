"""How much of the face every gene moves, and which genes move the same: what a search may know of a rig."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Geometry:
    """The genes of a rig as movements of the mesh, correctives left out.

    Compared and hashed by identity, as the rig that it belongs to.

    Attributes:
        multiplicities: (G,) how many shapes a gene drives: 2 for a left/right pair.
        products: (G, G) inner products of the genes' offsets, in square millimetres, summed over the vertices.
    """

    multiplicities: NDArray[np.float64]
    products: NDArray[np.float64]


def gene_geometry(gene_to_core: NDArray[np.floating], offsets: NDArray[np.floating]) -> Geometry:
    """Return the geometry of genes.

    Args:
        gene_to_core: (G, C) which core shapes a gene drives.
        offsets: (C or more, N, 3) offsets of the shapes, core shapes first, in millimetres.
    """
    drives = np.asarray(gene_to_core, np.float64)
    core = np.asarray(offsets[: drives.shape[1]], np.float64).reshape(drives.shape[1], -1)
    moved = drives @ core
    return Geometry(drives.sum(axis=1), moved @ moved.T)
