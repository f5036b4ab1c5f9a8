"""Portraits: drawn once, cached under their content key, drawn ahead while a participant is looking.

A portrait that is being drawn has one entry here, whoever asks for it: an urgent request raises an earlier, patient
one instead of drawing twice. Bytes go to memory and to a file; a file that cannot be written stops nobody.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from emogen_core.errors import EmogenError

from ..store import runs
from .background import watched
from .errors import NotFoundError, UnavailableError
from .evolution import Sketch, settings_of, unpack_weights
from .journal import config_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

    from ..store.engine import Database
    from .portrait_files import PortraitFiles
    from .steps import Walk
    from .wardrobe import Wardrobe

URGENT = 0
AHEAD = 1


class PortraitDrawer(Protocol):
    """What draws: the pool of drawing processes, or a fake in tests."""

    def key(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> str:
        """Return the content key of a portrait."""
        ...

    def submit(self, sketch: Sketch, priority: int, head: WornHead | None = None) -> Future[bytes]:
        """Have a portrait drawn; a lower `priority` goes first. Heads that the rig does not have come along."""
        ...

    def close(self) -> None:
        """Stop drawing."""
        ...


@dataclass
class _Job:
    promise: Future[bytes]
    drawing: Future[bytes]
    sketch: Sketch
    priority: int


class Portraits:
    """Draws and keeps portraits."""

    def __init__(
        self,
        drawer: PortraitDrawer,
        files: PortraitFiles,
        database: Database,
        wardrobe: Wardrobe,
        memory_bytes: int,
    ) -> None:
        self.key = drawer.key
        self._drawer = drawer
        self._files = files
        self._database = database
        self._wardrobe = wardrobe
        self._memory = _Memory(memory_bytes)
        self._jobs: dict[str, _Job] = {}
        self._lock = threading.RLock()
        self._background = ThreadPoolExecutor(1, thread_name_prefix="portraits-ahead")

    def cached(self, key: str) -> bytes | None:
        """Return a portrait that is drawn already."""
        found = self._memory.get(key)
        if found is None:
            found = self._files.read(key)
            if found is not None:
                self._memory.put(key, found)
        return found

    def request(self, key: str) -> Future[bytes]:
        """Return the promise of a portrait that a face in the database has.

        Raises:
            NotFoundError: no face has this portrait, or it is of an older look.
            UnavailableError: the head that it wears is still being made.
        """
        with self._lock:
            job = self._jobs.get(key)
        sketch = job.sketch if job else self._sketch(key)
        self._wardrobe.wait(sketch.identity)
        return self._want(key, sketch, URGENT)

    def sketched(self, sketch: Sketch, head: WornHead | None = None) -> Future[bytes]:
        """Return the promise of a portrait that no participant sees; one of a ``head`` to try on is not kept."""
        if head is not None:
            return self._submit(sketch, URGENT, head)
        key = self.key(sketch.identity, sketch.weights, sketch.settings)
        found = self.cached(key)
        if found is None:
            return self._want(key, sketch, URGENT)
        done: Future[bytes] = Future()
        done.set_result(found)
        return done

    def after(self, offered: Sequence[tuple[str, Sketch]], following: Callable[[], list[Sketch]]) -> None:
        """Draw the faces that were just offered, and then those that may follow."""
        # This only saves time: whatever fails here is drawn, or refused aloud, when it is asked for.
        watched(self._background.submit(self._draw, offered, following), "drawing ahead failed")

    def following(self, walk: Walk) -> Callable[[], list[Sketch]]:
        """Return what to draw ahead once the faces on the screen are drawn."""
        step, position = walk.participation.step, walk.participation.position
        if step == "instructions":
            upcoming = walk.trial_at(0)
            return lambda: walk.evolution.first(upcoming) if upcoming else []
        if step not in {"practice", "evolve"}:
            return list
        trial = walk.trial()
        if trial.generation < walk.last_generation(trial):
            return lambda: walk.evolution.ahead(trial)
        upcoming = walk.trial_at(position + 1)
        return lambda: walk.evolution.first(upcoming) if upcoming else []

    def settle(self) -> None:
        """Wait until everything that was to be drawn ahead has been asked for. For tests and a tidy end."""
        self._background.submit(lambda: None).result()

    def close(self) -> None:
        """Stop drawing."""
        self._background.shutdown(wait=True, cancel_futures=True)
        self._drawer.close()

    def _draw(self, offered: Sequence[tuple[str, Sketch]], following: Callable[[], list[Sketch]]) -> None:
        for key, sketch in offered:
            if not self._has(key):
                self._want(key, sketch, URGENT)
        for sketch in following():
            key = self.key(sketch.identity, sketch.weights, sketch.settings)
            if not self._has(key):
                self._want(key, sketch, AHEAD)

    def _has(self, key: str) -> bool:
        return self._memory.get(key) is not None or self._files.has(key)

    def _sketch(self, key: str) -> Sketch:
        with self._database.read() as tx:
            found = runs.face_with_portrait(tx, key)
            if found is None:
                raise NotFoundError("There is no such portrait.")
            face, version = found
            config = config_of(tx, version)
            sketch = Sketch(face.identity, unpack_weights(face.weights), settings_of(config))
        self._wardrobe.know(config)
        if self.key(sketch.identity, sketch.weights, sketch.settings) != key:
            raise NotFoundError("This face has a new picture since the server was updated. Reload the page.")
        return sketch

    def _want(self, key: str, sketch: Sketch, priority: int) -> Future[bytes]:
        with self._lock:
            job = self._jobs.get(key)
            if job is None:
                job = _Job(Future(), self._submit(sketch, priority), sketch, priority)
                self._jobs[key] = job
                self._watch(key, job)
            elif priority < job.priority:
                self._raise(key, job, priority)
            return job.promise

    def _raise(self, key: str, job: _Job, priority: int) -> None:
        job.priority = priority
        if job.drawing.cancel():  # not begun yet: it waits anew, further in front
            job.drawing = self._submit(job.sketch, priority)
            self._watch(key, job)

    def _submit(self, sketch: Sketch, priority: int, head: WornHead | None = None) -> Future[bytes]:
        worn = head or self._wardrobe.head(sketch.identity)
        try:
            return self._drawer.submit(sketch, priority, worn)
        except EmogenError as error:
            raise UnavailableError("Portraits cannot be drawn at the moment. Try again in a few seconds.", 5) from error

    def _watch(self, key: str, job: _Job) -> None:
        priority = job.priority
        job.drawing.add_done_callback(lambda drawing: self._done(key, job, drawing, priority))

    def _done(self, key: str, job: _Job, drawing: Future[bytes], priority: int) -> None:
        if drawing.cancelled() and job.priority < priority:
            return
        try:
            picture = drawing.result()
        except (Exception, CancelledError) as error:
            self._forget(key)
            job.promise.set_exception(error)
            return
        self._memory.put(key, picture)
        self._forget(key)
        job.promise.set_result(picture)
        self._files.write(key, picture)

    def _forget(self, key: str) -> None:
        with self._lock:
            self._jobs.pop(key, None)


class _Memory:
    """The portraits used last, up to a number of bytes."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._size = 0
        self._held: OrderedDict[str, bytes] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, key: str) -> bytes | None:
        with self._lock:
            found = self._held.get(key)
            if found is not None:
                self._held.move_to_end(key)
            return found

    def put(self, key: str, picture: bytes) -> None:
        with self._lock:
            self._size += len(picture) - len(self._held.pop(key, b""))
            self._held[key] = picture
            while self._size > self._limit and self._held:
                self._size -= len(self._held.popitem(last=False)[1])
