"""How somebody searched: measures of one trial over its generations.

Symbols: ``e_0 ... e_G`` the weights of the best faces of the generations, ``d`` the cosine distance, ``t`` the face
that is approached: the finished one, or the mean face of others. Two faces that are the same have distance 0 here,
also where both are neutral, which the metric puts at 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.cells import lengths
from emogen_core.analysis.distances import cosine_matrix
from emogen_core.analysis.enough import Result, too_few
from emogen_core.errors import InvalidInputError, expected
from emogen_core.similarity.cosine import cosine_distance

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

GENERATIONS = "generations"


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Process(Result):
    """One trial; what takes two generations is None in a shorter one.

    Attributes:
        generations: G, the number of choices after the first.
        steps: (G,) ``d(e_g, e_g+1)``.
        approach: (G,) ``d(e_g, t) - d(e_g+1, t)``, above 0 where the step leads nearer.
        intensity: (G + 1,) lengths |e_g|.
        speed: mean of the steps.
        velocity: mean of the approach, ``(d(e_0, t) - d(e_G, t)) / G``.
        stability: share of the steps in which the best face stays the same.
        range: greatest distance of two best faces of the trial.
        path: sum of the steps.
        peak: greatest intensity.
        peak_generation: the first generation that has it.
    """

    generations: int
    steps: Floats
    approach: Floats
    intensity: Floats
    speed: float | None = None
    velocity: float | None = None
    stability: float | None = None
    range: float | None = None
    path: float | None = None
    peak: float | None = None
    peak_generation: int | None = None


def process(elites: NDArray[np.floating], target: NDArray[np.floating] | None = None) -> Process:
    """Return the measures of a trial.

    Args:
        elites: (G + 1, K) weights of the best faces; (0, K) where the way is not known.
        target: (K,) what is approached; the finished face unless another is given.

    Raises:
        InvalidInputError: elites of a wrong shape.
    """
    path = np.asarray(elites, np.float64)
    if path.ndim != 2:
        raise InvalidInputError(f"elites: {expected('(generations + 1, K)', path.shape)}")
    if len(path) < 2:
        return _short(path)
    towards = path[-1] if target is None else np.asarray(target, np.float64)
    far = np.where((path == towards).all(1), 0.0, cosine_distance(path, towards))
    steps = np.where(_same(path), 0.0, cosine_distance(path[:-1], path[1:]))
    intensity = lengths(path)
    return Process(
        generations=len(steps), steps=steps, approach=-np.diff(far), intensity=intensity, speed=float(steps.mean()),
        velocity=float((far[0] - far[-1]) / len(steps)), stability=float(_same(path).mean()), range=_range(path),
        path=float(steps.sum()), peak=float(intensity.max()), peak_generation=int(intensity.argmax()),
    )  # fmt: skip


def _short(path: Floats) -> Process:
    """Return what a trial of one generation or none has."""
    none, intensity = np.zeros(0), lengths(path)
    return Process(
        generations=max(len(path) - 1, 0), steps=none, approach=none, intensity=intensity,
        lacks=too_few(len(path), 2, GENERATIONS), peak=float(intensity[0]) if len(path) else None,
        peak_generation=0 if len(path) else None,
    )  # fmt: skip


def _same(path: Floats) -> NDArray[np.bool_]:
    """Return (G,) in which steps the face stays: it is carried over unchanged, so it is equal to the bit."""
    return np.asarray((path[:-1] == path[1:]).all(1))


def _range(path: Floats) -> float:
    alike = (path[:, None] == path[None]).all(-1)
    return float(np.where(alike, 0.0, cosine_matrix(path, path)).max())
