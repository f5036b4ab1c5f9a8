"""Making studies and telling how they go."""

from __future__ import annotations

import secrets
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...store import runs, studies
from ...store.studies_tables import Study
from ..clock import now
from ..config import DEMO, StudyConfig
from ..config.stored import parsed
from ..config.way_back import check_redirects
from ..errors import ConflictError, InvalidError, NoStudyError, NotFoundError
from ..participation.joining import OPEN
from ..people.accounts import audit
from .fitting import require_fit
from .study_rows import new_link, new_version

if TYPE_CHECKING:
    from ...store.engine import Tx
    from ..participation.journal import Journal


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

    def create(
        self,
        config: StudyConfig,
        status: str = "recruiting",
        study_id: str | None = None,
        owner: str | None = None,
    ) -> StudySummary:
        """Store a study, its first version and a general link to it.

        Raises:
            InvalidError: the study does not fit the face model, or a document in it is not one.
            ConflictError: there is a study with this id.
        """
        config = self.journal.wardrobe.frozen(config)
        self.check(config)
        self.journal.wardrobe.prepare(config)
        created = now()
        study = Study(
            id=study_id or secrets.token_hex(8),
            title=config.title,
            status=status,
            owner_id=owner,
            note="",
            created_at=created,
        )
        version = new_version(study.id, 1, config, owner)
        version.frozen_at = None if status == "draft" else created
        link = new_link(study.id, "general_multiple", "General link")
        with self.journal.database.write() as tx:
            if not runs.add_once(tx, study):
                raise ConflictError("There is a study with this id.", field="study", got=study.id)
            runs.add(tx, version, link)
            audit(tx, owner, "create study", study.id, title=config.title)
        return self.summary(study.id)

    def check(self, config: StudyConfig) -> None:
        """Refuse a study that this face model cannot run, or that sends people where this server does not.

        Raises:
            InvalidError: names what does not fit.
        """
        try:
            rig = self.journal.rig_of(config)
        except NotFoundError as error:
            raise InvalidError(error.message, field="identities", got=error.got) from error
        require_fit(rig, config)
        check_redirects(config, self.journal.redirect_hosts)

    def demo(self, status: str = "recruiting", owner: str | None = None) -> StudySummary:
        """Store the demonstration study, on the heads that this face model has."""
        config = self._demo()
        try:
            return self.create(config, status, study_id=DEMO_ID, owner=owner)
        except ConflictError:
            return self.create(config, status, owner=owner)

    def with_head(self, head: dict[str, Any], *, children: bool, owner: str | None = None) -> StudySummary:
        """Make a draft of the demonstration's kind with one head.

        Args:
            head: its document.
            children: whether the study may show children's heads.
            owner: the user who makes it.

        Raises:
            InvalidError: the head is a child's, and children's heads are not allowed.
        """
        # The head's name is for those who work here: participants read the title.
        changes = {"title": DEMO.title, "children": children, "identities": (head,)}
        return self.create(DEMO.model_copy(update=changes), "draft", owner=owner)

    def prepare(self) -> None:
        """Have the heads of the studies that people may join fitted in the background."""
        with self.journal.database.read() as tx:
            open_ = [study.id for study in studies.all_studies(tx) if study.status in OPEN]
            versions = [studies.latest_version(tx, study_id) for study_id in open_]
        for version in filter(None, versions):
            self.journal.wardrobe.prepare(parsed(version))

    def ensure_one(self) -> StudySummary | None:
        """Store the demonstration study when there is no study at all; of several processes that start, one does."""
        with self.journal.database.read() as tx:
            empty = not studies.all_studies(tx)
        with suppress(ConflictError):
            return self.create(self._demo(), study_id=DEMO_ID) if empty else None
        return None

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
                raise NoStudyError(study_id)
            return _summary(tx, study)

    def _demo(self) -> StudyConfig:
        known = tuple(name for name in DEMO.heads if name in self.journal.rig.identities)
        return DEMO.model_copy(update={"identities": known or self.journal.rig.identities[:1]})


def _summary(tx: Tx, study: Study) -> StudySummary:
    version = studies.latest_version(tx, study.id)
    emotions = parsed(version).emotions if version else ()
    return StudySummary(
        study.id,
        study.title,
        study.status,
        tuple(emotion.noun for emotion in emotions),
        tuple(link.id for link in studies.links(tx, study.id)),
        version.config_hash if version else "",
        *studies.counts(tx, study.id, now()),
    )
