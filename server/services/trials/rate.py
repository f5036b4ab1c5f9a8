"""Rating: questions about faces, one face at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from ..config import Rate, Scale
from .fields import Field
from .items import RESPONSE
from .judging import Judging

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...store.runs_tables import Trial
    from .walk import Walk


class _Rate(Judging):
    KIND: ClassVar[str] = "rate"
    ANSWERS: ClassVar[Mapping[str, frozenset[str]]] = {"rate": RESPONSE}
    BLOCK = Rate
    TELLS_EMOTION: ClassVar[bool] = True

    def fields(self, walk: Walk, trial: Trial) -> Sequence[Field]:
        return tuple(map(_field, walk.block(trial, Rate).questions))


def _field(question: str | Scale) -> Field:
    if isinstance(question, Scale):
        return Field(question.name, "scale", question.text, low=question.low, high=question.high)
    return Field(question, "scale")


RATE = _Rate()
