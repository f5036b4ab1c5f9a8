"""From answers to draws, and from draws to faces, in arrays: what the strategy does for one search, for several.

Draws are kept between answers: a new answer first weights and resamples them, then moves them (see `sampler`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.params import POPULATION
from emogen_core.search.preference import prior
from emogen_core.search.preference.chains import NUMBERS, ROUND, Evidence
from emogen_core.search.preference.design import picked
from emogen_core.search.preference.likelihood import arranged
from emogen_core.search.preference.proposals import mean_face, means_of_many, pool, shaped
from emogen_core.search.preference.sample import Sample
from emogen_core.search.preference.sampler import moved, resampled, weighed
from emogen_core.search.preference.utility import COSINE, utilities
from emogen_core.search.state import Choice

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.preference.utility import Space

    Floats = NDArray[np.float64]

CHAINS = 64
FIRST = 640
"""Draws from the prior that the first answer is weighed on."""
FIRST_ROUNDS, ROUNDS = 8, 4
"""Rounds of moves after the first answer, and after every other."""
VARIED, MOST_ALIKE = 5, 0.3
"""Generation up to which the ten faces are kept as unlike as those of the paper's algorithm, and their mean cosine."""
IN_MEAN = 12
"""Draws in each of the faces of the last generation."""

Told = Sequence[tuple["Floats", Choice]]
"""All answers of a search: (10, A) faces, and the choice."""


def learn(
    space: Space, told: Sequence[Told], before: Sequence[Sample] | None, streams: Sequence[np.random.Generator]
) -> list[Sample]:
    """Return the draws of every search after its last answer.

    Args:
        space: the genes.
        told: the answers of every search; as many in each, of as many faces.
        before: the draws before the last answer; None if it was the first.
        streams: of random numbers, one a search.
    """
    begun = [_prior(space, rng) for rng in streams] if before is None else before
    kept = [_kept(space, *search) for search in zip(told, begun, streams, strict=True)]
    rounds = FIRST_ROUNDS if before is None else ROUNDS
    numbers = np.concatenate([rng.random((rounds, ROUND, NUMBERS, CHAINS)) for rng in streams], axis=3)
    searches = np.repeat(np.arange(len(streams)), CHAINS)
    after = moved(space, _evidence(told), _joined(kept), searches, numbers)
    return [after.at(np.flatnonzero(searches == i)) for i in range(len(streams))]


def _prior(space: Space, rng: np.random.Generator) -> Sample:
    return prior.drawn(rng.random((FIRST, 3 + 2 * space.genes)))


def _kept(space: Space, told: Told, sample: Sample, rng: np.random.Generator) -> Sample:
    """Return as many draws as there are chains, in proportion to how likely they make the last answer."""
    weights = weighed(space, _evidence([told[-1:]]), sample, np.zeros(len(sample.metric), np.intp))
    return sample.at(resampled(weights, CHAINS, rng.random()))


def _evidence(told: Sequence[Told]) -> Evidence:
    faces = np.stack([np.concatenate([faces for faces, _ in search]) for search in told])
    return Evidence(faces, [arranged([choice for _, choice in search]) for search in told])


def _joined(samples: Sequence[Sample]) -> Sample:
    return Sample(
        np.concatenate([one.genes for one in samples]),
        np.concatenate([one.log_tau for one in samples]),
        np.concatenate([one.metric for one in samples]),
    )


@dataclass(frozen=True, slots=True)
class Turn:
    """A generation, and the last one of its trial."""

    generation: int
    last: int


def faces_of(
    space: Space, sample: Sample, elite: Floats, turn: Turn, rng: np.random.Generator
) -> tuple[Floats, tuple[str, ...]]:
    """Return the (10, A) faces of a generation and where they come from: the elite, the mean face, and eight more.

    Args:
        space: the genes.
        sample: the draws.
        elite: (A,) the face that was best.
        turn: the generation; the faces of the last one are all near to what is meant, to be chosen from.
        rng: the stream of this generation.
    """
    mean = mean_face(space, sample)
    if turn.generation == turn.last:
        others = means_of_many(sample, POPULATION - 2, IN_MEAN, rng)
        faces, origins = np.concatenate([mean[None], others]), ("posterior-mean", *["draws-mean"] * len(others))
        return np.concatenate([elite[None], shaped(sample, faces, turn.generation)]), ("elite", *origins)
    candidates, named = pool(sample, elite, rng)
    made = shaped(sample, np.concatenate([mean[None], candidates]), turn.generation)
    _, first = np.unique(np.concatenate([elite[None], made]), axis=0, return_index=True)
    unlike = np.union1d(first, [0, 1])
    if len(unlike) < 2 * POPULATION:  # of very few genes, all faces are soon the same
        unlike = np.arange(1 + len(made))
    faces, origins = np.concatenate([elite[None], made]), ("elite", "posterior-mean", *named)
    judged = utilities(space, faces[unlike], sample.genes, sample.metric)
    composition = utilities(space, faces[unlike], faces[unlike], np.full(len(unlike), COSINE))
    most_alike = MOST_ALIKE if turn.generation <= VARIED else 1.0
    chosen = picked(judged / np.exp(np.median(sample.log_tau)), 2, POPULATION - 2, composition, most_alike)
    slots = unlike[np.concatenate([[0, 1], chosen])]
    return faces[slots], tuple(origins[slot] for slot in slots)
