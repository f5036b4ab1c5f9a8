"""Checks a head: that it rests in a neutral pose, that its lids close whatever else they do, that its lips meet.

A mouth is shut where genes leave it so at weight 1, and in the emotions that are shown with a closed mouth.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.collision.judge import dense_depth
from emogen_core.correctives.collision.regions import has_regions
from emogen_core.correctives.pipeline import face_weights, shape_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.eyeballs import RADIUS
from emogen_core.rigs.features import brow_height, corner_height, lid_covers
from emogen_core.rigs.fitting import SHUT_GENES
from emogen_core.rigs.heights import highest, over
from emogen_core.rigs.lids import EDGE, eye_depths, lid_rings, turned_below, visible_area
from emogen_core.rigs.lips import lip_gaps, teeth_area
from emogen_core.rigs.rest import BROWS
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    Mesh = NDArray[np.float64]

# What may happen while eyes are shut.
WITH_BLINK = (
    "", "gazeDown", "gazeUp", "lidsTight", "lidsSlit", "browDown", "cheekRaise", "lidUpperRaise", "lidsTight+lidsSlit",
    "gazeDown+lidsSlit", "cheekRaise+lidsTight", "gazeLeft", "gazeRight",
)  # fmt: skip
ON_THE_WAY = ("", "gazeDown", "gazeUp", "lidsTight", "lidsSlit")
# Emotion sets whose prototype has its mouth closed.
CLOSED_MOUTHS = ("sad", "angry")
HALF_SHUT = (0.25, 0.5, 0.75)
BELOW = 15.0

_CLOSING = "lidsClose"
_PITCH = 0.25
# An eyeball in front of a lid by more than this is in front of something else.
_BEHIND = 5.0


@dataclass(frozen=True, eq=False)
class _Worn:
    """A head on its rig, with what the measures need of it."""

    rig: Rig
    identity: str
    topology: RigTopology
    eye_centre: NDArray[np.float64]

    def faces(self, weights: list[dict[str, float]]) -> Mesh:
        """Return the (B, N, 3) faces of some genes' weights, combinational correctives on."""
        genes = np.zeros((len(weights), len(self.rig.genes)))
        for row, values in zip(genes, weights, strict=True):
            row[self.rig.gene_indices(tuple(values))] = list(values.values())
        meshes: Mesh = vertices(self.rig, self.identity, shape_weights(self.rig, genes)).astype(np.float64)
        return meshes

    def shown(self, genes: NDArray[np.float64]) -> Mesh:
        """Return the (N, 3) face of (G,) genes as it is shown, collisions corrected."""
        weights = face_weights(self.rig, self.identity, genes[np.newaxis]).weights
        mesh: Mesh = vertices(self.rig, self.identity, weights)[0].astype(np.float64)
        return mesh


