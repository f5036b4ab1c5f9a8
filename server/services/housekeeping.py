"""What a server sees to by itself: pictures of a new look at its start, and each hour what nobody needs any more."""

from __future__ import annotations

import logging
import threading
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ..store.engine import StorageError
from .participation.renewal import renew_portraits

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .participation.journal import Journal

EVERY_SECONDS = 3600.0

logger = logging.getLogger(__name__)


@dataclass
class Housekeeping:
    """Begins with `begin`, which only a server calls: commands that open the house change nothing by it."""

    journal: Journal
    sweeps: Sequence[Callable[[], object]]
    every: float = EVERY_SECONDS
    _over: threading.Event = field(default_factory=threading.Event)
    _thread: threading.Thread | None = None

    def begin(self) -> None:
        """Renew the portraits if the look is a new one, sweep, and sweep again every hour until `close`."""
        renew_portraits(self.journal)
        self.sweep()
        self._thread = threading.Thread(target=self._work, name="housekeeping", daemon=True)
        self._thread.start()

    def sweep(self) -> None:
        """Do away with what nobody needs any more."""
        for one in self.sweeps:
            one()

    def close(self) -> None:
        """Sweep no more."""
        self._over.set()
        if self._thread is not None:
            self._thread.join()

    def _work(self) -> None:
        while not self._over.wait(self.every):
            try:
                self.sweep()
            except StorageError as error:
                logger.warning("sweeping failed and is tried again later: %s", error)
