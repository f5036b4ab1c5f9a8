"""Measures the combinational correctives: what random faces do to the mesh with and without them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.quality import Damage, Gauge
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

BATCH = 10

_FLESH = ("skin", "mouth", "sockets")


def combination_report(rig: Rig, identity: str, faces: int, seed: int) -> dict[str, Any]:
    """Measure the combinational correctives on random faces of one head.

    Args:
        rig: the face model; its parts ``skin``, ``mouth`` and ``sockets`` are judged.
        identity: the head that wears it.
        faces: how many random faces.
        seed: of the faces.

    Returns:
        JSON-ready: mean flipped, folded and overstretched triangles a face without and with the correctives, by which
        shares these fell, and how many faces have fewer or more flipped triangles with them.

    Raises:
        InvalidInputError: an unknown identity.
    """
    genes = random_genes(rig, faces, seed)
    gauge = Gauge(rig.neutral(identity).astype(np.float64), _flesh(rig))
    without, corrected = (_damages(rig, identity, gauge, genes, on) for on in (False, True))
    means = {"without": _means(without), "with": _means(corrected)}
    return {
        **means,
        "flips_fell": _fall(means, "flips"),
        "stretched_fell": _fall(means, "stretched"),
        "faces_better": sum(b.flips < a.flips for a, b in zip(without, corrected, strict=True)),
        "faces_worse": sum(b.flips > a.flips for a, b in zip(without, corrected, strict=True)),
    }


def _flesh(rig: Rig) -> NDArray[np.int32]:
    rows = [rig.triangles[slice(*rig.parts[name])] for name in _FLESH if name in rig.parts]
    return np.concatenate(rows) if rows else rig.triangles


def _damages(rig: Rig, identity: str, gauge: Gauge, genes: NDArray[np.float64], combined: bool) -> list[Damage]:
    weights = shape_weights(rig, genes)
    if not combined:
        weights[:, len(rig.core_shapes) :] = 0
    batches = [weights[first : first + BATCH] for first in range(0, len(weights), BATCH)]
    return [gauge.damage(m.astype(np.float64)) for batch in batches for m in vertices(rig, identity, batch)]


def _means(damages: list[Damage]) -> dict[str, float]:
    fields = ("flips", "folds", "stretched")
    return {name: round(float(np.mean([getattr(d, name) for d in damages])), 3) for name in fields}


def _fall(means: dict[str, dict[str, float]], field: str) -> float:
    without = means["without"][field]
    return round(1 - means["with"][field] / without, 3) if without else 0.0
