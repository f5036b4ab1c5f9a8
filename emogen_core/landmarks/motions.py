"""What is known of an expression: how far some feature points moved, checked before anything is made of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.landmarks.points import NAMES, point_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

FEWEST = 5
"""Points that must be given. Fewer say too little about a face of 55 genes."""
STILL = 0.01
"""A point that moves less, millimetres, is still: it counts in least squares, not in the fitness."""
_LEAST, _MOST = 0.1, 100.0
"""The longest motion of a file in millimetres lies between these; a jaw opens by 35."""


@dataclass(frozen=True, eq=False)
class Motions:
    """Motion vectors of some of the 56 points.

    Attributes:
        rows: (n,) where the points stand in `NAMES`.
        vectors: (n, 3) millimetres; x to the head's left, y up, z out of the face.
    """

    rows: NDArray[np.intp]
    vectors: Floats

    @property
    def lengths(self) -> Floats:
        """(n,) millimetres."""
        with np.errstate(over="ignore"):  # becomes infinite, and is refused
            lengths: Floats = np.linalg.norm(self.vectors, axis=1)
        return lengths

    @property
    def moving(self) -> NDArray[np.bool_]:
        """(n,) whether a point moves: the paper's points with non-zero motion vectors."""
        moving: NDArray[np.bool_] = self.lengths >= STILL
        return moving

    def emphasised(self, level: float) -> Motions:
        """Return all motions times the emphasis level ``c`` of Zhu & Lee (2006, section 5).

        Raises:
            InvalidInputError: a level that is not above 0 or more than 10.
        """
        if not 0 < level <= 10:
            raise InvalidInputError(f"emphasis: {expected('a number above 0, at most 10', level)}")
        return Motions(self.rows, self.vectors * level)

    def among(self, chosen: NDArray[np.bool_]) -> Motions:
        """Return the motions of the points that ``chosen``, (P,), holds."""
        kept = chosen[self.rows]
        return Motions(self.rows[kept], self.vectors[kept])


def make_motions(names: Sequence[str], vectors: Floats) -> Motions:
    """Return checked motions of named points.

    Args:
        names: MPEG-4 names of n points.
        vectors: (n, 3) motions, millimetres.

    Raises:
        InvalidInputError: unknown or doubled names, numbers that are not finite, too few points, or motions longer
            than a face allows.
    """
    rows = point_rows(names)
    given = np.asarray(vectors, np.float64).reshape(-1, 3)
    if len(given) != len(rows):
        raise InvalidInputError(f"motions: {expected(f'one for each of {len(rows)} points', len(given))}")
    check_finite(names, given)
    if len(rows) < FEWEST:
        raise InvalidInputError(f"points: {expected(f'at least {FEWEST} of the {len(NAMES)}', len(rows))}")
    motions = Motions(rows, given)
    far = [name for name, length in zip(names, motions.lengths, strict=True) if length > _MOST]
    if far:
        raise InvalidInputError(
            f"motions: {expected(f'at most {_MOST:g} mm', f'up to {motions.lengths.max():.4g} at {far}')}: points that"
            " leave the face, or another unit than millimetres (--unit)"
        )
    return motions


def check_scale(frames: Sequence[Motions]) -> None:
    """Raise `InvalidInputError` if in none of the frames a point moves, or none so far that these are millimetres."""
    longest = max(float(motions.lengths.max()) for motions in frames)
    if longest == 0:
        raise InvalidInputError(f"motions: {expected('a point that moves', 'only points that are still')}")
    if longest < _LEAST:
        raise InvalidInputError(
            f"motions: {expected('millimetres', f'at most {longest:.3g}')}: if these are metres, say --unit m"
        )


def check_finite(names: Sequence[str], numbers: Floats) -> None:
    """Raise `InvalidInputError` with the names of points whose (n, 3) numbers are not finite."""
    bad = [name for name, row in zip(names, numbers, strict=True) if not np.isfinite(row).all()]
    if bad:
        raise InvalidInputError(f"points: {expected('finite numbers', f'others at {bad}')}")
