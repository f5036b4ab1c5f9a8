"""Heads of which the true shapes are known, made from a rig: what transfer is measured on.

A head is another one of the rig's identities, bent by a warp of space that no method uses (a sum of plane waves). Its
shapes are the rig's, carried through that warp; then each gets a gain of its own from U(.7, 1.3), and at every vertex a
quarter of its length is added in another direction, which changes smoothly over the head and is another for each shape.
So a method can foresee the warp, learn the rest from expressions, and know nothing of shapes that are in none.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator
    from numpy.typing import NDArray

    Mesh = NDArray[np.float64]

GAINS = (0.7, 1.3)
TURN = 0.25
SEEN = 0.1
"""Millimetres from which on a vertex counts as moving."""
_BENT = 6.0  # millimetres, times a standard normal direction
_BENDS = (150.0, 400.0)  # wavelengths of the warp, millimetres
_TURNS = (80.0, 200.0)  # and of the changes of direction


@dataclass(frozen=True, slots=True)
class Waves:
    """A smooth vector field: a sum of plane waves.

    Attributes:
        number: (W, 3) wave vectors, radians a millimetre.
        phase: (W,) radians.
        strength: (W, 3).
    """

    number: Mesh
    phase: Mesh
    strength: Mesh

    @classmethod
    def drawn(cls, rng: Generator, count: int, lengths: tuple[float, float]) -> Waves:
        """Return waves of random directions, of wavelengths in a range, of variance 1/2 an axis in all."""
        heading = rng.normal(size=(count, 3))
        heading /= np.linalg.norm(heading, axis=1, keepdims=True)
        number = 2 * np.pi * heading / rng.uniform(*lengths, (count, 1))
        return cls(number, rng.uniform(0, 2 * np.pi, count), rng.normal(size=(count, 3)) / np.sqrt(count))

    def at(self, points: Mesh) -> Mesh:
        """Return the (..., 3) field at (..., 3) points."""
        field: Mesh = np.sin(points @ self.number.T + self.phase) @ self.strength
        return field


def synthetic_head(identity: Mesh, offsets: Mesh, rng: Generator) -> tuple[Mesh, Mesh]:
    """Return the neutral (N, 3) and the true offsets (K, N, 3) of a head.

    Args:
        identity: (N, 3) the head that it is made from, millimetres.
        offsets: (K, N, 3) the shapes.
        rng: decides on everything else.
    """
    waves = Waves.drawn(rng, 6, _BENDS)
    neutral = identity + _BENT * waves.at(identity)
    true = np.empty(offsets.shape)
    for one, moved in zip(true, offsets, strict=True):
        carried = moved + _BENT * (waves.at(identity + moved) - waves.at(identity))
        heading = Waves.drawn(rng, 4, _TURNS).at(identity)
        heading /= np.linalg.norm(heading, axis=1, keepdims=True)
        length = np.linalg.norm(carried, axis=1, keepdims=True)
        one[:] = rng.uniform(*GAINS) * (carried + TURN * length * heading)
    return neutral, true


def errors(found: Mesh, true: Mesh) -> tuple[float, float]:
    """Return the mean and the greatest distance of (K, N, 3) offsets from the truth where that moves, millimetres."""
    away = np.linalg.norm(found - true, axis=2)[np.linalg.norm(true, axis=2) > SEEN]
    return float(away.mean()), float(away.max())
