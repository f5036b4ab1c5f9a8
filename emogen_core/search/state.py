"""What a search remembers between two choices, as plain data."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.search.params import Genome, SearchParams

STATE_VERSION = 1


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
    """

    strategy: str
    seed: int
    attempt: int
    generation: int = 0
    previous: tuple[Genome, ...] = ()
    choice: Choice | None = None
    version: int = STATE_VERSION

    def to_json(self) -> dict[str, Any]:
        """Return plain data; floats survive JSON bit for bit, the seed is text since it may exceed 2**53."""
        return {**asdict(self), "seed": str(self.seed)}

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> State:
        """Return the state that `to_json` described.

        Raises:
            InvalidInputError: another version of the record.
        """
        if data.get("version") != STATE_VERSION:
            raise InvalidInputError(f"search state: {expected(f'version {STATE_VERSION}', data.get('version'))}")
        choice = data["choice"]
        return cls(
            strategy=data["strategy"],
            seed=int(data["seed"]),
            attempt=data["attempt"],
            generation=data["generation"],
            previous=tuple(tuple(genome) for genome in data["previous"]),
            choice=choice and Choice(tuple(choice["selected"]), choice["elite"]),
        )


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
