"""The portrait of any head of the space, at rest or in an emotion, by a renderer that need not know the head."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.worn import worn_rig
from emogen_core.rigs.wear import fit_head

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.identity import Identity
    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace
    from emogen_core.rendering.protocol import Renderer, RenderSettings


def draw_head(  # noqa: PLR0913, PLR0917 - who draws what
    renderer: Renderer, rig: Rig, space: IdentitySpace, identity: Identity, settings: RenderSettings, emotion: str = ""
) -> NDArray[np.uint8]:
    """Draw one head, corrected as in a study; the renderer lets go of it afterwards.

    Args:
        renderer: draws; it must have been made for ``rig``.
        rig: the face model that the space was made for.
        space: the space of heads.
        identity: the head and its look.
        settings: size and background.
        emotion: an emotion set of the rig at full strength; at rest without it, which takes less time.

    Returns:
        (height, width, 3) uint8 sRGB.

    Raises:
        InvalidInputError: an unknown emotion, or the space was made for another mesh.
        IdentityError: the identity is no point of the space.
    """
    genes = rig.emotion_genes(emotion) if emotion else np.zeros(len(rig.genes))
    head = fit_head(rig, space, identity, moving=bool(emotion))
    weights = face_weights(worn_rig(rig, head), head.name, genes[np.newaxis]).weights
    renderer.wear(head)
    picture: NDArray[np.uint8] = renderer.draw(head.name, weights, settings)[0]
    renderer.drop(head.name)
    return picture
