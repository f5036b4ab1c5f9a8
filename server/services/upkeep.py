"""How this server stands, for its owner: what works, what to see to, what is running."""

from __future__ import annotations

import shutil
import statistics
import sys
import threading
import time
from concurrent.futures import Future
from concurrent.futures import TimeoutError as FutureTimeoutError
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.protocol import RenderSettings

from ..store.check import database_report, try_writing
from .errors import ServiceError
from .faces.sketch import Sketch

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..settings import Settings
    from .participation.journal import Journal

LEAST_FREE = 2 * 2**30
KEPT_SECONDS = 600.0
"""How long a measurement of drawing stands, so that looking at a page never costs more than one."""
PATIENCE_SECONDS = 1.0
SLOW_MS = 1000.0
LOCAL = frozenset({"127.0.0.1", "::1", "localhost"})
FACES = 10


@dataclass(frozen=True, slots=True)
class Check:
    """One thing that was looked at."""

    name: str
    good: bool
    text: str


@dataclass
class Upkeep:
    """Looks after a server."""

    settings: Settings
    journal: Journal
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _drawing: tuple[float, Future[Check]] | None = None

    def checks(self) -> tuple[Check, ...]:
        """Return what was looked at a moment ago: database, disk, drawing, address."""
        return (self._database(), self._disk(), self._measured(), self._address())

    def facts(self) -> dict[str, str]:
        """Return what is running, by names that an owner knows."""
        rig = self.journal.rig
        report = database_report(self.settings.url)
        return {
            "Python": sys.version.split()[0],
            "Database": str(report["url"]),
            "Database version": str(report["migration"]),
            "Face model": f"{rig.name}, {len(rig.genes)} genes, {len(rig.shape_names)} shapes",
            "Face model fingerprint": rig.hash,
            "Data folder": str(self.settings.data_dir.absolute()),
            "Public address": self.settings.address,
        }

    def _database(self) -> Check:
        kind = "SQLite" if self.settings.url.startswith("sqlite") else "PostgreSQL"
        problem = try_writing(self.journal.database)
        return Check("Database", problem is None, f"{kind}, {problem or 'write test passed'}")

    def _disk(self) -> Check:
        free = shutil.disk_usage(self.settings.data_dir).free
        return Check("Disk", free >= LEAST_FREE, f"{free / 1e9:.0f} GB free")

    def _address(self) -> Check:
        if self.settings.secure:
            return Check("HTTPS", True, "Participants reach this server by https.")
        if self.settings.host in LOCAL and not self.settings.base_url:
            return Check("HTTPS", False, "Only this computer is reached. Set EMOGEN_BASE_URL to recruit.")
        return Check("HTTPS", False, "Not set up. Needed before participants can join from elsewhere.")

    def _measured(self) -> Check:
        """Return what drawing takes; the first faces after a start take long, and no page waits for them."""
        with self._lock:
            if self._drawing is None or time.monotonic() - self._drawing[0] > KEPT_SECONDS:
                self._drawing = (time.monotonic(), _in_background(self._draw))
            measured = self._drawing[1]
        try:
            return measured.result(PATIENCE_SECONDS)
        except FutureTimeoutError:
            return Check("Drawing", True, "Being measured. Reload this page in some seconds.")

    def _draw(self) -> Check:
        random = np.random.default_rng()
        try:
            self._time(random)  # the first faces of a head also prepare it
            taken = statistics.median(self._time(random) for _ in range(3)) * 1000
        except (ServiceError, FutureTimeoutError) as error:
            return Check("Drawing", False, f"Faces cannot be drawn: {error or 'no answer'}. Run emogen doctor.")
        return Check("Drawing", taken <= SLOW_MS, f"Ten faces in {taken:.0f} ms on this processor")

    def _time(self, random: np.random.Generator) -> float:
        rig = self.journal.rig
        faces = random.random((FACES, len(rig.shape_names)), np.float32) * 0.1
        return self.journal.portraits.time_drawing(
            [Sketch(rig.identities[0], face, RenderSettings()) for face in faces]
        )


def _in_background(work: Callable[[], Check]) -> Future[Check]:
    promise: Future[Check] = Future()
    threading.Thread(target=lambda: promise.set_result(work()), name="measure-drawing", daemon=True).start()
    return promise
