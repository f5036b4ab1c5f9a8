"""How good a face looks to somebody with another one in mind: two metrics, of which the answers tell the right one.

Symbols: ``A`` genes that the search may move, ``a`` a face, ``t`` a target, both (A,); ``<a, t>_Q = a^T Q t`` and
``|a|_Q^2 = <a, a>_Q``. Utilities, larger is better:

- *cosine*: ``<a, t>_M / (|a|_M |t|_M)``, 0 for the neutral face, with M the diagonal of how many shapes a gene drives,
  so that the two sides of a face count as they do in eq. 12 of EmoGen 2021;
- *vertex*: ``-|a - t|_V / |t|_V``, with V the inner products of the meshes' offsets (eq. 13), -1 for the neutral face.

Both are functions of the inner products of faces with a target, so a changed gene of a target costs one
multiplication and one addition a face. Combinational correctives are not in the model: faces are linear here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.params import SearchParams

    Floats = NDArray[np.float64]
    Singles = NDArray[np.float32]

COSINE, VERTEX = 0, 1
METRICS = 2
LEAST_SQUARE = 1e-9
"""A target with a smaller square has no direction; this stands in for the square of an empty one."""


@dataclass(frozen=True, eq=False)
class Space:
    """The genes that a search may move, with both inner products.

    Attributes:
        products: (2, A, A) M and V, symmetrical, V scaled to the trace of M.
    """

    products: Floats

    @property
    def genes(self) -> int:
        """A."""
        return int(self.products.shape[-1])

    @property
    def multiplicities(self) -> Floats:
        """(A,) diagonal of M."""
        return np.asarray(np.diagonal(self.products[COSINE]))

    def squares(self, metric: NDArray[np.intp], faces: Floats) -> Floats:
        """Return the (B,) squared norms of (B, A) faces, each under its own metric."""
        images = np.where(metric[:, None] == COSINE, faces * self.multiplicities, faces @ self.products[VERTEX])
        return np.asarray((images * faces).sum(axis=1))


def space_of(params: SearchParams) -> Space:
    """Return the space of a search; without a rig every gene drives one shape, at right angles to all others."""
    active = np.array(params.active)
    if params.geometry is None:
        return Space(np.stack([np.eye(len(active))] * METRICS))
    multiplicities = params.geometry.multiplicities[active]
    vertices = params.geometry.products[np.ix_(active, active)]
    scaled = vertices * (multiplicities.sum() / np.trace(vertices))
    return Space(np.stack([np.diag(multiplicities), scaled]))


@dataclass(frozen=True, eq=False)
class Shown:
    """Faces that targets are compared with, prepared: `F` faces of each of `R` searches.

    Attributes:
        features: (F, 2, R, A) what a unit of a gene adds to the product of face and target, by metric and search.
        squares: (F, R) squared vertex norms.
    """

    features: Floats
    squares: Floats


def shown(space: Space, faces: Floats) -> Shown:
    """Return (R, F, A) faces as they are compared."""
    images = faces @ space.products[:, None]
    squares = (images * faces).sum(axis=-1)
    norms = np.sqrt(squares[COSINE])[..., None]
    images[COSINE] = np.divide(images[COSINE], norms, out=np.zeros_like(images[COSINE]), where=norms > 0)
    images[VERTEX] *= 2
    return Shown(images.transpose(2, 0, 1, 3), squares[VERTEX].T)


def utilities(space: Space, faces: Floats, targets: Floats, metric: NDArray[np.intp]) -> Floats:
    """Return the (C, F) utilities of (F, A) faces for (C, A) targets, each with its own metric."""
    compared = shown(space, faces[None])
    features = compared.features[:, :, 0]
    squares = np.maximum(space.squares(metric, targets), LEAST_SQUARE)[:, None]
    cosine = targets @ features[:, COSINE].T / np.sqrt(squares)
    apart = compared.squares[:, 0] - targets @ features[:, VERTEX].T + squares
    vertex = -np.sqrt(np.maximum(apart, 0) / squares)
    return np.where(metric[:, None] == COSINE, cosine, vertex)
