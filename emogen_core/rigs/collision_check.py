"""Measures the collision stage: what random faces of a head look like to the judge, before and after."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.collision.judge import dense_depth
from emogen_core.correctives.collision.solve import solve_collisions
from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.random_faces import random_genes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.solve import CollisionResult
    from emogen_core.face.rig import Rig

# A face collides, for the judge, when a point lies deeper in the lower lip than this; it is bad from RESIDUAL on.
TOUCH = 0.1
RESIDUAL = 0.5
_BATCH = 20
# The best of some runs is told: what other programs take from the caches is not this code's.
_REPEATS = 3


@dataclass(frozen=True, eq=False)
class _Run:
    """Faces corrected one by one: weights (n, K) before and after, the results, milliseconds (n, 2) each took."""

    before: NDArray[np.float32]
    after: NDArray[np.float32]
    results: list[CollisionResult]
    spent: NDArray[np.float64]

    @property
    def collided(self) -> NDArray[np.bool_]:
        """(n, 2) which types collided, as the solver sees it."""
        return np.concatenate([result.collided for result in self.results])


def check_collisions(rig: Rig, identity: str, faces: int = 1000, seed: int = 1) -> dict[str, Any]:
    """Measure the collision stage on random faces of one head, each corrected alone and timed.

    Args:
        rig: a rig with the eight collision correctives.
        identity: the head that wears it.
        faces: how many random faces, six genes each.
        seed: of the faces.

    Returns:
        JSON-ready: the shares of faces that collided (lips, teeth, any), as the solver or the judge sees it; the
        judge's depth in millimetres before and after over those faces; the shares of them over 0.5 mm; the judge's
        depth of the neutral; milliseconds a face for detecting and solving, processor time and wall clock, the best
        of three runs; and whether every face without a collision came out bit-identical, weights and vertices.

    Raises:
        InvalidInputError: no faces, an unknown identity, or a rig without collision correctives.
    """
    if faces < 1:
        raise InvalidInputError(f"faces: {expected('at least 1', faces)}")
    run = _corrected(rig, identity, shape_weights(rig, random_genes(rig, faces, seed)))
    before = dense_depth(rig, identity, run.before)
    after, moved = before.copy(), np.asarray(run.after[:, -8:].any(1), bool)
    after[moved] = dense_depth(rig, identity, run.after[moved])
    collided = (before > TOUCH) | run.collided
    struck = np.asarray(collided.any(1), bool)
    return {
        "collided": {"lips": _share(collided[:, 0]), "teeth": _share(collided[:, 1]), "any": _share(struck)},
        "corrected": _share(moved),
        **_depths("before", before[struck].max(1)),
        **_depths("after", after[struck].max(1)),
        "neutral_mm": round(float(dense_depth(rig, identity, np.zeros_like(run.before[:1])).max()), 3),
        "neutral_collides": _neutral_collides(rig, identity),
        "milliseconds": {"processor": _times(run.spent[:, 0]), "wall": _times(run.spent[:, 1])},
        "untouched_identical": _untouched_identical(rig, identity, run),
    }


def _corrected(rig: Rig, identity: str, weights: NDArray[np.float32]) -> _Run:
    solve_collisions(rig, identity, weights[:1])
    results, spent = zip(*(_timed(rig, identity, row[None]) for row in weights), strict=True)
    after = weights.copy()
    after[:, -8:] = np.concatenate([result.weights for result in results])
    return _Run(weights, after, list(results), 1000 * np.array(spent))


def _timed(rig: Rig, identity: str, face: NDArray[np.float32]) -> tuple[CollisionResult, tuple[float, float]]:
    """Return a face's result, and the seconds of processor time and of the wall clock that its best run took."""
    spent = []
    for _ in range(_REPEATS):
        start = time.thread_time(), time.perf_counter()
        result = solve_collisions(rig, identity, face)
        spent.append((time.thread_time() - start[0], time.perf_counter() - start[1]))
    processor, wall = zip(*spent, strict=True)
    return result, (min(processor), min(wall))


def _neutral_collides(rig: Rig, identity: str) -> bool:
    return bool(solve_collisions(rig, identity, np.zeros((1, len(rig.shape_names)), np.float32)).collided.any())


def _untouched_identical(rig: Rig, identity: str, run: _Run) -> bool:
    """Return whether all faces without a collision kept every bit of their weights and of their vertices."""
    free = np.flatnonzero(~run.collided.any(1))
    batches = [free[first : first + _BATCH] for first in range(0, len(free), _BATCH)]
    return run.before[free].tobytes() == run.after[free].tobytes() and all(
        vertices(rig, identity, run.before[rows]).tobytes() == vertices(rig, identity, run.after[rows]).tobytes()
        for rows in batches
    )


def _share(which: NDArray[np.bool_]) -> float:
    return round(float(which.mean()), 4) if len(which) else 0.0


def _depths(when: str, depth: NDArray[np.float64]) -> dict[str, Any]:
    over = _share(np.asarray(depth > RESIDUAL))
    return {f"depth_{when}_mm": _spread(depth), f"over_half_mm_{when}": over}


def _spread(depth: NDArray[np.float64]) -> dict[str, float]:
    if not len(depth):
        return dict.fromkeys(("mean", "median", "p90", "p99", "max"), 0.0)
    median, high, highest = np.percentile(depth, (50, 90, 99))
    named = {"mean": depth.mean(), "median": median, "p90": high, "p99": highest, "max": depth.max()}
    return {name: round(float(value), 3) for name, value in named.items()}


def _times(spent: NDArray[np.float64]) -> dict[str, float]:
    return {"mean": round(float(spent.mean()), 3), "p99": round(float(np.percentile(spent, 99)), 3)}
