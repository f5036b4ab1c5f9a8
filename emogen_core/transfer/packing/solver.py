"""Exact answers by integer programming (HiGHS): the heaviest expression, and the fewest expressions.

All questions are about units ``0 .. U - 1`` and (R, U) rows: of the units in a row, an expression has one at most. The
fewest expressions are the chromatic number of the graph that joins units which share a row. The model is that of
asymmetric representatives (Campêlo, Campos & Corrêa, Discrete Applied Mathematics 156, 2008,
doi:10.1016/j.dam.2007.05.058): an expression is named after one of its units, so that no two solutions differ in the
order of expressions alone::

    x[i, j] = 1: unit j is in the expression that is named after i, which comes before j in a fixed order or is j
    sum_i x[i, j] = 1  for every j,        sum_{j in row} x[i, j] <= x[i, i]  for every i and row
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import block_array, csr_array, eye_array

from emogen_core.transfer.packing.units import conflicts

if TYPE_CHECKING:
    from numpy.typing import NDArray

_WHOLE = 1e-6


def heaviest(weights: NDArray[np.float64], rows: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Return the units of the expression with the greatest sum of weights (eqs. 3a to 3c).

    Args:
        weights: (U,), above 0 for the units that may be in the expression, 0 for the others.
        rows: (R, U).
    """
    constraint = LinearConstraint(csr_array(rows.astype(float)), -np.inf, 1)
    return np.flatnonzero(_solved(-weights, weights > 0, constraint))


def fewest(rows: NDArray[np.bool_]) -> int:
    """Return the least number of expressions that show all units, proven."""
    names = _names(rows)
    units, apart = rows.shape[1], names.apart.shape[0]
    constraint = LinearConstraint(
        csr_array(block_array([[names.shown], [names.apart]])),
        np.concatenate([np.ones(units), np.full(apart, -np.inf)]),
        np.concatenate([np.ones(units), np.zeros(apart)]),
    )
    return int(_solved(names.own, np.ones(len(names.own)), constraint)[names.own > 0].sum())


def heaviest_leaving(weights: NDArray[np.float64], rows: NDArray[np.bool_], count: int) -> NDArray[np.intp]:
    """Return the heaviest expression that leaves the other units to no more than some expressions.

    Args:
        weights: (U,), above 0 for the units that may be in the expression, 0 for the others.
        rows: (R, U).
        count: how many expressions are left; there must be such an expression.
    """
    names = _names(rows)
    units, apart, pairs = rows.shape[1], names.apart.shape[0], len(names.own)
    blocks: list[list[Any]] = [
        [names.shown, eye_array(units)],
        [names.apart, None],
        [None, csr_array(rows.astype(float))],
        [csr_array(names.own[None]), None],
    ]
    constraint = LinearConstraint(
        csr_array(block_array(blocks)),
        np.concatenate([np.ones(units), np.full(apart + len(rows) + 1, -np.inf)]),
        np.concatenate([np.ones(units), np.zeros(apart), np.ones(len(rows)), [count]]),
    )
    cost, most = np.zeros(pairs + units), np.ones(pairs + units)
    cost[pairs:], most[pairs:] = -weights, weights > 0
    return np.flatnonzero(_solved(cost, most, constraint)[pairs:])


@dataclass(frozen=True, slots=True, eq=False)
class _Names:
    """The model's variables, one for each ``x[i, j]`` that no row forbids, and what they have to keep.

    Attributes:
        own: (variables,) 1 where ``i`` is ``j``: their sum is the number of expressions.
        shown: (U, variables): sums up all ``i`` of a ``j``, to be 1.
        apart: (U * R, variables): what a row has in an expression, less the expression itself; to be 0 at most.
    """

    own: NDArray[np.float64]
    shown: csr_array
    apart: csr_array


def _names(rows: NDArray[np.bool_]) -> _Names:
    count, units = rows.shape
    apart = conflicts(rows)
    # Units that forbid most come first: they need names of their own, which settles most of the question.
    place = np.argsort(np.argsort(-apart.sum(1), kind="stable"))
    i, j = np.nonzero(~apart & (place[:, None] <= place))
    own, variable = (i == j).astype(float), np.arange(len(i))
    row, at = np.nonzero(rows[:, j])
    less = np.arange(count * units)
    entries = np.concatenate([np.ones(len(at)), -np.ones(len(less))])
    where = np.concatenate([row * units + i[at], less]), np.concatenate([at, np.tile(variable[i == j], count)])
    return _Names(
        own,
        csr_array((np.ones(len(j)), (j, variable)), shape=(units, len(j))),
        csr_array((entries, where), shape=(count * units, len(j))),
    )


def _solved(cost: NDArray[np.float64], most: NDArray[Any], constraint: LinearConstraint) -> NDArray[np.bool_]:
    """Return which variables are 1 where the cost is least; ``most`` is 0 for those that must not be.

    Most often the best fractions are whole, which is found in a fifth of the time.
    """
    for whole in (np.zeros(len(cost), int), np.ones(len(cost), int)):
        # Without the option HiGHS is content with an answer one part in ten thousand short of the best.
        answer: Any = milp(
            cost, integrality=whole, bounds=Bounds(0, most), constraints=constraint, options={"mip_rel_gap": 0}
        )
        assert answer.status == 0, answer.message
        if np.abs(answer.x - answer.x.round()).max() < _WHOLE:
            break
    chosen: NDArray[np.bool_] = answer.x > 0.5
    return chosen
