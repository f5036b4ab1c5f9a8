"""Combinational correctives: a corrective's weight is the product of its parents' weights (EmoGen 2021, III-A).

Ours, where the paper says nothing: a family of correctives is damped while three or more of its genes are high.
Every pair takes back what its two parents count double; with many aligned genes the pairs together take back more
than was ever added (five smiles at 1 turn the corners down). Saturation as a whole should leave the largest gene
``m``, that is take back ``s - m`` of the sum ``s`` of the family's genes; the pairs that the rig has take back
``t``, the sum of their products. All correctives of the family are scaled by ``min(1, (s - m) / t)``: two genes
are never damped, nor are pairs that share no gene.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def combinational_weights(rig: Rig, core: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the weights of the combinational correctives.

    Args:
        rig: the face model.
        core: (B, C) weights of the core shapes in [0, 1]; a gene's value is the mean of its members.

    Returns:
        (B, number of combinations) float32 in [0, 1].
    """
    genes = core @ _mean_of_members(rig)
    weights = _products(genes, rig.combination_parents)
    for columns, parents in _families(rig):
        weights[:, columns] *= family_factor(genes[:, parents], weights[:, columns])[:, None]
    return weights


def _products(genes: NDArray[np.float32], parents: Sequence[NDArray[np.integer]]) -> NDArray[np.float32]:
    """Return the (B, k) products of the genes of each corrective, all correctives at once."""
    most = max(map(len, parents), default=0)
    one = genes.shape[1]  # a column of ones stands in for parents that a corrective does not have
    places = np.array([[*some, *[one] * (most - len(some))] for some in parents], np.intp).reshape(len(parents), most)
    filled = np.concatenate([genes, np.ones((len(genes), 1), np.float32)], axis=1)
    products = np.ones((len(genes), len(parents)), np.float32)
    for column in places.T:
        products *= filled[:, column]
    return products


def family_factor(genes: NDArray[np.float32], products: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (B,) how far to scale a family of correctives.

    Args:
        genes: (B, n) values of all parents of the family.
        products: (B, k) products of the parents' values, one a corrective.
    """
    excess = genes.sum(1) - genes.max(1)
    taken = products.sum(1)
    factor: NDArray[np.float32] = np.where(taken > excess, excess / np.where(taken > 0, taken, 1), 1)
    return factor.astype(np.float32)


def _families(rig: Rig) -> list[tuple[list[int], NDArray[np.intp]]]:
    """Return of every family the columns of its correctives and its parent genes."""
    found = []
    for family in sorted({c.family for c in rig.combinations if c.family}):
        columns = [i for i, c in enumerate(rig.combinations) if c.family == family]
        parents = sorted({parent for i in columns for parent in rig.combinations[i].parents})
        found.append((columns, rig.gene_indices(tuple(parents))))
    return found


def _mean_of_members(rig: Rig) -> NDArray[np.float32]:
    drives = rig.gene_to_core.T
    mean: NDArray[np.float32] = drives / np.maximum(drives.sum(0), 1)
    return mean
