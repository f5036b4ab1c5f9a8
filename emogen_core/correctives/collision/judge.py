"""The judge: depth measured with many more anchors than were solved for, so that the solver cannot flatter itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.detect import detect
from emogen_core.correctives.collision.model import judge_model
from emogen_core.face.evaluate import checked_weights

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def dense_depth(rig: Rig, identity: str, weights: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return how deep lips and teeth stand in the lower lip, on the mesh as it is drawn.

    28 points on every face of the anchor regions are tried.

    Args:
        rig: a rig with the eight collision correctives.
        identity: the head that wears it.
        weights: (B, K) weights of all shapes, collision correctives included.

    Returns:
        (B, 2) greatest depth in millimetres: upper lip, teeth.

    Raises:
        InvalidInputError: bad weights, unknown identity, or a rig without collision correctives.
    """
    alpha = checked_weights(weights, len(rig.shape_names))
    model = judge_model(rig, identity)
    depths = np.zeros((len(alpha), 2))
    for row, one in enumerate(alpha):
        patch, anchors = model.evaluate(one)
        depths[row] = detect(anchors, model.kind, patch, model.triangles).depths
    return depths
