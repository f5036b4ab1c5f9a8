"""The same faces without and with their expression lines, one above the other."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import look_for

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look
    from emogen_core.rendering.protocol import Renderer

# Identity and emotion set, at full strength.
FACES = (
    ("female", "surprised"), ("caucasian-male-old", "fearful"), ("african-male-young", "disgusted"),
    ("asian-female-old", "sad"), ("male", "happy"),
)  # fmt: skip
_SETTINGS = RenderSettings(400, 480)


def wrinkle_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw `FACES` with renderers of the given kind, above without and below with expression lines."""
    look, kind = look_for(rig), type(renderer)
    smooth = replace(look, styles={name: replace(style, wrinkles=0.0) for name, style in look.styles.items()})
    return Image.fromarray(np.concatenate([np.concatenate(_faces(kind, rig, worn), 1) for worn in (smooth, look)]))


def _faces(kind: Callable[[Rig, Look], Renderer], rig: Rig, look: Look) -> list[NDArray[np.uint8]]:
    renderer = kind(rig, look)
    pictures = []
    for identity, emotion in FACES:
        weights = face_weights(rig, identity, rig.emotion_genes(emotion)[np.newaxis]).weights
        pictures.append(renderer.draw(identity, weights, _SETTINGS)[0])
    renderer.close()
    return pictures
