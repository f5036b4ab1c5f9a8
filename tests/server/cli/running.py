"""A real server process, started the way everybody starts it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import httpx2

ROOT = Path(__file__).parents[3]
EMOGEN = [sys.executable, "-c", "from server.cli import app; app()"]


def environment(data_dir):
    return {
        **os.environ, "EMOGEN_DATA_DIR": str(data_dir), "EMOGEN_RENDERER": "software", "EMOGEN_RENDER_WORKERS": "1",
        "PYTHONPATH": str(ROOT),
    }  # fmt: skip


def emogen(data_dir, *arguments, timeout=120, **more):
    return subprocess.run(
        [*EMOGEN, *arguments], env={**environment(data_dir), **more}, capture_output=True, text=True, timeout=timeout,
        check=False,
    )  # fmt: skip


class Server:
    def __init__(self, data_dir):
        self.errors = (data_dir.parent / "errors.log").open("ab")
        self.process = subprocess.Popen(
            [*EMOGEN, "serve", "--port", "0"], env=environment(data_dir), stdout=subprocess.PIPE, stderr=self.errors,
            text=True,
        )  # fmt: skip
        self.said = []
        while not any("/admin" in line for line in self.said):
            line = self.process.stdout.readline()
            assert line, (data_dir.parent / "errors.log").read_text()
            self.said.append(line)
        self.base, self.link = re.search(r"(http://[^/]+)/s/(\S+)", "".join(self.said)).groups()
        self.client = httpx2.Client(base_url=self.base, timeout=60)

    def kill(self):
        """As the power cut does."""
        self.process.send_signal(signal.SIGKILL)
        self._end()

    def stop(self):
        self.process.terminate()
        self._end()
        return self.process.returncode

    def _end(self):
        self.process.wait(30)
        self.process.stdout.close()
        self.client.close()
        self.errors.close()
