"""Who is compared with whom: groups of different people, or the same people in several conditions."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np

from emogen_core.analysis.cells import lengths
from emogen_core.analysis.distances import unit
from emogen_core.analysis.recorded import by_person
from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]

Design = Literal["between", "within"]
"""Different people in every group, or the same people in all of them."""


@dataclass(frozen=True, slots=True, eq=False)
class Groups:
    """Values of people in groups.

    Attributes:
        design: whether groups share people.
        values: (N, ...) one row for each person of each group.
        places: for each group the (n,) rows of its people; within people, row i of every group is of the same person.
        left_out: people of a mixed design who are not in all groups, and so count in none.
    """

    design: Design
    values: Floats
    places: tuple[Places, ...]
    left_out: int

    @property
    def sizes(self) -> tuple[int, ...]:
        """How many people each group has."""
        return tuple(map(len, self.places))

    @property
    def pairs(self) -> tuple[tuple[int, int], ...]:
        """Every two groups."""
        return tuple(combinations(range(len(self.places)), 2))

    def of(self, group: int) -> Floats:
        """Return the (n, ...) values of a group."""
        return np.asarray(self.values[self.places[group]])

    def replaced(self, values: Floats) -> Groups:
        """Return the same people with other (N, ...) values."""
        return Groups(self.design, values, self.places, self.left_out)


def grouped(values: Sequence[NDArray[np.floating]], people: Sequence[NDArray[np.str_]]) -> Groups:
    """Return people in groups; the design follows from who is where.

    If nobody is in two groups the design is between people. Otherwise it is within people: those who are in all groups
    are compared with themselves, all others are left out.

    Args:
        values: for each of at least two groups (n, ...) values.
        people: for each group the (n,) people; everybody counts once in a group, by their mean.

    Raises:
        InvalidInputError: fewer than two groups.
    """
    if len(values) < 2:
        raise InvalidInputError(f"groups: {expected('at least two', len(values))}")
    means = [by_person(*one) for one in zip(values, people, strict=True)]
    names = [set(own.tolist()) for own, _ in means]
    together, common = set.union(*names), set.intersection(*names)
    within = sum(map(len, names)) > len(together)
    kept = [mean[np.isin(own, sorted(common))] if within else mean for own, mean in means]
    ends = np.cumsum([0, *map(len, kept)])
    places = tuple(np.arange(begin, end) for begin, end in pairwise(ends))
    left_out = len(together) - len(common) if within else 0
    return Groups("within" if within else "between", np.concatenate(kept), places, left_out)


def intensities(groups: Sequence[Faces]) -> Groups:
    """Return how strong people's faces are: the lengths of their weights."""
    return grouped([lengths(one.weights) for one in groups], [one.people for one in groups])


def ratings(groups: Sequence[Faces], question: str) -> Groups:
    """Return what people answered to a question; who did not answer is left out."""
    told = [one.ratings.get(question, np.full(len(one), np.nan)) for one in groups]
    there = [~np.isnan(one) for one in told]
    answers = [one[which] for one, which in zip(told, there, strict=True)]
    return grouped(answers, [one.people[which] for one, which in zip(groups, there, strict=True)])


def dispersions(groups: Sequence[Faces]) -> Groups:
    """Return how far people's faces are from the mean face of their own group (Anderson 2006, PERMDISP).

    These are cosine distances times n / (n - 1): a mean is the nearer to the faces that it is made of, the fewer they
    are.
    """
    people = grouped([one.weights for one in groups], [one.people for one in groups])
    values = np.zeros(len(people.values))
    for place, size in zip(people.places, people.sizes, strict=True):
        if size:
            own = people.values[place]
            values[place] = (1 - unit(own) @ unit(own.mean(0))) * size / max(size - 1, 1)
    return people.replaced(values)
