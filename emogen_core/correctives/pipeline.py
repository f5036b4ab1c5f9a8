"""The order in which a genome becomes a face, written here and nowhere else.

genes -> core weights -> combinational products -> (collision correctives) -> weights of all shapes. The vertices
follow from these by `emogen_core.face.evaluate`. EmoGen 2021, section III-A.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.combinational import combinational_weights
from emogen_core.face.evaluate import checked_weights

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def shape_weights(rig: Rig, genes: NDArray[np.float64]) -> NDArray[np.float32]:
    """Return the weights of all shapes for a batch of genomes.

    Args:
        rig: the face model.
        genes: (B, G) gene values in [0, 1].

    Returns:
        (B, K) float32, in [0, 1]: core shapes, combinational correctives, collision correctives.

    Raises:
        InvalidInputError: wrong shape, not finite, or outside [0, 1].
    """
    values = checked_weights(genes.astype(np.float32), len(rig.genes))
    core = np.clip(values @ rig.gene_to_core, 0, 1)
    combined = combinational_weights(rig, core)
    collision = np.zeros((len(core), len(rig.collision_shapes)), np.float32)
    return np.concatenate([core, combined, collision], axis=1)
