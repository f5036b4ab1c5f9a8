"""Which participations changed after which others: a counter for each study, set in whatever transaction writes.

The last thing that a write does before it commits is to raise the counter of the study and to write it into every
participation whose rows it changed. The row of the counter stays locked until the commit, so that revisions are
committed in their order, on PostgreSQL as well as on SQLite: whoever sees revision n sees everything up to n, and what
comes later has a higher one. Participations are locked first and counters in the order of their studies, so that two
writes never wait for each other in a circle. Previews are not data and leave no mark.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sqlalchemy import event, select, update
from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from .export_tables import StudyRevision
from .runs_tables import (
    ChoiceRecord,
    Estimate,
    Event,
    Face,
    Generation,
    Participation,
    Rating,
    Response,
    Stimulus,
    Trial,
)

if TYPE_CHECKING:
    from sqlalchemy.orm import sessionmaker

EXPORTED = (Participation, Trial, Generation, Face, ChoiceRecord, Estimate, Event, Rating, Stimulus, Response)
_CHANGED = "changed rows"


def count_revisions(writing: sessionmaker[Session]) -> None:
    """Let every transaction of these sessions leave its mark on what it changes.

    Rows that a statement changes without loading them leave none: whoever writes such a statement changes the
    participation itself as well.
    """
    event.listen(writing, "after_flush", _collect)
    event.listen(writing, "before_commit", _mark)


def revision(tx: Session, study_id: str) -> int:
    """Return the revision that a study is at; 0 before the first change."""
    return tx.scalar(select(StudyRevision.revision).where(StudyRevision.study_id == study_id)) or 0


def _collect(tx: Session, _context: object) -> None:
    changed: set[tuple[str, str]] = tx.info.setdefault(_CHANGED, set())
    rows = [*tx.new, *tx.deleted, *(row for row in tx.dirty if tx.is_modified(row))]
    changed.update(_belongs_to(row) for row in rows if isinstance(row, EXPORTED))


def _belongs_to(row: Any) -> tuple[str, str]:
    """Return what a row hangs on: participation, trial or generation, and its id."""
    if isinstance(row, Participation):
        return "participation", row.id
    for name in ("participation", "trial", "generation"):
        found = getattr(row, f"{name}_id", None)
        if found is not None:
            return name, found
    raise AssertionError(row)


def _mark(tx: Session) -> None:
    if tx.in_nested_transaction():
        return
    tx.flush()
    changed = tx.info.pop(_CHANGED, None)
    if not changed:
        return
    found = select(Participation.study_id, Participation.id).where(
        Participation.id.in_(_participations(tx, changed)), Participation.preview.is_(False)
    )
    studies: dict[str, list[str]] = {}
    for study, participation in tx.execute(found.order_by(Participation.id).with_for_update()).all():
        studies.setdefault(study, []).append(participation)
    for study, ids in sorted(studies.items()):
        tx.execute(
            update(Participation).where(Participation.id.in_(ids)).values(revision=_raised(tx, study)),
            execution_options={"synchronize_session": False},
        )


def _participations(tx: Session, changed: set[tuple[str, str]]) -> set[str]:
    ids: dict[str, set[str]] = {"participation": set(), "trial": set(), "generation": set()}
    for kind, found in changed:
        ids[kind].add(found)
    if ids["generation"]:
        ids["trial"].update(tx.scalars(select(Generation.trial_id).where(Generation.id.in_(ids["generation"]))))
    if ids["trial"]:
        query = select(Trial.participation_id).where(Trial.id.in_(ids["trial"]))
        ids["participation"].update(tx.scalars(query))
    return ids["participation"]


def _raised(tx: Session, study: str) -> int:
    """Raise the counter of a study by one and keep it until the commit."""
    raised = (
        update(StudyRevision)
        .where(StudyRevision.study_id == study)
        .values(revision=StudyRevision.revision + 1)
        .returning(StudyRevision.revision)
        .execution_options(synchronize_session=False)
    )
    found = tx.scalar(raised)
    if found is None:
        _begun(tx, study)
        found = tx.scalar(raised)
    assert found is not None
    return found


def _begun(tx: Session, study: str) -> None:
    try:
        with tx.begin_nested():
            tx.add(StudyRevision(study_id=study, revision=0))
    except IntegrityError:
        pass  # Another transaction was quicker.
