"""Corrects what an answer will put on the screen before its write transaction begins.

Separating lips and teeth takes milliseconds a face, too long to keep other writers waiting. So the step is taken once
on what a read transaction saw, without storing anything; the write transaction takes it again and finds the faces
remembered. If another answer was quicker, the rehearsal was for nothing and the write transaction corrects for itself.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.errors import EmogenError

from ..store import runs
from .answer_bodies import ChoiceAnswer, InstructionsAnswer, RatingAnswer, ResetAnswer
from .steps import Walk

if TYPE_CHECKING:
    from collections.abc import Callable

    from emogen_core.search import State

    from ..store.runs_tables import Trial
    from .answer_bodies import AnswerBody
    from .journal import Journal

    Next = tuple[Trial, Callable[[], State]]


def rehearse(journal: Journal, token: str, body: AnswerBody) -> None:
    """Correct the faces that an answer asks for; what is wrong with it is left to the write transaction to say.

    Raises:
        NotFoundError: unknown token.
        UnavailableError: the head that the faces wear is still being made.
        ConflictError: that head cannot be made.
    """
    with journal.database.read() as tx:
        participation, config = journal.find(tx, token)
        walk = Walk(tx, participation, config, journal.evolution(config))
        known = participation.rig_hash == journal.rig.hash
        following = _following(walk, body) if known else None
    if following is None:
        return
    trial, state = following
    journal.wardrobe.wait(trial.identity)
    try:
        walk.evolution.correct(trial, state())
    except EmogenError:
        return


def _following(walk: Walk, body: AnswerBody) -> Next | None:
    """Return the trial that will be on the screen and the state it will be in, if this answer changes them."""
    match body:
        case InstructionsAnswer():
            return _first(walk, 0)
        case RatingAnswer():
            return _first(walk, walk.participation.position + 1)
        case ChoiceAnswer() | ResetAnswer():
            trial = walk.trial_at(walk.participation.position)
            shown = (body.trial, body.attempt, body.generation)
            if trial is not None and (trial.id, trial.attempt, trial.generation) == shown:
                return _within(walk, trial, body)
    return None


def _within(walk: Walk, trial: Trial, body: ChoiceAnswer | ResetAnswer) -> Next | None:
    if isinstance(body, ResetAnswer):
        return trial, lambda: walk.evolution.begin(trial, trial.attempt + 1)
    if trial.generation >= walk.last_generation(trial):
        return _first(walk, trial.position + 1)
    slots = {face.id: face.slot for face in runs.faces_on_screen(walk.tx, trial)}
    if body.elite not in slots or not set(body.selected) <= set(slots):
        return None
    selected, elite = [slots[face] for face in body.selected], slots[body.elite]
    return trial, lambda: walk.evolution.tell(trial, selected, elite)


def _first(walk: Walk, position: int) -> Next | None:
    trial = walk.trial_at(position)
    return (trial, lambda: walk.evolution.begin(trial, 0)) if trial is not None else None
