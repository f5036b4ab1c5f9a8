"""Attention checks: a sentence that asks for one of several answers."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from ..config import Attention
from .fields import Field
from .items import RESPONSE, Items

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ...store.runs_tables import Trial
    from .fields import Value
    from .walk import Walk

ASKED = "answer"


class _Attention(Items):
    KIND: ClassVar[str] = "attention"
    ANSWERS: ClassVar[Mapping[str, frozenset[str]]] = {"attention": RESPONSE}

    def fields(self, walk: Walk, trial: Trial) -> Sequence[Field]:
        block = walk.block(trial, Attention)
        return (Field(ASKED, "single", block.text, block.options),)

    def expected(self, walk: Walk, trial: Trial) -> dict[str, list[Value]]:
        return {ASKED: [walk.block(trial, Attention).right]}

    def ended(self, walk: Walk, trial: Trial, values: Mapping[str, list[Value]]) -> str | None:
        block = walk.block(trial, Attention)
        failed = values[ASKED] != [block.right]
        return "failed_checks" if failed and block.failing == "end" else None


ATTENTION = _Attention()
