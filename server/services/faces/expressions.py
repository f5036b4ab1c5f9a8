"""What heads are shown with while they are made: at rest, or with one of their rig's emotions; small and large."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.protocol import RenderSettings

from ..errors import InvalidError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

NEUTRAL = "neutral"
SMALL, LARGE = RenderSettings(200, 240), RenderSettings(400, 480)


def emotion_weights(rig: Rig, head: str, emotion: str) -> NDArray[np.float32]:
    """Return the (K,) weights of a head at rest, or with one of its rig's prototypes at full strength."""
    if emotion == NEUTRAL:  # every head was made so that it collides with nothing at rest
        return np.zeros(len(rig.shape_names), np.float32)
    weights: NDArray[np.float32] = face_weights(rig, head, rig.emotion_genes(emotion)[np.newaxis]).weights[0]
    return weights


def check_emotion(rig: Rig, emotion: str) -> None:
    """Refuse, by `InvalidError`, what is neither neutral nor an emotion of a rig."""
    known = (NEUTRAL, *rig.emotion_sets)
    if emotion not in known:
        wanted = f"one of {', '.join(known)}"
        raise InvalidError("There is no such emotion.", field="emotion", expected=wanted, got=emotion)
