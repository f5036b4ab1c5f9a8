"""The life of a study: drafts and versions, who may join when, and its links. Every change is in the audit trail."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Literal

from ...store import runs, studies
from ..clock import now
from ..config import Problem, StudyConfig, mended
from ..config.difference import changes
from ..config.stored import parsed
from ..errors import ConflictError, InvalidError, NoStudyError, NotFoundError
from ..people.accounts import audit
from .study_rows import LinkKind, new_link, new_version

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime

    from ...store.engine import Tx
    from ...store.studies_tables import Study, StudyVersion
    from ..config.difference import Change
    from ..participation.journal import Journal
    from .studies import Studies

Status = Literal["draft", "pilot", "recruiting", "paused", "closed"]
NEXT: dict[str, tuple[Status, ...]] = {
    "draft": ("pilot", "recruiting"),
    "pilot": ("draft", "recruiting", "paused", "closed"),
    "recruiting": ("paused", "closed"),
    "paused": ("recruiting", "closed"),
    "closed": ("recruiting",),
}
"""What may follow each status (docs/study.md)."""
MOST_LINKS = 1000


@dataclass(frozen=True, slots=True)
class StudyHead:
    """What stands above every page of a study."""

    id: str
    title: str
    status: str
    note: str
    version: int
    config_hash: str
    next: tuple[Status, ...]


@dataclass(frozen=True, slots=True)
class VersionLine:
    """One version of a study in a list. `author` is empty for the command line; people are without simulated ones."""

    number: int
    config_hash: str
    created_at: datetime
    frozen_at: datetime | None
    author_id: str
    author: str
    people: int


@dataclass(frozen=True, slots=True)
class NewLinks:
    """Links to be made: what kind, one label for each, and what people get who come by them."""

    kind: LinkKind
    labels: Sequence[str]
    language: str | None = None
    condition: str | None = None


@dataclass(frozen=True)
class StudyLife:
    """Changes studies that are there."""

    journal: Journal
    studies: Studies

    def head(self, study_id: str) -> StudyHead:
        """Return what stands above every page of a study.

        Raises:
            NotFoundError: no such study.
        """
        with self.journal.database.read() as tx:
            study, latest = _found(tx, study_id)
            return StudyHead(
                study.id, study.title, study.status, study.note, latest.number, latest.config_hash, NEXT[study.status]
            )

    def save(self, study_id: str, config: StudyConfig, user: str | None, based_on: int | None = None) -> int:
        """Store a new version of a study for whoever joins from now on; return its number.

        The same configuration makes no new version.

        Args:
            study_id: the study.
            config: its new configuration.
            user: who saves it.
            based_on: the version that was changed; refused where somebody has saved a newer one. None: whatever it is.

        Raises:
            NotFoundError: no such study.
            InvalidError: the configuration does not fit the face model.
            ConflictError: there is a newer version than the one that was changed.
        """
        config = self.checked(config)
        self.journal.wardrobe.prepare(config)
        with self.journal.database.write() as tx:
            study, latest = _found(tx, study_id, lock=True)
            if based_on not in {None, latest.number}:
                raise ConflictError(
                    f"Version {latest.number} was saved meanwhile.",
                    field="version",
                    expected=latest.number,
                    got=based_on,
                )
            if latest.config_hash == config.hash():
                return latest.number
            version = new_version(study_id, latest.number + 1, config, user)
            version.frozen_at = None if study.status == "draft" else version.created_at
            study.title = config.title
            runs.add(tx, version)
            differing = changes(parsed(latest), config)
            audit(tx, user, "save study", study_id, version=version.number, changes=[asdict(one) for one in differing])
            return version.number

    def checked(self, config: StudyConfig) -> StudyConfig:
        """Return a study with its documents signed.

        Raises:
            InvalidError: the configuration does not fit the face model.
        """
        config = self.journal.wardrobe.frozen(config)
        self.studies.check(config)
        return config

    def beyond(self, plain: Any) -> tuple[Problem, ...]:
        """Return what does not fit the face model in those parts of a study that are right, though others are not."""
        found = mended(plain)
        if found is None:
            return ()
        config, replaced = found
        try:
            self.checked(config)
        except InvalidError as error:
            return tuple(one for one in found_in(error) if one.field.split(".")[0] not in replaced)
        return ()

    def move(self, study_id: str, status: Status, user: str | None, note: str = "") -> None:
        """Let people join a study, or stop it.

        Raises:
            NotFoundError: no such study.
            ConflictError: this cannot follow what it is.
        """
        with self.journal.database.write() as tx:
            study, latest = _found(tx, study_id, lock=True)
            if status not in NEXT[study.status]:
                raise ConflictError(
                    f"A study that is {study.status} cannot become {status}.",
                    field="status",
                    expected=f"one of {', '.join(NEXT[study.status])}",
                    got=status,
                )
            audit(tx, user, "change status", study_id, before=study.status, after=status, note=note)
            study.status, study.note = status, note[:500]
            latest.frozen_at = latest.frozen_at or now()

    def copy(self, study_id: str, user: str | None) -> str:
        """Make a draft with the newest configuration of a study; return its id.

        Raises:
            NotFoundError: no such study.
        """
        with self.journal.database.read() as tx:
            _, latest = _found(tx, study_id)
            config = parsed(latest)
        title = f"Copy of {config.title}"[:200]
        return self.studies.create(config.model_copy(update={"title": title}), "draft", owner=user).id

    def versions(self, study_id: str) -> Sequence[StudyVersion]:
        """Return all versions of a study, the first one first.

        Raises:
            NotFoundError: no such study.
        """
        with self.journal.database.read() as tx:
            _found(tx, study_id)
            return studies.versions(tx, study_id)

    def history(self, study_id: str) -> tuple[VersionLine, ...]:
        """Return all versions of a study with who made them and how many people are in them, the newest first.

        Raises:
            NotFoundError: no such study.
        """
        with self.journal.database.read() as tx:
            _found(tx, study_id)
            people, names = studies.version_people(tx, study_id), studies.version_authors(tx, study_id)
            lines = [
                VersionLine(
                    one.number, one.config_hash, one.created_at, one.frozen_at, one.author_id or "",
                    names.get(one.id, ""), people.get(one.id, 0),
                )
                for one in studies.versions(tx, study_id)
            ]  # fmt: skip
        return tuple(reversed(lines))

    def config(self, study_id: str, number: int | None = None) -> StudyConfig:
        """Return the configuration of a version, the newest unless one is named.

        Raises:
            NotFoundError: no such study or version.
        """
        found = [one for one in self.versions(study_id) if number is None or one.number == number]
        if not found:
            raise NotFoundError("There is no such version.", field="version", got=number)
        return parsed(found[-1])

    def difference(self, study_id: str, before: int, after: int) -> tuple[Change, ...]:
        """Return what differs between two versions.

        Raises:
            NotFoundError: no such study or version.
        """
        return changes(self.config(study_id, before), self.config(study_id, after))

    def add_links(self, study_id: str, wanted: NewLinks, user: str | None) -> list[str]:
        """Make links, one for each label; return their ids in this order.

        Raises:
            NotFoundError: no such study.
            InvalidError: too many, too long or equal labels, or a language or condition that the study does not have.
        """
        _check_labels(wanted.labels)
        with self.journal.database.write() as tx:
            _, latest = _found(tx, study_id, lock=True)
            config = parsed(latest)
            _one_of("language", wanted.language, [config.language, *config.translations])
            _check_new(wanted.labels, [link.label for link in studies.links(tx, study_id)])
            _one_of("condition", wanted.condition, [one.name for one in config.conditions])
            made = [new_link(study_id, wanted.kind, label) for label in wanted.labels]
            for link in made:
                link.language, link.condition = wanted.language, wanted.condition
            runs.add_all(tx, made)
            audit(tx, user, "make links", study_id, kind=wanted.kind, count=len(made))
            return [link.id for link in made]

    def close_link(self, study_id: str, link_id: str, user: str | None) -> None:
        """Let nobody join by a link any more; who has begun goes on.

        Raises:
            NotFoundError: no such link.
        """
        with self.journal.database.write() as tx:
            link = studies.link(tx, link_id)
            if link is None or link.study_id != study_id:
                raise NotFoundError("There is no such link.", field="link", got=link_id)
            if link.closed_at is None:
                link.closed_at = now()
                audit(tx, user, "close link", study_id, link=link.label)


def found_in(error: InvalidError) -> tuple[Problem, ...]:
    """Return what services found wrong with a study: all of it where they say so."""
    return tuple(error.problems) or (Problem(error.field or "study", f"expected {error.expected}", f"{error.got}"),)


def _found(tx: Tx, study_id: str, *, lock: bool = False) -> tuple[Study, StudyVersion]:
    study = studies.study(tx, study_id, lock=lock)
    latest = None if study is None else studies.latest_version(tx, study_id)
    if study is None or latest is None:
        raise NoStudyError(study_id)
    return study, latest


def _check_labels(labels: Sequence[str]) -> None:
    if not 1 <= len(labels) <= MOST_LINKS:
        raise InvalidError(
            f"Make 1 to {MOST_LINKS} links at once.", field="labels", expected=f"1 to {MOST_LINKS}", got=len(labels)
        )
    for label in labels:
        if not 1 <= len(label.strip()) <= 200:
            raise InvalidError("Give every link a label.", field="labels", expected="1 to 200 letters", got=label)


def _check_new(labels: Sequence[str], known: Sequence[str]) -> None:
    """Refuse a label that an open link or another new one has: whoever reads the list could not tell them apart."""
    taken = next((label for label in labels if label in known), None)
    if taken is not None:
        raise _label(f"There is an open link with the label {taken}.", taken)
    twice = next((label for at, label in enumerate(labels) if label in labels[:at]), None)
    if twice is not None:
        raise _label(f"The label {twice} is in the list twice.", twice)


def _label(what: str, got: str) -> InvalidError:
    return InvalidError(f"{what} Give every link its own.", field="labels", expected="different labels", got=got)


def _one_of(field: str, got: str | None, known: Sequence[str]) -> None:
    if got is not None and got not in known:
        raise InvalidError(
            f"The study has no such {field}.", field=field, expected=f"one of {', '.join(known) or 'none'}", got=got
        )
