"""Deleting a study: who may, what goes with it, and that nobody does it by accident."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ...store import removal, roster, studies
from ..errors import ConflictError, ForbiddenError, InvalidError, NoStudyError
from ..participation.joining import OPEN
from ..people.accounts import audit
from ..people.roles import RIGHTS

if TYPE_CHECKING:
    from ...store.engine import Tx
    from ...store.studies_tables import Study
    from ..participation.journal import Journal


@dataclass(frozen=True, slots=True)
class Belongings:
    """What a study has, and would take along."""

    title: str
    open: bool
    people: int
    simulated: int
    faces: int
    links: int


@dataclass(frozen=True)
class Removal:
    """Deletes studies."""

    journal: Journal

    def preview(self, study_id: str, user: str, role: str) -> Belongings:
        """Return what deleting a study would take away.

        Raises:
            NotFoundError: no such study.
            ForbiddenError: it is somebody else's.
        """
        with self.journal.database.read() as tx:
            study = _study(tx, study_id, user, role)
            return Belongings(study.title, study.status in OPEN, *removal.belongings(tx, study_id))

    def delete(self, study_id: str, user: str, role: str, *, typed: str, erase: bool) -> None:
        """Delete a study with everything that belongs to it. Only the audit trail remembers it.

        Args:
            study_id: the study.
            user: who deletes it.
            role: their role: owners may delete every study, experimenters their own.
            typed: its title, typed by whoever means it.
            erase: whether the data of people may go as well.

        Raises:
            NotFoundError: no such study.
            ForbiddenError: it is somebody else's.
            ConflictError: people can join it.
            InvalidError: the title is another one, or there are data of people and they are not to go.
        """
        with self.journal.database.write() as tx:
            study = _study(tx, study_id, user, role, lock=True)
            removal.lock_people(tx, study_id)
            people, simulated, faces, _ = removal.belongings(tx, study_id)
            _check(study, people, typed, erase=erase)
            portraits = removal.portraits_of(tx, study_id)
            audit(
                tx, user, "delete study", study_id, title=study.title, people=people, simulated=simulated, faces=faces
            )
            removal.delete_study(tx, study_id)
            portraits -= roster.named_portraits(tx, portraits)
        self.journal.portraits.discard(portraits)


def _study(tx: Tx, study_id: str, user: str, role: str, *, lock: bool = False) -> Study:
    study = studies.study(tx, study_id, lock=lock)
    if study is None:
        raise NoStudyError(study_id)
    rights = RIGHTS.get(role, frozenset())
    if "rule" not in rights and not ("work" in rights and study.owner_id == user):
        raise ForbiddenError(
            "Only an owner, or the experimenter who made this study, can delete it.", field="role", got=role
        )
    return study


def _check(study: Study, people: int, typed: str, *, erase: bool) -> None:
    if study.status in OPEN:
        raise ConflictError("People can join this study. Close it first.", field="status", got=study.status)
    if " ".join(typed.split()) != " ".join(study.title.split()):
        raise InvalidError("Type the title of the study, exactly as it stands above.", field="title", got=typed[:200])
    if people and not erase:
        raise InvalidError(
            f"This study has data of {people} {'person' if people == 1 else 'people'}. Say that they may be erased.",
            field="erase",
        )
