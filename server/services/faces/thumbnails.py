"""Small pictures of recorded faces, for pages that show a hundred of them: shrunk from the portraits that are there.

A portrait of an older look cannot be had any more; its face is then drawn as it looks today.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PIL import Image

if TYPE_CHECKING:
    from concurrent.futures import Future

    from .portraits import Portraits

WIDTH = 144
QUALITY = 88


@dataclass(frozen=True)
class Thumbnails:
    """Draws little and keeps much."""

    portraits: Portraits

    def kept(self, key: str) -> bytes | None:
        """Return the small picture of a portrait if it was made before."""
        return self.portraits.small(key)

    def portrait(self, key: str) -> Future[bytes]:
        """Return the promise of the portrait itself, drawn anew where it is of an older look.

        Raises:
            NotFoundError: no face has it, or it was made on another face model.
        """
        return self.portraits.recorded(key)

    def shrunk(self, key: str, portrait: bytes) -> bytes:
        """Return a portrait as a small JPEG, and keep it."""
        with Image.open(io.BytesIO(portrait)) as picture:
            small = picture.convert("RGB")
        if small.width > WIDTH:
            small = small.resize((WIDTH, round(small.height * WIDTH / small.width)), Image.Resampling.LANCZOS)
        buffer = io.BytesIO()
        small.save(buffer, "JPEG", quality=QUALITY)
        self.portraits.keep_small(key, buffer.getvalue())
        return buffer.getvalue()
