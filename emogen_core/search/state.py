"""What a search remembers between two choices, as plain data."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.search.params import Genome, SearchParams

STATE_VERSION = 1
LEARNING = ("earlier", "sample")
"""Fields that are in a record only if they hold something: those of strategies that learn from every choice."""


@dataclass(frozen=True, slots=True)
class Choice:
    """The slots (from 1) of the faces that a participant selected, the elite among them."""

    selected: tuple[int, ...]
    elite: int

    @property
    def others(self) -> tuple[int, ...]:
        """The selected slots without the elite, in rising order whatever the order of the clicks."""
        return tuple(sorted(set(self.selected) - {self.elite}))


@dataclass(frozen=True, slots=True)
class Answer:
    """A choice and the genomes of the ten faces on which it was made."""

    genomes: tuple[Genome, ...]
    choice: Choice


@dataclass(frozen=True, slots=True)
class Population:
    """Ten faces: (10, G) genes, and for each slot where it comes from and the slots of its parents."""

    genes: NDArray[np.float64]
    origins: tuple[str, ...]
    parents: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True)
class State:
    """Where a search stands: it has been told `generation` choices in this attempt.

    Attributes:
        strategy: name in the registry.
        seed: entropy of the trial.
        attempt: how often the trial was started again.
        generation: the generation that `ask` gives next, from 0.
        previous: genomes of the generation before, on which `choice` was made; empty at generation 0.
        choice: the last choice.
        version: of this record.
        earlier: the answers before `choice`, for strategies that learn from all of them; else empty.
        sample: what such a strategy believes after `choice`, in rows of numbers as it lays them out; else empty.
    """

    strategy: str
    seed: int
    attempt: int
    generation: int = 0
    previous: tuple[Genome, ...] = ()
    choice: Choice | None = None
    version: int = STATE_VERSION
    earlier: tuple[Answer, ...] = ()
    sample: tuple[Genome, ...] = ()

    @property
    def answers(self) -> tuple[Answer, ...]:
        """All answers of this attempt that the state keeps, the last one last."""
        return self.earlier if self.choice is None else (*self.earlier, Answer(self.previous, self.choice))

    def to_json(self) -> dict[str, Any]:
        """Return plain data; floats survive JSON bit for bit, the seed is text since it may exceed 2**53."""
        # Not by asdict, which copies every number of a long record.
        told = {name: getattr(self, name) for name in self.__slots__ if name not in LEARNING} | {"seed": str(self.seed)}
        told["choice"] = self.choice and asdict(self.choice)
        if self.earlier:
            told["earlier"] = [{"genomes": one.genomes, "choice": asdict(one.choice)} for one in self.earlier]
        return told | ({"sample": self.sample} if self.sample else {})

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> State:
        """Return the state that `to_json` described.

        Raises:
            InvalidInputError: another version of the record.
        """
        if data.get("version") != STATE_VERSION:
            raise InvalidInputError(f"search state: {expected(f'version {STATE_VERSION}', data.get('version'))}")
        return cls(
            strategy=data["strategy"],
            seed=int(data["seed"]),
            attempt=data["attempt"],
            generation=data["generation"],
            previous=_genomes(data["previous"]),
            choice=data["choice"] and _choice(data["choice"]),
            earlier=tuple(Answer(_genomes(one["genomes"]), _choice(one["choice"])) for one in data.get("earlier", ())),
            sample=_genomes(data.get("sample", ())),
        )


def _genomes(rows: Iterable[Sequence[float]]) -> tuple[Genome, ...]:
    return tuple(tuple(row) for row in rows)


def _choice(data: Mapping[str, Any]) -> Choice:
    return Choice(tuple(data["selected"]), data["elite"])


def checked_choice(params: SearchParams, choice: Choice, count: int) -> Choice:
    """Return the choice, or raise `InvalidInputError` where the study does not allow it."""
    selected = choice.selected
    if len(set(selected)) != len(selected) or not all(1 <= slot <= count for slot in selected):
        raise InvalidInputError(f"selected: {expected(f'different slots from 1 to {count}', selected)}")
    if not params.minimum <= len(selected) <= params.maximum:
        wanted = f"{params.minimum} to {params.maximum} faces"
        raise InvalidInputError(f"selected: {expected(wanted, len(selected))}")
    if choice.elite not in selected:
        raise InvalidInputError(f"elite: {expected(f'one of the selected slots {selected}', choice.elite)}")
    return choice
