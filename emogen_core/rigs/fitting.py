"""Shapes fitted to a head: lips that stay shut, lids that close and do not sink into the eyeball.

Units were made for one head, and their linear paths know nothing of what lies below the skin. Shapes that keep the
mouth shut are sealed once, on the default head. What moves lids is fitted on every head: closing is scaled to it, and
vertices that would enter the eyeball at weight 1 are pushed out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.eyeballs import CORNEA_BULGE, CORNEA_DEGREES, GAZE_DEGREES, RADIUS
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.lids import closing_weight
from emogen_core.rigs.lips import seal_lips

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.head_mesh import HeadGeometry

    Mesh = NDArray[np.float64]
    Meshes = dict[str, Mesh]

# Genes that close the mouth or leave it closed: at weight 1 the lips just touch.
SHUT_GENES = (
    "mouthSmile", "mouthSmileSharp", "mouthFrown", "mouthDepress", "mouthDimple", "mouthPress", "mouthPucker",
    "mouthRetract", "chinRaise", "lipRollUpper", "lipRollLower", "cheekPuff", "neckTighten",
)  # fmt: skip
# Genes that move lids over the eyeball.
LID_GENES = ("lidsClose", "lidsTight", "lidsSlit", "lidUpperRaise", "gazeUp", "gazeDown", "cheekRaise", "browDown")
# Skin stays this share of the radius outside the eyeball, so that flat triangles clear it too.
EYEBALL_MARGIN = 0.022

_CLOSURE = ("lidsClose.L", "lidsClose.R")
_MEMBERS = {recipe.name: recipe.members for recipe in RECIPES}


@dataclass(frozen=True, slots=True)
class Head:
    """A neutral (N, 3) of the render mesh, with its left eyeball's centre."""

    neutral: Mesh
    eye_centre: NDArray[np.float64]


def gene_offsets(core: Meshes) -> Meshes:
    """Return gene -> (N, 3) offsets of all its members together."""
    return {name: sum((core[m] for m in members[1:]), core[members[0]]) for name, members in _MEMBERS.items()}


def sealed_shapes(geometry: HeadGeometry, low: NDArray[np.float64], neutral: Mesh, core: Meshes) -> Meshes:
    """Return the core shapes with the lips of `SHUT_GENES` touching at weight 1."""
    fitted, genes = dict(core), gene_offsets(core)
    left = neutral[:, :1] > 0
    for gene in SHUT_GENES:
        change = seal_lips(geometry, low, neutral + genes[gene]) - neutral - genes[gene]
        _spread(fitted, gene, change, left, neutral)
    return fitted


def fitted_lids(geometry: HeadGeometry, head: Head, core: Meshes) -> Meshes:
    """Return the core shapes with what moves lids fitted to a head."""
    weight = closing_weight(geometry, head.neutral, core[_CLOSURE[0]])
    fitted = core | {name: core[name] * weight for name in _CLOSURE}
    genes = gene_offsets(fitted)
    left = head.neutral[:, :1] > 0
    for gene in LID_GENES:
        _spread(fitted, gene, cleared(geometry, head, genes[gene]) - genes[gene], left, head.neutral)
    return fitted


def cleared(geometry: HeadGeometry, head: Head, offsets: Mesh) -> Mesh:
    """Return (N, 3) offsets that keep skin and lashes out of the eyeballs, or as deep as they are at rest."""
    result = offsets.copy()
    covers = geometry.part_vertices("skin", "sockets", "lashes")
    for side in (1, -1):
        rest = head.neutral[covers] - head.eye_centre * (side, 1, 1)
        moved = rest + result[covers]
        depth = np.linalg.norm(moved, axis=1)
        limit = np.minimum(_clear_radius(moved, depth), np.linalg.norm(rest, axis=1))
        push = np.where(moved[:, 2] > 0, np.maximum(limit - depth, 0), 0) / np.maximum(depth, 1e-9)
        result[covers] += push[:, None] * moved
    return result


def _clear_radius(points: Mesh, distance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far from the centre skin must be in the direction of (n, 3) points, wherever the cornea looks."""
    angle = np.degrees(np.arccos(np.clip(points[:, 2] / np.maximum(distance, 1e-9), -1, 1)))
    off_cornea = np.maximum(angle - GAZE_DEGREES["LookDown"], 0)
    bulge = np.clip(1 - (off_cornea / CORNEA_DEGREES) ** 2, 0, None) ** 2
    radius: NDArray[np.float64] = RADIUS * (1 + EYEBALL_MARGIN + CORNEA_BULGE * bulge)
    return radius


def _spread(shapes: Meshes, gene: str, change: Mesh, left: NDArray[np.bool_], neutral: Mesh) -> None:
    """Add a change of a gene to its members: each side's half to its own, the middle to both alike."""
    members = _MEMBERS[gene]
    if len(members) == 1:
        shapes[members[0]] = shapes[members[0]] + change
        return
    share = np.where(np.abs(neutral[:, :1]) < 1e-6, 0.5, left)
    shapes[members[0]] = shapes[members[0]] + share * change
    shapes[members[1]] = shapes[members[1]] + (1 - share) * change
