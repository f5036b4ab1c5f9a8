"""Faces drawn by worker processes: two priorities, small batches, and no way to hang.

A thread of this process keeps one worker each: it takes the most urgent faces off the queue, sends them, and waits a
bounded time. A worker that dies or is late is killed and replaced, and its faces are drawn again, at most
`ATTEMPTS` times in all. Workers are separate programs rather than forks, because a GL context does not survive a
fork and because Mesa and BLAS read their thread counts from the environment when they are loaded.
"""

from __future__ import annotations

import heapq
import os
import socket
import subprocess
import sys
import threading
import time
from concurrent.futures import Future
from dataclasses import dataclass, field
from enum import IntEnum
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import EmogenError, InvalidInputError, MissingGLError, RenderingError, expected
from emogen_core.rendering.keys import portrait_key

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings

ATTEMPTS = 3
BATCH = 3
# One core a worker: Mesa's and BLAS's own threads would only get in the way of the other workers.
_ENVIRONMENT = {
    "PYOPENGL_PLATFORM": "egl", "LP_NUM_THREADS": "0", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1", "PYTHONUNBUFFERED": "1",
}  # fmt: skip


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
    attempts: int = field(compare=False, default=0)


class _LostError(Exception):
    """The worker died or was late."""


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
        count = workers if workers is not None else len(os.sched_getaffinity(0))
        if count < 1:
            raise InvalidInputError(f"workers: {expected('at least 1', count)}")
        self._limits = time_limit, start_limit
        self._command = [backend, str(rig or ""), str(look or "")]
        self._queue: list[_Job] = []
        self._wake = threading.Condition()
        self._closed = False
        self._number = 0
        self._workers: list[_Worker] = []
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
    ) -> Future[bytes]:
        """Have one face drawn.

        Args:
            identity: the head that wears the rig.
            weights: (K,) weights of all shapes.
            settings: size and background.
            priority: what somebody waits for goes before what is drawn ahead.

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
            heapq.heappush(self._queue, _Job(priority, self._number, identity, alpha, settings, result))
            self._wake.notify()
        return result

    def key(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> str:
        """Return the content key (SHA-256, hexadecimal) of the portrait that `submit` would give for the same face."""
        rig, look = self._hashes
        return portrait_key(rig, f"{look}/{self._command[0]}", identity, weights, settings)

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
                self._workers.append(_Worker(self._command))
            for worker in self._workers:
                self._hashes = worker.wait_ready(deadline - time.monotonic())
        except BaseException as error:
            for worker in self._workers:
                worker.kill(for_good=True)
            if isinstance(error, _LostError):
                raise RenderingError(f"a drawing process did not start: {error}") from error
            raise

    def _keep(self, worker: _Worker) -> None:
        """Feed one worker until the pool closes, replacing it when it is lost."""
        while jobs := self._take():
            try:
                if not worker.alive:
                    worker.restart()
                    worker.wait_ready(self._limits[1])
                answer = worker.draw(jobs, self._limits[0] * len(jobs))
            except (_LostError, EmogenError) as error:
                worker.kill()
                self._again(jobs, str(error))
            else:
                self._settle(jobs, answer)

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

    def _settle(self, jobs: list[_Job], answer: tuple[Any, ...]) -> None:
        try:
            _raise_failure(answer)
        except EmogenError as error:
            if len(jobs) > 1:
                self._again(jobs, str(error))
            else:
                _fail(jobs[0], error)
            return
        for job, picture in zip(jobs, answer[1], strict=True):
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


class _Worker:
    """One drawing process and this end of its socket."""

    def __init__(self, command: list[str]) -> None:
        self._command = command
        self._lock = threading.Lock()
        self._over = False
        self._socket: Connection[Any, Any] | None = None
        self.restart()

    def restart(self) -> None:
        ours, theirs = socket.socketpair()
        self._close_socket()
        program = [sys.executable, "-P", "-m", "emogen_core.rendering.worker", str(theirs.fileno()), *self._command]
        with self._lock, theirs:
            self._socket = Connection(ours.detach())
            if self._over:
                raise _LostError("the pool is closed")
            # In a process group of its own, so that Ctrl-C reaches only the parent, which then closes the pool.
            self.process = subprocess.Popen(  # noqa: S603 - our own interpreter and module
                program, env=_environment(), pass_fds=[theirs.fileno()], stdin=subprocess.DEVNULL, process_group=0
            )

    @property
    def alive(self) -> bool:
        return self.process.poll() is None

    def wait_ready(self, seconds: float) -> tuple[str, str]:
        """Wait until it has drawn its first face; return the hashes of its rig and look."""
        answer = self._receive(seconds)
        _raise_failure(answer)
        rig, look = answer[1]
        return rig, look

    def draw(self, jobs: list[_Job], seconds: float) -> tuple[Any, ...]:
        assert self._socket is not None
        try:
            self._socket.send((jobs[0].identity, np.stack([job.weights for job in jobs]), jobs[0].settings))
        except OSError as error:
            raise _LostError("the drawing process died") from error
        return self._receive(seconds)

    def kill(self, *, for_good: bool = False) -> None:
        with self._lock:
            self._over |= for_good
            self.process.kill()
            self.process.wait()

    def _close_socket(self) -> None:
        if self._socket is not None:
            self._socket.close()

    def _receive(self, seconds: float) -> tuple[Any, ...]:
        assert self._socket is not None
        try:
            if not self._socket.poll(max(0.0, seconds)):
                raise _LostError(f"the drawing process gave no answer within {seconds:.0f} s")
            answer: tuple[Any, ...] = self._socket.recv()
        except (EOFError, OSError) as error:
            raise _LostError("the drawing process died") from error
        return answer


def _environment() -> dict[str, str]:
    """Return the worker's environment: it finds every module that this process finds, wherever it was started."""
    root = str(Path(__file__).resolve().parents[2])
    return {**os.environ, **_ENVIRONMENT, "PYTHONPATH": os.pathsep.join([root, *filter(None, sys.path)])}


def _alike(a: _Job, b: _Job) -> bool:
    """Faces that were lost once are drawn alone."""
    same = (a.identity, a.settings, a.priority, a.weights.shape) == (
        b.identity,
        b.settings,
        b.priority,
        b.weights.shape,
    )
    return same and not a.attempts and not b.attempts


def _raise_failure(answer: tuple[Any, ...]) -> None:
    if answer[0] == "failed":
        _, kind, sentence = answer
        raise {"gl": MissingGLError, "input": InvalidInputError}.get(kind, RenderingError)(sentence)


def _fail(job: _Job, error: Exception) -> None:
    if not job.result.done():
        job.result.set_exception(error)
