"""Shapes fitted to a head: lips that stay shut, lids that close and do not sink into the eyeball.

Units were made for one head, and their linear paths know nothing of what lies below the skin. Shapes that keep the
mouth shut are sealed on every head: where lips only touched each other, or a tooth, collision correction would part
them, and a mouth that should be shut would show its teeth. What moves lids is fitted on every head, too: closing is
scaled to it (`lids.py`), and vertices that would enter the eyeball on the way to weight 1 are pushed out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.spatial import cKDTree

from emogen_core.rigs.canvas import smoothstep
from emogen_core.rigs.eyeballs import CORNEA_BULGE, CORNEA_DEGREES, GAZE_DEGREES, RADIUS
from emogen_core.rigs.gene_table import RECIPES
from emogen_core.rigs.lids import EDGE, closing_factor, closing_scale, lid_rings

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.rigs.topology import Topology

    Mesh = NDArray[np.float64]
    Meshes = dict[str, Mesh]
    Members = Mapping[str, tuple[str, ...]]

# Genes that close the mouth or leave it closed: at weight 1 the lips just touch.
SHUT_GENES = (
    "mouthSmile", "mouthSmileSharp", "mouthFrown", "mouthDepress", "mouthDimple", "mouthPress", "mouthPucker",
    "mouthRetract", "chinRaise", "lipRollUpper", "lipRollLower", "cheekPuff", "neckTighten",
)  # fmt: skip
# Genes that move lids over the eyeball.
LID_GENES = ("lidsClose", "lidsTight", "lidsSlit", "lidUpperRaise", "gazeUp", "gazeDown", "cheekRaise", "browDown")
CLOSING = "lidsClose"
# What comes with a gene in a felt smile, and would push the lid into the eyeball with it.
_COMPANY = {"cheekRaise": {"lidsTight": 0.6, "mouthSmile": 0.5, "mouthSmileOpen": 1.0}}
# Skin stays this share of the radius outside the eyeball, so that flat triangles clear it too.
EYEBALL_MARGIN = 0.022
# The very edge of a lid touches it.
EDGE_MARGIN = 0.002

_NEAR = 2.2
_CHORD_ROUNDS = 6
# What lies so near to a vertex that is pushed out is carried along, millimetres.
_CARRIED = 4.0
# Up to here from the rims of the lids, and from here on no more, millimetres, closed lids hold still.
_RIM_FADE = (3.0, 9.0)

_CLOSURE = (f"{CLOSING}.L", f"{CLOSING}.R")
_MEMBERS: Members = {recipe.name: recipe.members for recipe in RECIPES}


@dataclass(frozen=True, slots=True)
class Head:
    """A neutral (N, 3) of the render mesh, with its left eyeball's centre and radius; 0 for a head without eyes."""

    neutral: Mesh
    eye_centre: NDArray[np.float64]
    eye_radius: float = RADIUS


def gene_offsets(core: Meshes, members: Members = _MEMBERS) -> Meshes:
    """Return gene -> (N, 3) offsets of all its members together."""
    return {name: sum((core[m] for m in listed[1:]), core[listed[0]]) for name, listed in members.items()}


def sealed_shapes(neutral: Mesh, core: Meshes, seal: Callable[[Mesh], Mesh]) -> Meshes:
    """Return the core shapes under which each of `SHUT_GENES` keeps the mouth shut at weight 1.

    Args:
        neutral: (N, 3) the head at rest.
        core: core shape -> (N, 3) offsets.
        seal: takes an (N, 3) face with a closed mouth and closes what is open of it.
    """
    fitted, members = dict(core), {gene: _MEMBERS[gene] for gene in SHUT_GENES}
    for gene, offsets in gene_offsets(core, members).items():
        spread(fitted, members[gene], seal(neutral + offsets) - neutral - offsets, neutral)
    return fitted


def spread(shapes: Meshes, members: Sequence[str], change: Mesh, neutral: Mesh) -> None:
    """Add a change of a gene to its one or two members: each side's half to its own, the middle to both alike."""
    if len(members) == 1:
        shapes[members[0]] = shapes[members[0]] + change
        return
    across = neutral[:, :1]
    share = np.where(np.abs(across) < 1e-6, 0.5, across > 0)
    shapes[members[0]] = shapes[members[0]] + share * change
    shapes[members[1]] = shapes[members[1]] + (1 - share) * change


