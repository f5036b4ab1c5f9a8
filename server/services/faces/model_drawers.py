"""One drawer for the faces of all face models: each model has drawing processes of its own, started when needed.

They start behind the scenes: whoever asks for a face meanwhile has a promise that is kept once they run. A model that
nobody has drawn for a while gives its processes back.
"""

from __future__ import annotations

import threading
import time
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias

from emogen_core.errors import EmogenError, RenderingError
from emogen_core.rendering.keys import portrait_key

from .face_model import own_head, own_name

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

    from .face_model import FaceModel, Models
    from .portraits import PortraitDrawer
    from .sketch import Sketch

DrawerOf: TypeAlias = "Callable[[FaceModel], PortraitDrawer]"
IDLE_SECONDS = 600.0
"""How long drawing processes of a model beside the bundled one stay without work."""


@dataclass
class _Running:
    drawer: Future[PortraitDrawer]
    used: float = 0.0

    @property
    def failed(self) -> bool:
        return self.drawer.done() and _failure(self.drawer) is not None


class ModelDrawers:
    """Draws every face with the processes of its model."""

    def __init__(self, own: PortraitDrawer, models: Models, backend: str, drawer_of: DrawerOf | None = None) -> None:
        """Draw the bundled model's faces with `own`; without `drawer_of`, no others."""
        self._own, self._models, self._backend, self._drawer_of = own, models, backend, drawer_of
        self._running: dict[str, _Running] = {}
        self._lock = threading.Lock()
        self._starting = ThreadPoolExecutor(1, thread_name_prefix="drawers-start")

    def key(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> str:
        """Return the content key of a portrait."""
        model = self._models.of(identity)
        if model is None:
            return self._own.key(identity, weights, settings)
        return portrait_key(model.rig.hash, model.look_hash, self._backend, own_name(identity), weights, settings)

    def submit(self, sketch: Sketch, priority: int, head: WornHead | None = None) -> Future[bytes]:
        """Have a portrait drawn."""
        model = self._models.of(sketch.identity)
        if model is None:
            return self._own.submit(sketch, priority, head)
        own, worn = replace(sketch, identity=own_name(sketch.identity)), None if head is None else own_head(head)
        return _then(self._drawer(model), lambda drawer: drawer.submit(own, priority, worn))

    def close(self) -> None:
        """End all drawing processes."""
        self._starting.shutdown(wait=True, cancel_futures=True)
        for running in self._running.values():
            _end(running.drawer)
        self._own.close()

    def _drawer(self, model: FaceModel) -> Future[PortraitDrawer]:
        with self._lock:
            running = self._running.get(model.rig.hash)
            if running is None or running.failed:
                running = self._running[model.rig.hash] = _Running(self._starting.submit(self._start, model))
            running.used = time.monotonic()
            idle = [name for name, one in self._running.items() if running.used - one.used > IDLE_SECONDS]
            over = [self._running.pop(name) for name in idle]
        for one in over:
            _end(one.drawer)
        return running.drawer

    def _start(self, model: FaceModel) -> PortraitDrawer:
        if self._drawer_of is None:
            raise RenderingError("this process draws no portraits")
        return self._drawer_of(model)


def _end(drawer: Future[PortraitDrawer]) -> None:
    """End a drawer, as soon as it runs."""
    drawer.add_done_callback(lambda made: None if made.cancelled() or made.exception() else made.result().close())


def _then(drawer: Future[PortraitDrawer], draw: Callable[[PortraitDrawer], Future[bytes]]) -> Future[bytes]:
    """Return the promise of a portrait, whether its drawer runs yet or not."""
    if drawer.done() and not drawer.cancelled() and drawer.exception() is None:
        return draw(drawer.result())
    promise: Future[bytes] = Future()

    def started(made: Future[PortraitDrawer]) -> None:
        if not promise.set_running_or_notify_cancel():
            return
        if error := _failure(made):
            promise.set_exception(error)
            return
        try:
            draw(made.result()).add_done_callback(finished)
        except EmogenError as refused:
            promise.set_exception(refused)

    def finished(picture: Future[bytes]) -> None:
        if error := _failure(picture):
            promise.set_exception(error)
        else:
            promise.set_result(picture.result())

    drawer.add_done_callback(started)
    return promise


def _failure(done: Future[Any]) -> BaseException | None:
    """Return why something that is over has no result."""
    return CancelledError() if done.cancelled() else done.exception()
