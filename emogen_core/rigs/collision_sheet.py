"""The faces that collide worst, before and after: what figures of a collision stage cannot show."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from emogen_core.correctives.collision.judge import dense_depth
from emogen_core.correctives.pipeline import face_weights, shape_weights
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import make_renderer
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

# Of every head: the deepest by lips, then the deepest by teeth.
WORST = (3, 2)
_DRAWN = RenderSettings(800, 960)
# The mouth's part of a portrait: left, top, right, bottom as shares.
_MOUTH = (0.27, 0.5, 0.73, 0.84)
_CAPTION = 18
_COLUMNS = 5
_QUALITY = 88


def collision_sheet(
    path: Path,
    identities: tuple[str, ...] = ("female", "male"),
    faces: int = 200,
    seed: int = 1,
    backend: str = "pyrender",
) -> None:
    """Draw the mouths of the deepest of some random faces, uncorrected above corrected, as a JPEG file.

    Args:
        path: the file to write.
        identities: the heads; `WORST` faces of each.
        faces: random faces a head.
        seed: of the faces.
        backend: which renderer draws.

    Raises:
        MissingGLError: ``pyrender`` on a machine without OpenGL.
    """
    renderer, rig = make_renderer(backend)
    tiles = []
    for identity in identities:
        before, after, depths = _worst(rig, identity, random_genes(rig, faces, seed))
        pictures = renderer.draw(identity, np.concatenate([before, after]), _DRAWN)
        above, below = np.split(pictures, 2)
        tiles += [_tile(identity, *parts) for parts in zip(above, below, depths, strict=True)]
    renderer.close()
    width, height = tiles[0].size
    sheet = Image.new("RGB", (width * _COLUMNS, height * -(-len(tiles) // _COLUMNS)), "white")
    for place, tile in enumerate(tiles):
        sheet.paste(tile, (place % _COLUMNS * width, place // _COLUMNS * height))
    sheet.save(path, quality=_QUALITY)


def _worst(
    rig: Rig, identity: str, genes: NDArray[np.float64]
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float64]]:
    """Return weights (n, K) without and with correction, and (n, 2) depths, of the deepest faces."""
    before = shape_weights(rig, genes)
    depth = dense_depth(rig, identity, before)
    chosen: list[int] = []
    for kind, count in enumerate(WORST):
        ranked = np.argsort(-depth[:, kind], kind="stable").tolist()
        chosen += [row for row in ranked if row not in chosen][:count]
    after = face_weights(rig, identity, genes[chosen]).weights
    return before[chosen], after, np.stack([depth[chosen].max(1), dense_depth(rig, identity, after).max(1)], 1)


def _tile(
    identity: str, before: NDArray[np.uint8], after: NDArray[np.uint8], depth: NDArray[np.float64]
) -> Image.Image:
    left, top, right, bottom = _MOUTH
    box = tuple(int(s * n) for s, n in zip((left, top, right, bottom), 2 * before.shape[1::-1], strict=True))
    mouths = [picture[box[1] : box[3], box[0] : box[2]] for picture in (before, after)]
    height, width = mouths[0].shape[:2]
    tile = Image.new("RGB", (width, 2 * height + _CAPTION), "white")
    caption = f"{identity}: {depth[0]:.1f} mm, then {depth[1]:.1f} mm"
    ImageDraw.Draw(tile).text((4, 2), caption, fill="black", font=ImageFont.load_default(13))
    for row, mouth in enumerate(mouths):
        tile.paste(Image.fromarray(mouth), (0, _CAPTION + row * height))
    return tile