def fitted_lids(geometry: Topology, head: Head, core: Meshes) -> Meshes:
    """Return the core shapes that move lids, fitted to a head whose skin is clear of its eyeballs."""
    return clear_lids(geometry, head, core | closed_lids(geometry, head, core), _MEMBERS)


def clear_lids(geometry: Topology, head: Head, core: Meshes, members: Members) -> Meshes:
    """Return the core shapes that move lids, none of which lets the eyeballs through on its way to weight 1.

    ``members`` are gene -> core shapes; those of `LID_GENES` that are not there are left out.
    """
    lids = [gene for gene in LID_GENES if gene in members]
    fitted = {member: core[member] for gene in lids for member in members[gene]}
    genes = gene_offsets(core, members)
    for gene in lids:
        company = (share * genes[other] for other, share in _COMPANY.get(gene, {}).items() if other in genes)
        together = sum(company, genes[gene])
        spread(fitted, members[gene], cleared(geometry, head, together) - together, head.neutral)
    return fitted


def closed_lids(geometry: Topology, head: Head, core: Meshes) -> Meshes:
    """Return the two closing shapes, scaled so that weight 1 just shuts the eyes of a head."""
    left, right = (core[name] for name in _CLOSURE)
    own = closing_scale(geometry, head.eye_centre, head.neutral, left)
    # The same columns, counted from the middle outwards, serve the other eye.
    order = np.argsort(head.neutral[:, 0])
    other = np.interp(-head.neutral[:, 0], head.neutral[order, 0], own[order])
    scaled = {_CLOSURE[0]: left * own[:, None], _CLOSURE[1]: right * other[:, None]}
    both = sum(scaled.values(), np.zeros_like(left))
    factor = closing_factor(
        geometry, head.eye_centre, head.neutral, lambda weight: cleared(geometry, head, weight * both)
    )
    return {name: factor * offsets for name, offsets in scaled.items()}


def cleared(geometry: Topology, head: Head, offsets: Mesh) -> Mesh:
    """Return (N, 3) offsets whose straight path keeps skin and lashes as far out of the eyeballs as they are at rest.

    A straight path cuts the corner of a round one: where its nearest point is too deep, its end is moved out until it
    is not. What lies about it, the lid's other side and its lining too, is carried along: a lid of which one side
    alone moves turns over.
    """
    result = offsets.copy()
    for side in (1, -1):
        centre = head.eye_centre * (side, 1, 1)
        covers, margin = _covers(geometry, head, centre)
        around = _around(geometry, head, centre)
        carried = _carried(head.neutral[around], head.neutral[covers])
        rest = head.neutral[covers] - centre
        at_rest = np.linalg.norm(rest, axis=1)
        for _ in range(_CHORD_ROUNDS):
            end = rest + result[covers]
            nearest = _nearest_on_path(rest, end)
            missing = _missing(nearest, end, np.minimum(clear_radius(nearest, margin, head.eye_radius), at_rest))
            result[around] += _outwards(head.neutral[around] + result[around] - centre, _largest(carried, missing))
    return result


def cleared_neutral(geometry: Topology, head: Head) -> Mesh:
    """Return a head's (N, 3) neutral with skin and lashes outside the eyeballs."""
    mesh = head.neutral.copy()
    for side in (1, -1):
        centre = head.eye_centre * (side, 1, 1)
        covers, margin = _covers(geometry, replace(head, neutral=mesh), centre)
        place = mesh[covers] - centre
        mesh[covers] += _outwards(place, _missing(place, place, clear_radius(place, margin, head.eye_radius)))
    return mesh


