"""Pictures of expressions: from the front, turned, and where each movement is seen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import core_face_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rendering.heat import HeatArtist
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import renderer_for

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.protocol import Renderer
    from emogen_core.transfer.packing.pack import Packing

    from .words import Movement

    Pixels = NDArray[np.uint8]

PAPER = (255, 255, 255)
SETTINGS = RenderSettings(720, 864, PAPER)
TURN = 30.0
# What is kept of a portrait: left, top, right, bottom as shares of it. Turned heads reach further to the left.
_FRONT, _TURNED = (0.16, 0.06, 0.84, 0.885), (0.02, 0.06, 0.70, 0.885)
# Share of a picture's height over which it runs out into the paper.
_RUN_OUT = 0.07
# The map of movements needs no pores, and is drawn slowly.
_MAP = RenderSettings(540, 648, PAPER)
# A face without movement, sRGB, and how much of its movement's colour a vertex has that barely moves.
_GREY, _FAINT = 0.88, 0.35


@dataclass(frozen=True, slots=True)
class Views:
    """Three pictures of an expression, (height, width, 3) uint8 sRGB on white, all of one part of the head."""

    front: Pixels
    turned: Pixels
    moves: Pixels


class Studio:
    """Draws expressions of one head."""

    def __init__(self, rig: Rig, identity: str, front: Renderer, turned: Renderer) -> None:
        """Take the rig, the head that wears it, and what draws it from the front and turned by `TURN`."""
        self._rig, self._identity, self._front, self._turned = rig, identity, front, turned
        skin = rig.parts["skin"] if "skin" in rig.parts else (0, len(rig.triangles))
        used = np.unique(rig.triangles[slice(*skin)])
        self._artist = HeatArtist(rig.neutral(identity)[used], rig.triangles, _MAP)

    def views(self, core: NDArray[np.floating], painted: NDArray[np.floating]) -> Views:
        """Return the pictures of the (C,) weights of core shapes, with the (N, 3) colours of its movements."""
        weights = core_face_weights(self._rig, self._identity, core[np.newaxis]).weights
        front, turned = (one.draw(self._identity, weights, SETTINGS)[0] for one in (self._front, self._turned))
        moves = self._artist.paint(vertices(self._rig, self._identity, weights)[0], painted)
        return Views(_cut(front, _FRONT), _cut(turned, _TURNED), _cut(moves, _FRONT))

    def close(self) -> None:
        """Close the renderers."""
        self._turned.close()
        self._front.close()


def studio(rig: Rig, look: Look, identity: str, backend: str) -> Studio:
    """Return a studio with its renderers, to be closed.

    Raises:
        MissingGLError: ``pyrender`` on a machine without OpenGL.
    """
    front = renderer_for(backend, rig, look)
    turned = renderer_for(backend, rig, look, TURN)
    return Studio(rig, identity, front, turned)


def painted(packing: Packing, names: Sequence[str], movements: Sequence[Movement]) -> NDArray[np.float64]:
    """Return (N, 3) sRGB colours in [0, 1]: a face in grey, and each movement in its colour where it is active.

    Colours run out beyond the active vertices, for the mesh is too coarse for a clean edge.

    Args:
        packing: of the shapes.
        names: of the shapes.
        movements: of one expression; the earlier ones are painted over the later ones.
    """
    edge = packing.reach[packing.active].min()
    colours = np.full((packing.active.shape[1], 3), _GREY)
    for movement in reversed(movements):
        rows = [names.index(name) for name in movement.shapes]
        reach = packing.reach[rows].max(0)
        share = (np.minimum(reach / edge, 1) ** 3 * (_FAINT + (1 - _FAINT) * reach))[:, None]
        colours = (1 - share) * colours + share * rgb(movement.colour)
    return colours


def rgb(colour: str) -> NDArray[np.float64]:
    """Return the (3,) sRGB in [0, 1] of a colour as CSS writes it, ``#0b6b7b``."""
    return np.array([int(colour[at : at + 2], 16) for at in (1, 3, 5)]) / 255


def _cut(picture: Pixels, part: tuple[float, float, float, float]) -> Pixels:
    """Return a part of a picture, running out into the paper at its lower edge, where shoulders are cut."""
    height, width = picture.shape[:2]
    left, top, right, bottom = part
    cut = picture[round(top * height) : round(bottom * height), round(left * width) : round(right * width)]
    ink = np.clip(np.linspace(1 / _RUN_OUT, 0, len(cut)), 0, 1)[:, None, None]
    faded: Pixels = np.round(255 - ink * (255 - cut.astype(np.float64))).astype(np.uint8)
    return faded
