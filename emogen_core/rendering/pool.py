"""Faces drawn by worker processes: two priorities, small batches, and no way to hang.

A thread of this process keeps one worker each: it takes the most urgent faces off the queue, sends them, and waits a
bounded time. A worker that dies or is late is killed and replaced, and its faces are drawn again, at most
`ATTEMPTS` times in all.
"""

from __future__ import annotations

import heapq
import threading
import time
from concurrent.futures import Future
from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.cores import cores
from emogen_core.errors import EmogenError, InvalidInputError, RenderingError, expected
from emogen_core.rendering.keys import portrait_key
from emogen_core.rendering.process import LostError, WorkerProcess

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

ATTEMPTS = 3
BATCH = 3


class Priority(IntEnum):
    """What is drawn first."""

    NOW = 0
    AHEAD = 1


@dataclass(order=True)
class _Job:
    priority: int
    number: int
    identity: str = field(compare=False)
    weights: NDArray[np.float32] = field(compare=False)
    settings: RenderSettings = field(compare=False)
    result: Future[bytes] = field(compare=False)
    head: WornHead | None = field(compare=False)
    attempts: int = field(compare=False, default=0)


class RenderPool:
    """Draws faces in other processes. Safe to use from several threads; close it, or use it as a context manager."""

    def __init__(  # noqa: PLR0913 - all by keyword
        self,
        workers: int | None = None,
        backend: str = "pyrender",
        *,
        rig: Path | None = None,
        look: Path | None = None,
        time_limit: float = 20.0,
        start_limit: float = 60.0,
    ) -> None:
        """Start the workers and wait until each has drawn its first face.

        Args:
            workers: how many; one a core by default.
            backend: ``pyrender``, ``software``, or ``module:function`` of a factory that returns a `Renderer`.
            rig: rig file; the bundled one by default.
            look: look file; the bundled one by default.
            time_limit: seconds after which a worker is taken for hung.
            start_limit: seconds that a worker may take to start.

        Raises:
            MissingGLError: the workers cannot draw on this machine; one sentence says what to install.
            RenderingError: the workers cannot start for another reason.
        """
        count = workers if workers is not None else cores()
        if count < 1:
            raise InvalidInputError(f"workers: {expected('at least 1', count)}")
        self._limits = time_limit, start_limit
        self._command = [backend, str(rig or ""), str(look or "")]
        self._queue: list[_Job] = []
        self._wake = threading.Condition()
        self._closed = False
        self._number = 0
        self._workers: list[WorkerProcess] = []
        self._hashes = "", ""
        self._start(count)
        self._threads = [
            threading.Thread(target=self._keep, args=(worker,), name=f"render-{i}", daemon=True)
            for i, worker in enumerate(self._workers)
        ]
        for thread in self._threads:
            thread.start()

    def submit(
        self,
        identity: str,
        weights: NDArray[np.float32],
        settings: RenderSettings,
        priority: int = Priority.NOW,
        head: WornHead | None = None,
    ) -> Future[bytes]:
        """Have one face drawn.

        Args:
            identity: the head that wears the rig.
            weights: (K,) weights of all shapes.
            settings: size and background.
            priority: what somebody waits for goes before what is drawn ahead.
            head: the head itself, where the rig file does not have it; a worker is sent it once.

        Returns:
            A future of the PNG file. It raises `InvalidInputError` for bad input and `RenderingError` when the face
            could not be drawn or the pool was closed. It may be cancelled while it waits in the queue.
        """
        result: Future[bytes] = Future()
        alpha = np.array(weights, np.float32)
        with self._wake:
            if self._closed:
                raise RenderingError("the pool is closed")
            self._number += 1
            heapq.heappush(self._queue, _Job(priority, self._number, identity, alpha, settings, result, head))
            self._wake.notify()
        return result

    def key(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> str:
        """Return the content key (SHA-256, hexadecimal) of the portrait that `submit` would give for the same face."""
        rig, look = self._hashes
        return portrait_key(rig, look, self._command[0], identity, weights, settings)

    def close(self) -> None:
        """End all workers; faces not drawn yet fail with `RenderingError`. Never waits for a worker."""
        with self._wake:
            self._closed = True
            dropped, self._queue = self._queue, []
            self._wake.notify_all()
        for worker in self._workers:
            worker.kill(for_good=True)
        for job in dropped:
            _fail(job, RenderingError("the pool was closed before this face was drawn"))
        for thread in self._threads:
            thread.join(timeout=5)

    @property
    def process_ids(self) -> list[int]:
        """Process ids of the workers that run now."""
        return [worker.process.pid for worker in self._workers if worker.process.poll() is None]

    def __enter__(self) -> RenderPool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _start(self, count: int) -> None:
        """Start all workers side by side, then wait for each: starting is mostly loading."""
        deadline = time.monotonic() + self._limits[1]
        try:
            for _ in range(count):
                self._workers.append(WorkerProcess(self._command))
            for worker in self._workers:
                self._hashes = worker.wait_ready(deadline - time.monotonic())
        except BaseException as error:
            for worker in self._workers:
                worker.kill(for_good=True)
            if isinstance(error, LostError):
                raise RenderingError(f"a drawing process did not start: {error}") from error
            raise

    def _keep(self, worker: WorkerProcess) -> None:
        """Feed one worker until the pool closes, replacing it when it is lost."""
        while jobs := self._take():
            try:
                if not worker.alive:
                    worker.restart()
                    worker.wait_ready(self._limits[1])
            except (LostError, EmogenError) as error:
                worker.kill()
                self._again(jobs, str(error))
            else:
                self._draw(worker, jobs)

    def _take(self) -> list[_Job]:
        """Wait for work; return up to `BATCH` faces of one head and size, fewer while other workers could help."""
        with self._wake:
            while not self._closed:
                share = max(1, min(BATCH, -(-len(self._queue) // len(self._workers))))
                jobs: list[_Job] = []
                while self._queue and len(jobs) < share and (not jobs or _alike(jobs[0], self._queue[0])):
                    job = heapq.heappop(self._queue)
                    if job.attempts or job.result.set_running_or_notify_cancel():
                        jobs.append(job)
                if jobs:
                    return jobs
                self._wake.wait()
        return []

    def _draw(self, worker: WorkerProcess, jobs: list[_Job]) -> None:
        weights = np.stack([job.weights for job in jobs])
        try:
            first, seconds = jobs[0], self._limits[0] * len(jobs)
            pictures = worker.draw(first.identity, weights, first.settings, seconds, first.head)
        except LostError as error:
            worker.kill()
            self._again(jobs, str(error))
        except EmogenError as error:
            if len(jobs) == 1:
                _fail(jobs[0], error)
            else:
                self._again(jobs, str(error))
        else:
            for job, picture in zip(jobs, pictures, strict=True):
                job.result.set_result(picture)

    def _again(self, jobs: list[_Job], reason: str) -> None:
        """Queue the faces of a lost worker again, each for itself, so that one bad face cannot fail its neighbours."""
        with self._wake:
            for job in jobs:
                job.attempts += 1
                if self._closed:
                    _fail(job, RenderingError("the pool was closed before this face was drawn"))
                elif job.attempts >= ATTEMPTS:
                    _fail(job, RenderingError(f"a face could not be drawn in {ATTEMPTS} attempts: {reason}"))
                else:
                    heapq.heappush(self._queue, job)
            self._wake.notify_all()


def _alike(a: _Job, b: _Job) -> bool:
    """Faces that were lost once are drawn alone."""
    same = (a.identity, a.settings, a.priority, a.weights.shape) == (
        b.identity,
        b.settings,
        b.priority,
        b.weights.shape,
    )
    return same and not a.attempts and not b.attempts


def _fail(job: _Job, error: Exception) -> None:
    if not job.result.done():
        job.result.set_exception(error)