def _missing(points: Mesh, ends: Mesh, limit: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (n,) what (n, 3) points lack to the distance (n,) ``limit``, where their ends are in front."""
    lacking: NDArray[np.float64] = np.maximum(limit - np.linalg.norm(points, axis=1), 0) * smoothstep(ends[:, 2], 0, 3)
    return lacking


def _outwards(points: Mesh, amount: NDArray[np.float64]) -> Mesh:
    """Return (n, 3) steps of (n,) lengths that lead (n, 3) points away from the centre."""
    away: Mesh = (amount / np.maximum(np.linalg.norm(points, axis=1), 1e-9))[:, None] * points
    return away


def _around(geometry: Topology, head: Head, centre: NDArray[np.float64]) -> NDArray[np.intp]:
    """Return all soft vertices near an eyeball."""
    soft = geometry.part_vertices("skin", "sockets", "lashes")
    near: NDArray[np.intp] = soft[np.linalg.norm(head.neutral[soft] - centre, axis=1) < _NEAR * head.eye_radius]
    return near


def _carried(points: Mesh, pushed: Mesh) -> csr_array:
    """Return (n, m) by which share each of (n, 3) points is carried along with each of (m, 3) pushed ones."""
    pairs = cKDTree(points).sparse_distance_matrix(cKDTree(pushed), _CARRIED, output_type="coo_matrix")
    share = 1 - smoothstep(pairs.data, 0, _CARRIED)
    return csr_array(coo_array((share, (pairs.row, pairs.col)), shape=pairs.shape))


def _largest(share: csr_array, amount: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (n,) the largest of what (m,) amounts bring each row of (n, m) shares."""
    if not share.nnz:
        return np.zeros(share.shape[0])
    brought: NDArray[np.float64] = (share @ diags_array(amount)).max(axis=1).toarray().ravel()
    return brought


def clear_radius(points: Mesh, margin: NDArray[np.float64] | float, eye_radius: float = RADIUS) -> NDArray[np.float64]:
    """Return how far from the centre skin must be in the direction of (n, 3) points, wherever the cornea looks."""
    distance = np.linalg.norm(points, axis=1)
    angle = np.degrees(np.arccos(np.clip(points[:, 2] / np.maximum(distance, 1e-9), -1, 1)))
    off_cornea = np.maximum(angle - max(GAZE_DEGREES.values()), 0)
    bulge = np.clip(1 - (off_cornea / CORNEA_DEGREES) ** 2, 0, None) ** 2
    radius: NDArray[np.float64] = eye_radius * (1 + margin + CORNEA_BULGE * bulge)
    return radius


def kept_shut(
    geometry: Topology, head: Head, parents: tuple[str, ...], genes: Mapping[str, Mesh], corrective: Mesh
) -> Mesh:
    """Return a (N, 3) corrective changed so that, at weight 1, what comes with closed lids does not move their rims.

    Only pairs with `CLOSING` are changed, near the rims; what the other gene does further away stays.
    """
    if CLOSING not in parents or len(parents) != 2:
        return corrective
    other = next(name for name in parents if name != CLOSING)
    soft = geometry.part_vertices("skin", "sockets", "lashes")
    rim = np.flatnonzero(lid_rings(geometry) == EDGE)
    away = np.asarray(cKDTree(head.neutral[rim]).query(head.neutral[soft])[0])
    hold = 1 - smoothstep(away, *_RIM_FADE)
    hold[np.isin(soft, geometry.part_vertices("lashes"))] = 1
    kept = corrective.copy()
    kept[soft] -= hold[:, None] * (genes[other] + corrective)[soft]
    return kept


def _covers(
    geometry: Topology, head: Head, centre: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return the vertices near an eyeball that must stay outside, and by which share of the radius."""
    skin, lashes = geometry.part_vertices("skin"), geometry.part_vertices("lashes")
    rings = lid_rings(geometry)
    covers = np.concatenate([skin[rings[skin] >= EDGE], lashes])
    near = covers[np.linalg.norm(head.neutral[covers] - centre, axis=1) < _NEAR * head.eye_radius]
    return near, np.where(rings[near] == EDGE, EDGE_MARGIN, EYEBALL_MARGIN)


def _nearest_on_path(start: Mesh, end: Mesh) -> Mesh:
    """Return the (n, 3) points nearest to the origin on the straight paths between (n, 3) points."""
    way = end - start
    share = -(start * way).sum(1) / np.maximum((way**2).sum(1), 1e-12)
    nearest: Mesh = start + np.clip(share, 0, 1)[:, None] * way
    return nearest
