"""The pool's end of one drawing process: starting it, asking it, giving it up.

Workers are separate programs rather than forks, because a GL context does not survive a fork and because Mesa and BLAS
read their thread counts from the environment when they are loaded.
"""

from __future__ import annotations

import os
import socket
import struct
import subprocess
import sys
import threading
from collections import OrderedDict
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from emogen_core.errors import InvalidInputError, MissingGLError, RenderingError
from emogen_core.rendering.recent import HEADS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

# One core a worker: Mesa's and BLAS's own threads would only get in the way of the other workers.
_ENVIRONMENT = {
    "PYOPENGL_PLATFORM": "egl", "LP_NUM_THREADS": "0", "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1", "PYTHONUNBUFFERED": "1",
}  # fmt: skip
# Seconds after which a process that takes no message is given up: a head is larger than a socket's buffer.
_SEND_SECONDS = 20


class LostError(Exception):
    """The process died or gave no answer in time."""


class WorkerProcess:
    """One drawing process and this end of its socket."""

    def __init__(self, command: list[str]) -> None:
        self._command = command
        self._lock = threading.Lock()
        self._over = False
        self._socket: Connection[Any, Any] | None = None
        self._worn: OrderedDict[str, None] = OrderedDict()
        self.restart()

    def restart(self) -> None:
        """Start a new process in place of one that is lost."""
        ours, theirs = socket.socketpair()
        self._close_socket()
        self._worn.clear()
        ours.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, struct.pack("ll", _SEND_SECONDS, 0))
        program = [sys.executable, "-P", "-m", "emogen_core.rendering.worker", str(theirs.fileno()), *self._command]
        with self._lock, theirs:
            self._socket = Connection(ours.detach())
            if self._over:
                raise LostError("the pool is closed")
            # In a process group of its own, so that Ctrl-C reaches only the parent, which then closes the pool.
            self.process = subprocess.Popen(  # noqa: S603 - our own interpreter and module
                program, env=_environment(), pass_fds=[theirs.fileno()], stdin=subprocess.DEVNULL, process_group=0
            )

    @property
    def alive(self) -> bool:
        """Whether the process runs."""
        return self.process.poll() is None

    def wait_ready(self, seconds: float) -> tuple[str, str]:
        """Wait until it has drawn its first face; return the hashes of its rig and look. Raises as `draw`."""
        rig, look = self._receive(seconds)
        return rig, look

    def draw(
        self,
        identity: str,
        weights: NDArray[np.float32],
        settings: RenderSettings,
        seconds: float,
        head: WornHead | None = None,
    ) -> list[bytes]:
        """Have a (B, K) batch drawn; return the PNG files. A ``head`` besides the rig's is handed over where need be.

        Raises:
            LostError: the process died or took more than ``seconds``.
            InvalidInputError, RenderingError: it refused, or could not draw.
        """
        if head is not None:
            self._hand(head, seconds)
        pictures: list[bytes] = self._ask(("draw", identity, weights, settings), seconds)
        return pictures

    def kill(self, *, for_good: bool = False) -> None:
        """End the process at once; ``for_good`` refuses a restart."""
        with self._lock:
            self._over |= for_good
            self.process.kill()
            self.process.wait()

    def _close_socket(self) -> None:
        if self._socket is not None:
            self._socket.close()

    def _hand(self, head: WornHead, seconds: float) -> None:
        """Give the process a head that it does not have, and take back the one that was drawn longest ago."""
        if head.name not in self._worn:
            self._ask(("wear", head), seconds)
            self._worn[head.name] = None
            if len(self._worn) > HEADS:
                self._ask(("drop", self._worn.popitem(last=False)[0]), seconds)
        self._worn.move_to_end(head.name)

    def _ask(self, order: tuple[Any, ...], seconds: float) -> Any:
        assert self._socket is not None
        try:
            self._socket.send(order)
        except OSError as error:
            raise LostError("the drawing process died") from error
        return self._receive(seconds)

    def _receive(self, seconds: float) -> Any:
        """Return what the process answers, or raise what it could not do."""
        assert self._socket is not None
        try:
            if not self._socket.poll(max(0.0, seconds)):
                raise LostError(f"the drawing process gave no answer within {seconds:.0f} s")
            told, *rest = self._socket.recv()
        except (EOFError, OSError) as error:
            raise LostError("the drawing process died") from error
        if told == "failed":
            kind, sentence = rest
            raise {"gl": MissingGLError, "input": InvalidInputError}.get(kind, RenderingError)(sentence)
        return rest[0]


def _environment() -> dict[str, str]:
    """Return the worker's environment: it finds every module that this process finds, wherever it was started."""
    root = str(Path(__file__).resolve().parents[2])
    return {**os.environ, **_ENVIRONMENT, "PYTHONPATH": os.pathsep.join([root, *filter(None, sys.path)])}
