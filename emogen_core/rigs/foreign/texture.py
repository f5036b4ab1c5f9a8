"""The texture coordinates of a rig's triangles, from the look that dresses it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look


def corner_uv(rig: Rig, look: Look) -> NDArray[np.float32]:
    """Return (T, 3, 2) texture coordinates of the rig's triangles, 0 for those that the look does not draw.

    Raises:
        InvalidInputError: the look is made for another rig.
    """
    look.check(rig)
    uv = np.zeros((*rig.triangles.shape, 2), np.float32)
    whole, turned = _keys(rig.triangles)
    order = np.argsort(whole)
    for layer in look.layers.values():
        keys, rolled = _keys(layer.source[layer.triangles])
        place = np.minimum(np.searchsorted(whole[order], keys), len(order) - 1)
        row = order[place]
        same = whole[row] == keys
        values = np.take_along_axis(layer.uv[layer.triangles], rolled[..., np.newaxis], axis=1)
        # Row by row, so that the corner that a key begins with gets its own coordinates again.
        uv[row[same, np.newaxis], turned[row[same]]] = values[same]
    return uv


def _keys(triangles: NDArray[np.int32]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return a number for every triangle, whichever corner comes first, and its corners in that order."""
    first = triangles.argmin(axis=1)
    turned = (first[:, np.newaxis] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, turned, axis=1).astype(np.int64).T
    return (a << 42) | (b << 21) | c, turned
