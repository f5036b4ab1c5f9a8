"""Trials that are a row of items, each a page of questions, with or without a face: all but evolve."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar

from ...store import runs
from ...store.runs_tables import Response
from ..clock import now
from ..errors import InvalidError
from .answer_bodies import ResponseAnswer
from .fields import first_answers, values_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...store.runs_tables import Stimulus, Trial
    from .answer_bodies import AnswerBody
    from .base import Later
    from .fields import Field, Value
    from .walk import Walk


RESPONSE = frozenset({"response"})


class Items(ABC):
    """What these trial types share. `Trial.generation` is the item that is on the screen."""

    KIND: ClassVar[str]
    ANSWERS: ClassVar[Mapping[str, frozenset[str]]]
    WRITES: ClassVar[tuple[str, ...]] = ("responses",)

    @abstractmethod
    def fields(self, walk: Walk, trial: Trial) -> Sequence[Field]:
        """Return the questions of every item."""

    def told(self, walk: Walk, trial: Trial) -> dict[str, Any]:  # noqa: ARG002
        """Return what the page is told beside the questions."""
        return {}

    def expected(self, walk: Walk, trial: Trial) -> dict[str, list[Value]]:  # noqa: ARG002
        """Return the right answers, where there are any."""
        return {}

    def ended(self, walk: Walk, trial: Trial, values: Mapping[str, list[Value]]) -> str | None:  # noqa: ARG002
        """Return the outcome that these answers end the participation with, if they do."""
        return None

    def enter(self, walk: Walk, trial: Trial) -> bool:
        """Put the first item on the screen."""
        trial.started_at = now()
        walk.participation.step = self.KIND
        return True

    def state(self, walk: Walk, trial: Trial) -> dict[str, Any]:
        """Return the item on the screen and its questions."""
        shown = runs.stimuli(walk.tx, trial.id)
        face = _at(shown, trial.generation)
        item = {
            "trial": trial.id,
            "block": trial.block,
            "item": trial.generation,
            "items": max(len(shown), 1),
            "portrait": walk.portrait(face.portrait_key) if face else None,
            "questions": [field.plain() for field in self.fields(walk, trial)],
        }
        return {"item": item | self.told(walk, trial)}

    def take(self, walk: Walk, trial: Trial, body: AnswerBody) -> None:
        """Store the answers to an item and go on to the next one."""
        assert isinstance(body, ResponseAnswer)
        if body.item != trial.generation:
            walk.stale("item", trial.generation, body.item)
        values = values_of(self.fields(walk, trial), body.values)
        shown = runs.stimuli(walk.tx, trial.id)
        face = _at(shown, trial.generation)
        runs.add_all(walk.tx, _rows(trial, face, values, self.expected(walk, trial), body))
        outcome = self.ended(walk, trial, values)
        trial.generation += 1
        if outcome is None and trial.generation < len(shown):
            return
        trial.ended_at = now()
        if outcome is None:
            walk.enter(trial.position + 1)
        else:
            walk.finish(outcome)

    def rehearsed(self, walk: Walk, trial: Trial, body: AnswerBody | None) -> Later | None:  # noqa: ARG002
        """Return the faces to correct ahead: none, unless there are faces to be made."""
        return None

    def concluded(self, walk: Walk, trial: Trial, body: AnswerBody) -> Later | None:  # noqa: ARG002
        """Return none: all that is stored was shown."""
        return None

    def played(self, told: Mapping[str, Any]) -> dict[str, Any]:
        """Return an acceptable answer."""
        item = told["item"]
        values = first_answers(item["questions"])
        return {"kind": "response", "trial": item["trial"], "item": item["item"], "values": values}


def _rows(
    trial: Trial,
    face: Stimulus | None,
    values: Mapping[str, list[Value]],
    expected: Mapping[str, list[Value]],
    body: ResponseAnswer,
) -> list[Response]:
    return [
        Response(
            trial_id=trial.id,
            item=trial.generation,
            question=name,
            stimulus_id=face.id if face else None,
            value=value,
            expected=expected.get(name),
            arrived_at=now(),
            onset_ms=body.timing.onset_ms,
            answered_ms=body.timing.chosen_ms,
            hidden_ms=body.timing.hidden_ms,
        )
        for name, value in values.items()
    ]


def _at(shown: Sequence[Stimulus], item: int) -> Stimulus | None:
    if not shown:
        return None
    if item >= len(shown):
        raise InvalidError("This face is not there.", field="item", expected=f"below {len(shown)}", got=item)
    return shown[item]
