"""Which genes differ between two groups, with false discoveries under control."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats

from emogen_core.analysis.effects import Effect, effect
from emogen_core.analysis.enough import ALPHA, VARIETY, Result, too_few, untestable
from emogen_core.analysis.groups import grouped
from emogen_core.analysis.permutation import RESAMPLES, best, ratio, shuffled
from emogen_core.analysis.resampling import counts

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from emogen_core.analysis.groups import Design, Groups
    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class GeneDifference:
    """One gene.

    Attributes:
        gene: its index.
        effect: how far the first group is above the second.
        p: by permutation.
        q: adjusted over all genes that are tested (Benjamini and Hochberg 1995).
    """

    gene: int
    effect: Effect
    p: float
    q: float


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneDifferences(Result):
    """All genes.

    Attributes:
        design, sizes, left_out: as of `comparisons.Comparison`.
        genes: those that are tested, in their order.
        still: genes with the same value in all faces, which cannot differ.
        rare: genes at work in so few people that the smallest possible p is above .05; they are not tested, so that
            they cost the others nothing (Tarone 1990).
    """

    design: Design
    sizes: tuple[int, ...]
    left_out: int
    genes: tuple[GeneDifference, ...] = ()
    still: tuple[int, ...] = ()
    rare: tuple[int, ...] = ()


def gene_differences(
    first: Faces, second: Faces, rng: np.random.Generator, resamples: int = RESAMPLES
) -> GeneDifferences:
    """Return how two groups differ in every gene, by the t of `comparisons.values_differ`.

    Args:
        first, second: the groups.
        rng: where shufflings come from, unless all are made.
        resamples: greatest number of shufflings.
    """
    people = grouped([first.genes, second.genes], [first.people, second.people])
    lacks = too_few(min(people.sizes), 2)
    varied = np.ptp(people.values, axis=0) > 1e-12 if not lacks else np.zeros(first.genes.shape[1], bool)
    still = tuple(np.flatnonzero(~varied).tolist()) if not lacks else ()
    told = GeneDifferences(design=people.design, sizes=people.sizes, left_out=people.left_out, still=still, lacks=lacks)
    if lacks or not varied.any():
        return told if lacks else replace(told, lacks=too_few(1, 2, VARIETY))
    found = shuffled(people, _statistic(people.replaced(people.values[:, varied])), rng, resamples)
    able = found.least <= ALPHA
    genes = np.flatnonzero(varied)
    told = replace(told, rare=tuple(genes[~able].tolist()))
    if not able.any():
        least = float(found.least.min())
        return replace(told, lacks=untestable(least, best(people.design, people.sizes), varied=True))
    p = found.p[able]
    lines = zip(genes[able].tolist(), p.tolist(), stats.false_discovery_control(p, method="bh").tolist(), strict=True)
    return replace(
        told, genes=tuple(GeneDifference(i, effect(people.replaced(people.values[:, i])), p, q) for i, p, q in lines)
    )


def _statistic(people: Groups) -> Callable[[list[Places]], Floats]:
    """Return |t| of (N, G) values as a function of who is in which group."""
    values, squares = people.values, people.values**2
    if people.design == "within":
        return _paired(people)

    def welch(places: list[Places]) -> Floats:
        """Return |t| of every gene."""
        means, errors = [], []
        for place in places:
            often, size = counts(place, len(values)), place.shape[-1]
            mean = often @ values / size
            means.append(mean)
            errors.append((often @ squares / size - mean**2) / (size - 1))
        return np.abs(ratio(means[0] - means[1], errors[0] + errors[1]))

    return welch


def _paired(people: Groups) -> Callable[[list[Places]], Floats]:
    """Shuffling within people swaps the sign of their difference, which leaves the squares alone."""
    difference = people.of(0) - people.of(1)
    squares = (difference**2).mean(0)

    def paired(places: list[Places]) -> Floats:
        """Return |t| of every gene."""
        sign = np.where(places[0] < len(difference), 1.0, -1.0)
        mean = sign @ difference / len(difference)
        return np.abs(ratio(mean, (squares - mean**2) / (len(difference) - 1)))

    return paired
