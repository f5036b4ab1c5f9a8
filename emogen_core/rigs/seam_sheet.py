"""How regions of the face meet: one expression cut apart at the borders and one that fades across them.

Every region gets an emotion of its own, unlike that of its neighbours. Below each face stands, as colour, by how much
the displacement jumps to a neighbouring vertex.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.landmarks.bank import bank_genes, make_bank
from emogen_core.landmarks.fit import Fitter
from emogen_core.landmarks.motions import Motions
from emogen_core.landmarks.regions import BAND, border_height, largest_jump, region_shares
from emogen_core.landmarks.solvers import make_solver
from emogen_core.rendering.heat import HeatArtist
from emogen_core.rendering.worn import WornHead
from emogen_core.rigs.contact import Frame, arranged, captioned
from emogen_core.rigs.piercing import triangle_edges

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from PIL import Image

    from emogen_core.landmarks.head import DrivenHead
    from emogen_core.rendering.protocol import Renderer

    Floats = NDArray[np.float64]

EMOTIONS = {2: ("happy", "angry"), 4: ("surprised", "happy", "angry", "sad")}
"""Of every region, in the order of `region_shares`."""
SEAM = Frame(560, (0.22, 0.25, 0.78, 0.81))
_LIMIT = 6.0


@dataclass(frozen=True, eq=False)
class Seam:
    """One way to put regions together.

    Attributes:
        regions: how many.
        band: width of the band, millimetres.
        surface: (N, 3) displacement of all vertices.
        jump: largest difference of displacements across an edge of the skin near a border, millimetres.
    """

    regions: int
    band: float
    surface: Floats
    jump: float


def make_seams(head: DrivenHead) -> list[Seam]:
    """Return two and four regions, each cut apart and blended, of expressions found by least squares."""
    solver = make_solver("nnls", head, make_bank(head, bank_genes(head.rig)))
    whole = Fitter(head, solver)
    edges = _edges_near_borders(head)
    seams = []
    for count in EMOTIONS:
        for band in (0.0, BAND):
            found = replace(whole, regions=count, band=band).fit(_mixed_motions(head, count))
            jump = largest_jump(found.surface, edges[count])
            seams.append(Seam(count, band, found.surface, jump))
    return seams


def own_jumps(head: DrivenHead) -> dict[int, float]:
    """Return by regions the largest jump near a border in the whole emotions: what is there without any border."""
    edges = _edges_near_borders(head)
    return {
        count: max(largest_jump(_emotion(head, name), edges[count]) for name in names)
        for count, names in EMOTIONS.items()
    }


def seam_report(head: DrivenHead) -> list[dict[str, Any]]:
    """Return the measures of `make_seams` as rows of plain values."""
    own = own_jumps(head)
    return [
        {
            "regions": seam.regions,
            "band_mm": seam.band,
            "largest_jump_mm": round(seam.jump, 2),
            "without_a_border_mm": round(own[seam.regions], 2),
        }
        for seam in make_seams(head)
    ]


def seam_picture(renderer: Renderer, head: DrivenHead, frame: Frame = SEAM) -> Image.Image:
    """Draw `make_seams`: faces above, the jumps of the displacement as colour below.

    Args:
        renderer: draws; it must wear the head's rig. It lets go of the faces afterwards.
        head: who is driven.
        frame: which part of a portrait is shown, and how large.
    """
    skin = head.rig.triangles[slice(*head.rig.parts["skin"])]
    artist = HeatArtist(head.neutral[np.unique(skin)], head.rig.triangles, frame.settings)
    tiles = []
    for number, seam in enumerate(make_seams(head)):
        face = (head.neutral + seam.surface).astype(np.float32)
        name = f"seam-{number}"
        renderer.wear(WornHead(name, face, None, {}, head.identity))
        rest = np.zeros((1, len(head.rig.shape_names)), np.float32)
        shown = renderer.draw(name, rest, frame.settings)[0]
        renderer.drop(name)
        heat = artist.draw(face, _jumps(seam.surface, skin), _LIMIT)
        tiles.append(captioned([frame.cut(shown), frame.cut(heat)], _caption(seam)))
    return arranged(tiles, len(tiles))


def _caption(seam: Seam) -> str:
    how = f"blended over {seam.band:g} mm" if seam.band else "cut apart"
    return f"{seam.regions} regions {how}: displacement jumps by up to {seam.jump:.1f} mm across an edge"


def _mixed_motions(head: DrivenHead, count: int) -> Motions:
    """Return motions of the points, each of the emotion of its region."""
    shares = region_shares(head.points, head.points, count, 0)
    moved = [_emotion(head, name)[head.vertices] for name in EMOTIONS[count]]
    return Motions(np.arange(len(head.points)), np.einsum("rp,rpk->pk", shares, np.stack(moved)))


def _emotion(head: DrivenHead, name: str) -> Floats:
    core = np.clip(head.rig.emotion_genes(name) @ head.rig.gene_to_core, 0, 1)
    return head.surface(head.face(core))


def _edges_near_borders(head: DrivenHead) -> dict[int, NDArray[np.int32]]:
    """Return by regions the (E, 2) edges of the skin within the bands."""
    edges = triangle_edges(head.rig.triangles[slice(*head.rig.parts["skin"])])
    middle = head.neutral[edges].mean(1)
    sides = np.abs(middle[:, 0]) < BAND / 2
    halves = np.abs(middle[:, 1] - border_height(head.points)) < BAND / 2
    return {2: edges[sides], 4: edges[sides | halves]}


def _jumps(surface: Floats, triangles: NDArray[np.int32]) -> Floats:
    """Return (N,) the largest jump at every vertex."""
    edges = triangle_edges(triangles)
    lengths = np.linalg.norm(surface[edges[:, 0]] - surface[edges[:, 1]], axis=1)
    jumps = np.zeros(len(surface))
    np.maximum.at(jumps, edges[:, 0], lengths)
    np.maximum.at(jumps, edges[:, 1], lengths)
    return jumps
