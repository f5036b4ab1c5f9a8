"""The drawing processes as the portraits' drawer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.errors import RenderingError
from emogen_core.rendering.keys import portrait_key
from emogen_core.rendering.pool import Priority

if TYPE_CHECKING:
    from concurrent.futures import Future

    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.rendering.pool import RenderPool
    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

    from .sketch import Sketch


@dataclass(frozen=True)
class PoolDrawer:
    """Draws in the processes of a pool."""

    pool: RenderPool

    def key(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> str:
        """Return the content key of a portrait."""
        return self.pool.key(identity, weights, settings)

    def submit(self, sketch: Sketch, priority: int, head: WornHead | None = None) -> Future[bytes]:
        """Have a portrait drawn."""
        return self.pool.submit(sketch.identity, sketch.weights, sketch.settings, Priority(priority), head)

    def close(self) -> None:
        """End the drawing processes."""
        self.pool.close()


@dataclass(frozen=True)
class NoDrawer:
    """Knows the keys and draws nothing, for work that nobody looks at."""

    rig_hash: str
    look_hash: str
    backend: str

    def key(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> str:
        """Return the content key that the pool would give."""
        return portrait_key(self.rig_hash, self.look_hash, self.backend, identity, weights, settings)

    def submit(self, *_: object) -> Future[bytes]:
        """Refuse."""
        raise RenderingError("this process draws no portraits")

    def close(self) -> None:
        """Do nothing."""
