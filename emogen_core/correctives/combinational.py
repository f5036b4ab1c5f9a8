"""Combinational correctives: a corrective's weight is the product of its parents' weights (EmoGen 2021, section III-A)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def combinational_weights(rig: Rig, core: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the (B, number of combinations) products of the parents' weights for (B, C) core weights."""
    index = {name: i for i, name in enumerate(rig.core_shapes)}
    columns = [core[:, [index[parent] for parent in c.parents]].prod(axis=1) for c in rig.combinations]
    return np.stack(columns, axis=1) if columns else np.zeros((len(core), 0), np.float32)
