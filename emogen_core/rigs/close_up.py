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

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def close_up(
    identity: str = "", genes: Sequence[str] = (), emotion: str = "", size: int = 1000, backend: str = "pyrender"
) -> bytes:
    """Draw one face of the bundled rig, corrected as in a study.

    Args:
        identity: who; the rig's first by default.
        genes: each ``name=value``, value in [0, 1].
        emotion: an emotion set of the rig, at full strength before ``genes`` are set.
        size: width and height, pixels.
        backend: which renderer draws.

    Returns:
        A PNG file.

    Raises:
        InvalidInputError: an unknown identity, gene or emotion, or a value outside [0, 1].
        MissingGLError: ``pyrender`` on a machine without OpenGL.
    """
    renderer, rig = make_renderer(backend)
    who = identity or rig.identities[0]
    weights = face_weights(rig, who, genome(rig, genes, emotion)[np.newaxis]).weights
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
