"""Portraits: drawn once, cached under their content key, drawn ahead while a participant is looking.

A portrait that is being drawn has one entry here, whoever asks for it: an urgent request raises an earlier, patient
one instead of drawing twice. Bytes go to memory and to a file; a file that cannot be written stops nobody.
"""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from emogen_core.errors import EmogenError

from ...store import runs
from ..background import watched
from ..config.stored import own_config
from ..errors import NotFoundError, ServiceError, UnavailableError
from .portrait_memory import PortraitMemory
from .sketch import Sketch, settings_of, unpack_weights

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

    from ...store.engine import Database
    from .portrait_files import PortraitFiles
    from .wardrobe import Wardrobe

URGENT = 0
AHEAD = 1
REMEMBERED = 10_000
"""Drawing times that nobody has asked for yet, and portraits that were discarded last."""


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
    wanted: float


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
        self._memory = PortraitMemory(memory_bytes)
        self._took: OrderedDict[str, float] = OrderedDict()
        self._jobs: dict[str, _Job] = {}
        self._gone: OrderedDict[str, None] = OrderedDict()
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

    def drawing_ms(self, key: str) -> float | None:
        """Return how long a portrait was drawn for somebody who waits, once; None if it was drawn ahead or elsewhere.

        From when it was wanted to when it was there: the wait for a free drawing process is part of it.
        """
        with self._lock:
            return self._took.pop(key, None)

    def request(self, key: str) -> Future[bytes]:
        """Return the promise of a portrait that a face in the database has.

        Raises:
            NotFoundError: no face has this portrait, or it is of an older look.
            UnavailableError: the head that it wears is still being made.
        """
        with self._lock:
            job = self._jobs.get(key)
            if job is None:
                # Before the row is looked for: whoever is erased after that takes the picture along again.
                self._gone.pop(key, None)
        sketch = job.sketch if job else self._sketch(key)
        self._wardrobe.wait(sketch.identity)
        return self._want(key, sketch, URGENT)

    def recorded(self, key: str) -> Future[bytes]:
        """Return the promise of the picture of a face in the database, as it looks today if its own look is gone.

        Raises:
            NotFoundError: no face has this portrait, or it was made on another face model.
            UnavailableError: the head that it wears is still being made.
        """
        found = self.cached(key)
        if found is not None:
            return _kept(found)
        sketch, rig_hash = self._row(key)
        if rig_hash != self._wardrobe.rig_hash(sketch.identity):
            raise NotFoundError("This face was made on another face model and cannot be drawn on this one.")
        self._wardrobe.wait(sketch.identity)
        return self.sketched(sketch)

    def small(self, key: str) -> bytes | None:
        """Return a small picture of a portrait, if one was kept."""
        return self._memory.get(_small(key))

    def keep_small(self, key: str, picture: bytes) -> None:
        """Keep a small picture of a portrait for a while."""
        self._memory.put(_small(key), picture)

    def discard(self, keys: Iterable[str]) -> None:
        """Drop portraits that no face has any more, from memory and from the disk, also those being drawn just now."""
        for key in keys:
            with self._lock:
                self._gone[key] = None
                while len(self._gone) > REMEMBERED:
                    self._gone.popitem(last=False)
            self._drop(key)

    def sketched(self, sketch: Sketch, head: WornHead | None = None) -> Future[bytes]:
        """Return the promise of a portrait that no participant sees; one of a ``head`` to try on is not kept."""
        if head is not None:
            return self._submit(sketch, URGENT, head)
        key = self.key(sketch.identity, sketch.weights, sketch.settings)
        found = self.cached(key)
        if found is None:
            return self._want(key, sketch, URGENT)
        return _kept(found)

    def time_drawing(self, sketches: Sequence[Sketch], patience: float = 60.0) -> float:
        """Return how many seconds it takes to draw faces anew, together, after what participants wait for.

        Raises:
            TimeoutError: it takes longer than `patience` seconds.
            UnavailableError: nothing can be drawn.
        """
        began = time.perf_counter()
        try:
            for promise in [self._submit(sketch, AHEAD) for sketch in sketches]:
                promise.result(patience)
        except EmogenError as error:
            raise UnavailableError(str(error)) from error
        return time.perf_counter() - began

    def after(self, offered: Sequence[tuple[str, Sketch]], following: Callable[[], list[Sketch]]) -> None:
        """Draw the faces that were just offered, and then those that may follow."""
        # This only saves time: whatever fails here is drawn, or refused aloud, when it is asked for.
        watched(self._background.submit(self._draw, offered, following), "drawing ahead failed")

    def settle(self) -> None:
        """Wait until everything that was to be drawn ahead has been asked for. For tests and a tidy end."""
        self._background.submit(lambda: None).result()

    def close(self) -> None:
        """Stop drawing."""
        self._background.shutdown(wait=True, cancel_futures=True)
        self._drawer.close()

    def _draw(self, offered: Sequence[tuple[str, Sketch]], following: Callable[[], list[Sketch]]) -> None:
        for key, sketch in offered:
            if key not in self._gone and not self._has(key):
                self._want(key, sketch, URGENT)
        for sketch in following():
            key = self.key(sketch.identity, sketch.weights, sketch.settings)
            if not self._has(key):
                self._want(key, sketch, AHEAD)

    def _has(self, key: str) -> bool:
        return self._memory.get(key) is not None or self._files.has(key)

    def _row(self, key: str) -> tuple[Sketch, str]:
        with self._database.read() as tx:
            found = runs.portrait_row(tx, key)
            if found is None:
                raise NotFoundError("There is no such portrait.")
            face, participation = found
            config = own_config(tx, participation)
            sketch = Sketch(face.identity, unpack_weights(face.weights), settings_of(config))
        self._wardrobe.know(config)
        return sketch, participation.rig_hash

    def _sketch(self, key: str) -> Sketch:
        sketch, _ = self._row(key)
        if self.key(sketch.identity, sketch.weights, sketch.settings) != key:
            raise NotFoundError("This face has a new picture since the server was updated. Reload the page.")
        return sketch

    def _want(self, key: str, sketch: Sketch, priority: int) -> Future[bytes]:
        with self._lock:
            job = self._jobs.get(key)
            if job is None:
                job = _Job(Future(), self._submit(sketch, priority), sketch, priority, time.perf_counter())
                self._jobs[key] = job
                self._watch(key, job)
            elif priority < job.priority:
                self._raise(key, job, priority)
            return job.promise

    def _raise(self, key: str, job: _Job, priority: int) -> None:
        job.priority, job.wanted = priority, time.perf_counter()
        if job.drawing.cancel():  # not begun yet: it waits anew, further in front
            try:
                job.drawing = self._submit(job.sketch, priority)
            except ServiceError as error:
                self._forget(key)
                job.promise.set_exception(error)
                return
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
        self._note(key, job)
        self._forget(key)
        job.promise.set_result(picture)
        self._files.write(key, picture)
        with self._lock:
            unwanted = key in self._gone
        if unwanted:
            self._drop(key)

    def _note(self, key: str, job: _Job) -> None:
        if job.priority != URGENT:
            return
        with self._lock:
            self._took[key] = (time.perf_counter() - job.wanted) * 1000
            while len(self._took) > REMEMBERED:
                self._took.popitem(last=False)

    def _drop(self, key: str) -> None:
        self._memory.drop(key)
        self._memory.drop(_small(key))
        self._files.remove(key)

    def _forget(self, key: str) -> None:
        with self._lock:
            self._jobs.pop(key, None)


def _small(key: str) -> str:
    return f"{key} small"


def _kept(picture: bytes) -> Future[bytes]:
    done: Future[bytes] = Future()
    done.set_result(picture)
    return done
