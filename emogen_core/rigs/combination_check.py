"""Measures the combinational correctives: what random faces do to the mesh with and without them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.quality import Damage, Gauge
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

BATCH = 10
# Piercing edges take a third of a second a face: they are counted on this many.
PIERCED_FACES = 20

_FLESH = ("skin", "mouth", "sockets")
_FIELDS = ("flips", "folds", "stretched", "piercing")


def combination_report(rig: Rig, identity: str, faces: int, seed: int) -> dict[str, Any]:
    """Measure the combinational correctives on random faces of one head.

    Args:
        rig: the face model; its parts ``skin``, ``mouth`` and ``sockets`` are judged.
        identity: the head that wears it.
        faces: how many random faces; piercing edges are counted on the first `PIERCED_FACES`.
        seed: of the faces.

    Returns:
        JSON-ready: mean ``flips``, ``folds``, ``stretched`` triangles and ``piercing`` edges a face ``without`` and
        ``with`` the correctives; ``..._fell``: by which share each did; how many faces have fewer flips
        (``faces_better``) or more (``faces_worse``), and the first for each of the second (or for one, if none).

    Raises:
        InvalidInputError: an unknown identity.
    """
    genes = random_genes(rig, faces, seed)
    gauge = Gauge(rig.neutral(identity).astype(np.float64), flesh(rig))
    without, corrected = (_damages(rig, identity, gauge, genes, on) for on in (False, True))
    means = {"without": _means(without), "with": _means(corrected)}
    better = sum(b.flips < a.flips for a, b in zip(without, corrected, strict=True))
    worse = sum(b.flips > a.flips for a, b in zip(without, corrected, strict=True))
    return _report(means, better, worse)


def pooled(reports: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Return what `combination_report` would say of the faces of several heads, as many of each, taken together."""
    means = {
        on: {field: round(float(np.mean([report[on][field] for report in reports])), 3) for field in _FIELDS}
        for on in ("without", "with")
    }
    return _report(means, *(sum(report[name] for report in reports) for name in ("faces_better", "faces_worse")))


def flesh(rig: Rig) -> NDArray[np.int32]:
    """Return the (T, 3) triangles that are judged: skin, mouth and sockets, or all of a rig without these parts."""
    rows = [rig.triangles[slice(*rig.parts[name])] for name in _FLESH if name in rig.parts]
    return np.concatenate(rows) if rows else rig.triangles


def _report(means: dict[str, dict[str, float]], better: int, worse: int) -> dict[str, Any]:
    return {
        **means,
        **{f"{field}_fell": _fall(means["without"][field], means["with"][field]) for field in _FIELDS},
        "faces_better": better,
        "faces_worse": worse,
        "better_for_one_worse": round(better / max(worse, 1), 2),
    }


def _damages(rig: Rig, identity: str, gauge: Gauge, genes: NDArray[np.float64], combined: bool) -> list[Damage]:
    weights = shape_weights(rig, genes)
    if not combined:
        weights[:, len(rig.core_shapes) :] = 0
    found: list[Damage] = []
    for first in range(0, len(weights), BATCH):
        meshes = vertices(rig, identity, weights[first : first + BATCH]).astype(np.float64)
        found += [gauge.damage(mesh, piercing=len(found) + k < PIERCED_FACES) for k, mesh in enumerate(meshes)]
    return found


def _means(damages: list[Damage]) -> dict[str, float]:
    means = {name: float(np.mean([getattr(d, name) for d in damages])) for name in _FIELDS[:3]}
    means["piercing"] = float(np.mean([d.piercing for d in damages[:PIERCED_FACES]]))
    return {name: round(mean, 3) for name, mean in means.items()}


def _fall(without: float, corrected: float) -> float:
    return round(1 - corrected / without, 3) if without else 0.0
