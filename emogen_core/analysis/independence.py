"""Is the face of an emotion the same on every head? Two questions that a study with several identities asks.

`agreement`: do mean faces of one emotion on different heads agree more than those of different emotions? The names of
the emotions are shuffled over the mean faces of each head but the first: if a head had its own faces for emotions,
any assignment would fit as well. `head_effect`: are faces of one emotion on two heads further apart than on one? Its
interval says how large an influence of the head the data leave open; that no influence is found is not enough.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats

from emogen_core.analysis.distances import cosine_matrix, varied
from emogen_core.analysis.enough import DISTANCES, Result, too_few, untestable
from emogen_core.analysis.permutation import RESAMPLES
from emogen_core.analysis.recorded import by_person
from emogen_core.analysis.resampling import pair_mean, people_interval, strata

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]
    Places = NDArray[np.intp]

IDENTITIES, EMOTIONS = "identities", "emotions on every identity"
_BATCH = 500


@dataclass(frozen=True, slots=True, kw_only=True)
class Agreement(Result):
    """Mean faces of the same emotions on different heads.

    Attributes:
        emotions, identities: which there are; emotions that some head does not have are left out.
        same: mean cosine distance of mean faces of one emotion on two heads.
        other: of two emotions on two heads.
        identified: share of mean faces to which, on another head, that of the same emotion is the nearest; of those
            equally near, each counts its share. By chance 1 / emotions.
        tied: share of mean faces to which, on another head, several are equally near.
        p: of a distance `same` as small by chance; None where it could not show anything.
        permutations, exact: how many shufflings, and whether these are all.
    """

    emotions: tuple[str, ...]
    identities: tuple[str, ...]
    same: float | None = None
    other: float | None = None
    identified: float | None = None
    tied: float | None = None
    p: float | None = None
    permutations: int = 0
    exact: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadEffect(Result):
    """Faces of different people for one emotion, on one head and on two.

    Attributes:
        people: how many.
        same_head, other_head: mean cosine distances; None without such pairs.
        excess: how much greater the distance on two heads is, and its 95 % interval by resampling people.
    """

    people: int
    same_head: float | None = None
    other_head: float | None = None
    excess: float | None = None
    low: float | None = None
    high: float | None = None


def agreement(faces: Faces, rng: np.random.Generator, resamples: int = RESAMPLES) -> Agreement:
    """Return whether mean faces of the same emotion on different heads agree more than by chance.

    Args:
        faces: of several emotions on several identities, of one condition or of all.
        rng: where shufflings come from, unless all are made.
        resamples: greatest number of shufflings.
    """
    heads = tuple(dict.fromkeys(faces.identities.tolist()))
    emotions = tuple(
        name for name in dict.fromkeys(faces.emotions.tolist())
        if set(faces.only(name).identities.tolist()) == set(heads)
    )  # fmt: skip
    cells = [faces.only(emotion, head) for head in heads for emotion in emotions]
    lacks = too_few(len(heads), 2, IDENTITIES) or too_few(len(emotions), 2, EMOTIONS)
    lacks = lacks or too_few(min(one.person_count for one in cells))
    told = Agreement(emotions=emotions, identities=heads, lacks=lacks)
    if lacks:
        return told
    means = np.stack([by_person(one.weights, one.people)[1].mean(0) for one in cells])
    return _agreed(told, _tables(means, len(heads)), rng, resamples)


def _tables(means: Floats, heads: int) -> Floats:
    """Return the (H, H, E, E) distances of the mean faces of every two heads."""
    apart = cosine_matrix(means, means)
    return apart.reshape(heads, len(means) // heads, heads, -1).transpose(0, 2, 1, 3)


def _agreed(told: Agreement, tables: Floats, rng: np.random.Generator, resamples: int) -> Agreement:
    heads, emotions = len(tables), tables.shape[-1]
    pairs = list(combinations(range(heads), 2))
    first = np.arange(emotions)

    def same(*names: Places, axis: int) -> Floats:
        """Return the mean distance of equal names."""
        each = [np.broadcast_to(first, names[0].shape), *names]
        found = [tables[i, j][each[i], each[j]].mean(axis) for i, j in pairs]
        return np.asarray(np.round(np.mean(found, axis=0), 9))

    found = stats.permutation_test(
        (first,) * (heads - 1), same, permutation_type="pairings", vectorized=True, n_resamples=resamples,
        batch=_BATCH, alternative="less", rng=rng,
    )  # fmt: skip
    null, exact = np.asarray(found.null_distribution), math.factorial(emotions) ** (heads - 1) <= resamples
    least = float((null == null.min()).mean()) if exact else 1 / (len(null) + 1)
    every = np.stack([tables[i, j] for i, j in pairs])
    lacks = untestable(least, 1 / math.factorial(emotions) ** (heads - 1), varied(every), DISTANCES)
    identified, tied = _identified(every)
    return replace(
        told, same=float(found.statistic), other=float(every[:, ~np.eye(emotions, dtype=bool)].mean()),
        identified=identified, tied=tied, p=None if lacks else float(found.pvalue), permutations=len(null), exact=exact,
        lacks=lacks,
    )  # fmt: skip


def _identified(tables: Floats) -> tuple[float, float]:
    """Return how often the nearest mean face on another head is that of the same emotion, and how often several are.

    Both ways; distances that differ by rounding alone are equal.
    """
    shares, ties = [], []
    for away in (np.round(tables, 9), np.round(tables.transpose(0, 2, 1), 9)):
        nearest = away == away.min(-1, keepdims=True)
        count = nearest.sum(-1)
        shares.append(np.diagonal(nearest, axis1=-2, axis2=-1) / count)
        ties.append(count > 1)
    return float(np.mean(shares)), float(np.mean(ties))


def head_effect(faces: Faces, rng: np.random.Generator) -> HeadEffect:
    """Return how much further apart the faces of two people are on two heads than on one.

    Args:
        faces: of one emotion on several identities.
        rng: where the resamples come from.
    """
    apart = cosine_matrix(faces.weights, faces.weights)
    same = faces.identities[:, None] == faces.identities
    tables = [_by_pair(apart, one, faces.people) for one in (same, ~same)]
    same_head, other_head = (float(values[pairs].mean()) if pairs.any() else None for values, pairs in tables)
    told = HeadEffect(people=faces.person_count, same_head=same_head, other_head=other_head)
    heads = _people_of_heads(faces)
    lacks = too_few(len(heads), 2, IDENTITIES) or too_few(int(heads.sum(1).min()))
    lacks = lacks or too_few(1 + varied(apart), 2, DISTANCES)
    if lacks:
        return replace(told, lacks=lacks)
    one, other = (pair_mean(*table) for table in tables)
    low, high = people_interval(lambda often: other(often) - one(often), strata(*heads), rng)
    everybody = np.ones(told.people)
    return replace(told, excess=float(other(everybody) - one(everybody)), low=low, high=high)


def _people_of_heads(faces: Faces) -> NDArray[np.bool_]:
    """Return (H, P) who made a face on which head."""
    people, heads = np.unique(faces.people), np.unique(faces.identities).tolist()
    found = [np.isin(people, faces.only(identity=head).people) for head in heads]
    return np.array(found, bool).reshape(len(heads), len(people))


def _by_pair(apart: Floats, counted: NDArray[np.bool_], people: NDArray[np.str_]) -> tuple[Floats, NDArray[np.bool_]]:
    """Return (P, P) mean distances of different people over those (n, n) pairs that count, and where there are any."""
    names, index = np.unique(people, return_inverse=True)
    own = (np.arange(len(names))[:, None] == index).astype(np.float64)
    number = own @ counted @ own.T
    total = own @ np.where(counted, apart, 0.0) @ own.T
    pairs = np.triu(number > 0, 1)
    return np.divide(total, number, out=np.zeros_like(total), where=number > 0), pairs
