"""Algorithm 1: one expression after the other, each the most important one of what is left.

``greedy`` is the order as published. Its number of expressions may be one more than needed, so in ``minimal`` the most
important expression is sought among those that leave a remainder which fits into the fewest expressions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.transfer.packing.solver import fewest, heaviest, heaviest_leaving

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from emogen_core.transfer.packing.importance import Importance
    from emogen_core.transfer.packing.units import Units

    Weights = NDArray[np.float64]
    Rows = NDArray[np.bool_]
    Expressions = list[tuple[int, ...]]


def greedy(units: Units, importance: Importance) -> Expressions:
    """Return the units of every expression, most important expressions first (Algorithm 1)."""
    return _in_turn(units, importance, lambda weights, rows, _: heaviest(weights, rows))


def minimal(units: Units, importance: Importance, count: int) -> Expressions:
    """Return the units of every expression: ``count`` expressions, `fewest` or more, most important ones first."""

    def choose(weights: Weights, rows: Rows, before: int) -> NDArray[np.intp]:
        """Return the most important units that leave a rest which fits."""
        others = count - before - 1
        best = heaviest(weights, rows)
        rest = np.delete(rows, best, axis=1)
        # Most often the best one will do, and that is quick to see.
        fits = not rest.shape[1] or fewest(rest) <= others
        return best if fits else heaviest_leaving(weights, rows, others)

    return _in_turn(units, importance, choose)


def _in_turn(
    units: Units, importance: Importance, choose: Callable[[Weights, Rows, int], NDArray[np.intp]]
) -> Expressions:
    left, made = np.arange(len(units.members)), list[tuple[int, ...]]()
    while len(left):
        chosen = left[choose(_weights(units, importance, left, made), units.rows[:, left], len(made))]
        assert len(chosen), "one unit alone is always an expression"
        made.append(tuple(chosen.tolist()))
        left = np.setdiff1d(left, chosen)
    return made


def _weights(units: Units, importance: Importance, left: NDArray[np.intp], made: Expressions) -> Weights:
    """Return the importance of the units that are left; 0 where a unit has to wait for one that it holds."""
    shown = units.shapes([unit for one in made for unit in one])
    values = importance.of(units.shapes(left.tolist()), shown)
    waits = [bool(set(units.holds[unit]) & set(left.tolist())) for unit in left]
    return np.where(waits, 0, [values[[*units.members[unit]]].sum() for unit in left])
