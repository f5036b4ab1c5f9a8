"""Reports of studies: one is made at a time; the last one of each study is kept until somebody in it is erased."""

from __future__ import annotations

import io
import json
import threading
import zipfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from datetime import timedelta
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from ....store import analyses as rows
from ....store import revisions, studies
from ....store.analyses_tables import Analysis
from ....store.results import has_estimates
from ...background import watched
from ...clock import local, new_id, now
from ...config.stored import parsed
from ...errors import ConflictError, InvalidError, NotFoundError, ServiceError
from ...faces.face_model import FileModels
from ...people.accounts import audit
from ..tables.package import write_zip
from ..tables.selection import Filters
from .analyst import MOST_SECONDS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from datetime import datetime

    from ....store.engine import Database
    from ...faces.face_model import Models
    from ..tables.export import Exports

    Make = Callable[[Path, Path, Sequence[str]], None]
    """From an export, a folder and options to the files of a report in that folder."""

LEASE = timedelta(seconds=MOST_SECONDS + 60)
"""After which a report that is still being made is taken for lost: its process was killed."""
PAGE, ABOUT = "report.html", "about.json"
KINDS = {
    "people": (Filters(kind="people"), ()),
    "pilot": (Filters(kind="pilot"), ("--pilot",)),
    "simulated": (Filters(kind="simulated"), ("--simulated",)),
    "all": (Filters(), ("--pilot", "--simulated")),
}
"""For everybody who can be counted: what is exported, and what the command is told."""
USUAL = "elite"
RESULTS = {USUAL: "the faces chosen as best", "estimate": "the search’s own estimates"}
"""Which face of every trial can be analysed, in words."""


@dataclass(frozen=True, slots=True)
class Standing:
    """How it stands with the report of a study.

    Attributes:
        begun_at: when the one that was asked for last was begun, in the time zone of this machine.
        running: whether it is being made.
        problem: why it was not made.
        who: who counts in it.
        result: which face of every trial it is of.
        made_at: when the one that is there was begun.
        counted: who counts in that, and of which faces it is where that is not the usual one, in words.
        changed: whether data came or went since.
    """

    begun_at: datetime
    running: bool
    problem: str | None
    who: str
    result: str
    made_at: datetime | None
    counted: str | None
    changed: bool


