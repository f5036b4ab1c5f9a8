"""Corrects what an answer will put on the screen, or store, before its write transaction begins.

Separating lips and teeth takes milliseconds a face, and a search that learns, or looking through the faces of
everybody, takes more: too long to keep other writers waiting. So the step is taken once without storing anything: a
read transaction looks up what it needs, and when that is over the search is told and asked and faces are corrected.
The write transaction takes it again and finds all that remembered. If another answer was quicker, the rehearsal was
for nothing and the write transaction works for itself.
"""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Any

from emogen_core.errors import EmogenError

from ..trials import type_of
from ..trials.answer_bodies import InstructionsAnswer, trial_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np
    from numpy.typing import NDArray

    from ..trials.answer_bodies import AnswerBody
    from ..trials.base import Later
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
        needed = _following(walk, body) if participation.rig_hash == walk.evolution.rig.hash else []
    for identity, genes in _worked_out(needed):
        journal.wardrobe.wait(identity)
        with suppress(EmogenError):
            walk.evolution.correction.faces(identity, [genes])
    return walk.ahead


def _following(walk: Walk, body: AnswerBody) -> list[Later]:
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
        if faces is not None:
            return [faces]
        ended = kind.concluded(walk, trial, body)
        return [*([ended] if ended else []), *_first(walk, position + 1)]
    except EmogenError:
        return []


def _first(walk: Walk, position: int) -> list[Later]:
    trial = walk.trial_at(position)
    faces = None if trial is None else type_of(trial).rehearsed(walk, trial, None)
    return [] if faces is None else [faces]


def _worked_out(needed: list[Later]) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Yield head and genes of faces, but for what cannot be worked out."""
    for faces in needed:
        with suppress(EmogenError):
            yield from faces()
