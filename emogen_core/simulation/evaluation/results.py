"""Finished runs, and what is measured on them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.evaluation.table import Heat

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.specs import RunSpec
    from emogen_core.simulation.runs import Elites

    Floats = NDArray[np.float64]

CERTAIN = 2.0
"""Standard errors from which on a difference is more than chance."""


@dataclass(frozen=True, slots=True)
class Spread:
    """Mean and standard deviation of a number of distances, and what 19 of 20 of them stay below."""

    mean: float
    sd: float
    most: float
    count: int

    def __str__(self) -> str:
        """Return mean and standard deviation, as papers write them."""
        return f"{self.mean:.3f} ± {self.sd:.3f}"

    @property
    def both(self) -> tuple[float, float]:
        """Mean and standard deviation."""
        return self.mean, self.sd

    def below(self, other: Spread) -> bool:
        """Return whether this mean is smaller by more than chance: by two standard errors of the difference."""
        error = np.hypot(self.sd / np.sqrt(self.count), other.sd / np.sqrt(other.count))
        return bool(self.mean < other.mean - CERTAIN * error)


def spread(distances: NDArray[np.floating]) -> Spread:
    """Return mean, standard deviation and 95th percentile of (n,) distances."""
    sd = float(distances.std(ddof=1)) if len(distances) > 1 else 0.0
    return Spread(float(distances.mean()), sd, float(np.quantile(distances, 0.95)), len(distances))


def averaged(spreads: Sequence[Spread]) -> Spread:
    """Return the means of means, standard deviations and percentiles, as the paper's threshold is one over targets."""
    mean, sd, most = np.mean([(one.mean, one.sd, one.most) for one in spreads], axis=0).tolist()
    return Spread(mean, sd, most, sum(one.count for one in spreads))


@dataclass(frozen=True, eq=False)
class Results:
    """Finished runs.

    Attributes:
        laboratory: where they were made.
        runs: by key of their spec.
    """

    laboratory: Laboratory
    runs: Mapping[str, Elites]

    def elites(self, spec: RunSpec) -> Elites:
        """Return the elites of a run."""
        return self.runs[spec.key]

    def target(self, spec: RunSpec) -> NDArray[np.float32]:
        """Return the (1, K) weights of a run's target, or (R, K), one a search."""
        return self.laboratory.faces(np.atleast_2d(self.laboratory.meant(spec)))

    def errors(self, spec: RunSpec) -> Floats:
        """Return the (R, generations + 1) cosine distances of the elites to their target (eq. 12)."""
        elites, target = self.elites(spec).weights, self.target(spec)
        return cosine_distance(elites, target[np.arange(len(elites)) % len(target), None])

    def last(self, spec: RunSpec) -> Spread:
        """Return how far the results of a run are from their target."""
        return spread(self.errors(spec)[:, -1])

    def no_answer(self, spec: RunSpec) -> float:
        """Return the mean cosine distance, to the targets of a run, of the face whose genes are all the same.

        Nobody has to answer for that face, so a search that ends further away has found less than nothing.
        """
        even = self.laboratory.faces(self.laboratory.even(spec)[None])
        return float(cosine_distance(even, self.target(spec)).mean())

    def heat(self, label: str, spec: RunSpec) -> Heat:
        """Return the average of a run's last elites beside its target."""
        return Heat(label, self.elites(spec).final.mean(0), self.target(spec)[0])


def divergence(errors: Floats, bins: int = 25) -> Floats:
    """Return the (generations,) KL divergences of each generation's errors from those of the one before.

    Both are histograms over [0, 1] with half a count added to every bin, so that an empty one divides nothing
    (figures 15 and 17; the paper does not say how it bins).
    """
    counts = np.stack([np.histogram(column, bins, (0, 1))[0] + 0.5 for column in errors.T])
    shares = counts / counts.sum(1, keepdims=True)
    return np.asarray((shares[1:] * np.log(shares[1:] / shares[:-1])).sum(1))


def pairwise(weights: NDArray[np.floating]) -> Floats:
    """Return the cosine distances of all pairs of (R, K) faces, each pair once."""
    rows, columns = np.triu_indices(len(weights), 1)
    unit = weights / np.maximum(np.linalg.norm(weights, axis=1, keepdims=True), 1e-12)
    return np.asarray(1 - np.clip(unit @ unit.T, 0, 1)[rows, columns], np.float64)
