"""How people come to a study: its links with what came of them, as addresses, QR codes and a table."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, get_args

import segno

from ...store import studies
from ..config import Outcome, StudyConfig
from ..config.stored import newest
from ..errors import NotFoundError
from ..participation.joining import OPEN
from ..spreadsheet import guarded

if TYPE_CHECKING:
    from datetime import datetime

    from ...store.engine import Database
    from ...store.studies_tables import Link

PLACEHOLDERS = {
    "PROLIFIC_PID": "{{%PROLIFIC_PID%}}",
    "STUDY_ID": "{{%STUDY_ID%}}",
    "SESSION_ID": "{{%SESSION_ID%}}",
    "survey_code": "%SURVEY_CODE%",
    "workerId": "${workerId}",
    "assignmentId": "${assignmentId}",
    "hitId": "${hitId}",
}
"""What recruiters fill in for the parameters that they are known for: Prolific, SONA, Mechanical Turk."""


@dataclass(frozen=True, slots=True)
class LinkView:
    """A link and what came of it; simulated participants and previews are not counted."""

    id: str
    kind: str
    label: str
    language: str
    condition: str
    address: str
    since: datetime
    closed: bool
    joined: int
    complete: int


@dataclass(frozen=True, slots=True)
class Way:
    """How people come, and what they are sent back with."""

    links: tuple[LinkView, ...]
    languages: tuple[str, ...]
    conditions: tuple[str, ...]
    recruiter: str
    """Address for a recruiter, with its own placeholders; empty where the study names no parameters."""
    outcomes: tuple[tuple[str, str, str], ...]
    """Outcome, code, address, empty where there is none."""


@dataclass(frozen=True)
class Recruiting:
    """The links of studies as people see them."""

    database: Database
    address: str

    def way(self, study_id: str) -> Way:
        """Return how people come to a study.

        Raises:
            NotFoundError: no such study.
        """
        with self.database.read() as tx:
            config = newest(tx, study_id)
            links = tuple(self._view(*found) for found in studies.every_link(tx, study_id))
        first = next((link for link in links if not link.closed and link.kind != "personal"), None)
        codes, redirects = dict(config.completion.codes), dict(config.completion.redirects)
        return Way(
            links,
            (config.language, *config.translations),
            tuple(one.name for one in config.conditions),
            _asked(first.address, config) if first else "",
            tuple((name, codes.get(name, ""), redirects.get(name, "")) for name in get_args(Outcome)),
        )

    def open_links(self, most: int) -> list[tuple[str, str]]:
        """Return title and address of general links by which people can join now, of the newest studies first."""
        with self.database.read() as tx:
            found = [
                (study.title, self._address(link))
                for study in studies.all_studies(tx)
                if study.status in OPEN
                for link in studies.links(tx, study.id)
                if link.kind != "personal"
            ]
        return found[:most]

    def table(self, study_id: str) -> str:
        """Return the open links as CSV, for letters to the people who get them.

        Raises:
            NotFoundError: no such study.
        """
        buffer = io.StringIO()
        writer = csv.writer(buffer)
        writer.writerow(("label", "kind", "language", "condition", "address"))
        for link in self.way(study_id).links:
            if not link.closed:
                writer.writerow((guarded(link.label), link.kind, link.language, link.condition, link.address))
        return buffer.getvalue()

    def code(self, study_id: str, link_id: str) -> str:
        """Return the QR code of a link as SVG.

        Raises:
            NotFoundError: the study has no such link.
        """
        with self.database.read() as tx:
            link = studies.link(tx, link_id)
        if link is None or link.study_id != study_id:
            raise NotFoundError("There is no such link.", field="link", got=link_id)
        picture = io.BytesIO()
        segno.make(self._address(link), error="m").save(picture, kind="svg", border=4, scale=8, light="#fff")
        return picture.getvalue().decode()

    def _view(self, link: Link, joined: int, complete: int) -> LinkView:
        return LinkView(
            link.id,
            link.kind,
            link.label,
            link.language or "",
            link.condition or "",
            self._address(link),
            link.created_at,
            link.closed_at is not None,
            joined,
            complete,
        )

    def _address(self, link: Link) -> str:
        return f"{self.address}/s/{link.id}"


def _asked(address: str, config: StudyConfig) -> str:
    names = config.recruiter_parameters
    query = "&".join(f"{name}={PLACEHOLDERS.get(name, name.upper())}" for name in names)
    return f"{address}?{query}" if query else ""
