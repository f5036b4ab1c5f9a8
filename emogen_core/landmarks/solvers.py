"""Every method behind one interface: motions of points in, the weights of a basis out.

A basis is what a method adds up: the examples of a bank, or the genes of the rig. It knows what any weights look like,
so whoever blends regions or measures errors need not know which method it was.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.landmarks.genetic import evolve
from emogen_core.landmarks.least_squares import nonnegative
from emogen_core.landmarks.rig_fit import solve_genes

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from emogen_core.landmarks.bank import Bank
    from emogen_core.landmarks.head import DrivenHead
    from emogen_core.landmarks.motions import Motions

    Floats = NDArray[np.float64]
    Weigh = Callable[[Floats, Floats, np.random.Generator], Floats]

METHODS = ("ga-line", "ga-midpoint", "ga-blx", "nnls", "nnls-weighted", "rig")
_CROSSOVERS = {"ga-line": "line", "ga-midpoint": "midpoint", "ga-blx": "blx"}


class Solver(Protocol):
    """Finds an expression whose feature points move as wanted."""

    def solve(self, motions: Motions, rng: np.random.Generator) -> Floats:
        """Return the (n,) weights of the basis for motions of which at least one is not zero."""
        ...

    def surface(self, weights: Floats) -> Floats:
        """Return how far (n,) weights move every vertex: (N, 3) millimetres."""
        ...

    def core(self, weights: Floats) -> Floats:
        """Return the (C,) weights of the rig's core shapes that (n,) weights stand for; not yet within [0, 1]."""
        ...


def make_solver(method: str, head: DrivenHead, bank: Bank | None) -> Solver:
    """Return the solver of a method on a head; the bank is what all methods but ``rig`` add up.

    Raises:
        InvalidInputError: an unknown method, or one that needs a bank and has none.
    """
    if method not in METHODS:
        raise InvalidInputError(f"method: {expected(f'one of {list(METHODS)}', method)}")
    if method == "rig":
        return _OnGenes(head)
    if bank is None:
        raise InvalidInputError(f"bank: {expected(f'examples for {method}', 'none')}")
    if method in _CROSSOVERS:
        crossover = _CROSSOVERS[method]
        return _OnBank(bank, lambda examples, target, rng: evolve(examples, target, crossover, rng), still=False)
    weighted = method == "nnls-weighted"
    return _OnBank(bank, lambda examples, target, _: nonnegative(examples, target, weighted=weighted), still=True)


@dataclass(frozen=True, eq=False)
class _OnBank:
    """Adds up examples; ``still`` tells whether points that do not move count as well."""

    bank: Bank
    weigh: Weigh
    still: bool

    def solve(self, motions: Motions, rng: np.random.Generator) -> Floats:
        """Return the (E,) weights of the examples."""
        kept = np.ones(len(motions.rows), bool) if self.still else motions.moving
        return self.weigh(self.bank.motions[:, motions.rows[kept]], motions.vectors[kept], rng)

    def surface(self, weights: Floats) -> Floats:
        """Return the (N, 3) displacements of these weights."""
        return np.tensordot(weights.astype(np.float32), self.bank.surfaces, 1).astype(np.float64)

    def core(self, weights: Floats) -> Floats:
        """Return the (C,) core weights."""
        core: Floats = weights @ self.bank.core
        return core


@dataclass(frozen=True, eq=False)
class _OnGenes:
    """Sets genes; the weights are a genome."""

    head: DrivenHead

    def solve(self, motions: Motions, rng: np.random.Generator) -> Floats:  # noqa: ARG002 - draws nothing
        """Return the (G,) genes."""
        return solve_genes(self.head, motions)

    def surface(self, weights: Floats) -> Floats:
        """Return the (N, 3) displacements of these genes."""
        return self.head.surface(self.head.face(self.core(weights)))

    def core(self, weights: Floats) -> Floats:
        """Return the (C,) core weights."""
        core: Floats = weights @ self.head.rig.gene_to_core
        return core
