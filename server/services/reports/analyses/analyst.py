"""Who makes a report: the command `emogen analyse` in a process of its own.

It takes seconds of arithmetic and draws faces. In another process, which gives way to those who draw for participants,
it holds nobody up, and what the dashboard shows is by construction what the command prints.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ...errors import UnavailableError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

COMMAND = (sys.executable, "-c", "from server.cli import app; app()", "analyse")
MOST_SECONDS = 600.0
NICE = 10
"""How far it stands back behind the processes of the server."""
_GLANCE = 0.1

logger = logging.getLogger(__name__)


@dataclass
class Analyst:
    """Makes one report after the other.

    Attributes:
        command: what is started, before its arguments.
        most_seconds: after which it is ended.
    """

    command: Sequence[str] = COMMAND
    most_seconds: float = MOST_SECONDS
    _stopped: threading.Event = field(default_factory=threading.Event)

    def __call__(self, export: Path, out: Path, options: Sequence[str]) -> None:
        """Write the report of an export into a folder.

        Raises:
            UnavailableError: it failed, took too long, or the server is stopping; the message says which.
        """
        arguments = [*self.command, str(export), "--out", str(out), *options]
        with subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:  # noqa: S603 - our own command, no shell
            _stand_back(process.pid)
            said: list[str] = []
            reader = threading.Thread(target=lambda: said.extend(process.stderr or ()), daemon=True)
            reader.start()
            ended = self._waited(process)
            reader.join()
        if ended is not None:
            raise UnavailableError(ended)
        if process.returncode:
            logger.warning("emogen analyse ended with %s: %s", process.returncode, "".join(said))
            raise UnavailableError(_last(said) or "The analysis failed; the server's log says why.")

    def stop(self) -> None:
        """End what is being made, and make nothing more."""
        self._stopped.set()

    def _waited(self, process: subprocess.Popen[str]) -> str | None:
        """Wait until it is over, or end it; return why it was ended."""
        until = time.monotonic() + self.most_seconds
        while process.poll() is None:
            late = time.monotonic() > until
            if late or self._stopped.wait(_GLANCE):
                process.kill()
                if late:
                    return f"The analysis took longer than {self.most_seconds:g} seconds. Use emogen analyse."
                return "The server was stopped."
        return None


def _stand_back(pid: int) -> None:
    if hasattr(os, "setpriority"):
        try:
            os.setpriority(os.PRIO_PROCESS, pid, NICE)
        except OSError:  # it is over already
            logger.debug("no priority to set")


def _last(said: Sequence[str]) -> str:
    """Return the sentence that a command ends with, unless that is not one for people."""
    lines = [line.strip() for line in said if line.strip()]
    return lines[-1] if lines and not any(line.startswith("Traceback") for line in lines) else ""
