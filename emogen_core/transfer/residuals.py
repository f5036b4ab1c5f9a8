"""What training expressions show beyond a first guess, given to the shapes that are worn in them.

An expression is the sum of the shapes worn in it, so what it differs by from the sum of the guesses (its residual) has
to be shared out. A prior says how: that a shape is wrong by about a share of what it moves. At each vertex this is a
ridge regression, which has the residual shared by the square of what shapes move there, and met but for scan noise.

Where shapes overlap that alone cannot tell whose a residual is. But a person smiles wider all over, not vertex by
vertex: the error of a shape is mostly a gain ``g(v)``, and a turn ``u(v)`` in proportion to what it moves, both smooth:

    error_k(v) = g_k(v) b_k(v) + |b_k(v)| u_k(v) + rest_k(v)

So the shares are smoothed into such fields, the fields become the guess, and the residual is shared out again, a few
times (a block-wise fit of the additive model; Hastie & Tibshirani 1990, section 4.4); the rest takes what is left.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse.csgraph import connected_components

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]
    Indices = NDArray[np.intp]

NOISE = 0.005
"""Standard deviation of the positions of an expression, millimetres, at which it is not followed any closer."""
# Of a shape's error, in units of what it moves.
_SPREAD = 0.35
# Where no shape moves, what is seen is shared evenly: millimetres.
_FLOOR = 0.02
_ROUNDS = 2
# Millimetres: nobody sees a micrometre.
_STILL = 1e-3


@dataclass(frozen=True, eq=False)
class Evidence:
    """Training expressions as offsets.

    Attributes:
        weights: (E, K).
        shown: (E, N, 3) expression minus neutral.
    """

    weights: Mesh
    shown: Mesh


def with_ridge(guess: Mesh, evidence: Evidence, noise: float = NOISE) -> Mesh:
    """Return (K, N, 3) guesses corrected by a ridge regression at each vertex.

    Args:
        guess: (K, N, 3) the shapes as they are thought to be.
        evidence: expressions.
        noise: millimetres, above 0; as it goes to 0, expressions are reproduced.
    """
    found = guess.copy()
    for where, part in _parts(guess, evidence, noise):
        found[where] = part.met(part.guess).swapaxes(0, 1)
    return found


def with_fields(guess: Mesh, evidence: Evidence, shares: Mesh, noise: float = NOISE) -> Mesh:
    """Return (K, N, 3) guesses corrected by smooth gains and turns, and by a ridge for what these leave.

    Args:
        guess: (K, N, 3) the shapes as they are thought to be.
        evidence: expressions.
        shares: (N, M) smooth functions that sum to 1 at every vertex.
        noise: millimetres, above 0; as it goes to 0, expressions are reproduced.
    """
    found = guess.copy()
    for where, part in _parts(guess, evidence, noise):
        near = shares[where[1][0]]
        smooth = part.guess
        for _ in range(_ROUNDS):
            smooth = part.guess + part.fields(part.met(smooth) - part.guess, near)
        found[where] = part.met(smooth).swapaxes(0, 1)
    return found


def _parts(guess: Mesh, evidence: Evidence, noise: float) -> Iterator[tuple[tuple[Indices, ...], _Part]]:
    """Yield shapes that are explained together, with the vertices at which there is anything, and how."""
    for rows, shapes in _groups(evidence.weights):
        moved = (np.abs(guess[shapes]) > _STILL).any((0, 2)) | (np.abs(evidence.shown[rows]) > _STILL).any((0, 2))
        vertices = np.flatnonzero(moved)
        where, seen = np.ix_(shapes, vertices), evidence.shown[np.ix_(rows, vertices)]
        yield where, _Part(guess[where], evidence.weights[np.ix_(rows, shapes)], seen, noise)


def _groups(weights: Mesh) -> Iterator[tuple[Indices, Indices]]:
    """Yield expressions that have shapes in common, directly or by others, with all their shapes."""
    worn = (weights > 0).astype(np.intp)
    count, label = connected_components(worn @ worn.T, directed=False) if len(worn) else (0, np.zeros(0))
    for group in range(count):
        rows = np.flatnonzero(label == group)
        yield rows, np.flatnonzero(worn[rows].any(0))


class _Part:
    """Expressions (E, N, 3) that are explained together, and the shapes (K, N, 3) that are worn in them.

    Inside, vertices come first: (N, K, 3), so that smoothing is one product of matrices.
    """

    def __init__(self, guess: Mesh, weights: Mesh, shown: Mesh, noise: float) -> None:
        self.guess, self.weights, self.shown = guess.swapaxes(0, 1).copy(), weights, shown.swapaxes(0, 1)
        self.length = np.linalg.norm(self.guess, axis=2, keepdims=True)
        self._variance = self.length**2 + _FLOOR**2
        ridge = (noise / _SPREAD) ** 2 * np.eye(len(weights))
        self._inverse = np.linalg.inv((weights * self._variance.swapaxes(1, 2)) @ weights.T + ridge)

    def met(self, shapes: Mesh) -> Mesh:
        """Return (N, K, 3) shapes changed so that their sums become the expressions."""
        residual = self.shown - self.weights @ shapes
        changed: Mesh = shapes + self._variance * (self.weights.T @ (self._inverse @ residual))
        return changed

    def fields(self, change: Mesh, shares: Mesh) -> Mesh:
        """Return (N, K, 3) changes as smooth gains and smooth turns of the guesses."""
        weight = shares.T @ self.length[:, :, 0] ** 2
        stretched = _smooth((change * self.guess).sum(2, keepdims=True), weight, shares) * self.guess
        turned: Mesh = stretched + _smooth((change - stretched) * self.length, weight, shares) * self.length
        return turned


def _smooth(values: Mesh, weight: Mesh, shares: Mesh) -> Mesh:
    """Return (N, K, c) values, sums over (M, K) weights, as a smooth field of means."""
    heaps = (shares.T @ values.reshape(len(values), -1)).reshape(*weight.shape, -1)
    means = heaps / np.maximum(weight, np.finfo(np.float64).tiny)[:, :, None]
    field: Mesh = (shares @ means.reshape(len(means), -1)).reshape(values.shape)
    return field
