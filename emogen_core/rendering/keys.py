"""The name of a portrait: the same face always has the same key, and a key never changes its meaning."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings

# Counted up whenever the same rig, look, weights and settings come to give other pixels (shaders, camera, encoder).
PICTURE_VERSION = 6


def portrait_key(  # noqa: PLR0913, PLR0917 - all that a picture depends on
    rig_hash: str, look_hash: str, backend: str, identity: str, weights: NDArray[np.float32], settings: RenderSettings
) -> str:
    """Return the SHA-256 (hexadecimal) that names one portrait.

    Args:
        rig_hash: hash of the rig file.
        look_hash: hash of the look file.
        backend: name of the renderer; two renderers never share a picture.
        identity: the head that wears the rig.
        weights: (K,) weights of all shapes.
        settings: size and background.
    """
    head = [
        PICTURE_VERSION, rig_hash, look_hash, backend, identity,
        settings.width, settings.height, list(settings.background),
    ]  # fmt: skip
    digest = hashlib.sha256(json.dumps(head, separators=(",", ":")).encode())
    digest.update(b"\0" + np.ascontiguousarray(weights, "<f4").tobytes())
    return digest.hexdigest()
