"""Shapes that are worn as one, and what forbids two such units in one expression."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.transfer.packing.poseability import Rules


@dataclass(frozen=True, eq=False)
class Units:
    """What the solver chooses from.

    Attributes:
        members: unit -> its shapes, ascending; every shape is in one unit (eq. 3d).
        holds: unit -> units that are worn with it.
        rows: (R, U): of the units in a row, an expression has one at most (eq. 3b), and no row could have more units.
    """

    members: tuple[tuple[int, ...], ...]
    holds: tuple[tuple[int, ...], ...]
    rows: NDArray[np.bool_]

    def shapes(self, units: Sequence[int]) -> list[int]:
        """Return the shapes of some units, unit by unit."""
        return [shape for unit in units for shape in self.members[unit]]


def make_units(active: NDArray[np.bool_], rules: Rules) -> Units:
    """Return the units of (K, N) binary shapes under some rules.

    Partners may share vertices: both are worn anyway, so together they count once. A unit that holds others needs the
    room of these, too.
    """
    label = _labels(len(active), rules)
    members = tuple(tuple(np.flatnonzero(label == unit).tolist()) for unit in range(label.max() + 1))
    holds: list[set[int]] = [set() for _ in members]
    for shape, held in rules.holds.items():
        holds[label[shape]].add(int(label[held]))
    room = np.array([active[[*shapes]].any(0) for shapes in members])
    room = np.array([room[[unit, *sorted(held)]].any(0) for unit, held in enumerate(holds)])
    apart = np.zeros((len(rules.apart), len(members)), bool)
    for row, pair in zip(apart, rules.apart, strict=True):
        row[label[list(pair)]] = True
    return Units(members, tuple(tuple(sorted(held)) for held in holds), full_rows(np.vstack([room.T, apart])))


def full_rows(rows: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return few (R, U) rows that forbid what all of the given ones forbid together.

    Three units of which any two are in a row may as well be in one: without that, half of each would fit into an
    expression, and the solver would have to try what it can now see.
    """
    merged = merged_rows(rows)
    apart = conflicts(merged)
    for row in merged:
        free = apart[row].all(0)
        while free.any():
            unit = free.argmax()
            row[unit] = True
            free &= apart[unit]
    return merged_rows(merged)


def conflicts(rows: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which of (U, U) units are in a row together, and so never in an expression."""
    counts = rows.astype(np.float32)
    together: NDArray[np.bool_] = counts.T @ counts > 0
    np.fill_diagonal(together, False)
    return together


def merged_rows(rows: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the (R, U) rows that are left when none is there twice, and none within another."""
    packed = np.unique(np.packbits(rows[rows.sum(1) > 1], axis=1), axis=0)
    distinct = np.unpackbits(packed, axis=1, count=rows.shape[1]).astype(bool)
    common = distinct.astype(np.float32) @ distinct.T.astype(np.float32)
    within = common == np.diag(common)[:, None]
    kept: NDArray[np.bool_] = distinct[within.sum(1) == 1]
    return kept


def _labels(count: int, rules: Rules) -> NDArray[np.intp]:
    """Return the (K,) unit of every shape, in the order of their first shapes."""
    a, b = np.array(rules.together, np.intp).reshape(-1, 2).T
    graph = coo_array((np.ones(len(a)), (a, b)), shape=(count, count))
    _, label = connected_components(graph, directed=False)
    _, first, inverse = np.unique(label, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[inverse].astype(np.intp)
