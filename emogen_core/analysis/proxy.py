"""What a person meant is not known; the mean face of the others of their cell stands for it (EmoGen 2021, IV-C).

For every face the proxy target is the mean of the weights of everybody else in its cell, so that no face is measured
by a mean that it is part of. All of it is to be held against the simulated `proxy`, whose mean is of the other results
for one face in mind.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.distances import Noise, Share, share_beyond
from emogen_core.analysis.enough import Result, too_few
from emogen_core.analysis.intervals import Interval, people_mean
from emogen_core.analysis.recorded import by_person, shares
from emogen_core.similarity.cosine import cosine_distance

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.analysis.recorded import Faces

    Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Proxy(Result):
    """The distances of people to the mean of the others.

    Attributes:
        people: (P,) sorted.
        distances: (P,) cosine distances, a person's mean; empty with too few people.
        mean, sd: of the distances; None with too few people.
        beyond: how many are beyond what 19 of 20 simulated ones stay below.
    """

    people: NDArray[np.str_]
    distances: Floats
    mean: float | None
    sd: float | None
    beyond: Share


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Convergence(Result):
    """How the best faces of the generations come nearer to the proxy target.

    Attributes:
        distances: (n, generations + 1) of every trial; NaN behind the end of a trial. No rows with too few people.
        points: mean over people of every generation and its interval.
    """

    distances: Floats
    points: tuple[Interval, ...]


def proxy(faces: Faces, noise: Noise) -> Proxy:
    """Return how far people's faces are from the mean of the others of their cell.

    Args:
        faces: of one cell.
        noise: the simulated `proxy` of the same face model, search and settings.
    """
    people, share = shares(faces.people)
    lacks = too_few(len(people))
    values = np.array([]) if lacks else share @ cosine_distance(faces.weights, others_mean(faces))
    return Proxy(
        people=people, distances=values, lacks=lacks, beyond=share_beyond(values, noise),
        mean=None if lacks else float(values.mean()), sd=None if lacks else float(values.std(ddof=1)),
    )  # fmt: skip


def others_mean(faces: Faces) -> Floats:
    """Return for each face the (n, K) mean of the weights of all other people, each of whom counts once.

    Of a single person there are no others; then the mean is the neutral face.
    """
    people, means = by_person(faces.weights, faces.people)
    others = (means.sum(0) - means) / max(len(people) - 1, 1)
    return np.asarray(others[np.searchsorted(people, faces.people)])


def convergence(faces: Faces) -> Convergence:
    """Return how the trials of a cell come nearer to the mean of the other people's finished faces.

    Trials whose way is not known have no value in any generation.
    """
    lacks = too_few(len(np.unique(faces.people[[len(path) > 0 for path in faces.elites]])))
    if lacks:
        return Convergence(distances=np.zeros((0, 0)), points=(), lacks=lacks)
    found = np.full((len(faces), max(map(len, faces.elites))), np.nan)
    for row, path, target in zip(found, faces.elites, others_mean(faces), strict=True):
        row[: len(path)] = cosine_distance(path, target)
    return Convergence(distances=found, points=tuple(people_mean(column, faces.people) for column in found.T))
