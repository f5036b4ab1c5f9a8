"""Where on the face two mean faces differ: a number at every vertex, for `emogen_core.rendering.heat` to draw."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.evaluate import vertices

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def vertex_difference(
    rig: Rig, identity: str, first: NDArray[np.floating], second: NDArray[np.floating]
) -> NDArray[np.float64]:
    """Return the (N,) distances in millimetres of the vertices of two faces worn by one head.

    Args:
        rig: the face model.
        identity: the head that wears both.
        first, second: (K,) weights.

    Raises:
        InvalidInputError: weights of a wrong shape or outside of [0, 1]; an unknown identity.
    """
    meshes = vertices(rig, identity, np.stack([first, second]).astype(np.float32)).astype(np.float64)
    return np.asarray(np.linalg.norm(meshes[0] - meshes[1], axis=-1))