def check_head(rig: Rig, identity: str, low: NDArray[np.float64]) -> dict[str, Any]:
    """Measure one head of a rig.

    Args:
        rig: the face model.
        identity: the head.
        low: (N,) 0 on the upper, 1 on the lower lip (`IdentitySpace.low`).

    Returns:
        JSON-ready: ``visible_mm2``, what shows of the left eyeball at full blink alone and with other genes (the larger
        of the views from the front and from 15 degrees below), the first and the largest of these; ``poke_mm``, how far
        the eyeball comes through the lids on the way; the shares of the iris that the lids cover at rest; brows over
        the eyes and corners over the middle of the mouth, millimetres; ``teeth_mm2`` that show and the widest
        ``lip_gap_mm`` at rest, both where lips lie above each other; under ``shut_teeth`` what shows of the teeth with
        each gene and in each emotion that has the mouth closed, and the most of the genes and of the emotions; and how
        deep the neutral collides.

    Raises:
        InvalidInputError: an unknown identity, or a rig without the genes that are looked at.
    """
    neutral = rig.neutral(identity).astype(np.float64)
    topology = RigTopology(rig)
    worn = _Worn(rig, identity, topology, eye_centre(topology, neutral))
    upper, lower = lid_covers(topology, neutral, worn.eye_centre)
    gap = lip_gaps(topology, low, neutral)[0]
    visible = _visible(worn)
    shut = _shut_teeth(worn)
    nothing = np.zeros((1, len(rig.shape_names)), np.float32)
    return {
        "identity": identity,
        "visible_mm2": visible,
        "visible_at_blink_mm2": visible[_CLOSING],
        "visible_worst_mm2": max(visible.values()),
        "poke_mm": _poke(worn),
        "upper_lid_cover": round(upper, 3),
        "lower_lid_cover": round(lower, 3),
        "brow_height_mm": round(brow_height(neutral, rig.regions[BROWS], worn.eye_centre), 2),
        "corner_height_mm": round(corner_height(topology, low, neutral), 2),
        "teeth_mm2": round(teeth_area(topology, neutral), 3),
        "shut_teeth": shut,
        "shut_teeth_mm2": max((area for name, area in shut.items() if name not in CLOSED_MOUTHS), default=0.0),
        "closed_emotion_teeth_mm2": max((shut.get(name, 0.0) for name in CLOSED_MOUTHS), default=0.0),
        "lip_gap_mm": round(float(gap[np.isfinite(gap)].max(initial=0)), 3),
        "collision_mm": round(float(dense_depth(rig, identity, nothing).max()), 3) if has_regions(rig) else 0.0,
    }


def eye_centre(topology: RigTopology, neutral: Mesh) -> NDArray[np.float64]:
    """Return the (3,) centre of the left eyeball of a head in the rig's frame."""
    across = neutral[topology.part_vertices("eye_left"), 0]
    return np.array([(across.min() + across.max()) / 2, 0.0, 0.0])


def _visible(worn: _Worn) -> dict[str, float]:
    meshes = worn.faces([{_CLOSING: 1.0, **_genes(names)} for names in WITH_BLINK])
    found = {}
    for names, mesh in zip(WITH_BLINK, meshes, strict=True):
        areas = (visible_area(worn.topology, mesh, worn.eye_centre, view, _PITCH) for view in (0.0, BELOW))
        found["+".join(filter(None, (_CLOSING, names)))] = round(max(areas), 3)
    return found


def _shut_teeth(worn: _Worn) -> dict[str, float]:
    """Return gene or emotion -> square millimetres of teeth seen in a mouth that it leaves closed."""
    rig = worn.rig
    alone = {name: np.eye(len(rig.genes))[rig.gene_indices((name,))[0]] for name in SHUT_GENES}
    posed = alone | {name: rig.emotion_genes(name) for name in CLOSED_MOUTHS}
    return {name: round(teeth_area(worn.topology, worn.shown(genes)), 3) for name, genes in posed.items()}


def _poke(worn: _Worn) -> float:
    steps = [(weight, names) for weight in HALF_SHUT for names in ON_THE_WAY]
    meshes = worn.faces([{_CLOSING: weight, **_genes(names)} for weight, names in steps])
    skin = worn.topology.triangles[slice(*worn.topology.parts["skin"])]
    outer = skin[(lid_rings(worn.topology)[skin] >= EDGE).all(1)]
    return round(max(_poke_depth(worn, outer, mesh) for mesh in meshes), 3)


def _poke_depth(worn: _Worn, outer: NDArray[np.int32], mesh: Mesh) -> float:
    """Return how far the left eyeball comes through the (n, 3) triangles of the lids' outer skin, from below."""
    ball, flesh = eye_depths(worn.topology, mesh, worn.eye_centre, BELOW, _PITCH)
    grid = np.arange(-RADIUS, RADIUS, _PITCH)
    lids = highest(over(turned_below(mesh - worn.eye_centre, BELOW)[outer], grid, grid), grid, grid)
    showing = np.isfinite(ball) & (flesh < ball) & (lids > ball - _BEHIND)
    return float((ball - lids)[showing].max(initial=0))


def _genes(names: str) -> dict[str, float]:
    return dict.fromkeys(filter(None, names.split("+")), 1.0)
