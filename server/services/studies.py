"""Making studies and telling how they go."""

from __future__ import annotations

import secrets
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..store import runs, studies
from ..store.studies_tables import Link, Study, StudyVersion
from .clock import new_id, now
from .config import DEMO, StudyConfig
from .errors import InvalidError, NotFoundError
from .evolution import params_of
from .joining import OPEN

if TYPE_CHECKING:
    from ..store.engine import Tx
    from .journal import Journal


DEMO_ID = "demo"


@dataclass(frozen=True, slots=True)
class StudySummary:
    """A study in a list: who is where."""

    id: str
    title: str
    status: str
    emotions: tuple[str, ...]
    links: tuple[str, ...]
    config_hash: str
    arrived: int
    running: int
    complete: int
    left: int


@dataclass(frozen=True)
class Studies:
    """The studies of this server."""

    journal: Journal

    def create(self, config: StudyConfig, status: str = "recruiting", study_id: str | None = None) -> StudySummary:
        """Store a study, its first version and a general link to it.

        Raises:
            InvalidError: the study does not fit the face model, or a document in it is not one.
        """
        config = self.journal.wardrobe.frozen(config)
        self.check(config)
        self.journal.wardrobe.prepare(config)
        created = now()
        study = Study(id=study_id or secrets.token_hex(8), title=config.title, status=status, created_at=created)
        version = StudyVersion(
            id=new_id(),
            study_id=study.id,
            number=1,
            config=config.canonical(),
            config_hash=config.hash(),
            created_at=created,
        )
        link = Link(id=secrets.token_urlsafe(12), study_id=study.id, label="General link", created_at=created)
        with self.journal.database.write() as tx:
            runs.add(tx, study, version, link)
        return self.summary(study.id)

    def check(self, config: StudyConfig) -> None:
        """Refuse a study that this face model cannot run.

        Raises:
            InvalidError: names what does not fit.
        """
        rig = self.journal.rig
        strange = [name for name in config.identities if isinstance(name, str) and name not in rig.identities]
        if strange:
            raise InvalidError(
                "The study names a head that the face model does not have.",
                field="identities",
                expected=f"among {', '.join(rig.identities)}",
                got=", ".join(strange),
            )
        params_of(rig, config)

    def demo(self) -> StudySummary:
        """Store the demonstration study, on the heads that this face model has."""
        known = tuple(name for name in DEMO.heads if name in self.journal.rig.identities)
        identities = known or self.journal.rig.identities[:1]
        with self.journal.database.read() as tx:
            free = studies.study(tx, DEMO_ID) is None
        return self.create(DEMO.model_copy(update={"identities": identities}), study_id=DEMO_ID if free else None)

    def prepare(self) -> None:
        """Have the heads of the studies that people may join fitted in the background."""
        with self.journal.database.read() as tx:
            open_ = [study.id for study in studies.all_studies(tx) if study.status in OPEN]
            versions = [studies.latest_version(tx, study_id) for study_id in open_]
        for version in filter(None, versions):
            self.journal.wardrobe.prepare(StudyConfig.model_validate(version.config))

    def ensure_one(self) -> StudySummary | None:
        """Store the demonstration study when there is no study at all."""
        with self.journal.database.read() as tx:
            empty = not studies.all_studies(tx)
        return self.demo() if empty else None

    def all(self) -> list[StudySummary]:
        """Return all studies, the newest first."""
        with self.journal.database.read() as tx:
            return [_summary(tx, study) for study in studies.all_studies(tx)]

    def summary(self, study_id: str) -> StudySummary:
        """Return one study.

        Raises:
            NotFoundError: unknown.
        """
        with self.journal.database.read() as tx:
            study = studies.study(tx, study_id)
            if study is None:
                raise NotFoundError("There is no such study.", field="study", got=study_id)
            return _summary(tx, study)


def _summary(tx: Tx, study: Study) -> StudySummary:
    version = studies.latest_version(tx, study.id)
    emotions = StudyConfig.model_validate(version.config).emotions if version else ()
    return StudySummary(
        study.id,
        study.title,
        study.status,
        tuple(emotion.noun for emotion in emotions),
        tuple(link.id for link in studies.links(tx, study.id)),
        version.config_hash if version else "",
        *studies.counts(tx, study.id),
    )
