"""What of a study is exported: filters, and a cursor that says up to where somebody has it."""

from __future__ import annotations

import base64
import binascii
import hashlib
import json
from array import array
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, Literal

from ....store import export, revisions, studies
from ...errors import InvalidError, NotFoundError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ....store.engine import Database, Tx
    from ....store.studies_tables import RigRecord

Kind = Literal["people", "pilot", "simulated"]
_FORM = 1
_TIME, _SHOWN = "a time like 2026-03-01T00:00Z", "%Y-%m-%d %H:%M UTC"


@dataclass(frozen=True, slots=True)
class Filters:
    """What is wanted; empty fields restrict nothing. Times are of arrival, with their zone: from, and before."""

    condition: str = ""
    kind: Kind | Literal[""] = ""
    arrived_from: datetime | None = None
    arrived_before: datetime | None = None
    block: str = ""
    emotion: str = ""

    def told(self) -> dict[str, str]:
        """Return those that restrict something, as text."""
        return {name: str(value) for name, value in asdict(self).items() if value}

    def wanted(self, study_id: str, since: int | None = None) -> export.Wanted:
        """Return them as the store takes them.

        Raises:
            InvalidError: a time without a zone or outside the calendar, or an end that is not after the begin.
        """
        begin, end = _utc("arrived_from", self.arrived_from), _utc("arrived_before", self.arrived_before)
        if begin and end and end <= begin:
            raise InvalidError(
                "The end of the arrivals has to be after their begin.",
                field="arrived_before",
                expected=f"a time after {begin:{_SHOWN}}",
                got=f"{end:{_SHOWN}}",
            )
        return export.Wanted(study_id=study_id, since=since, **asdict(self))


@dataclass(frozen=True, slots=True)
class Selection:
    """The participations of an export, chosen at one moment, with the rigs that name their numbers."""

    title: str
    wanted: export.Wanted
    filters: Filters
    numbers: array[int]
    rigs: Sequence[RigRecord]
    revision: int

    @property
    def cursor(self) -> str:
        """Return the cursor after which changes are what came since this selection was made."""
        return _cursor(self.wanted.study_id, self.filters, self.revision)


def select(database: Database, study_id: str, filters: Filters, since: str | None = None) -> Selection:
    """Choose the participations of an export; with a cursor, those that came or changed since.

    Raises:
        NotFoundError: no such study.
        InvalidError: a time without a zone, or a cursor that is not of this study with these filters.
    """
    wanted = filters.wanted(study_id, None if since is None else _revision(since, study_id, filters))
    with database.read() as tx:
        study = found_study(tx, study_id)
        reached = revisions.revision(tx, study_id)
        if wanted.since is not None and wanted.since > reached:
            raise _wrong("The data is older than this cursor; a backup was probably restored. Load it all again.")
        numbers = array("q", export.chosen(tx, wanted))
        return Selection(study.title, wanted, filters, numbers, studies.rigs_of(tx, study_id), reached)


def _utc(name: str, moment: datetime | None) -> datetime | None:
    if moment is None:
        return None
    try:
        if moment.tzinfo is not None:
            return moment.astimezone(UTC)
    except OverflowError as error:
        raise InvalidError("There is no such time.", field=name, expected=_TIME, got=moment) from error
    raise InvalidError("A time needs its zone.", field=name, expected=_TIME, got=moment)


def found_study(tx: Tx, study_id: str) -> Any:
    """Return a study.

    Raises:
        NotFoundError: no such study.
    """
    found = studies.study(tx, study_id)
    if found is None:
        raise NotFoundError("There is no such study.", field="study", got=study_id)
    return found


def _cursor(study_id: str, filters: Filters, revision: int) -> str:
    plain = json.dumps([_FORM, study_id, _mark(filters), revision], separators=(",", ":"))
    return base64.urlsafe_b64encode(plain.encode()).decode().rstrip("=")


def _revision(cursor: str, study_id: str, filters: Filters) -> int:
    try:
        form, study, mark, revision = json.loads(base64.urlsafe_b64decode(cursor + "=" * (-len(cursor) % 4)))
    except (ValueError, TypeError, binascii.Error) as error:
        raise _wrong("This is no cursor.", cursor) from error
    if form != _FORM or type(revision) is not int or revision < 0:
        raise _wrong("This is no cursor.", cursor)
    if (study, mark) != (study_id, _mark(filters)):
        raise _wrong("This cursor is of another study or of other filters. Use the same ones, or load it all again.")
    return revision


def _mark(filters: Filters) -> str:
    return hashlib.sha256(json.dumps(filters.told(), sort_keys=True).encode()).hexdigest()[:16]


def _wrong(message: str, got: str | None = None) -> InvalidError:
    return InvalidError(message, field="since", expected="a cursor that an export of this study gave", got=got)
