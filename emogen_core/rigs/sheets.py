"""Contact sheets: every gene, identity and emotion, and random faces, so that somebody can look at all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import make_renderer

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.protocol import Renderer

    Tile = tuple[str, str, NDArray[np.float64]]

RANDOM_FACES = 20
# As the search's random faces: so many genes of the enabled ones, each uniform in [0, 1].
RANDOM_GENES = 6
_SMALL, _LARGE = RenderSettings(220, 264), RenderSettings(320, 384)
_CAPTION = 18
_QUALITY = 84


def make_sheets(out_dir: Path, backend: str = "pyrender") -> list[Path]:
    """Draw all sheets of the bundled rig as JPEG files.

    Args:
        out_dir: the folder to write to; made if need be.
        backend: which renderer draws.

    Returns:
        The files: ``genes.jpg`` (every gene at 1 on two heads), ``identities.jpg``, ``emotions.jpg`` (the emotion
        sets at full strength on every head) and ``random.jpg``.

    Raises:
        MissingGLError: ``pyrender`` on a machine without OpenGL.
    """
    out_dir.mkdir(parents=True, exist_ok=True)
    renderer, rig = make_renderer(backend)
    sheets = {
        "genes": (_genes(rig), 10, _SMALL),
        "identities": (_identities(rig), 7, _LARGE),
        "emotions": (_emotions(rig), 1 + len(rig.emotion_sets), _SMALL),
        "random": (_random(rig), 5, _LARGE),
    }
    paths = []
    for name, (tiles, columns, settings) in sheets.items():
        paths.append(out_dir / f"{name}.jpg")
        _sheet(renderer, rig, tiles, columns, settings).save(paths[-1], quality=_QUALITY)
    renderer.close()
    return paths


def _genes(rig: Rig) -> Iterator[Tile]:
    for identity in ("female", "male"):
        yield identity, "neutral", np.zeros(len(rig.genes))
        for row, gene in zip(np.eye(len(rig.genes)), rig.genes, strict=True):
            yield identity, f"{gene.name} {'+'.join(gene.action_units)}", row


def _identities(rig: Rig) -> Iterator[Tile]:
    for identity in rig.identities:
        yield identity, identity, np.zeros(len(rig.genes))


def _emotions(rig: Rig) -> Iterator[Tile]:
    for identity in rig.identities:
        yield identity, identity, np.zeros(len(rig.genes))
        for emotion in rig.emotion_sets:
            yield identity, emotion, rig.emotion_genes(emotion)


def _random(rig: Rig) -> Iterator[Tile]:
    rng = np.random.default_rng(2021)
    enabled = [i for i, gene in enumerate(rig.genes) if not gene.flags & {"disabled", "lateral", "gaze"}]
    for number in range(RANDOM_FACES):
        genes = np.zeros(len(rig.genes))
        genes[rng.choice(enabled, RANDOM_GENES, replace=False)] = rng.random(RANDOM_GENES)
        identity = rig.identities[number % len(rig.identities)]
        yield identity, f"{number + 1} {identity}", genes


def _sheet(renderer: Renderer, rig: Rig, tiles: Iterable[Tile], columns: int, settings: RenderSettings) -> Image.Image:
    listed = list(tiles)
    height = settings.height + _CAPTION
    rows = -(-len(listed) // columns)
    sheet = Image.new("RGB", (columns * settings.width, rows * height), "white")
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(12)
    for number, (identity, caption, genes) in enumerate(listed):
        weights = face_weights(rig, identity, genes[np.newaxis]).weights
        left, top = number % columns * settings.width, number // columns * height
        sheet.paste(Image.fromarray(renderer.draw(identity, weights, settings)[0]), (left, top))
        pen.text((left + 4, top + settings.height + 2), caption, fill="black", font=font)
    return sheet
