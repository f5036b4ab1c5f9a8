"""Test and retest: whether two faces of one person for one emotion are nearer than those of different people.

Three views of the (P, P) table of distances of everybody's first face (rows) to everybody's second (columns), whose
diagonal holds the distances of people to themselves: identification (Finn et al. 2015, doi:10.1038/nn.4135),
discriminability (Bridgeford et al. 2021, doi:10.1371/journal.pcbi.1009279), and the distances themselves beside the
simulated distance of two results for one face in mind.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats

from emogen_core.analysis.distances import Noise, Share, cosine_matrix, share_beyond, varied
from emogen_core.analysis.enough import DISTANCES, Result, too_few
from emogen_core.analysis.intervals import Interval, mean_interval
from emogen_core.analysis.permutation import RESAMPLES, pairing_p
from emogen_core.analysis.recorded import by_person

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Retest:
    """People who made the same face twice.

    Attributes:
        people: (P,) sorted.
        first, second: (P, G) genes or (P, K) weights, or whatever was compared, row i of person i.
    """

    people: NDArray[np.str_]
    first: Floats
    second: Floats

    @property
    def distances(self) -> Floats:
        """(P, P) cosine distances of first faces to second ones."""
        return cosine_matrix(self.first, self.second)


@dataclass(frozen=True, slots=True, kw_only=True)
class Reliability(Result):
    """How well people repeat themselves.

    Attributes:
        people: who made both.
        own: distance of the two faces of one person, mean and interval.
        others: mean distance of the first face of one person to the second of another.
        identified: share of people whose own second face is the nearest of all to their first; of those equally near,
            each counts its share. By chance 1 / people.
        rank: mean rank of the own second face, 1 the nearest; by chance (people + 1) / 2.
        discriminability: chance that the own second face is nearer than somebody else's; .5 by chance.
        p: of a mean rank as low by chance, second faces shuffled over people.
        permutations, exact: how many shufflings, and whether these are all.
        excess: how much greater the mean own distance is than the simulated one; None without simulation or people.
        beyond: own distances beyond what 19 of 20 simulated ones stay below; None without simulation.
    """

    people: int
    own: Interval
    others: float | None = None
    identified: float | None = None
    rank: float | None = None
    discriminability: float | None = None
    p: float | None = None
    permutations: int = 0
    exact: bool = False
    excess: float | None = None
    beyond: Share | None = None


def retest(faces: Faces, attribute: str = "weights") -> Retest:
    """Return the first and the second faces of the people who made both; several of one repetition count by their mean.

    Args:
        faces: of one cell.
        attribute: `weights` or `genes`.
    """
    values = np.asarray(getattr(faces, attribute), np.float64)
    (ours, first), (theirs, second) = (
        by_person(values[faces.repetitions == times], faces.people[faces.repetitions == times]) for times in (0, 1)
    )
    both, at, to = np.intersect1d(ours, theirs, return_indices=True)
    return Retest(both, first[at], second[to])


def reliability(
    pairs: Retest, rng: np.random.Generator, noise: Noise | None = None, resamples: int = RESAMPLES
) -> Reliability:
    """Return how well people repeat themselves.

    Args:
        pairs: their weights.
        rng: where shufflings come from, unless all are made.
        noise: the simulated `apart` of the same face model, search and settings.
        resamples: greatest number of shufflings.
    """
    table = pairs.distances
    count, own = len(table), np.diag(table)
    lacks = too_few(count) or too_few(1 + varied(table), 2, DISTANCES)
    mean = float(own.mean()) if count else None
    beyond = None if noise is None else share_beyond(own, noise)
    excess = None if noise is None or mean is None else mean - noise.mean
    if lacks:
        return Reliability(
            people=count, own=Interval(count, mean, None, None), beyond=beyond, excess=excess, lacks=lacks
        )
    p, permutations, exact = pairing_p(ranks(table), "less", rng, resamples)
    away = table[~np.eye(count, dtype=bool)].reshape(count, -1)
    return Reliability(
        people=count, own=mean_interval(own), others=float(away.mean()), identified=_identified(table),
        rank=float(np.diag(ranks(table)).mean()), discriminability=_nearer(own, away), p=p,
        permutations=permutations, exact=exact, excess=excess, beyond=beyond,
    )  # fmt: skip


def ranks(table: Floats) -> Floats:
    """Return the (P, P) ranks within each row, 1 the nearest; equal ones share the mean of theirs."""
    return np.asarray(stats.rankdata(table, axis=1))


def _identified(table: Floats) -> float:
    nearest = table <= table.min(1, keepdims=True)
    return float((np.diag(nearest) / nearest.sum(1)).mean())


def _nearer(own: Floats, away: Floats) -> float:
    return float(((away > own[:, None]) + 0.5 * (away == own[:, None])).mean())
