"""The audit trail: who did what to what, and when."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...store import people, studies

if TYPE_CHECKING:
    from datetime import datetime

    from ...store.admin_tables import AuditEntry
    from ...store.engine import Database

PAGE = 50


@dataclass(frozen=True, slots=True)
class Deed:
    """One entry of the trail."""

    at: datetime
    who: str
    """Name of somebody with an account; a command or the server itself has none."""
    action: str
    subject: str
    title: str
    """Title of the study that it concerns, empty for anything else."""
    detail: dict[str, Any]
    about: str
    """What it concerns as a person says it: a participant by number, a token by its name, else the subject."""


@dataclass(frozen=True, slots=True)
class Pages:
    """Some entries, the newest first, and where the older ones begin."""

    deeds: tuple[Deed, ...]
    older: str | None


@dataclass(frozen=True)
class Trail:
    """What was done here."""

    database: Database

    def read(self, before: str | None = None, subject: str | None = None, most: int = PAGE) -> Pages:
        """Return the newest entries.

        Args:
            before: the `older` of the page before; the newest entries without it.
            subject: only what concerns this, for example the id of a study.
            most: how many.
        """
        with self.database.read() as tx:
            found = people.audit_entries(tx, before, most + 1, subject)
            names = {user.id: user.name for user in people.users(tx)}
            titles = {study.id: study.title for study in studies.all_studies(tx)}
            about = people.called(tx, {entry.subject for entry in found} - titles.keys())
        deeds = tuple(_deed(entry, names, titles, about) for entry in found[:most])
        return Pages(deeds, found[most - 1].id if len(found) > most else None)


def _deed(entry: AuditEntry, names: dict[str, str], titles: dict[str, str], about: dict[str, str]) -> Deed:
    who = names.get(entry.user_id, "somebody without an account") if entry.user_id else "the command line"
    title = titles.get(entry.subject, "")
    # What was deleted has no name any more but the one in the entry itself.
    called = title or about.get(entry.subject) or str(entry.detail.get("title") or entry.subject)
    return Deed(entry.at, who, entry.action, entry.subject, title, entry.detail, called)
