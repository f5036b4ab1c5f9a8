"""Questionnaires: the study's own questions on one page, some of which may end a participation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from ..config import Questionnaire
from .fields import Field
from .items import RESPONSE, Items

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...store.runs_tables import Trial
    from .fields import Value
    from .walk import Walk


class _Questionnaire(Items):
    KIND: ClassVar[str] = "questionnaire"
    ANSWERS: ClassVar[Mapping[str, frozenset[str]]] = {"questionnaire": RESPONSE}

    def fields(self, walk: Walk, trial: Trial) -> Sequence[Field]:
        return tuple(Field(**item.model_dump()) for item in walk.block(trial, Questionnaire).items)

    def told(self, walk: Walk, trial: Trial) -> dict[str, Any]:
        return {"title": walk.block(trial, Questionnaire).title}

    def ended(self, walk: Walk, trial: Trial, values: Mapping[str, list[Value]]) -> str | None:
        for rule in walk.block(trial, Questionnaire).screen_out:
            if any(rule.meets(value) for value in values[rule.item]):
                return "screened_out"
        return None


QUESTIONNAIRE = _Questionnaire()
