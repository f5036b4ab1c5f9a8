"""Measures the collision stage: what random faces of every head look like to the judge, before and after."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.correctives.collision.judge import dense_depth
from emogen_core.correctives.collision.solve import solve_collisions
from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.check import random_genes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.solve import CollisionResult
    from emogen_core.face.rig import Rig

# A face collides, for the judge, when a point lies deeper in the lower lip than this; it is bad from RESIDUAL on.
TOUCH = 0.1
RESIDUAL = 0.5
_SAMPLE = 10
# The better of two runs is timed: what other processes take from the caches is not this code's.
_REPEATS = 2


def check_collisions(rig: Rig, identity: str, faces: int = 1000, seed: int = 1) -> dict[str, Any]:
    """Measure the collision stage on random faces of one head, each corrected alone and timed.

    Args:
        rig: a rig with the eight collision correctives.
        identity: the head that wears it.
        faces: how many random faces, six genes each.
        seed: of the faces.

    Returns:
        JSON-ready: the shares of faces that collided (lips, teeth) as the solver and as the judge see it; the
        judge's depth in millimetres before and after over those faces (median, p90, max); the share of them
        over 0.5 mm afterwards; the neutral's depth; milliseconds a face (mean, p99) of processor time, the better of
        two runs; and whether faces without a collision came out bit-identical.

    Raises:
        InvalidInputError: no faces, an unknown identity, or a rig without collision correctives.
    """
    if faces < 1:
        raise InvalidInputError(f"faces: {expected('at least 1', faces)}")
    weights = shape_weights(rig, random_genes(rig, faces, seed))
    results, spent = _solve_each(rig, identity, weights)
    corrected = weights.copy()
    corrected[:, -8:] = np.concatenate([result.weights for result in results])
    before = dense_depth(rig, identity, weights)
    after, moved = before.copy(), np.asarray(corrected[:, -8:].any(1), bool)
    after[moved] = dense_depth(rig, identity, corrected[moved])
    collided = (before > TOUCH) | np.concatenate([result.collided for result in results])
    struck = np.asarray(collided.any(1), bool)
    return {
        "identity": identity,
        "faces": faces,
        "seed": seed,
        "collided": {"lips": _share(collided[:, 0]), "teeth": _share(collided[:, 1]), "any": _share(struck)},
        "corrected": _share(moved),
        "depth_before_mm": _spread(before[struck].max(1)),
        "depth_after_mm": _spread(after[struck].max(1)),
        "over_half_mm_before": _share(np.asarray(before[struck].max(1) > RESIDUAL)),
        "over_half_mm_after": _share(np.asarray(after[struck].max(1) > RESIDUAL)),
        "neutral_mm": round(float(dense_depth(rig, identity, np.zeros_like(weights[:1])).max()), 3),
        "milliseconds": {"mean": round(float(spent.mean()), 3), "p99": round(float(np.percentile(spent, 99)), 3)},
        "untouched_identical": _identical(rig, identity, weights, corrected, ~moved),
    }


def _solve_each(
    rig: Rig, identity: str, weights: NDArray[np.float32]
) -> tuple[list[CollisionResult], NDArray[np.float64]]:
    solve_collisions(rig, identity, weights[:1])
    results, spent = [], []
    for row in range(len(weights)):
        times = []
        for _ in range(_REPEATS):
            start = time.thread_time()
            result = solve_collisions(rig, identity, weights[row : row + 1])
            times.append((time.thread_time() - start) * 1000)
        results.append(result)
        spent.append(min(times))
    return results, np.array(spent)


def _identical(
    rig: Rig, identity: str, weights: NDArray[np.float32], corrected: NDArray[np.float32], untouched: NDArray[np.bool_]
) -> bool:
    """Return whether untouched faces kept every bit: of their weights, and (of a sample) of their vertices."""
    sample = np.flatnonzero(untouched)[:_SAMPLE]
    meshes = (vertices(rig, identity, w[sample]).tobytes() for w in (weights, corrected))
    return weights[untouched].tobytes() == corrected[untouched].tobytes() and next(meshes) == next(meshes)


def _share(which: NDArray[np.bool_]) -> float:
    return round(float(which.mean()), 4) if len(which) else 0.0


def _spread(depth: NDArray[np.float64]) -> dict[str, float]:
    if not len(depth):
        return {"median": 0.0, "p90": 0.0, "max": 0.0}
    median, high = np.percentile(depth, (50, 90))
    return {"median": round(float(median), 3), "p90": round(float(high), 3), "max": round(float(depth.max()), 3)}