@dataclass(frozen=True)
class Analyses:
    """Has reports made, and keeps them."""

    database: Database
    exports: Exports
    make: Make
    models: Models = field(default_factory=FileModels)
    _behind: ThreadPoolExecutor = field(default_factory=lambda: ThreadPoolExecutor(1, thread_name_prefix="analysis"))
    _busy: threading.Lock = field(default_factory=threading.Lock)
    """Held from the moment a report is asked for until it is there: nothing queues, so that leases need not allow for
    it."""

    def begin(self, study_id: str, who: str, user: str | None, result: str = USUAL) -> None:
        """Ask for a report; return at once.

        Args:
            study_id: of which study.
            who: who counts.
            user: who asks.
            result: which face of every trial is analysed.

        Raises:
            NotFoundError: no such study.
            InvalidError: nobody of this kind can be counted, or no such face analysed.
            ConflictError: one is being made.
        """
        if who not in KINDS:
            raise InvalidError("There is no such filter.", field="who", expected=f"one of {', '.join(KINDS)}", got=who)
        if result not in RESULTS:
            expected = f"one of {', '.join(RESULTS)}"
            raise InvalidError("There is no such result.", field="result", expected=expected, got=result)
        if not self._busy.acquire(blocking=False):
            raise ConflictError(
                "A report is being made already: of this or another study, or one to be dropped, since somebody was "
                "erased meanwhile. Ask again in a minute."
            )
        try:
            analysis = self._asked(study_id, who, result, user)
            watched(self._behind.submit(self._work, analysis, study_id, who, result), "a report could not be made")
        except BaseException:
            self._busy.release()
            raise

    def of(self, study_id: str) -> Standing | None:
        """Return how it stands with the report of a study; nothing where nobody asked for one."""
        with self.database.read() as tx:
            last, there = rows.latest(tx, study_id), rows.made(tx, study_id)
            if last is None:
                return None
            running = _running(last)
            lost = "It was interrupted." if last.ended_at is None and not running else None
            return Standing(
                begun_at=local(last.begun_at), running=running, problem=last.problem or lost, who=last.who,
                result=last.result, made_at=local(there.begun_at) if there else None,
                counted=_told(there) if there else None,
                changed=there is not None and there.revision != revisions.revision(tx, study_id),
            )  # fmt: skip

    def results(self, study_id: str) -> dict[str, str]:
        """Return which faces of a trial can be analysed, with words for them; the first is the usual one."""
        with self.database.read() as tx:
            return RESULTS if has_estimates(tx, study_id) else {USUAL: RESULTS[USUAL]}

    def page(self, study_id: str) -> bytes:
        """Return the page of the report.

        Raises:
            NotFoundError: there is none.
        """
        with zipfile.ZipFile(io.BytesIO(self.archive(study_id))) as files:
            return files.read(PAGE)

    def archive(self, study_id: str) -> bytes:
        """Return all files of the report as a zip.

        Raises:
            NotFoundError: there is none.
        """
        with self.database.read() as tx:
            there = rows.made(tx, study_id)
            if there is None or there.archive is None:
                raise NotFoundError(
                    "There is no report of this study. Make one on the tab Results.", field="study", got=study_id
                )
            return there.archive

    def settle(self) -> None:
        """Wait until everything that was asked for is made. For tests."""
        self._behind.submit(lambda: None).result()

    def close(self) -> None:
        """Make nothing more; `make` has to end what it is at."""
        self._behind.shutdown(wait=True, cancel_futures=True)

    def _rig(self, study_id: str) -> list[str]:
        """Return the option that names the rig of a study that is not on the bundled one."""
        with self.database.read() as tx:
            version = studies.latest_version(tx, study_id)
        model = self.models.of(next(iter(parsed(version).heads))) if version else None
        return ["--rig", str(model.files[0])] if model else []

    def _asked(self, study_id: str, who: str, result: str, user: str | None) -> str:
        """Write down that a report is being made; return its id."""
        with self.database.write() as tx:
            if studies.study(tx, study_id, lock=True) is None:
                raise NotFoundError("There is no such study.", field="study", got=study_id)
            last, there = rows.latest(tx, study_id), rows.made(tx, study_id)
            if last is not None and _running(last):
                raise ConflictError("The report of this study is being made already. Wait until it is there.")
            rows.forget_others(tx, study_id, {there.id} if there else set())
            row = Analysis(
                id=new_id(), study_id=study_id, who=who, result=result, revision=revisions.revision(tx, study_id),
                begun_at=now(),
            )  # fmt: skip
            rows.add(tx, row)
            audit(tx, user, "make report", study_id, who=who, result=result)
            return row.id

    def _work(self, analysis_id: str, study_id: str, who: str, result: str) -> None:
        try:
            self._attempt(analysis_id, study_id, who, result)
        finally:
            self._busy.release()

    def _attempt(self, analysis_id: str, study_id: str, who: str, result: str) -> None:
        try:
            archive, counted = self._made(study_id, who, result)
        except ServiceError as error:
            self._end(analysis_id, problem=error.message)
        except BaseException:
            self._end(analysis_id, problem="The report could not be made; the server's log says why.")
            raise
        else:
            self._end(analysis_id, archive=archive, counted=counted)

    def _made(self, study_id: str, who: str, result: str) -> tuple[bytes, str]:
        """Return the files of a report as a zip, and who was counted."""
        filters, kinds = KINDS[who]
        options = [*kinds, *(("--result", result) if result != USUAL else ()), *self._rig(study_id)]
        with TemporaryDirectory(prefix="emogen-analysis-") as folder:
            export, out = Path(folder, f"{study_id}.zip"), Path(folder, "report")
            write_zip(self.exports.package(study_id, "parquet", filters).entries(), export)
            self.make(export, out, options)
            counted = json.loads((out / ABOUT).read_text(encoding="utf-8"))["counted"]
            return _zipped(out), str(counted)

    def _end(
        self, analysis_id: str, *, archive: bytes | None = None, counted: str | None = None, problem: str | None = None
    ) -> None:
        """Write down what became of a report, unless somebody was erased meanwhile: then it is dropped."""
        with self.database.write() as tx:
            row = rows.asked(tx, analysis_id)
            if row is None:
                return
            row.ended_at, row.archive, row.counted, row.problem = now(), archive, counted, problem
            if archive is not None:
                rows.forget_others(tx, row.study_id, {row.id})


def _told(row: Analysis) -> str | None:
    """Return who counts in a report, and of which faces it is where that is not the usual one."""
    return row.counted if row.result == USUAL else f"{row.counted}, {RESULTS[row.result]}"


def _running(row: Analysis) -> bool:
    return row.ended_at is None and now() - row.begun_at < LEASE


def _zipped(folder: Path) -> bytes:
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as files:
        for path in sorted(folder.iterdir()):
            files.write(path, path.name)
    return target.getvalue()
