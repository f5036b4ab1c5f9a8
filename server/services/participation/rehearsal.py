"""Corrects what an answer will put on the screen, or store, before its write transaction begins.

Separating lips and teeth takes milliseconds a face, and looking through the faces of everybody takes more: too long to
keep other writers waiting. So the step is taken once on what a read transaction saw, without storing anything; the
write transaction takes it again and finds the faces remembered, and what was looked up. If another answer was quicker,
the rehearsal was for nothing and the write transaction corrects for itself.
"""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

from emogen_core.errors import EmogenError

from ..trials import type_of
from ..trials.answer_bodies import InstructionsAnswer, trial_of

if TYPE_CHECKING:
    from ..trials.answer_bodies import AnswerBody
    from ..trials.base import Faces
    from ..trials.walk import Walk
    from .journal import Journal


def rehearse(journal: Journal, token: str, body: AnswerBody) -> dict[tuple[str, ...], Any]:
    """Correct the faces that an answer asks for; return what was looked up, for the walk that takes the answer.

    What is wrong with the answer is left to the write transaction to say.

    Raises:
        NotFoundError: unknown token.
        UnavailableError: the head that the faces wear is still being made.
        ConflictError: that head cannot be made.
    """
    with journal.database.read() as tx:
        participation, config = journal.find(tx, token)
        walk = journal.walk(tx, participation, config)
        faces = _following(walk, body) if participation.rig_hash == walk.evolution.rig.hash else []
    for identity, genes in faces:
        journal.wardrobe.wait(identity)
        with suppress(EmogenError):
            walk.evolution.correction.faces(identity, [genes])
    return walk.ahead


def _following(walk: Walk, body: AnswerBody) -> Faces:
    """Return the faces that this answer may need: those of this trial, or else of its end and of the next one."""
    position = walk.participation.position
    if isinstance(body, InstructionsAnswer):
        return _first(walk, 0)
    trial = walk.trial_at(position)
    if trial is None or trial.id != trial_of(body):
        return []
    walk.ending = trial.id
    kind = type_of(trial)
    try:
        faces = kind.rehearsed(walk, trial, body)
        return faces or [*kind.concluded(walk, trial, body), *_first(walk, position + 1)]
    except EmogenError:
        return []


def _first(walk: Walk, position: int) -> Faces:
    trial = walk.trial_at(position)
    return [] if trial is None else type_of(trial).rehearsed(walk, trial, None)
