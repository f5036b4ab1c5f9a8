"""The random faces that checks and sheets judge: those of the search's random operator."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Set as AbstractSet

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

# This many genes a face, each at a uniform weight.
GENES_A_FACE = 6

_INACTIVE = frozenset({"lateral", "disabled"})


def active_genes(rig: Rig, without: AbstractSet[str] = frozenset()) -> NDArray[np.intp]:
    """Return where the genes stand that a study uses unless it says otherwise: neither lateral nor disabled.

    Args:
        rig: the face model.
        without: flags whose genes are left out as well.
    """
    return np.flatnonzero([not gene.flags & (_INACTIVE | without) for gene in rig.genes])


def random_genes(rig: Rig, faces: int, seed: int, without: AbstractSet[str] = frozenset()) -> NDArray[np.float64]:
    """Return (faces, G) genomes with `GENES_A_FACE` genes of `active_genes` each, uniform in [0, 1)."""
    generator = np.random.default_rng(seed)
    active = active_genes(rig, without)
    genes = np.zeros((faces, len(rig.genes)))
    for row in genes:
        chosen = generator.choice(active, min(GENES_A_FACE, len(active)), replace=False)
        row[chosen] = generator.random(len(chosen))
    return genes
