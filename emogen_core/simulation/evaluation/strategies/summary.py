"""The searches of one strategy under one condition, as numbers: noise as scatter and as bias, and what was shown.

``scatter`` is ``1 - |mean unit vector|^2`` of the results for one target, on average over targets: it sets how many
participants a study needs. ``bias`` is the cosine distance of that mean from the target: no number of participants
takes it away. Both are told as of many searches: what chance adds to the length of a mean of few is taken off.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.simulation.evaluation.dispersion import units

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.strategies.course import Course
    from emogen_core.simulation.runs import Experiment

    Floats = NDArray[np.float64]

_LEAST = 1e-12
STRENGTHS = np.linspace(0.02, 1, 50)
"""Of the face whose genes are all the same: the one that suits best stands for no information."""


@dataclass(frozen=True, eq=False)
class Summary:
    """One strategy under one condition, for targets of as many genes; N generations with the first faces.

    Attributes:
        judged: (N,) mean errors of best faces, by the metric that people judge by.
        cosine: (N,) the same by cosine.
        believed: (N,) mean errors of the strategy's own mean faces; NaN without any.
        error: standard error of the mean of the last errors.
        scatter, bias: of the last best faces.
        intensity: mean length of a result as a share of that of the target.
        alike, active, faint: (N,) means over the faces that were shown.
        generations: mean of the last generations.
        early: percentage of searches that ended before the last one that there could be.
        estimated, expected: mean cosine distance of the last mean faces from what was meant, and as the strategy itself
            expects it; NaN without any.
    """

    judged: Floats
    cosine: Floats
    believed: Floats
    error: float
    scatter: float
    bias: float
    intensity: float
    alike: Floats
    active: Floats
    faint: Floats
    generations: float
    early: float
    estimated: float
    expected: float


def summary(course: Course, meant: NDArray[np.floating]) -> Summary:
    """Return the summary of searches for (M, K) targets; search i is for target i % M, at least two for each."""
    last = course.judged[:, -1]
    return Summary(
        course.judged.mean(0), course.cosine.mean(0), course.believed.mean(0),
        float(last.std(ddof=1) / np.sqrt(len(last))),
        scatter(course.final, len(meant)), bias(course.final, meant), float(course.intensity.mean()),
        course.alike.mean(0), course.active.mean(0), course.faint.mean(0),
        float(course.ended.mean()), 100 * float((course.ended < course.judged.shape[1] - 1).mean()),
        float(course.mean_cosine[:, -1].mean()), float(course.doubt[:, -1].mean()),
    )  # fmt: skip


def scatter(final: NDArray[np.floating], targets: int) -> float:
    """Return the mean scatter of (R, K) results by target, search i for target i % targets."""
    _, lengths = _means(final, targets)
    return float(1 - lengths.mean())


def bias(final: NDArray[np.floating], meant: NDArray[np.floating]) -> float:
    """Return the mean cosine distance of the averaged (R, K) results from the (M, K) targets, search i for i % M."""
    means, lengths = _means(final, len(meant))
    along = (means * units(meant)).sum(-1)
    return float((1 - along / np.sqrt(np.maximum(np.maximum(lengths, along**2), _LEAST))).mean())


def _means(final: NDArray[np.floating], targets: int) -> tuple[Floats, Floats]:
    """Return the (M, K) mean directions by target, and (M,) their squared lengths without what chance adds to them."""
    own = units(final).reshape(-1, targets, final.shape[-1])
    means, searches = own.mean(0), len(own)
    return means, (searches * np.square(means).sum(-1) - np.square(own).sum(-1).mean(0)) / (searches - 1)


def no_information(experiment: Experiment) -> float:
    """Return the mean error, by the metric that people judge by, of the face whose genes are all the same.

    Its strength is the one that suits all targets best.
    """
    reach = np.zeros((1, experiment.params.gene_count))
    reach[:, list(experiment.params.active)] = 1
    meant = np.asarray(experiment.faces(np.atleast_2d(experiment.target)), np.float64)
    faces = np.asarray(experiment.faces(STRENGTHS[:, None] * reach), np.float64)
    return float(min(experiment.metric(np.broadcast_to(face, meant.shape), meant).mean() for face in faces))
