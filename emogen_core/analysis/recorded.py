"""Finished faces as plain arrays: what every analysis starts from, wherever they were read."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Words = NDArray[np.str_]


class Cell(NamedTuple):
    """What faces have in common."""

    emotion: str
    identity: str
    condition: str


@dataclass(frozen=True, slots=True, eq=False)
class Faces:
    """Finished faces; every array has one entry a face.

    Attributes:
        people: (n,) who made it; the same word for all faces of one person, whatever the condition.
        emotions, identities, conditions: (n,) what was asked for, on which head, in which condition.
        repetitions: (n,) 0, and 1 for a retest of the same emotion.
        genes: (n, G) in [0, 1].
        weights: (n, K) weights of all shapes.
        ratings: question -> (n,) answers; NaN is no answer.
        elites: for each face the (generations + 1, K) best faces on the way, the finished one last; (0, K) where the
            way is not known. Empty where it is known of no face.
    """

    people: Words
    emotions: Words
    identities: Words
    conditions: Words
    repetitions: NDArray[np.intp]
    genes: Floats
    weights: Floats
    ratings: Mapping[str, Floats] = field(default_factory=dict)
    elites: tuple[Floats, ...] = ()

    def __post_init__(self) -> None:
        """Make arrays of what is given.

        Raises:
            InvalidInputError: arrays of different lengths, faces that are not finite, or ways that end elsewhere.
        """
        for name, kind in _KINDS.items():
            object.__setattr__(self, name, np.asarray(getattr(self, name), kind))
        object.__setattr__(self, "ratings", {name: np.asarray(told, float) for name, told in self.ratings.items()})
        paths = tuple(np.asarray(one, float) for one in self.elites) or (np.zeros((0, self.shapes)),) * len(self)
        object.__setattr__(self, "elites", paths)
        self._check_lengths()
        self._check_faces()

    def __len__(self) -> int:
        """Return how many faces there are."""
        return len(self.people)

    @property
    def shapes(self) -> int:
        """K."""
        return int(self.weights.shape[-1]) if self.weights.ndim else 0

    @property
    def person_count(self) -> int:
        """How many people made them."""
        return len(np.unique(self.people))

    @property
    def cells(self) -> tuple[Cell, ...]:
        """Every emotion, identity and condition that there are faces of, in the order they first appear."""
        told = zip(self.emotions.tolist(), self.identities.tolist(), self.conditions.tolist(), strict=True)
        return tuple(Cell(*one) for one in dict.fromkeys(told))

    def take(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Faces:
        """Return some of the faces, by a (n,) mask or by indices."""
        chosen = np.arange(len(self))[which]
        arrays: dict[str, Any] = {name: getattr(self, name)[chosen] for name in _KINDS}
        ratings = {name: told[chosen] for name, told in self.ratings.items()}
        return Faces(**arrays, ratings=ratings, elites=tuple(self.elites[i] for i in chosen))

    def only(
        self,
        emotion: str | None = None,
        identity: str | None = None,
        condition: str | None = None,
        repetition: int | None = None,
    ) -> Faces:
        """Return the faces of an emotion, identity, condition and repetition; None restricts nothing."""
        keep = np.ones(len(self), bool)
        wanted = (emotion, identity, condition, repetition)
        columns = (self.emotions, self.identities, self.conditions, self.repetitions)
        for value, column in zip(wanted, columns, strict=True):
            if value is not None:
                keep &= column == value
        return self.take(keep)

    def by_cell(self) -> Iterator[tuple[Cell, Faces]]:
        """Yield every cell with its faces."""
        for cell in self.cells:
            yield cell, self.only(*cell)

    def _check_lengths(self) -> None:
        told = {name: getattr(self, name) for name in _KINDS} | dict(self.ratings)
        lengths = {name: len(one) if one.ndim else -1 for name, one in told.items()} | {"elites": len(self.elites)}
        if len(set(lengths.values())) > 1:
            raise InvalidInputError(f"faces: {expected('one entry a face in every array', lengths)}")

    def _check_faces(self) -> None:
        for name in ("genes", "weights"):
            given = getattr(self, name)
            if given.ndim != 2 or not np.isfinite(given).all():
                got = given.shape if given.ndim != 2 else "values that are not"
                raise InvalidInputError(f"{name}: {expected('(n, ...) finite numbers', got)}")
        for path in self.elites:
            if path.ndim != 2 or path.shape[1] != self.shapes or not np.isfinite(path).all():
                raise InvalidInputError(f"elites: {expected(f'(generations + 1, {self.shapes}) finite', path.shape)}")


_KINDS: dict[str, type] = {
    "people": str, "emotions": str, "identities": str, "conditions": str, "repetitions": int, "genes": float,
    "weights": float,
}  # fmt: skip


def joined(*parts: Faces) -> Faces:
    """Return the faces of all parts as one; a question that a part does not have is unanswered there."""
    questions = dict.fromkeys(name for part in parts for name in part.ratings)
    arrays: dict[str, Any] = {name: np.concatenate([getattr(part, name) for part in parts]) for name in _KINDS}
    ratings = {
        name: np.concatenate([part.ratings.get(name, np.full(len(part), np.nan)) for part in parts])
        for name in questions
    }
    return Faces(**arrays, ratings=ratings, elites=tuple(path for part in parts for path in part.elites))


def by_person(values: NDArray[np.floating], people: Words) -> tuple[Words, Floats]:
    """Return everybody, sorted, and the mean of their values: a person counts once, however many faces they made.

    Args:
        values: (n, ...) numbers.
        people: (n,) whose they are.

    Returns:
        (P,) people and (P, ...) means.
    """
    names, share = shares(people)
    return names, np.asarray(np.tensordot(share, np.asarray(values, np.float64), 1))


def shares(people: Words) -> tuple[Words, Floats]:
    """Return (P,) everybody, sorted, and the (P, n) matrix that takes the mean of each person's faces."""
    names, index = np.unique(people, return_inverse=True)
    own = (np.arange(len(names))[:, None] == index).astype(np.float64)
    return names, own / np.maximum(own.sum(1, keepdims=True), 1)
