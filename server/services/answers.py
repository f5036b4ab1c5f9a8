"""An answer moves a participation one step on, exactly once.

Everything happens in one short write transaction that begins with the participation's row: look the answer up by its
id, check that it is for the current step, apply it, store it with the reply. So a repeat gets the stored reply, and of
two racing tabs one wins and the other is told the state to go on from. Faces are corrected before the transaction and
drawn after it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..store import runs
from ..store.runs_tables import Answer, ChoiceRecord, Rating
from .answer_bodies import ChoiceAnswer, ConsentAnswer, InstructionsAnswer, RatingAnswer, ResetAnswer
from .clock import new_id, now
from .errors import AnswerConflictError, InvalidError, StaleStepError
from .rehearsal import rehearse
from .steps import Walk

if TYPE_CHECKING:
    from ..store.runs_tables import Face, Generation, Trial
    from .answer_bodies import AnswerBody
    from .journal import Journal

STEPS = {
    "consent": {"consent"},
    "instructions": {"instructions"},
    "choice": {"practice", "evolve"},
    "reset": {"practice", "evolve"},
    "rating": {"rating"},
}


@dataclass(frozen=True)
class Answers:
    """Takes answers."""

    journal: Journal

    def take(self, token: str, body: AnswerBody) -> dict[str, Any]:
        """Take an answer and return the next state.

        Raises:
            NotFoundError: unknown token.
            AnswerConflictError: this id was used for another content.
            StaleStepError: not for the current step.
            InvalidError: not acceptable; nothing was stored.
        """
        rehearse(self.journal, token, body)
        with self.journal.database.write() as tx:
            participation, config = self.journal.find(tx, token, lock=True)
            stored = runs.answer(tx, participation.id, str(body.id))
            if stored is not None:
                return _repeated(stored, body)
            walk = Walk(tx, participation, config, self.journal.evolution(config))
            _check_step(walk, body)
            _apply(walk, body)
            participation.last_answer_at = now()
            tx.flush()
            reply = walk.state()
            runs.add(tx, _answer(walk, body, reply))
            following = self.journal.portraits.following(walk)
        if not participation.simulated:
            self.journal.portraits.after(walk.sketches(), following)
        return reply


def _repeated(stored: Answer, body: AnswerBody) -> dict[str, Any]:
    if stored.body_hash != body.fingerprint():
        raise AnswerConflictError(
            "An answer with this id was stored already, with other content. Reload the page to go on.",
            field="id",
            expected="a new id for a new answer",
            got=str(body.id),
        )
    return stored.reply


def _check_step(walk: Walk, body: AnswerBody) -> None:
    step = walk.participation.step
    if step not in STEPS[body.kind]:
        _stale(walk, "kind", f"an answer to the step {step!r}", body.kind)
    if isinstance(body, (ChoiceAnswer, ResetAnswer, RatingAnswer)):
        _check_trial(walk, body)


def _check_trial(walk: Walk, body: ChoiceAnswer | ResetAnswer | RatingAnswer) -> None:
    trial = walk.trial()
    if body.trial != trial.id:
        _stale(walk, "trial", trial.id, body.trial)
    if isinstance(body, RatingAnswer):
        return
    for name, current, got in (
        ("attempt", trial.attempt, body.attempt),
        ("generation", trial.generation, body.generation),
    ):
        if current != got:
            _stale(walk, name, current, got)


def _stale(walk: Walk, name: str, wanted: object, got: object) -> None:
    raise StaleStepError(
        "This answer is not for the current step; another page may have been quicker. Go on from the state given here.",
        state=walk.state(),
        field=name,
        expected=wanted,
        got=got,
    )


def _apply(walk: Walk, body: AnswerBody) -> None:
    match body:
        case ConsentAnswer():
            _consent(walk, body)
        case InstructionsAnswer():
            walk.enter(0)
        case ChoiceAnswer():
            _choice(walk, body)
        case ResetAnswer():
            _reset(walk)
        case RatingAnswer():
            _rating(walk, body)


def _consent(walk: Walk, body: ConsentAnswer) -> None:
    if not body.given:
        walk.finish("no_consent")
        return
    walk.participation.consented_at = now()
    walk.participation.step = "instructions"


def _choice(walk: Walk, body: ChoiceAnswer) -> None:
    walk.check_rig()
    trial = walk.trial()
    faces = {face.id: face for face in runs.faces_on_screen(walk.tx, trial)}
    _check_choice(walk.bounds(trial), faces, body)
    elite = faces[body.elite]
    runs.add(walk.tx, _record(elite.generation_id, body))
    if trial.generation < walk.last_generation(trial):
        slots = [faces[face].slot for face in body.selected]
        walk.offer(trial, walk.evolution.tell(trial, slots, elite.slot))
        return
    trial.final_face_id, trial.ended_at = elite.id, now()
    if walk.config.ratings and not trial.practice:
        walk.participation.step = "rating"
    else:
        walk.enter(trial.position + 1)


def _check_choice(bounds: tuple[int, int], faces: dict[str, Face], body: ChoiceAnswer) -> None:
    unknown = [face for face in body.selected if face not in faces]
    if unknown:
        raise InvalidError(
            "One of the chosen faces is not on the screen. Reload the page.",
            field="selected",
            expected="faces of this generation",
            got=unknown[0],
        )
    if len(set(body.selected)) != len(body.selected):
        raise InvalidError("A face was chosen twice.", field="selected", expected="different faces")
    minimum, maximum = bounds
    if not minimum <= len(body.selected) <= maximum:
        raise InvalidError(
            f"Choose {minimum} to {maximum} faces.",
            field="selected",
            expected=f"{minimum} to {maximum} faces",
            got=len(body.selected),
        )
    if body.elite not in body.selected:
        raise InvalidError(
            "The best face must be one of those chosen.",
            field="elite",
            expected="one of the selected faces",
            got=body.elite,
        )


def _record(generation_id: str, body: ChoiceAnswer) -> ChoiceRecord:
    viewport = body.client.viewport or (None, None)
    tile = body.client.tile or (None, None)
    return ChoiceRecord(
        id=new_id(),
        generation_id=generation_id,
        selected=list(body.selected),
        elite_face_id=body.elite,
        arrived_at=now(),
        viewport_width=viewport[0],
        viewport_height=viewport[1],
        tile_width=tile[0],
        tile_height=tile[1],
        pixel_ratio=body.client.pixel_ratio,
        input=body.client.input,
        **body.timing.model_dump(),
    )


def _reset(walk: Walk) -> None:
    trial = walk.trial()
    if not walk.may_reset(trial):
        raise InvalidError("This face cannot be started again now.", field="kind", got="reset")
    _current_generation(walk, trial).discarded_at = now()
    walk.offer(trial, walk.evolution.begin(trial, trial.attempt + 1))


def _current_generation(walk: Walk, trial: Trial) -> Generation:
    found = runs.generation_of(walk.tx, trial.id, trial.attempt, trial.generation)
    if found is None:
        raise InvalidError("This generation is not there.")
    return found


def _rating(walk: Walk, body: RatingAnswer) -> None:
    asked = set(walk.config.ratings)
    if set(body.values) != asked:
        raise InvalidError(
            "Answer every question.",
            field="values",
            expected=", ".join(sorted(asked)),
            got=", ".join(sorted(body.values)) or "nothing",
        )
    arrived = now()
    runs.add_all(
        walk.tx,
        [
            Rating(trial_id=body.trial, question=question, value=value, arrived_at=arrived)
            for question, value in body.values.items()
        ],
    )
    walk.enter(walk.participation.position + 1)


def _answer(walk: Walk, body: AnswerBody, reply: dict[str, Any]) -> Answer:
    return Answer(
        participation_id=walk.participation.id,
        id=str(body.id),
        kind=body.kind,
        body_hash=body.fingerprint(),
        reply=reply,
        arrived_at=now(),
    )
