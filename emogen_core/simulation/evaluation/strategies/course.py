"""What searches came through, generation by generation, measured where they are made: the faces themselves stay there.

Symbols: ``R`` searches, ``N`` generations with the first faces, ``K`` shapes.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.runs import chunk

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.simulation.evaluation.laboratory import Laboratory
    from emogen_core.simulation.evaluation.specs import RunSpec
    from emogen_core.simulation.learners import Learned
    from emogen_core.simulation.runs import Elites, Experiment

    Floats = NDArray[np.float64]

FAINT = 0.1
"""A face none of whose genes reaches it is nearly invisible."""
_LEAST = 1e-12


@dataclass(frozen=True, eq=False)
class Course:
    """Searches of one run.

    Attributes:
        judged: (R, N) distances of the best faces to the face in mind, by the metric that the person judges by.
        cosine: (R, N) the same by cosine.
        believed: (R, N) as `judged`, of the mean face of what the strategy believes after the answer; NaN without one.
        alike: (R, N) mean cosine of any two of the ten faces.
        active: (R, N) mean number of genes at work in a face.
        faint: (R, N) share of faces that are nearly invisible.
        doubt: (R, N) how far it is expected to be from the face in mind by the strategy itself, by cosine.
        mean_cosine: (R, N) how far it is; both NaN without a mean face.
        intensity: (R,) length of the result as a share of that of the face in mind.
        final: (R, K) weights of the results.
        ended: (R,) last generation that was seen. What stands at the end of a search that ended early is told again for
            the generations after it.
    """

    judged: Floats
    cosine: Floats
    believed: Floats
    alike: Floats
    active: Floats
    faint: Floats
    doubt: Floats
    mean_cosine: Floats
    intensity: Floats
    final: NDArray[np.float32]
    ended: NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Watching:
    """Makes chunks of runs as `Course`; see `work.Maker`."""

    laboratory: Laboratory

    def chunk(self, spec: RunSpec, number: int, searches: int, /) -> Course:
        """Return one chunk of a run."""
        experiment, begun = self.laboratory.experiment(spec), number * spec.chunk
        targets = np.atleast_2d(experiment.target)
        meant = experiment.faces(targets)[np.arange(begun, begun + searches) % len(targets)]
        if spec.learns:
            found = self.laboratory.learned(spec, number, searches)
            return _course(experiment, meant, found.elites, found.shown, found)
        seen: list[Floats] = []
        elites = chunk(experiment, spec.entropy(self.laboratory.seed), number, searches, seen.append)
        return _course(experiment, meant, elites, np.stack(seen, 1)[:searches], None)


def joined(parts: Sequence[Course]) -> Course:
    """Return the courses of chunks, in their order, as one."""
    return Course(*(np.concatenate([getattr(part, one.name) for part in parts]) for one in fields(Course)))


def _course(
    experiment: Experiment,
    meant: NDArray[np.floating],
    elites: Elites,
    shown: NDArray[np.floating],
    found: Learned | None,
) -> Course:
    """Return the course of best faces, (R, N, 10, G) shown ones and, of a strategy that learns, the rest."""
    target = np.asarray(meant, np.float64)[:, None]
    best = elites.weights.astype(np.float64)
    judged = experiment.metric(best, target)
    nothing = np.full_like(judged, np.nan)
    means = None if found is None else found.means.astype(np.float64)
    strongest = shown.max(axis=-1)
    return Course(
        judged,
        cosine_distance(best, target),
        nothing if means is None else experiment.metric(means, target),
        _alike(experiment, shown),
        (shown > 0).sum(axis=-1).mean(axis=-1),
        (strongest < FAINT).mean(axis=-1),
        nothing if found is None else found.doubt.astype(np.float64),
        nothing if means is None else cosine_distance(means, target),
        np.linalg.norm(best[:, -1], axis=-1) / np.maximum(np.linalg.norm(target[:, 0], axis=-1), _LEAST),
        elites.final,
        elites.ended,
    )


def _alike(experiment: Experiment, shown: NDArray[np.floating]) -> Floats:
    """Return the (R, N) mean cosines of pairs of (R, N, 10, G) faces; with a neutral face it is 0."""
    flat = np.asarray(experiment.faces(np.asarray(shown, np.float64).reshape(-1, shown.shape[-1])), np.float64)
    unit = flat / np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), _LEAST)
    unit = unit.reshape(*shown.shape[:3], -1)
    faces = unit.shape[2]
    both = np.square(unit.sum(axis=2)).sum(axis=-1) - np.square(unit).sum(axis=(2, 3))
    return np.asarray(both / (faces * (faces - 1)))
