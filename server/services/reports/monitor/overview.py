"""The list of studies: how each goes, and which of them lose unusually many people."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ....store import monitor
from ...clock import now
from ...config.stored import config_of
from ...participation.joining import OPEN
from .people import wanted
from .stations import stations_of
from .times import LIMIT_MS, Spread, kind_of, spread, wait_of

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from ....store.engine import Database, Tx
    from ....store.monitor import Run, StudyRow

LATELY = 30
"""Drop-out is unusual where at least `MANY` of the last so many people left during the same station."""
MANY = 6
HIGH = 0.15
LEAST_LEFT = 5
MOST_WARNINGS = 3


@dataclass(frozen=True, slots=True)
class Listed:
    """One study of the list."""

    id: str
    title: str
    version: int
    status: str
    note: str
    emotions: tuple[str, ...]
    conditions: int
    languages: int
    owner_id: str | None
    owner: str | None
    complete: int
    quota: int | None
    here: int
    left: int
    last_answer_at: datetime | None

    @property
    def left_share(self) -> float | None:
        """Share of those no longer in the study who left early; None when nobody is over."""
        over = self.complete + self.left
        return self.left / over if over else None

    @property
    def loses(self) -> bool:
        """Whether that share is high."""
        return self.left >= LEAST_LEFT and (self.left_share or 0) >= HIGH


@dataclass(frozen=True, slots=True)
class Warned:
    """A study that many left lately, at one station; and how long phones waited there, where that was long."""

    id: str
    title: str
    left: int
    people: int
    station: str
    phones: Spread | None


@dataclass(frozen=True, slots=True)
class Listing:
    """The list of studies, the one with the latest answer first, and its warnings."""

    moment: datetime
    studies: tuple[Listed, ...]
    warned: tuple[Warned, ...]


@dataclass(frozen=True)
class Overview:
    """All studies at once: a handful of queries, however many there are."""

    database: Database

    def all(self) -> Listing:
        """Return the list of studies."""
        moment = now()
        with self.database.read() as tx:
            rows = monitor.study_rows(tx, moment)
            warned = _warned(tx, {row.id: row for row in rows if row.status in OPEN}, moment)
        listed = sorted(map(_listed, rows), key=lambda one: one.last_answer_at.timestamp() if one.last_answer_at else 0)
        return Listing(moment, tuple(reversed(listed)), warned)


def _listed(row: StudyRow) -> Listed:
    config: dict[str, Any] = row.config
    conditions = config.get("conditions", [])
    return Listed(
        id=row.id,
        title=row.title,
        version=row.version,
        status=row.status,
        note=row.note,
        emotions=tuple(one["noun"] for one in config["emotions"]),
        conditions=len(conditions),
        languages=1 + len(config.get("translations", {})),
        owner_id=row.owner_id,
        owner=row.owner,
        complete=row.complete,
        quota=wanted(config.get("quota"), [one.get("quota") for one in conditions]),
        here=row.running,
        left=row.left,
        last_answer_at=row.last_answer_at,
    )


def _warned(tx: Tx, rows: dict[str, StudyRow], moment: datetime) -> tuple[Warned, ...]:
    suspects = [row.id for row in rows.values() if row.left >= MANY]
    if not suspects:
        return ()
    gone: dict[str, list[Run]] = {}
    for study, run in monitor.last_ended(tx, suspects, moment, LATELY, left=True):
        gone.setdefault(study, []).append(run)
    found = filter(None, (_left(tx, rows[study], runs) for study, runs in gone.items()))
    worst = sorted(found, key=lambda one: -one.left / one.people)[:MOST_WARNINGS]
    lately = monitor.last_ended(tx, [one.id for one in worst], moment, LATELY) if worst else ()
    return tuple(replace(one, phones=_phones(tx, [run for study, run in lately if study == one.id])) for one in worst)


def _left(tx: Tx, row: StudyRow, gone: Sequence[Run]) -> Warned | None:
    """Return a warning where many of the last people left at the same station."""
    if len(gone) < MANY:
        return None
    stations = stations_of(config_of(tx, row.version_id))
    station, left = Counter(map(stations.name, gone)).most_common(1)[0]
    return (
        Warned(row.id, row.title, left, min(row.complete + row.left, LATELY), station, None) if left >= MANY else None
    )


def _phones(tx: Tx, runs: Sequence[Run]) -> Spread | None:
    """Return how long phones waited, if it was long."""
    choices = monitor.choices_of(tx, [run.id for run in runs])
    phones = spread(wait for choice in choices if kind_of(choice) == "phone" and (wait := wait_of(choice)) is not None)
    return phones if phones and phones.median > LIMIT_MS else None
