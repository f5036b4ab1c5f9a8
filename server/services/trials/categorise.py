"""Categorising: what a face expresses, how strongly, and how sure the participant is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from ...store import runs
from ..config import Categorise
from .fields import Field
from .items import RESPONSE
from .judging import Judging

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...store.runs_tables import Trial
    from .fields import Value
    from .walk import Walk

LABEL, NONE = "label", "none_of_these"


class _Categorise(Judging):
    KIND: ClassVar[str] = "categorise"
    ANSWERS: ClassVar[Mapping[str, frozenset[str]]] = {"categorise": RESPONSE}
    BLOCK = Categorise
    TELLS_EMOTION: ClassVar[bool] = False

    def fields(self, walk: Walk, trial: Trial) -> Sequence[Field]:
        block = walk.block(trial, Categorise)
        asked = [Field(LABEL, "single", options=labels(walk, block))]
        asked += [Field("intensity", "scale", required=False)] if block.intensity else []
        asked += [Field("confidence", "scale")] if block.confidence else []
        return asked

    def expected(self, walk: Walk, trial: Trial) -> dict[str, list[Value]]:
        meant = runs.stimuli(walk.tx, trial.id)[trial.generation].emotion
        return {LABEL: [meant]} if meant in labels(walk, walk.block(trial, Categorise)) else {}

    def told(self, walk: Walk, trial: Trial) -> dict[str, Any]:
        # Labels of the study's own are shown as they are written, emotions by their nouns.
        own = walk.block(trial, Categorise).labels
        return {"labels": {} if own else {one.adjective: one.model_dump() for one in walk.config.emotions}}


def labels(walk: Walk, block: Categorise) -> tuple[str, ...]:
    """Return the words to choose from."""
    words = block.labels or tuple(emotion.adjective for emotion in walk.config.emotions)
    return (*words, NONE) if block.none_of_these else words


CATEGORISE = _Categorise()
