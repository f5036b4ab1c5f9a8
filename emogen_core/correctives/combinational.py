"""Combinational correctives: a corrective's weight is the product of its parents' weights (EmoGen 2021, III-A).

Ours, where the paper says nothing: a family of correctives is damped while three or more of its genes are high.
Every pair takes back what its two parents count double; with many aligned genes the pairs together take back
more than was ever added (five smiles at 1 turn the corners down). For genes ``a`` of a family with sum ``s``
and sum of squares ``q``, saturation as a whole should take ``s - sqrt(q)``, while pairs take ``(2 - sqrt 2)
(s^2 - q) / 2``; all correctives of the family are scaled by the ratio of the two, at most 1. Two genes are
never damped.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

_PAIR = 2 - np.sqrt(2)


def combinational_weights(rig: Rig, core: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the weights of the combinational correctives.

    Args:
        rig: the face model.
        core: (B, C) weights of the core shapes in [0, 1]; a gene's value is the mean of its members.

    Returns:
        (B, number of combinations) float32 in [0, 1].
    """
    genes = core @ _mean_of_members(rig)
    weights = np.ones((len(core), len(rig.combinations)), np.float32)
    index = {name: i for i, name in enumerate(rig.gene_names)}
    for column, combination in enumerate(rig.combinations):
        for parent in combination.parents:
            weights[:, column] *= genes[:, index[parent]]
    return weights * _damping(rig, genes)


def _mean_of_members(rig: Rig) -> NDArray[np.float32]:
    drives = rig.gene_to_core.T
    mean: NDArray[np.float32] = drives / np.maximum(drives.sum(0), 1)
    return mean


def _damping(rig: Rig, genes: NDArray[np.float32]) -> NDArray[np.float32]:
    factors = np.ones((len(genes), len(rig.combinations)), np.float32)
    for family in sorted({c.family for c in rig.combinations if c.family}):
        columns = [i for i, c in enumerate(rig.combinations) if c.family == family]
        parents = sorted({parent for i in columns for parent in rig.combinations[i].parents})
        factors[:, columns] = family_factor(genes[:, rig.gene_indices(tuple(parents))])[:, None]
    return factors


def family_factor(genes: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (B,) how far to scale the pair correctives of a family of (B, n) gene values."""
    values = genes.astype(np.float64)
    total, squares = values.sum(1), (values**2).sum(1)
    pairs = _PAIR * (total**2 - squares) / 2
    excess = total - np.sqrt(squares)
    factor = np.where(pairs > excess, excess / np.where(pairs > 0, pairs, 1), 1)
    return np.clip(factor, 0, 1).astype(np.float32)
