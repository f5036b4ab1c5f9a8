"""The bank of expressions on which the published method stands (Zhu & Lee 2006, section 2).

Theirs are 30 frames of one recorded face, six full emotions among them; the others lie between these. Ours are the six
emotion sets of the rig (an imported one may have fewer) and mixtures of two of them up to 30, with every gene at a
strength of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.landmarks.head import DrivenHead

    Floats = NDArray[np.float64]

SIZE = 30
_SEED = 2006
_MIXED = 2
_STRENGTH, _VARIED = (0.2, 1.0), (0.4, 1.0)


@dataclass(frozen=True, eq=False)
class Bank:
    """Examples of expressions on one head.

    Attributes:
        core: (n, C) weights of the core shapes.
        motions: (n, P, 3) motions of the feature points, millimetres.
        surfaces: (n, N, 3) float32 motions of all vertices.
    """

    core: Floats
    motions: Floats
    surfaces: NDArray[np.float32]


def make_bank(head: DrivenHead, genes: Floats) -> Bank:
    """Return the bank of (n, G) genomes on a head, corrected as faces are that participants see."""
    core = np.clip(genes @ head.rig.gene_to_core, 0, 1).astype(np.float64)
    surfaces = np.stack([head.surface(head.face(row)) for row in core]).astype(np.float32)
    return Bank(core, surfaces[:, head.vertices].astype(np.float64), surfaces)


def bank_genes(rig: Rig) -> Floats:
    """Return the (30, G) genomes of a rig's bank: always the same.

    Raises:
        InvalidInputError: the rig has no emotion sets.
    """
    if not rig.emotion_sets:
        raise InvalidInputError(f"bank: {expected('a rig with emotion sets', 'none')}; use the method rig")
    prototypes = np.stack([rig.emotion_genes(name) for name in rig.emotion_sets])
    return np.concatenate([prototypes, mixtures(rig, SIZE - len(prototypes), np.random.default_rng(_SEED))])


def mixtures(rig: Rig, count: int, rng: np.random.Generator) -> Floats:
    """Return (count, G) genomes between two emotions each."""
    prototypes = np.stack([rig.emotion_genes(name) for name in rig.emotion_sets])
    made = np.zeros((count, len(rig.genes)))
    for place in range(count):
        for emotion in rng.permutation(len(prototypes))[:_MIXED]:
            made[place] += prototypes[emotion] * rng.uniform(*_STRENGTH) * rng.uniform(*_VARIED, made.shape[1])
    return np.minimum(made, 1)
