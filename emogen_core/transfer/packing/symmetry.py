"""Which shapes are each other's mirror image (section 4.4), by geometry: names are the maker's, and often wrong.

The head's left is x > 0. A shape's mirror image has its offsets reflected, at the vertices that lie across from its
own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Pair = tuple[int, int]

_REFLECTED = np.array([-1, 1, 1], np.float32)
# Cosine between a shape and another's mirror image from which on the two are a pair, each being the other's best.
_ALIKE = 0.9
# Share of their displacement that one-sided shapes have in common with their own mirror image, at most.
_ACROSS = 0.6
# Vertices that no shape moves by so much of its greatest displacement tell nothing.
_TELLING = 0.1


@dataclass(frozen=True, slots=True)
class Mirrored:
    """Shapes that are each other's mirror image.

    Attributes:
        pairs: one-sided ones, as the two corners of a smile: easier to pose together.
        opposites: others, as a jaw that moves to the left and one that moves to the right: they undo each other.
    """

    pairs: tuple[Pair, ...]
    opposites: tuple[Pair, ...]


def mirror_image(neutral: NDArray[np.floating]) -> NDArray[np.intp]:
    """Return (N,): the vertex of an (N, 3) neutral that lies nearest to each vertex's reflection at x = 0."""
    _, nearest = cKDTree(neutral).query(neutral * _REFLECTED)
    return np.asarray(nearest, np.intp)


def find_mirrored(offsets: NDArray[np.floating], reach: NDArray[np.floating], mirror: NDArray[np.integer]) -> Mirrored:
    """Return which shapes are each other's mirror image, lower index first; none that is more like its own.

    Args:
        offsets: (K, N, 3) millimetres.
        reach: (K, N) displacements as shares of a shape's greatest.
        mirror: (N,) the vertex across from each.
    """
    moved = np.maximum.reduce(reach) >= _TELLING
    moved = moved | moved[mirror]
    likeness = _likeness(offsets[:, moved], offsets[:, mirror[moved]] * _REFLECTED)
    best = likeness.argmax(1)
    found = [(a, int(b)) for a, b in enumerate(best) if a < b and best[b] == a and likeness[a, b] >= _ALIKE]
    here, across = reach[:, moved], reach[:, mirror[moved]]
    sided = np.minimum(here, across).sum(1) <= _ACROSS * np.maximum(here, across).sum(1)
    return Mirrored(
        tuple((a, b) for a, b in found if sided[a] and sided[b]),
        tuple((a, b) for a, b in found if not (sided[a] and sided[b])),
    )


def _likeness(offsets: NDArray[np.floating], images: NDArray[np.floating]) -> NDArray[np.floating]:
    """Return the (K, K) cosines between (K, N, 3) shapes and mirror images, symmetric."""
    flat, reflected = (meshes.reshape(len(meshes), -1) for meshes in (offsets, images))
    lengths = np.linalg.norm(flat, axis=1)
    cosines = flat @ reflected.T / np.maximum(np.outer(lengths, lengths), np.finfo(np.float32).tiny)
    likeness: NDArray[np.floating] = (cosines + cosines.T) / 2
    return likeness
