"""`emogen serve` in a process of its own, as it is shipped, for measurements through the real interface."""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .common import stop

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

COMMAND = (sys.executable, "-c", "from server.cli import app; app()", "serve")


@dataclass(frozen=True, slots=True)
class Served:
    """A running server: where it listens, the links that it printed, and how it is set up."""

    address: str
    links: tuple[str, ...]
    setup: str
    process: subprocess.Popen[str]


@contextmanager
def served(folder: Path, port: int = 0, **environment: str) -> Iterator[Served]:
    """Serve what a data folder holds, the demo study if that is nothing; what goes wrong is in `server.log` there."""
    told = {"EMOGEN_DATA_DIR": str(folder), "EMOGEN_PORT": str(port), **environment}
    with (folder / "server.log").open("a", encoding="utf-8") as log:
        process = subprocess.Popen(  # noqa: S603 - our own command
            COMMAND, env={**os.environ, **told}, stdout=subprocess.PIPE, stderr=log, text=True, cwd=folder
        )
        with process:
            try:
                yield _greeting(process, folder)
            finally:
                process.terminate()


def _wait(address: str) -> None:
    """Wait until the server listens: its greeting comes just before."""
    host, port = address.removeprefix("http://").rsplit(":", 1)
    for _ in range(200):
        with suppress(OSError), socket.create_connection((host, int(port)), timeout=5):
            return
        time.sleep(0.05)


def _greeting(process: subprocess.Popen[str], folder: Path) -> Served:
    links: list[str] = []
    for line in process.stdout or ():
        if found := re.search(r"/s/([\w-]+)\s*$", line):
            links.append(found[1])
        if found := re.search(r"(http://[\w.]+:\d+)/admin(\S*)", line):
            _wait(found[1])
            return Served(found[1], tuple(links), found[0], process)
    said = (folder / "server.log").read_text(encoding="utf-8").strip().splitlines()
    raise stop(f"emogen serve did not start: {said[-1] if said else 'it said nothing'}")
