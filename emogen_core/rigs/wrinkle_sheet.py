"""The same faces without and with their expression lines, one above the other."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import load_dressed, renderer_for
from emogen_core.rigs.close_up import genome

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look

# Identity and emotion, each with all its genes at 1.
FACES = (
    ("female", "surprised"), ("caucasian-male-old", "fearful"), ("african-male-young", "disgusted"),
    ("asian-female-old", "sad"), ("male", "happy"),
)  # fmt: skip
_SETTINGS = RenderSettings(400, 480)
_QUALITY = 88


def wrinkle_sheet(path: Path, backend: str = "pyrender") -> None:
    """Write a JPEG file of `FACES`, above without and below with expression lines.

    Raises:
        MissingGLError: ``pyrender`` on a machine without OpenGL.
    """
    rig, look = load_dressed()
    smooth = replace(look, styles={name: replace(style, wrinkles=0.0) for name, style in look.styles.items()})
    rows = [np.concatenate(_faces(rig, worn, backend), axis=1) for worn in (smooth, look)]
    Image.fromarray(np.concatenate(rows)).save(path, quality=_QUALITY)


def _faces(rig: Rig, look: Look, backend: str) -> list[NDArray[np.uint8]]:
    renderer = renderer_for(backend, rig, look)
    pictures = []
    for identity, emotion in FACES:
        weights = face_weights(rig, identity, genome(rig, (), emotion)[np.newaxis]).weights
        pictures.append(renderer.draw(identity, weights, _SETTINGS)[0])
    renderer.close()
    return pictures
