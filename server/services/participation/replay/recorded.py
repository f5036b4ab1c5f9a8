"""A participation as it was recorded, and what a replay says of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ....store.runs_tables import ChoiceRecord, Estimate, Face, Generation, Trial
    from ...config import StudyConfig

    Shown = Sequence[tuple[Generation, Sequence[Face], ChoiceRecord | None]]

Extent = Literal["some", "begun", "all"]
"""Which of a person's trials are there: those of some blocks or emotions, all that have begun, or all."""


@dataclass(frozen=True, slots=True)
class Difference:
    """The first place where the record and its replay disagree; empty where it is not about a generation or a slot."""

    participation: str
    trial: str
    attempt: int | None
    generation: int | None
    slot: int | None
    what: str
    expected: str
    got: str


@dataclass(frozen=True, slots=True)
class Replayed:
    """What a replay covered, and the first difference if there is one."""

    generations: int
    difference: Difference | None


@dataclass(frozen=True, slots=True)
class Seat:
    """Where somebody sits in the design.

    Attributes:
        head: the one that they see; empty if it is several.
        row: of the Latin square; None in records of the first release, which did not keep it.
        emotions: those they were asked for, in their order.
    """

    head: str
    row: int | None
    emotions: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Recorded:
    """One participation as it was recorded.

    Attributes:
        participation: its id.
        seed: of the participation, decimal.
        config: the study as it had it, in its condition.
        seat: where it sits in the design; None when it was erased.
        complete: whether it went through to the end.
        extent: which of its trials are here.
        trials: in their order, each with the generations that were shown, in the order of showing, and their choices.
        estimates: by trial, what the search took for the face in mind, where it did.
    """

    participation: str
    seed: str
    config: StudyConfig
    seat: Seat | None
    complete: bool
    extent: Extent
    trials: Sequence[tuple[Trial, Shown]]
    estimates: Mapping[str, Estimate]
