"""The faces that collide worst, before and after: what figures of a collision stage cannot show."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.judge import dense_depth
from emogen_core.correctives.pipeline import face_weights, shape_weights
from emogen_core.rigs.contact import MOUTH, arranged, captioned
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from PIL import Image

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.protocol import Renderer

# So many heads with their deepest face by lips, and by teeth.
WORST = (6, 4)
FACES = 200
SEED = 1
_COLUMNS = 5


@dataclass(frozen=True, slots=True, eq=False)
class _Face:
    """A head's deepest face of one type: weights (K,) without and with the correction, millimetres for the judge."""

    identity: str
    weights: tuple[NDArray[np.float32], NDArray[np.float32]]
    depth: tuple[float, float]


def collision_sheet(renderer: Renderer, rig: Rig, faces: int = FACES, seed: int = SEED) -> Image.Image:
    """Draw the mouths of the deepest of some random faces of every head, uncorrected above corrected.

    Args:
        renderer: draws; it must wear ``rig``.
        rig: the face model.
        faces: random faces a head.
        seed: of the faces.
    """
    genes = random_genes(rig, faces, seed)
    worst = [_deepest(rig, identity, genes) for identity in rig.identities]
    chosen = []
    for kind, count in enumerate(WORST):
        ranked = sorted((pair[kind] for pair in worst), key=lambda face: -face.depth[0])
        chosen += ranked[:count]
    return arranged([_tile(renderer, face) for face in chosen], _COLUMNS)


def _deepest(rig: Rig, identity: str, genes: NDArray[np.float64]) -> tuple[_Face, _Face]:
    """Return a head's deepest faces by lips and by teeth."""
    before = shape_weights(rig, genes)
    depth = dense_depth(rig, identity, before)
    rows = depth.argmax(0)
    after = face_weights(rig, identity, genes[rows]).weights
    left = dense_depth(rig, identity, after).max(1)
    lips, teeth = (
        _Face(identity, (before[row], after[kind]), (float(depth[row].max()), float(left[kind])))
        for kind, row in enumerate(rows)
    )
    return lips, teeth


def _tile(renderer: Renderer, face: _Face) -> Image.Image:
    pictures = renderer.draw(face.identity, np.stack(face.weights), MOUTH.settings)
    caption = f"{face.identity}: {face.depth[0]:.1f} mm, then {face.depth[1]:.1f} mm"
    return captioned([MOUTH.cut(picture) for picture in pictures], caption)
