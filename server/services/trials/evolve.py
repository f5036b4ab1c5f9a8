"""The evolve trial: ten faces, a choice, the next ten; at the end, questions about the finished face."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from ...store import runs
from ...store.runs_tables import ChoiceRecord, Rating
from ..clock import new_id, now
from ..errors import InvalidError
from .answer_bodies import ChoiceAnswer, RatingAnswer, ResetAnswer
from .fields import POINTS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from emogen_core.search import State

    from ...store.runs_tables import Face, Generation, Trial
    from ..config import StudyConfig
    from .answer_bodies import AnswerBody
    from .base import Later
    from .walk import Walk

ATTEMPTS = 50


class _Evolve:
    KIND: ClassVar[str] = "evolve"
    ANSWERS: ClassVar[Mapping[str, frozenset[str]]] = {
        "practice": frozenset({"choice", "reset"}),
        "evolve": frozenset({"choice", "reset"}),
        "rating": frozenset({"rating"}),
    }
    WRITES: ClassVar[tuple[str, ...]] = ("generations", "faces", "choices", "estimates", "events", "ratings")

    def enter(self, walk: Walk, trial: Trial) -> bool:
        walk.participation.step = "practice" if trial.practice else "evolve"
        trial.started_at = now()
        _offer(walk, trial, walk.evolution.begin(trial, 0))
        return True

    def state(self, walk: Walk, trial: Trial) -> dict[str, Any]:
        if walk.participation.step == "rating":
            return {"rating": _rating_state(walk, trial)}
        return {"trial": _trial_state(walk, trial)}

    def take(self, walk: Walk, trial: Trial, body: AnswerBody) -> None:
        _check_step(walk, trial, body)
        match body:
            case ChoiceAnswer():
                _choice(walk, trial, body)
            case ResetAnswer():
                _reset(walk, trial)
            case RatingAnswer():
                _rating(walk, trial, body)

    def rehearsed(self, walk: Walk, trial: Trial, body: AnswerBody | None) -> Later | None:
        following = _beginning(walk, trial, 0) if body is None else _following(walk, trial, body)
        return None if following is None else lambda: walk.evolution.asked(trial, following())

    def concluded(self, walk: Walk, trial: Trial, body: AnswerBody) -> Later | None:
        told = _telling(walk, trial, body) if _final(walk, trial) else None
        return None if told is None else lambda: walk.evolution.estimated(trial, told())

    def played(self, told: Mapping[str, Any]) -> dict[str, Any]:
        rating = told["rating"]
        values = dict.fromkeys(rating["questions"], (POINTS + 1) // 2)
        return {"kind": "rating", "trial": rating["trial"], "values": values}


EVOLVE = _Evolve()


def last_generation(config: StudyConfig, trial: Trial) -> int:
    """Return the generation whose best face ends the trial, as far as that is known: the first one when practising."""
    if trial.practice:
        return 0
    return config.generations if trial.last_generation is None else trial.last_generation


def may_end_early(config: StudyConfig) -> bool:
    """Return whether trials of a study may end before its last generation."""
    return config.search.stop_at is not None and config.search.least_generations < config.generations


def _offer(walk: Walk, trial: Trial, state: State) -> None:
    """Put the ten faces of a search state on the screen."""
    walk.check_rig()
    generation, faces = walk.evolution.offer(trial, state)
    runs.add(walk.tx, generation)
    runs.add_all(walk.tx, faces)
    trial.attempt, trial.generation = state.attempt, state.generation
    trial.last_generation = walk.evolution.last_early(trial, state)
    trial.state = walk.evolution.dump(state)
    walk.offered.extend(faces)


def _trial_state(walk: Walk, trial: Trial) -> dict[str, Any]:
    last = last_generation(walk.config, trial)
    minimum, maximum = _bounds(walk, trial)
    return {
        "id": trial.id,
        "kind": trial.kind,
        "practice": trial.practice,
        "emotion": trial.emotion,
        "noun": walk.config.emotion(trial.emotion).noun,
        "generation": trial.generation,
        "generations": last,
        "open": may_end_early(walk.config) and not _final(walk, trial),
        "attempt": trial.attempt,
        "minimum": minimum,
        "maximum": maximum,
        "final": _final(walk, trial),
        "reset": _may_reset(walk, trial),
        "none_is_close": walk.config.none_is_close,
        "pause_ms": walk.config.pause_ms,
        "faces": [
            {"id": face.id, "place": face.place, "portrait": walk.portrait(face.portrait_key)}
            for face in runs.faces_on_screen(walk.tx, trial)
        ],
    }


def _rating_state(walk: Walk, trial: Trial) -> dict[str, Any]:
    face = runs.face(walk.tx, trial.final_face_id or "")
    return {
        "trial": trial.id,
        "portrait": walk.portrait(face.portrait_key) if face else None,
        "emotion": trial.emotion,
        "noun": walk.config.emotion(trial.emotion).noun,
        "questions": list(walk.config.ratings),
    }


def _check_step(walk: Walk, trial: Trial, body: AnswerBody) -> None:
    if not isinstance(body, (ChoiceAnswer, ResetAnswer)):
        return
    for name, current, got in (
        ("attempt", trial.attempt, body.attempt),
        ("generation", trial.generation, body.generation),
    ):
        if current != got:
            walk.stale(name, current, got)


def _bounds(walk: Walk, trial: Trial) -> tuple[int, int]:
    """Return the least and the most faces that may be chosen now; only the best matters in the last generation."""
    return (1 if _final(walk, trial) else walk.config.minimum), walk.config.maximum


def _may_reset(walk: Walk, trial: Trial) -> bool:
    """Return whether this face may be started again now."""
    reset = walk.config.search.reset
    if trial.practice or reset == "off" or trial.attempt >= ATTEMPTS:
        return False
    return trial.generation > 0 or reset == "redraw"


def _choice(walk: Walk, trial: Trial, body: ChoiceAnswer) -> None:
    walk.check_rig()
    faces = {face.id: face for face in runs.faces_on_screen(walk.tx, trial)}
    _check_choice(_bounds(walk, trial), faces, body)
    elite = faces[body.elite]
    runs.add(walk.tx, _record(elite.generation_id, body, none_is_close=_none_is_close(walk, body)))
    slots = [faces[face].slot for face in body.selected]
    state = walk.evolution.tell(trial, slots, elite.slot)
    if not _final(walk, trial):
        _offer(walk, trial, state)
        return
    estimate = walk.evolution.estimate(trial, state)
    if estimate is not None:
        runs.add(walk.tx, estimate)
    trial.final_face_id, trial.ended_at = elite.id, now()
    trial.state = None  # the next ten faces would be made of it; what led here is in the rows of faces and choices
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


def _none_is_close(walk: Walk, body: ChoiceAnswer) -> bool | None:
    """Return whether it was said that none comes close; None where the study does not ask."""
    if walk.config.none_is_close:
        return bool(body.none_is_close)
    if body.none_is_close is not None:
        raise InvalidError(
            "This study does not ask whether none of the faces is close.",
            field="none_is_close",
            expected="nothing",
            got=body.none_is_close,
        )
    return None


def _record(generation_id: str, body: ChoiceAnswer, *, none_is_close: bool | None) -> ChoiceRecord:
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
        none_is_close=none_is_close,
        **body.timing.model_dump(),
    )


def _reset(walk: Walk, trial: Trial) -> None:
    if not _may_reset(walk, trial):
        raise InvalidError("This face cannot be started again now.", field="kind", got="reset")
    _current_generation(walk, trial).discarded_at = now()
    _offer(walk, trial, walk.evolution.begin(trial, trial.attempt + 1))


def _current_generation(walk: Walk, trial: Trial) -> Generation:
    found = runs.generation_of(walk.tx, trial.id, trial.attempt, trial.generation)
    if found is None:
        raise InvalidError("This generation is not there.")
    return found


def _rating(walk: Walk, trial: Trial, body: RatingAnswer) -> None:
    asked = set(walk.config.ratings)
    if set(body.values) != asked:
        raise InvalidError(
            "Answer every question.",
            field="values",
            expected=", ".join(sorted(asked)),
            got=", ".join(sorted(body.values)) or "nothing",
        )
    arrived = now()
    rows = [
        Rating(trial_id=trial.id, question=name, value=value, arrived_at=arrived) for name, value in body.values.items()
    ]
    runs.add_all(walk.tx, rows)
    walk.enter(trial.position + 1)


def _following(walk: Walk, trial: Trial, body: AnswerBody) -> Callable[[], State] | None:
    """Return what works out the state that an answer leads to within this trial, if it does."""
    if isinstance(body, ResetAnswer):
        return _beginning(walk, trial, trial.attempt + 1) if _current(trial, body) else None
    return None if _final(walk, trial) else _telling(walk, trial, body)


def _beginning(walk: Walk, trial: Trial, attempt: int) -> Callable[[], State]:
    return lambda: walk.evolution.begin(trial, attempt)


def _telling(walk: Walk, trial: Trial, body: AnswerBody) -> Callable[[], State] | None:
    """Return what works out the state after a choice among the faces on the screen; None for all else."""
    if not isinstance(body, ChoiceAnswer) or not _current(trial, body):
        return None
    slots = {face.id: face.slot for face in runs.faces_on_screen(walk.tx, trial)}
    if body.elite not in slots or not set(body.selected) <= set(slots):
        return None
    selected, elite = [slots[face] for face in body.selected], slots[body.elite]
    return lambda: walk.evolution.tell(trial, selected, elite)


def _current(trial: Trial, body: ChoiceAnswer | ResetAnswer) -> bool:
    return trial.ended_at is None and (trial.attempt, trial.generation) == (body.attempt, body.generation)


def _final(walk: Walk, trial: Trial) -> bool:
    return trial.generation >= last_generation(walk.config, trial)
