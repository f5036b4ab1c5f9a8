"""The steps of a participation: what comes next, and the state that the page is told. Works inside a transaction."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import timedelta
from typing import TYPE_CHECKING, Any, NoReturn, Protocol, TypeVar

from ...store import runs
from ..clock import new_code, now
from ..config.way_back import way_back
from ..errors import ConflictError, RenewedError, StaleStepError
from ..faces.sketch import Sketch, settings_of, unpack_weights
from . import ANSWERS, type_of

if TYPE_CHECKING:
    from ...store.engine import Tx
    from ...store.runs_tables import Participation, Trial
    from ..config import Block, Outcome, StudyConfig
    from .evolution import Evolution

    AnyBlock = TypeVar("AnyBlock", bound=Block)


class Drawable(Protocol):
    """A row that has a portrait."""

    portrait_key: str
    identity: str
    weights: bytes


@dataclass
class Walk:
    """One participation inside one transaction; `offered` collects what must be drawn afterwards.

    `config` is the study as this participation has it: in its condition. `ahead` holds what was looked up while an
    answer was rehearsed, and `ending` the trial that the rehearsed answer may end.
    """

    tx: Tx
    participation: Participation
    config: StudyConfig
    evolution: Evolution
    redirect_hosts: tuple[str, ...] = ()
    offered: list[Drawable] = field(default_factory=list)
    ahead: dict[tuple[str, ...], Any] = field(default_factory=dict)
    ending: str | None = None

    def trial(self) -> Trial:
        """Return the trial that the participation is at.

        Raises:
            ConflictError: it is at none.
        """
        found = self.trial_at(self.participation.position)
        if found is None:
            raise ConflictError("This participation is at no trial.")
        return found

    def trial_at(self, position: int) -> Trial | None:
        """Return the trial at a position, if there is one."""
        return runs.trial_at(self.tx, self.participation.id, position)

    def block(self, trial: Trial, kind: type[AnyBlock]) -> AnyBlock:
        """Return the block of a trial, which is of this kind."""
        found = next(block for block in self.config.steps if block.name == trial.block)
        assert isinstance(found, kind)
        return found

    def enter(self, position: int) -> None:
        """Go to the trial at a position, past those in which there is nothing to do; to the end when none is left."""
        while (trial := self.trial_at(position)) is not None:
            self.participation.position = position
            if type_of(trial).enter(self, trial):
                return
            position += 1
        self.participation.position = position
        self.finish("complete", step="debrief")

    def check_rig(self) -> None:
        """Refuse to go on with another face model than the one that this participation began with.

        Raises:
            RenewedError: it was exchanged.
        """
        if self.participation.rig_hash != self.evolution.rig.hash:
            raise RenewedError(
                "The faces of this study were renewed while you took part, so it cannot go on. "
                "Your answers are kept; please tell whoever invited you.",
                field="rig",
                expected=self.participation.rig_hash,
                got=self.evolution.rig.hash,
            )

    def sketches(self) -> list[tuple[str, Sketch]]:
        """Return the faces that were offered, ready to be drawn."""
        settings = settings_of(self.config)
        return [
            (face.portrait_key, Sketch(face.identity, unpack_weights(face.weights), settings)) for face in self.offered
        ]

    def renew_lease(self) -> None:
        """Keep the place for as long as the study says from now on."""
        self.participation.last_answer_at = now()
        self.participation.lease_until = now() + timedelta(minutes=self.config.lease_minutes)

    def finish(self, outcome: Outcome | str, step: str = "ended") -> None:
        """End the participation with an outcome, and with the code that the study has for it."""
        participation = self.participation
        codes: dict[Any, str] = dict(self.config.completion.codes)
        participation.step, participation.outcome, participation.ended_at = step, outcome, now()
        participation.completion_code = codes.get(outcome) or (new_code() if outcome == "complete" else None)

    def stale(self, name: str, wanted: object, got: object) -> NoReturn:
        """Refuse an answer to another step than the one that is on the screen."""
        raise StaleStepError(
            "This answer is not for the current step; another page may have been quicker. "
            "Go on from the state given here.",
            state=self.state(),
            field=name,
            expected=wanted,
            got=got,
        )

    def state(self) -> dict[str, Any]:
        """Return the current step as the page is told it: docs/participant-interface.md.

        Raises:
            RenewedError: the faces of this step cannot be drawn any more.
        """
        step = self.participation.step
        if step in {"practice", "evolve", "rate", "categorise"}:
            self.check_rig()
        told: dict[str, Any] = {
            "step": step,
            "study": {
                "title": self.config.title,
                "surround": self.config.surround,
                "language": self.participation.language,
                "tile_height": self.participation.device.get("tile_height"),
            },
            "progress": self._progress(),
        }
        if step == "calibration":
            told["calibration"] = {"degrees": self.config.devices.face_degrees}
        elif step in ANSWERS:
            told |= type_of(self.trial()).state(self, self.trial())
        elif step in {"debrief", "ended"}:
            told["completion"] = self._completion()
        return told

    def portrait(self, key: str) -> str:
        """Return where a portrait is served."""
        return f"/portraits/{key}.png"

    def _progress(self) -> dict[str, int]:
        trials = len(self.participation.trial_order)
        begun = self.participation.step not in {"consent", "calibration", "instructions"}
        reached = runs.faces_reached(self.tx, self.participation) if begun else 0
        return {"trial": min(reached, trials), "trials": trials}

    def _completion(self) -> dict[str, Any]:
        participation = self.participation
        outcome, code = participation.outcome, participation.completion_code
        return {
            "outcome": outcome,
            "code": code,
            "redirect": way_back(self.config, outcome, code, participation.recruiter, self.redirect_hosts),
            "withdrawal_code": None if participation.erased_at else participation.withdrawal_code,
        }
