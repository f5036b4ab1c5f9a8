"""What became of the import that was begun last, in a file: memory does not outlive a server that is killed."""

from __future__ import annotations

import json
import logging
import os
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import TYPE_CHECKING, Any

from ..clock import now

if TYPE_CHECKING:
    from pathlib import Path

INTERRUPTED = "The server stopped while it was being imported. Import it again."

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class ImportRun:
    """The import that was begun last: of which name, since when, and what became of it."""

    name: str
    began_at: datetime
    running: bool = True
    problem: str | None = None


@dataclass(frozen=True)
class ImportNote:
    """Keeps one import in a file.

    Attributes:
        path: the file; its folder may be missing.
        most_seconds: after which no import runs any more, whatever the file says.
    """

    path: Path
    most_seconds: float

    def write(self, run: ImportRun) -> None:
        """Keep what is known; a file that cannot be written stops no import."""
        plain = {
            "name": run.name, "began_at": run.began_at.isoformat(), "running": run.running, "problem": run.problem,
            "process": os.getpid(),
        }  # fmt: skip
        part = self.path.with_suffix(".part")
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            part.write_text(json.dumps(plain), encoding="utf-8")
            part.replace(self.path)
        except OSError as error:
            logger.warning("%s cannot be written: %s", self.path.name, error)

    def read(self) -> ImportRun | None:
        """Return what a process before this one left: an import that it did not end is over, and told so."""
        try:
            plain: dict[str, Any] = json.loads(self.path.read_text(encoding="utf-8"))
            run = ImportRun(
                str(plain["name"]), datetime.fromisoformat(plain["began_at"]), bool(plain["running"]), plain["problem"]
            )
            process = int(plain["process"])
        except (OSError, ValueError, KeyError, TypeError):
            return None
        if not run.running or self._goes_on(run, process):
            return run
        return ImportRun(run.name, run.began_at, running=False, problem=INTERRUPTED)

    def _goes_on(self, run: ImportRun, process: int) -> bool:
        """Whether another process of this server is at it still; this one has only just begun."""
        recent = now() - run.began_at < timedelta(seconds=self.most_seconds)
        return recent and process != os.getpid() and _alive(process)


def _alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except PermissionError:
        return True
    except (OSError, OverflowError):
        return False
    return True
