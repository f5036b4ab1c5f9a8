"""Pictures inside a page, and the scale of heat on faces."""

from __future__ import annotations

import base64
import io
import math
from typing import TYPE_CHECKING

from PIL import Image

from emogen_core.rendering.heat import STOPS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

STEPS_MM = (1, 5, 10, 50)
"""The last colour of the heat is a multiple of one of these, no more than ten times as much."""


def inline(picture: Image.Image | NDArray[np.uint8]) -> str:
    """Return a picture, or its (height, width, 3) pixels, as an address that holds it."""
    image = picture if isinstance(picture, Image.Image) else Image.fromarray(picture)
    buffer = io.BytesIO()
    image.save(buffer, "WEBP", quality=82)
    return f"data:image/webp;base64,{base64.b64encode(buffer.getvalue()).decode()}"


def rounded_up(millimetres: float) -> float:
    """Return the next round number of millimetres, 1 at least."""
    step = next((step for step in STEPS_MM if millimetres <= 10 * step), STEPS_MM[-1])
    return float(max(math.ceil(millimetres / step), 1) * step)


def scale() -> str:
    """Return the colours of the heat, from nothing to the limit, as a gradient of CSS."""
    stops = (" ".join(f"{100 * part:.0f}%" for part in stop) for stop in STOPS.tolist())
    return f"linear-gradient(90deg, {', '.join(f'rgb({stop})' for stop in stops)})"
