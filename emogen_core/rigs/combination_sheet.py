"""Combinational correctives before and after: the strongest pairs at full weight, and random faces that need them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.combination_check import flesh
from emogen_core.rigs.contact import Frame, arranged, captioned
from emogen_core.rigs.quality import Gauge
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from PIL import Image

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.protocol import Renderer

PAIRS, FACES = 10, 5
# Random faces among which those are looked for that the correctives help most.
SEARCHED = 120
_FRAME = Frame(345, (0.14, 0.2, 0.86, 0.86))
_COLUMNS = 5


def combination_sheet(renderer: Renderer, rig: Rig, identity: str | None = None, seed: int = 1) -> Image.Image:
    """Draw faces with their shapes added above, corrected below.

    First the pairs whose corrective mends most, both genes at 1, then random faces that all correctives together mend
    most. Captions say how many triangles are flipped, folded or overstretched, without and with.

    Args:
        renderer: draws; it must wear ``rig``.
        rig: the face model.
        identity: the head; the first one if not given.
        seed: of the random faces.

    Raises:
        InvalidInputError: an unknown identity.
    """
    head = identity or rig.identities[0]
    captions, before, after = _chosen(rig, head, seed)
    above, below = np.split(renderer.draw(head, np.concatenate([before, after]), _FRAME.settings), 2)
    faces = zip(captions, above, below, strict=True)
    return arranged([captioned([_FRAME.cut(one), _FRAME.cut(two)], caption) for caption, one, two in faces], _COLUMNS)


def _chosen(rig: Rig, identity: str, seed: int) -> tuple[list[str], NDArray[np.float32], NDArray[np.float32]]:
    """Return captions and weights (n, K) without and with correctives: the strongest pairs, then random faces."""
    pairs = [combination.parents for combination in rig.combinations if len(combination.parents) == 2]
    genes = np.concatenate([_at_one(rig, pairs), random_genes(rig, SEARCHED, seed)])
    after = shape_weights(rig, genes)
    before = after.copy()
    before[:, len(rig.core_shapes) :] = 0
    gauge = Gauge(rig.neutral(identity).astype(np.float64), flesh(rig))
    broken = np.array(
        [[_broken(gauge, rig, identity, row) for row in both] for both in zip(before, after, strict=True)]
    )
    gain = broken[:, 0] - broken[:, 1]
    best_pairs = np.argsort(-gain[: len(pairs)], kind="stable")[:PAIRS]
    best_faces = len(pairs) + np.argsort(-gain[len(pairs) :], kind="stable")[:FACES]
    rows = np.concatenate([best_pairs, best_faces])
    names = [" + ".join(pairs[row]) if row < len(pairs) else f"random face {row - len(pairs) + 1}" for row in rows]
    captions = [f"{name}: {a} then {b}" for name, (a, b) in zip(names, broken[rows], strict=True)]
    return captions, before[rows], after[rows]


def _at_one(rig: Rig, pairs: list[tuple[str, ...]]) -> NDArray[np.float64]:
    genes = np.zeros((len(pairs), len(rig.genes)))
    for row, parents in zip(genes, pairs, strict=True):
        row[rig.gene_indices(parents)] = 1
    return genes


def _broken(gauge: Gauge, rig: Rig, identity: str, weights: NDArray[np.float32]) -> int:
    mesh = vertices(rig, identity, weights[np.newaxis])[0].astype(np.float64)
    return int(gauge.damage(mesh).total)
