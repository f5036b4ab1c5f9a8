"""Do people settle? How far the best face of each generation is from the one that a trial ended with.

Trials may differ in length: what a trial does not have is NaN.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.similarity.cosine import cosine_distance

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

NEVER = np.inf


def distances_to_last(trials: Sequence[NDArray[np.floating]]) -> NDArray[np.float64]:
    """Return the cosine distance of each generation's best face to the last one.

    Args:
        trials: for each trial the (g + 1, K) weights of the best faces of generations 0 to g, the finished one last.

    Returns:
        (trials, greatest g): the finished face itself is left out, since its distance is 0 by definition.
    """
    most = max((len(trial) - 1 for trial in trials), default=0)
    found = np.full((len(trials), max(most, 0)), np.nan)
    for row, trial in zip(found, trials, strict=True):
        if len(trial) > 1:
            row[: len(trial) - 1] = cosine_distance(trial[:-1], trial[-1])
    return found


def settled_at(distances: NDArray[np.floating], threshold: float) -> NDArray[np.float64]:
    """Return for each trial the first generation from which on every distance is at most the threshold, or `NEVER`.

    Args:
        distances: (trials, generations), NaN behind the end of a trial.
        threshold: what counts as near, for example how far a search ends from the face in mind.
    """
    far = distances > threshold  # NaN is not far
    generations = distances.shape[1]
    # One past the last generation that was still far; a trial whose last distance is far never settled.
    after = np.where(far.any(axis=1), generations - far[:, ::-1].argmax(axis=1), 0)
    length = (~np.isnan(distances)).sum(axis=1)
    return np.where(after < length, after.astype(np.float64), NEVER)


def share_settled(generations: NDArray[np.floating]) -> float | None:
    """Return the share of (trials,) that settled before their last generation; none without trials."""
    return float(np.isfinite(generations).mean()) if len(generations) else None


def median_settling(generations: NDArray[np.floating]) -> float | None:
    """Return the median generation of settling over all (trials,), `NEVER` where half of them never did."""
    if not len(generations):
        return None
    middle = np.sort(generations)[[(len(generations) - 1) // 2, len(generations) // 2]]
    return float(middle.mean())
