"""Taking part in one's own study to see what it is like: everything works, nothing is kept."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING

from ...store import runs, studies
from ..clock import digest, new_token, now
from ..config import StudyConfig
from ..config.stored import parsed
from ..errors import InvalidError, NotFoundError
from ..people.accounts import audit
from .arrival import Joined
from .assignment import Cell, Place, cells
from .seating import new_participation, seat

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...store.engine import Tx
    from ...store.runs_tables import Participation
    from ...store.studies_tables import StudyVersion
    from .journal import Journal

KEPT = timedelta(days=1)
OWNER = "preview_of"
"""Where the row of a preview says whose it is; a preview is never data."""


@dataclass(frozen=True, slots=True)
class Wish:
    """What is to be seen; what is left out is the first there is.

    Attributes:
        version: number of the study's version; the newest unless one is named.
        condition: the condition.
        head: the head, by the name that the data has for it.
        language: the language of the pages.
    """

    version: int | None = None
    condition: str | None = None
    head: str | None = None
    language: str | None = None


@dataclass(frozen=True, slots=True)
class Offers:
    """What a preview of the newest version may show; empty where there is nothing to choose."""

    conditions: tuple[str, ...]
    heads: tuple[tuple[str, str], ...]
    """Each by the name that the data has for it, and what it is called."""
    languages: tuple[str, ...]

    @property
    def any(self) -> bool:
        """Whether there is anything to choose."""
        return bool(self.conditions or self.heads or self.languages)


@dataclass(frozen=True)
class Previews:
    """Previews of studies in any status, drafts included."""

    journal: Journal

    def offers(self, study_id: str) -> Offers:
        """Return what there is to choose from before a preview of the newest version.

        Raises:
            NotFoundError: no such study.
        """
        with self.journal.database.read() as tx:
            config = StudyConfig.model_validate(_version(tx, study_id, None).config)
        found = cells(config)
        heads = dict.fromkeys(cell.head for cell in found if cell.head)
        called = tuple((head, str(config.documents.get(head, {}).get("name") or head)) for head in heads)
        languages = (config.language, *config.translations)
        return Offers(
            tuple(one.name for one in config.conditions) if len(config.conditions) > 1 else (),
            called if len(called) > 1 else (),
            languages if len(languages) > 1 else (),
        )

    def begin(self, study_id: str, user: str, wish: Wish | None = None) -> Joined:
        """Take a place that counts nowhere; an earlier preview of the same person ends.

        Raises:
            NotFoundError: no such study or version.
            InvalidError: the version has no such condition, head or language.
        """
        wanted = wish or Wish()
        self.sweep(user)
        token = new_token()
        with self.journal.database.write() as tx:
            study, link = studies.study(tx, study_id, lock=True), studies.any_link(tx, study_id)
            if study is None or link is None:
                raise NotFoundError("There is no such study.", field="study", got=study_id)
            version = _version(tx, study_id, wanted.version)
            config = parsed(version)
            participation = new_participation(link, study, version, token)
            participation.preview, participation.pilot = True, False
            participation.device = {OWNER: user}
            participation.recruiter = dict.fromkeys(config.recruiter_parameters, "preview")
            participation.number = runs.preview_number(tx, study_id)
            participation.language = _language(config, wanted.language)
            cell = _cell(config, wanted)
            own = config.in_condition(cell.condition)
            seat(tx, self.journal.rig_of(own), participation, own, Place(cell, 0))
            audit(tx, user, "preview study", study_id, version=version.number)
        self.journal.wardrobe.prepare(config)
        return Joined(token, participation.id)

    def end(self, token: str) -> None:
        """Delete a preview completely; what is none stays."""
        with self.journal.database.write() as tx:
            found = runs.participation_by_token(tx, digest(token), lock=True)
            if found is not None and found.preview:
                runs.delete_preview(tx, found)

    def sweep(self, user: str | None = None) -> int:
        """Delete what is older than a day, and every preview of `user`; return how many there were."""
        with self.journal.database.read() as tx:
            if not _over(runs.previews(tx), user):
                return 0
        with self.journal.database.write() as tx:
            over = _over(runs.previews(tx, lock=True), user)
            for preview in over:
                runs.delete_preview(tx, preview)
            return len(over)


def _over(previews: Sequence[Participation], user: str | None) -> list[Participation]:
    oldest = now() - KEPT
    return [one for one in previews if one.arrived_at < oldest or (user and one.device.get(OWNER) == user)]


def _version(tx: Tx, study_id: str, number: int | None) -> StudyVersion:
    found = [one for one in studies.versions(tx, study_id) if number is None or one.number == number]
    if not found:
        raise NotFoundError("There is no such version.", field="version", got=number)
    return found[-1]


def _cell(config: StudyConfig, wanted: Wish) -> Cell:
    found = [cell for cell in cells(config) if wanted.condition in {None, cell.condition}]
    if not found:
        known = ", ".join(one.name for one in config.conditions) or "none"
        raise InvalidError(
            "The study has no such condition.", field="condition", expected=f"one of {known}", got=wanted.condition
        )
    of_head = [cell for cell in found if wanted.head in {None, cell.head}]
    if not of_head:
        known = ", ".join(sorted({cell.head for cell in found} - {""})) or "all of them, one after the other"
        raise InvalidError("The study has no such head here.", field="head", expected=known, got=wanted.head)
    return of_head[0]


def _language(config: StudyConfig, language: str | None) -> str:
    if language is not None and language not in (config.language, *config.translations):
        known = ", ".join((config.language, *config.translations))
        raise InvalidError(
            "The study has no such language.", field="language", expected=f"one of {known}", got=language
        )
    return language or config.language
