"""A command of this program in a process of its own: it gives way to who draws for participants, and can be ended."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import UnavailableError

if TYPE_CHECKING:
    from collections.abc import Sequence

PROGRAM = (sys.executable, "-c", "from server.cli import app; app()")
NICE = 10
"""How far it stands back behind the processes of the server."""
_GLANCE = 0.1

logger = logging.getLogger(__name__)


@dataclass
class OwnProcess:
    """Runs one command after the other.

    Attributes:
        command: what is started, before its arguments.
        name: of the command, as somebody would type it.
        what: it is, for sentences: "analysis".
        most_seconds: after which it is ended.
    """

    command: Sequence[str]
    name: str
    what: str
    most_seconds: float
    _stopped: threading.Event = field(default_factory=threading.Event)

    def run(self, arguments: Sequence[str], printed: Path | None = None) -> None:
        """Run it to its end; what it prints goes to a file, if one is named.

        Raises:
            UnavailableError: it failed, took too long, or the server is stopping; the message says which.
        """
        with (
            Path(printed or os.devnull).open("w", encoding="utf-8") as output,
            subprocess.Popen(  # noqa: S603 - our own command, no shell
                [*self.command, *arguments], stdout=output, stderr=subprocess.PIPE, text=True
            ) as process,
        ):
            _stand_back(process.pid)
            said: list[str] = []
            reader = threading.Thread(target=lambda: said.extend(process.stderr or ()), daemon=True)
            reader.start()
            ended = self._waited(process)
            reader.join()
        if ended is not None:
            raise UnavailableError(ended)
        if process.returncode:
            logger.warning("%s ended with %s: %s", self.name, process.returncode, "".join(said))
            raise UnavailableError(_last(said) or f"The {self.what} failed; the server's log says why.")

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
                    return f"The {self.what} took longer than {self.most_seconds:g} seconds. Use {self.name}."
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
