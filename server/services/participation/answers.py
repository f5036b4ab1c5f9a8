"""An answer moves a participation one step on, exactly once.

Everything happens in one short write transaction that begins with the participation's row: look the answer up by its
id, check that it is for the current step, apply it, store it with the reply. So a repeat gets the stored reply, and of
two racing tabs one wins and the other is told the state to go on from. Faces are corrected before the transaction and
drawn after it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ...store import runs
from ...store.runs_tables import Answer
from ..clock import now
from ..errors import AnswerConflictError
from ..trials import ANSWERS, type_of
from ..trials.answer_bodies import CalibrationAnswer, ConsentAnswer, InstructionsAnswer, trial_of
from .ahead import following
from .devices import tile_height
from .rehearsal import rehearse

if TYPE_CHECKING:
    from ..trials.answer_bodies import AnswerBody
    from ..trials.walk import Walk
    from .journal import Journal

BEFORE = {step: frozenset({step}) for step in ("consent", "calibration", "instructions")}
"""Answers before the first trial, by step."""


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
        ahead = rehearse(self.journal, token, body)
        with self.journal.database.write() as tx:
            participation, config = self.journal.find(tx, token, lock=True)
            stored = runs.answer(tx, participation.id, str(body.id))
            if stored is not None:
                return _repeated(stored, body)
            walk = self.journal.walk(tx, participation, config)
            walk.ahead = ahead
            _check_step(walk, body)
            _apply(walk, body)
            walk.renew_lease()
            tx.flush()
            reply = walk.state()
            runs.add(tx, _answer(walk, body, reply))
            upcoming = following(walk)
        if not participation.simulated:
            self.journal.portraits.after(walk.sketches(), upcoming)
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
    if body.kind not in (BEFORE | ANSWERS).get(step, ()):
        walk.stale("kind", f"an answer to the step {step!r}", body.kind)
    if step in ANSWERS and trial_of(body) != walk.trial().id:
        walk.stale("trial", walk.trial().id, trial_of(body))


def _apply(walk: Walk, body: AnswerBody) -> None:
    match body:
        case ConsentAnswer():
            _consent(walk, body)
        case CalibrationAnswer():
            _calibration(walk, body)
        case InstructionsAnswer():
            walk.enter(0)
        case _:
            trial = walk.trial()
            type_of(trial).take(walk, trial, body)


def _consent(walk: Walk, body: ConsentAnswer) -> None:
    if not body.given:
        walk.participation.device = {}
        walk.finish("no_consent")
        return
    walk.participation.consented_at = now()
    walk.participation.step = "calibration" if walk.config.devices.face_degrees else "instructions"


def _calibration(walk: Walk, body: CalibrationAnswer) -> None:
    """Keep how large the screen is and how far away; where that is not known the faces are as large as they get."""
    measured: dict[str, Any] = {"calibrated": body.px_per_mm is not None}
    degrees = walk.config.devices.face_degrees
    if body.px_per_mm is not None and body.distance_mm is not None and degrees is not None:
        measured["px_per_mm"], measured["distance_mm"] = body.px_per_mm, body.distance_mm
        measured["tile_height"] = tile_height(degrees, body.px_per_mm, body.distance_mm)
    # A new object: what lies inside a JSON column is not watched.
    walk.participation.device = {**walk.participation.device, **measured}
    walk.participation.step = "instructions"


def _answer(walk: Walk, body: AnswerBody, reply: dict[str, Any]) -> Answer:
    return Answer(
        participation_id=walk.participation.id,
        id=str(body.id),
        kind=body.kind,
        body_hash=body.fingerprint(),
        reply=reply,
        arrived_at=now(),
    )
