"""Measures a rig: what it has, and what random faces do to its mesh with and without combinational correctives."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.quality import Damage, Gauge

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

# Random faces are those of the search's random operator: this many genes at a uniform weight.
GENES_A_FACE = 6
BATCH = 10

_INACTIVE = frozenset({"lateral", "disabled"})
_FLESH = ("skin", "mouth", "sockets")


def check_rig(rig: Rig, faces: int = 200, seed: int = 0, identity: str | None = None) -> dict[str, Any]:
    """Measure a rig on random faces.

    Args:
        rig: the face model; its parts ``skin``, ``mouth`` and ``sockets`` are judged.
        faces: how many random faces to draw.
        seed: of the faces.
        identity: the head that wears the rig; the first one if not given.

    Returns:
        JSON-ready figures: counts, mean flipped and overstretched triangles a face without and with
        combinational correctives, how many faces these make better or worse, and milliseconds a face from genes to
        vertices.

    Raises:
        InvalidInputError: no faces, or an unknown identity.
    """
    if faces < 1:
        raise InvalidInputError(f"faces: {expected('at least 1', faces)}")
    worn = identity or rig.identities[0]
    genes = random_genes(rig, faces, seed)
    gauge = Gauge(rig.neutral(worn).astype(np.float64), _flesh(rig))
    without, corrected = (_damages(rig, worn, gauge, genes, on) for on in (False, True))
    return {
        "name": rig.name,
        "hash": rig.hash,
        "identity": worn,
        "counts": _counts(rig),
        "faces": faces,
        "seed": seed,
        "without_combinations": _means(without),
        "with_combinations": _means(corrected),
        "faces_better": sum(b.flips < a.flips for a, b in zip(without, corrected, strict=True)),
        "faces_worse": sum(b.flips > a.flips for a, b in zip(without, corrected, strict=True)),
        "milliseconds_a_face": _milliseconds(rig, worn, genes),
    }


def random_genes(rig: Rig, faces: int, seed: int) -> NDArray[np.float64]:
    """Return (faces, G) genomes with `GENES_A_FACE` active genes each, uniform in [0, 1]."""
    generator = np.random.default_rng(seed)
    active = np.flatnonzero([not gene.flags & _INACTIVE for gene in rig.genes])
    genes = np.zeros((faces, len(rig.genes)))
    for row in genes:
        chosen = generator.choice(active, min(GENES_A_FACE, len(active)), replace=False)
        row[chosen] = generator.random(len(chosen))
    return genes


def _counts(rig: Rig) -> dict[str, int]:
    return {
        "genes": len(rig.genes),
        "active_genes": sum(not gene.flags & _INACTIVE for gene in rig.genes),
        "core_shapes": len(rig.core_shapes),
        "combinational_correctives": len(rig.combinations),
        "collision_correctives": len(rig.collision_shapes),
        "shapes": len(rig.shape_names),
        "identities": len(rig.identities),
        "vertices": rig.offsets.shape[1],
        "triangles": len(rig.triangles),
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


def _milliseconds(rig: Rig, identity: str, genes: NDArray[np.float64]) -> float:
    batch = genes[:BATCH]
    vertices(rig, identity, shape_weights(rig, batch))
    start = time.perf_counter()
    vertices(rig, identity, shape_weights(rig, batch))
    return round((time.perf_counter() - start) * 1000 / len(batch), 3)
