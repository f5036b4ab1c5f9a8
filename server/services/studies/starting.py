"""What to look at before a study lets people in or lets nobody in any more: consequences first, then the button."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from ...store import studies
from ..clock import now
from ..config import StudyConfig
from ..errors import NoStudyError
from ..participation.joining import OPEN

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ...store.engine import Database
    from ...store.studies_tables import Link

LOCAL = frozenset({"127.0.0.1", "::1", "localhost"})


@dataclass(frozen=True, slots=True)
class StartCheck:
    """One thing that was looked at. `place` is the field of the form that it stands in, empty where there is none."""

    name: str
    good: bool
    text: str
    place: str = ""


@dataclass(frozen=True, slots=True)
class Outlook:
    """What a change of status would mean now."""

    opens: bool
    here: int
    frozen: bool
    checks: tuple[StartCheck, ...]

    @property
    def open_points(self) -> int:
        """How many things are worth seeing to first."""
        return sum(not check.good for check in self.checks)


@dataclass(frozen=True)
class Starting:
    """Looks at studies before their status changes."""

    database: Database
    address: str

    def outlook(self, study_id: str, status: str) -> Outlook:
        """Return what stands before a change to a status, and what it means for who is in the study.

        Raises:
            NotFoundError: no such study.
        """
        with self.database.read() as tx:
            version = studies.latest_version(tx, study_id)
            if version is None:
                raise NoStudyError(study_id)
            config, links = StudyConfig.model_validate(version.config), studies.links(tx, study_id)
            here, tried = studies.standing(tx, study_id, now())
        opens = status in OPEN
        checks = (*_said(config), *self._ways(config, links), _tried(tried)) if opens else ()
        return Outlook(opens, here, version.frozen_at is not None, checks)

    def _ways(self, config: StudyConfig, links: Sequence[Link]) -> Iterator[StartCheck]:
        host = urlsplit(self.address).hostname or ""
        reached = f"Links begin with {self.address}"
        if host in LOCAL:
            reached += ", which only this computer reaches. Set EMOGEN_BASE_URL to recruit elsewhere"
        yield StartCheck("Address", host not in LOCAL, f"{reached}.")
        told = f"{len(links)} open" if links else "None is open, so nobody can come. Make one under Recruit"
        yield StartCheck("Links", bool(links), f"{told}.")
        yield from _places(config)


def _said(config: StudyConfig) -> Iterator[StartCheck]:
    """Yield what participants are told about the study before they agree."""
    texts = config.texts
    contact = ", ".join(filter(None, (texts.contact_name, texts.contact)))
    yield _filled("Contact", contact if texts.contact else "", "Participants are told nobody to ask", "texts.contact")
    yield _filled("Ethics approval", texts.ethics, "Participants are not told who approved the study", "texts.ethics")
    yield _filled("Purpose", texts.purpose, "Participants are not told what the study is about", "texts.purpose")
    minutes = f"{texts.minutes} minutes" if texts.minutes else ""
    yield _filled("Time it takes", minutes, "Participants are not told how long it takes", "texts.minutes")
    for language, translation in config.translations.items():
        missing = [one.noun for one in config.emotions if one.adjective not in translation.emotions]
        if missing:
            text = f"Not translated: {', '.join(missing)}. Participants get the study’s own words."
            yield StartCheck(f"Language {language}", False, text, "translations")


def _filled(name: str, said: str, otherwise: str, place: str) -> StartCheck:
    """Return whether something is said; only its beginning, where it is long."""
    short = said if len(said) <= 120 else f"{said[:119].rstrip()}…"
    return StartCheck(name, bool(said), short or f"Empty. {otherwise}.", place)


def _places(config: StudyConfig) -> Iterator[StartCheck]:
    quotas = [one.quota for one in config.conditions]
    whole = config.quota or (sum(filter(None, quotas)) if quotas and all(quotas) else None)
    text = f"{whole} places" if whole else "No limit: people can join until you pause or close the study"
    yield StartCheck("Participants wanted", whole is not None, f"{text}.", "quota")
    if config.recruiter_parameters:
        back = config.completion.codes.get("complete") or config.completion.redirects.get("complete")
        text = "Set for who finishes" if back else "The recruiter’s code or address for who finishes is missing"
        yield StartCheck("Way back to the recruiter", bool(back), f"{text}.", "completion")


def _tried(finished: int) -> StartCheck:
    text = (
        f"{finished} pilot or simulated {'participant has' if finished == 1 else 'participants have'} finished."
        if finished
        else "Nobody has gone through to the end yet. Preview it, start a pilot, or send simulated participants."
    )
    return StartCheck("Tried out", bool(finished), text)
