"""Who took part in a study: a list in pages, filtered, and the people that a search word leads to."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime
from typing import TYPE_CHECKING

from ....store import roster, studies
from ....store.roster import Wanted
from ...clock import local, now
from ...errors import InvalidError, NotFoundError
from ...naming import name_of, number_in
from ...people.browsers import browser_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ....store.engine import Database
    from ....store.runs_tables import Participation

PAGE = 50
MOST_FOUND = 50
STATUSES = {
    "complete": "Completed",
    "running": "In the study",
    "left": "Left",
    "stopped": "Stopped",
    "no_consent": "No consent",
    "screened_out": "Screened out",
    "failed_checks": "Failed checks",
    "erased": "Erased",
}
"""Every status of a person, and its words."""
KINDS = {"people": "Participants", "pilot": "Pilot", "simulated": "Simulated"}


@dataclass(frozen=True, slots=True)
class Filters:
    """What the address of a list says; empty fields restrict nothing. `below` and `above` turn its pages."""

    status: str = ""
    condition: str = ""
    kind: str = ""
    q: str = ""
    below: int | None = None
    above: int | None = None


@dataclass(frozen=True, slots=True)
class Entry:
    """One row of the list. Of a person who was erased what they did and who they were is gone."""

    number: int
    name: str
    status: str
    words: str
    condition: str
    head: str
    language: str
    device: str
    version: int
    started: datetime
    finished: datetime | None
    recruiter: str
    pilot: bool
    simulated: bool

    @property
    def minutes(self) -> int | None:
        """How long the participation took, rounded."""
        return None if self.finished is None else round((self.finished - self.started).total_seconds() / 60)

    @property
    def erased(self) -> bool:
        """Whether this is a tombstone."""
        return self.status == "erased"


@dataclass(frozen=True, slots=True)
class Page:
    """One page of a list, and how its pages are turned."""

    entries: Sequence[Entry]
    total: int
    conditions: Sequence[str]
    newer: int | None
    older: int | None


@dataclass(frozen=True, slots=True)
class Found:
    """Where a search word leads: (id, title) of studies, and people as (study's id, its title, entry)."""

    studies: Sequence[tuple[str, str]]
    people: Sequence[tuple[str, str, Entry]]


@dataclass(frozen=True)
class Roster:
    """Everybody who took part."""

    database: Database

    def page(self, study_id: str, filters: Filters) -> Page:
        """Return a page of the people of a study, who came last first.

        Raises:
            NotFoundError: no such study.
            InvalidError: a filter that there is not.
        """
        _known("status", filters.status, STATUSES)
        _known("kind", filters.kind, KINDS)
        wanted = replace(_searched(study_id, filters.q), status=filters.status, condition=filters.condition)
        wanted = replace(wanted, kind=filters.kind)
        with self.database.read() as tx:
            if studies.study(tx, study_id) is None:
                raise NotFoundError("There is no such study.", field="study", got=study_id)
            rows = roster.people(tx, wanted, PAGE, below=filters.below, above=filters.above)
            total = roster.number_of_people(tx, wanted)
            known = roster.conditions(tx, study_id)
            last, first = (rows[-1][0].number, rows[0][0].number) if rows else (None, None)
            older = last is not None and roster.people(tx, wanted, 1, below=last)
            newer = first is not None and roster.people(tx, wanted, 1, above=first)
        entries = [entry(*row) for row in rows]
        return Page(entries, total, known, first if newer else None, last if older else None)

    def find(self, words: str) -> Found:
        """Return the studies and people that words lead to: a title, a number, a recruiter's id, a withdrawal code."""
        words = words.strip()[:100]
        if not words:
            return Found((), ())
        with self.database.read() as tx:
            named = [(study.id, study.title) for study in roster.found_studies(tx, words, MOST_FOUND)]
            people = roster.found_people(tx, number_in(words), words, MOST_FOUND)
            return Found(named, [(study.id, study.title, entry(one, 0)) for one, study in people])


def entry(row: Participation, version: int) -> Entry:
    """Return a participation as a list shows it; of an erased one what its tombstone has."""
    status = status_of(row)
    gone = status == "erased"
    return Entry(
        number=row.number,
        name=name_of(row.number),
        status=status,
        words=STATUSES.get(status, status),
        condition=row.condition,
        head=row.head,
        language=row.language,
        device="" if gone else device_of(row),
        version=version,
        started=local(row.consented_at or row.arrived_at),
        finished=local(row.ended_at) if row.ended_at else None,
        recruiter="" if gone else ", ".join(str(value) for value in row.recruiter.values()),
        pilot=row.pilot,
        simulated=row.simulated,
    )


def status_of(row: Participation) -> str:
    """Return where somebody is, as one of `STATUSES`."""
    if row.erased_at is not None:
        return "erased"
    if row.outcome is not None:
        return row.outcome
    return "running" if row.lease_until is not None and row.lease_until > now() else "left"


def device_of(row: Participation) -> str:
    """Return what somebody took part on, as far as it is known."""
    known = (row.device.get("kind"), browser_of(row.device.get("user_agent", "")))
    return ", ".join(filter(None, known))


def _searched(study_id: str, words: str) -> Wanted:
    words = words.strip()[:100]
    return Wanted(study_id, now(), number=number_in(words), recruiter=words)


def _known(field: str, got: str, known: dict[str, str]) -> None:
    if got and got not in known:
        raise InvalidError("There is no such filter.", field=field, expected=f"one of {', '.join(known)}", got=got)
