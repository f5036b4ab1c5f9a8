"""A real server process, started the way everybody starts it."""

from __future__ import annotations

import os
import re
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
    """Use it as a context manager: whatever a test does, the process ends and nothing stays open."""

    def __init__(self, data_dir):
        self.log = data_dir.parent / "errors.log"
        with self.log.open("ab") as errors:
            self.process = subprocess.Popen(
                [*EMOGEN, "serve", "--port", "0"], env=environment(data_dir), stdout=subprocess.PIPE, stderr=errors,
                text=True,
            )  # fmt: skip
        try:
            said = self._greeting()
        except BaseException:
            self.kill()
            raise
        self.said = said
        self.base, self.link = re.search(r"(http://[^/]+)/s/(\S+)", said).groups()
        self.client = httpx2.Client(
            base_url=self.base,
            timeout=60,
            transport=httpx2.HTTPTransport(retries=6),  # it listens soon after it greets
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()
        self.client.close()

    def kill(self):
        """As the power cut does."""
        self.process.kill()
        self._end()

    def stop(self):
        """As the service manager does; return the exit status."""
        self.process.terminate()
        self._end()
        return self.process.returncode

    def portrait(self, address):
        """A portrait, however long this machine takes to draw it."""
        reply = self.client.get(address)
        for _ in range(20):
            if reply.status_code != 503:
                break
            reply = self.client.get(address)
        return reply

    def _greeting(self):
        said = ""
        while "/admin" not in said:
            line = self.process.stdout.readline()
            assert line, self.log.read_text()
            said += line
        return said

    def _end(self):
        self.process.wait(30)
        self.process.stdout.close()
