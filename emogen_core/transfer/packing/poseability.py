"""What a face can pose (goal 4 of the paper), beyond symmetry.

The paper leaves the rest to an artist. Ours: eyes look the same way, a jaw does not go both ways, and lips that meet on
a dropped jaw need the jaw dropped. All of it is found by geometry; only which shapes turn the eyes has to be told.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.transfer.packing.activity import displacements

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.transfer.packing.symmetry import Mirrored, Pair

# Cosine between the ways that two eyes go, seen from the front, from which on they look the same way.
_SAME_WAY = 0.9
# A shape closes the mouth of a dropped jaw if, where it acts, it takes back so much of the drop and goes against it.
_TAKEN_BACK, _AGAINST = 0.5, -0.9


@dataclass(frozen=True, slots=True)
class Rules:
    """What expressions have to keep, besides that no vertex is active twice.

    Attributes:
        together: shapes that are only worn together.
        apart: shapes that are never worn together.
        holds: shape -> shape that is worn with it, although another expression shows that one alone.
    """

    together: tuple[Pair, ...] = ()
    apart: tuple[Pair, ...] = ()
    holds: Mapping[int, int] = field(default_factory=dict)


def poseable(
    mirrored: Mirrored,
    offsets: NDArray[np.floating],
    active: NDArray[np.bool_],
    neutral: NDArray[np.floating],
    gaze: Sequence[int],
) -> Rules:
    """Return the rules of a face that can be posed.

    Args:
        mirrored: mirror images among the shapes.
        offsets: (K, N, 3) millimetres.
        active: (K, N) binary shapes.
        neutral: (N, 3) of the face model, millimetres.
        gaze: the shapes that turn an eye; mirror images that look sideways turn the eyes against each other.
    """
    eyes = conjugate_gaze(offsets, active, neutral, gaze)
    squints = [pair for pair in mirrored.pairs if set(pair) <= set(gaze) and pair not in eyes]
    return Rules(tuple(eyes), (*mirrored.opposites, *squints), dict(_closers(offsets, active)))


def conjugate_gaze(
    offsets: NDArray[np.floating], active: NDArray[np.bool_], neutral: NDArray[np.floating], gaze: Sequence[int]
) -> list[Pair]:
    """Return which shapes of the two eyes look the same way, lower index first: lids go where the eye looks.

    Args: see `poseable`.
    """
    ways = {k: offsets[k][active[k], :2].mean(0, dtype=np.float64) for k in gaze}
    left = [k for k in gaze if neutral[active[k], 0].mean() > 0]
    right = [k for k in gaze if k not in left]
    cosines = np.array([[_cosine(ways[a], ways[b]) for b in right] for a in left]).reshape(len(left), len(right))
    if not cosines.size:
        return []
    best = enumerate(cosines.argmax(1))
    good = [(a, b) for a, b in best if cosines[:, b].argmax() == a and cosines[a, b] >= _SAME_WAY]
    return [(min(left[a], right[b]), max(left[a], right[b])) for a, b in good]


def _closers(offsets: NDArray[np.floating], active: NDArray[np.bool_]) -> Iterator[Pair]:
    """Yield the shapes that close the mouth of a dropped jaw, each with the one that drops it: the farthest of all."""
    opener = int(displacements(offsets).max(1).argmax())
    for k, where in enumerate(active):
        ours, drop = (offsets[i][where].ravel().astype(np.float64) for i in (k, opener))
        if -(ours @ drop) >= _TAKEN_BACK * (drop @ drop) > 0 and _cosine(ours, drop) <= _AGAINST:
            yield k, opener


def _cosine(a: NDArray[np.floating], b: NDArray[np.floating]) -> float:
    lengths = float(np.linalg.norm(a) * np.linalg.norm(b))
    return float(a @ b) / lengths if lengths else 0.0
