"""What every renderer offers, so that the outside world (OpenGL) can be swapped behind one method."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.rendering.worn import WornHead

SURROUND_LIGHT = (0xC9, 0xC9, 0xC9)
SURROUND_DARK = (0x4B, 0x4B, 0x4B)


@dataclass(frozen=True, slots=True)
class RenderSettings:
    """Size in pixels and background (sRGB, 0 to 255) of a portrait. Part of the portrait's content key."""

    width: int = 400
    height: int = 480
    background: tuple[int, int, int] = SURROUND_LIGHT


class Renderer(Protocol):
    """Draws faces of one rig and look; lives in one thread and keeps its GL objects between calls."""

    def draw(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> NDArray[np.uint8]:
        """Draw faces given by their full weights, correctives included.

        Args:
            identity: the head that wears the rig.
            weights: (B, K) weights of all shapes, in [0, 1].
            settings: size and background.

        Returns:
            (B, height, width, 3) uint8 sRGB.
        """
        ...

    def wear(self, head: WornHead) -> None:
        """Take one more head in, to be drawn under its name."""
        ...

    def drop(self, name: str) -> None:
        """Let a head go that was taken in."""
        ...

    def close(self) -> None:
        """Free what the renderer holds; it draws no more."""
        ...
