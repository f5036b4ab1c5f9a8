"""Where values lie in a drawing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .scale import Axis


@dataclass(frozen=True, slots=True)
class Frame:
    """Two axes and a size in pixels; `left`, `right`, `top`, `bottom` is the room around them."""

    x: Axis
    y: Axis
    width: float = 304
    height: float = 168
    left: float = 44
    right: float = 8
    top: float = 12
    bottom: float = 26

    @property
    def floor(self) -> float:
        """Height of the lower edge."""
        return self.height - self.bottom

    @property
    def end(self) -> float:
        """Where the axes end on the right."""
        return self.width - self.right

    def across(self, value: float) -> float:
        """Return how far right a value lies."""
        return self.left + self.x.share(value) * (self.end - self.left)

    def down(self, value: float) -> float:
        """Return how far down a value lies."""
        return self.floor - self.y.share(value) * (self.floor - self.top)

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point lies."""
        return self.across(x), self.down(y)
