"""The steps of a participation: what comes next, and the state that the page is told. Works inside a transaction."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..store import runs
from .clock import new_code, now
from .errors import ConflictError, RenewedError
from .evolution import Sketch, settings_of, unpack_weights

if TYPE_CHECKING:
    from emogen_core.search import State

    from ..store.engine import Tx
    from ..store.runs_tables import Face, Participation, Trial
    from .config import Outcome, StudyConfig
    from .evolution import Evolution

ATTEMPTS = 50


@dataclass
class Walk:
    """One participation inside one transaction; `offered` collects the faces that must be drawn afterwards."""

    tx: Tx
    participation: Participation
    config: StudyConfig
    evolution: Evolution
    offered: list[Face] = field(default_factory=list)

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

    def enter(self, position: int) -> None:
        """Go to the trial at a position, or to the end when there is none."""
        self.participation.position = position
        trial = self.trial_at(position)
        if trial is None:
            self.finish("complete", step="debrief")
            return
        self.participation.step = "practice" if trial.practice else "evolve"
        trial.started_at = now()
        self.offer(trial, self.evolution.begin(trial, 0))

    def offer(self, trial: Trial, state: State) -> None:
        """Put the ten faces of a search state on the screen.

        Raises:
            ConflictError: the face model was exchanged since this participation began.
        """
        self.check_rig()
        generation, faces = self.evolution.offer(trial, state)
        runs.add(self.tx, generation)
        runs.add_all(self.tx, faces)
        trial.attempt, trial.generation = state.attempt, state.generation
        trial.state = self.evolution.dump(state)
        self.offered.extend(faces)

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

    def finish(self, outcome: Outcome | str, step: str = "ended") -> None:
        """End the participation with an outcome, and with the code that the study has for it."""
        participation = self.participation
        codes: dict[Any, str] = dict(self.config.completion.codes)
        participation.step, participation.outcome, participation.ended_at = step, outcome, now()
        participation.completion_code = codes.get(outcome) or (new_code() if outcome == "complete" else None)

    def last_generation(self, trial: Trial) -> int:
        """Return the generation whose best face ends the trial: the first one already when practising."""
        return 0 if trial.practice else self.config.generations

    def may_reset(self, trial: Trial) -> bool:
        """Return whether this face may be started again now."""
        reset = self.config.search.reset
        if trial.practice or reset == "off" or trial.attempt >= ATTEMPTS:
            return False
        return trial.generation > 0 or reset == "redraw"

    def bounds(self, trial: Trial) -> tuple[int, int]:
        """Return the least and the most faces that may be chosen now; only the best matters in the last generation."""
        final = trial.generation >= self.last_generation(trial)
        return (1 if final else self.config.minimum), self.config.maximum

    def state(self) -> dict[str, Any]:
        """Return the current step as the page is told it: docs/participant-interface.md.

        Raises:
            RenewedError: the faces of this step cannot be drawn any more.
        """
        step = self.participation.step
        if step in {"practice", "evolve"}:
            self.check_rig()
        told: dict[str, Any] = {
            "step": step,
            "study": {
                "title": self.config.title,
                "surround": self.config.surround,
                "language": self.config.language,
            },
            "progress": self._progress(),
        }
        if step in {"practice", "evolve"}:
            told["trial"] = self._trial_state(self.trial())
        elif step == "rating":
            told["rating"] = self._rating_state(self.trial())
        elif step in {"debrief", "ended"}:
            told["completion"] = self._completion()
        return told

    def _progress(self) -> dict[str, int]:
        practised = 1 if self.config.practice else 0
        trials = len(self.participation.trial_order)
        reached = self.participation.position - practised + 1
        begun = self.participation.step not in {"consent", "instructions"}
        return {"trial": min(max(reached, 0), trials) if begun else 0, "trials": trials}

    def _trial_state(self, trial: Trial) -> dict[str, Any]:
        last = self.last_generation(trial)
        minimum, maximum = self.bounds(trial)
        return {
            "id": trial.id,
            "kind": trial.kind,
            "practice": trial.practice,
            "emotion": trial.emotion,
            "noun": self.config.emotion(trial.emotion).noun,
            "generation": trial.generation,
            "generations": last,
            "attempt": trial.attempt,
            "minimum": minimum,
            "maximum": maximum,
            "final": trial.generation >= last,
            "reset": self.may_reset(trial),
            "faces": [
                {"id": face.id, "place": face.place, "portrait": portrait_address(face.portrait_key)}
                for face in runs.faces_on_screen(self.tx, trial)
            ],
        }

    def _rating_state(self, trial: Trial) -> dict[str, Any]:
        face = runs.face(self.tx, trial.final_face_id or "")
        return {
            "trial": trial.id,
            "portrait": portrait_address(face.portrait_key) if face else None,
            "emotion": trial.emotion,
            "noun": self.config.emotion(trial.emotion).noun,
            "questions": list(self.config.ratings),
        }

    def _completion(self) -> dict[str, Any]:
        participation = self.participation
        redirects: dict[Any, str] = dict(self.config.completion.redirects)
        return {
            "outcome": participation.outcome,
            "code": participation.completion_code,
            "redirect": redirects.get(participation.outcome),
            "withdrawal_code": None if participation.erased_at else participation.withdrawal_code,
        }


def portrait_address(key: str) -> str:
    """Return where a portrait is served."""
    return f"/portraits/{key}.png"
