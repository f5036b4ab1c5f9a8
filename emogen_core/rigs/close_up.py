"""One face, as large as somebody wants to look at it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import face_weights
from emogen_core.errors import InvalidInputError, expected
from emogen_core.rendering.png import encode_png
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import make_renderer

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def close_up(  # noqa: PLR0913 - the last two by keyword
    identity: str = "",
    genes: Sequence[str] = (),
    emotion: str = "",
    size: int = 1000,
    *,
    backend: str = "pyrender",
    rig: Path | None = None,
) -> bytes:
    """Draw one face, corrected as in a study.

    Args:
        identity: who; the rig's first by default.
        genes: each ``name=value``, value in [0, 1].
        emotion: an emotion set of the rig, at full strength before ``genes`` are set.
        size: width and height, pixels.
        backend: which renderer draws.
        rig: a rig file, with its look beside it; the bundled one by default.

    Returns:
        A PNG file.

    Raises:
        InvalidInputError: an unknown identity, gene or emotion, or a value outside [0, 1].
        MissingGLError: ``pyrender`` on a machine without OpenGL.
        RigFileError: a file is missing or damaged.
    """
    renderer, model = make_renderer(backend, rig)
    who = identity or model.identities[0]
    weights = face_weights(model, who, genome(model, genes, emotion)[np.newaxis]).weights
    picture = renderer.draw(who, weights, RenderSettings(size, size))[0]
    renderer.close()
    return encode_png(picture)


def genome(rig: Rig, genes: Sequence[str], emotion: str = "") -> NDArray[np.float64]:
    """Return the (G,) genome of an emotion set, changed by ``name=value`` words. Raises as `close_up`."""
    values = rig.emotion_genes(emotion) if emotion else np.zeros(len(rig.genes))
    for word in genes:
        name, _, value = word.partition("=")
        try:
            number = float(value)
        except ValueError:
            raise InvalidInputError(f"gene: {expected('name=value, as mouthSmile=0.5', word)}") from None
        values[rig.gene_indices((name,))] = number
    return values
