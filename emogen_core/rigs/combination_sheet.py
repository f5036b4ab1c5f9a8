"""Combinational correctives before and after: the strongest pairs at full weight, and random faces that need them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import make_renderer
from emogen_core.rigs.combination_check import flesh
from emogen_core.rigs.quality import Gauge
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

PAIRS, FACES = 10, 5
# Random faces among which those are looked for that the correctives help most.
SEARCHED = 120
_DRAWN = RenderSettings(480, 576)
# The face's part of a portrait: left, top, right, bottom as shares.
_FACE = (0.14, 0.2, 0.86, 0.86)
_CAPTION = 18
_COLUMNS = 5
_QUALITY = 88


def combination_sheet(
    path: Path, identity: str = "female", seed: int = 1, backend: str = "pyrender", rig: Path | None = None
) -> None:
    """Draw faces with their shapes added above, corrected below, as a JPEG file.

    First the pairs whose corrective mends most, both genes at 1, then random faces that all correctives together mend
    most. Captions say how many triangles are flipped, folded or overstretched, without and with.

    Args:
        path: the file to write.
        identity: the head.
        seed: of the random faces.
        backend: which renderer draws.
        rig: rig file; the bundled one by default.

    Raises:
        InvalidInputError: an unknown identity.
        MissingGLError: ``pyrender`` on a machine without OpenGL.
        RigFileError: the rig file is missing or damaged.
    """
    renderer, model = make_renderer(backend, rig)
    captions, before, after = _chosen(model, identity, seed)
    above, below = np.split(renderer.draw(identity, np.concatenate([before, after]), _DRAWN), 2)
    renderer.close()
    tiles = [_tile(*parts) for parts in zip(captions, above, below, strict=True)]
    width, height = tiles[0].size
    sheet = Image.new("RGB", (width * _COLUMNS, height * -(-len(tiles) // _COLUMNS)), "white")
    for place, tile in enumerate(tiles):
        sheet.paste(tile, (place % _COLUMNS * width, place // _COLUMNS * height))
    sheet.save(path, quality=_QUALITY)


def _chosen(rig: Rig, identity: str, seed: int) -> tuple[list[str], NDArray[np.float32], NDArray[np.float32]]:
    """Return captions and weights (n, K) without and with correctives: the strongest pairs, then random faces."""
    pairs: list[tuple[str, ...]] = [
        combination.parents for combination in rig.combinations if len(combination.parents) == 2
    ]
    genes = np.concatenate([_at_one(rig, pairs), random_genes(rig, SEARCHED, seed)])
    after = shape_weights(rig, genes)
    before = after.copy()
    before[:, len(rig.core_shapes) :] = 0
    gauge = Gauge(rig.neutral(identity).astype(np.float64), flesh(rig))
    broken = np.array(
        [[_broken(gauge, rig, identity, row) for row in both] for both in zip(before, after, strict=True)]
    )
    gain = broken[:, 0] - broken[:, 1]
    best_pairs = np.argsort(-gain[: len(pairs)], kind="stable")[:PAIRS]
    best_faces = len(pairs) + np.argsort(-gain[len(pairs) :], kind="stable")[:FACES]
    rows = np.concatenate([best_pairs, best_faces])
    names = [" + ".join(pairs[row]) if row < len(pairs) else f"random face {row - len(pairs) + 1}" for row in rows]
    captions = [f"{name}: {a} then {b}" for name, (a, b) in zip(names, broken[rows], strict=True)]
    return captions, before[rows], after[rows]


def _at_one(rig: Rig, pairs: list[tuple[str, ...]]) -> NDArray[np.float64]:
    genes = np.zeros((len(pairs), len(rig.genes)))
    for row, parents in zip(genes, pairs, strict=True):
        row[rig.gene_indices(parents)] = 1
    return genes


def _broken(gauge: Gauge, rig: Rig, identity: str, weights: NDArray[np.float32]) -> int:
    mesh = vertices(rig, identity, weights[np.newaxis])[0].astype(np.float64)
    return int(gauge.damage(mesh).total)


def _tile(caption: str, before: NDArray[np.uint8], after: NDArray[np.uint8]) -> Image.Image:
    box = tuple(int(s * n) for s, n in zip(_FACE, 2 * before.shape[1::-1], strict=True))
    faces = [picture[box[1] : box[3], box[0] : box[2]] for picture in (before, after)]
    height, width = faces[0].shape[:2]
    tile = Image.new("RGB", (width, 2 * height + _CAPTION), "white")
    ImageDraw.Draw(tile).text((4, 2), caption, fill="black", font=ImageFont.load_default(12))
    for row, face in enumerate(faces):
        tile.paste(Image.fromarray(face), (0, _CAPTION + row * height))
    return tile
