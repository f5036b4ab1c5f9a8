"""Heads of others that become face models here: `emogen rig import` in a process of its own, one at a time."""

from __future__ import annotations

import json
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Protocol

from emogen_core.errors import EmogenError
from emogen_core.face.modes import ENDING

from ..background import watched
from ..clock import now
from ..errors import ConflictError, InvalidError, ServiceError
from ..own_process import PROGRAM, OwnProcess
from .import_note import ImportNote, ImportRun

if TYPE_CHECKING:
    from collections.abc import Callable

    from .models import FaceModels

MOST_BYTES = 96 * 2**20
"""Of the file that comes; larger ones are for the command."""
MOST_SECONDS = 1800.0
ENDINGS = (".glb", ".zip")
REPORT = "report.json"


class Importer(Protocol):
    """What makes a rig and its look of a head: the command, or a quick fake in tests."""

    def __call__(self, source: Path, out: Path, wears: str) -> None:
        """Write ``out``, the look beside it, and what was found to `REPORT` there."""
        ...

    def stop(self) -> None:
        """End what is being made, and make nothing more."""
        ...


class HeadImporter(OwnProcess):
    """Runs `emogen rig import`."""

    def __init__(self) -> None:
        super().__init__((*PROGRAM, "rig", "import"), "emogen rig import", "import", MOST_SECONDS)

    def __call__(self, source: Path, out: Path, wears: str) -> None:
        """Write rig, look and report; raises `UnavailableError` with the command's own sentence."""
        self.run([str(source), "--out", str(out), "--wears", wears, "--json"], out.parent / REPORT)


@dataclass
class Imports:
    """Makes face models of uploaded heads, one at a time, while somebody does something else.

    Attributes:
        models: where they are put.
        make: does the work.
        unpack: a file and an empty folder -> what `make` reads.
        note: keeps what became of the last one for whoever asks after a restart; without it nobody does.
    """

    models: FaceModels
    make: Importer
    unpack: Callable[[Path, Path], Path]
    note: ImportNote | None = None
    last: ImportRun | None = None
    _behind: ThreadPoolExecutor = field(default_factory=lambda: ThreadPoolExecutor(1, thread_name_prefix="import"))
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def __post_init__(self) -> None:
        """Tell what a process before this one left: what it could not end, or why it failed."""
        found = self.note.read() if self.note else None
        if found is not None and found.name not in {row.name for row in self.models.all()}:
            self.last = found

    def begin(self, name: str, file: str, content: bytes, wears: str, user: str | None = None) -> None:
        """Take a file; return at once.

        Args:
            name: of the face model.
            file: what the file is called; its ending says what it is.
            content: of the file.
            wears: the preset whose skin, eyes and hair the head has.
            user: who brings it.

        Raises:
            InvalidError: no name, or no file of a head.
            ConflictError: there is a face model of this name, or an import is under way.
        """
        self.models.check_name(name)
        ending = Path(file).suffix.lower()
        if ending not in ENDINGS or not content or len(content) > MOST_BYTES:
            wanted = f"a {' or '.join(ENDINGS)} file of at most {MOST_BYTES // 2**20} MiB"
            raise InvalidError("Choose the head's file.", field="file", expected=wanted, got=file or "none")
        with self._lock:
            if self.last is not None and self.last.running:
                raise ConflictError(f"The head {self.last.name} is being imported. Wait until it is there.")
            self._tell(ImportRun(name, now()))
        work = self._behind.submit(self._work, name, ending, content, wears, user)
        watched(work, "a head could not be imported")

    def settle(self) -> None:
        """Wait until what was begun is over. For tests."""
        self._behind.submit(lambda: None).result()

    def close(self) -> None:
        """End what is being made, and make nothing more."""
        self.make.stop()
        self._behind.shutdown(wait=True, cancel_futures=True)

    def _work(self, name: str, ending: str, content: bytes, wears: str, user: str | None) -> None:
        problem: str | None = "It failed; the server's log says why."
        try:
            self._made(name, ending, content, wears, user)
            problem = None
        except (ServiceError, EmogenError) as error:
            problem = str(error)
        finally:
            assert self.last is not None
            self._tell(ImportRun(name, self.last.began_at, running=False, problem=problem))

    def _tell(self, run: ImportRun) -> None:
        self.last = run
        if self.note is not None:
            self.note.write(run)

    def _made(self, name: str, ending: str, content: bytes, wears: str, user: str | None) -> None:
        with TemporaryDirectory(prefix="emogen-import-") as place:
            file, folder, out = Path(place, f"{name}{ending}"), Path(place, name), Path(place, "made", "head.rig")
            file.write_bytes(content)
            for made in (folder, out.parent):
                made.mkdir()
            self.make(self.unpack(file, folder), out, wears)
            findings = json.loads((out.parent / REPORT).read_text(encoding="utf-8"))
            told = {key: findings[key] for key in ("found", "guessed", "missing")}
            look, modes = out.with_suffix(".look").read_bytes(), out.with_suffix(ENDING)
            known = modes.read_bytes() if modes.is_file() else None
            self.models.add(name, out.read_bytes(), look, user, told, modes=known)
