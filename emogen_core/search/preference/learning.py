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
from emogen_core.search.preference.design import BestFace, Disagreement, picked
from emogen_core.search.preference.likelihood import arranged
from emogen_core.search.preference.proposals import (
    EARLY,
    composition_leads,
    mean_face,
    means_of_many,
    pool,
    shaped,
    visible,
)
from emogen_core.search.preference.sample import Sample
from emogen_core.search.preference.sampler import moved, resampled, weighed
from emogen_core.search.preference.utility import COSINE, VERTEX, utilities
from emogen_core.search.state import Choice

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.search.preference.utility import Space

    Floats = NDArray[np.float64]

CHAINS = 64
FIRST = 2000
"""Draws from the prior that the first answer is weighed on."""
FIRST_ROUNDS, ROUNDS = 4, 4
"""Rounds of moves after the first answer, and after every other."""
MOST_ALIKE = {COSINE: (1.0, 0.28, 0.29, 0.31, 0.34, 0.37), VERTEX: (1.0, 0.19, 0.21, 0.22, 0.26, 0.29)}
"""Mean cosine of any two of ten faces by leading metric and generation, below that of the paper's algorithm with people
who judge so; later faces may be more alike."""
VARIED = len(MOST_ALIKE[COSINE])
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
    """A generation of a trial.

    Attributes:
        generation: its number.
        last: the most that the trial has.
        best_only: whether every choice so far told nothing but the best face.
        sure: whether enough is known, so that the trial ends with this generation.
    """

    generation: int
    last: int
    best_only: bool = False
    sure: bool = False

    @property
    def final(self) -> bool:
        """Whether the trial ends with this generation."""
        return self.sure or self.generation == self.last


def faces_of(
    space: Space, sample: Sample, elite: Floats, turn: Turn, rng: np.random.Generator
) -> tuple[Floats, tuple[str, ...]]:
    """Return the (10, A) faces of a generation and where they come from, the elite first.

    An elite that can hardly be told from the neutral face, as some of the first faces, is not shown again.

    Args:
        space: the genes.
        sample: the draws.
        elite: (A,) the face that was best.
        turn: the generation; the faces of the last one are all near to what is meant, to be chosen from.
        rng: the stream of this generation.
    """
    if turn.final:
        made, named = _nearest(space, sample, rng)
    else:
        made, named = pool(sample, elite, rng)
    late = EARLY + 1 if turn.sure else turn.generation  # where a result is chosen, no gene of it is left out
    made = shaped(sample, np.concatenate([mean_face(space, sample)[None], made]), late)
    faces, origins = np.concatenate([elite[None], made]), ("elite", "posterior-mean", *named)
    if not visible(elite):
        faces, origins = faces[1:], origins[1:]
    slots = np.arange(POPULATION) if turn.final else _asked(space, sample, faces, turn)
    return faces[slots], tuple(origins[slot] for slot in slots)


def turn_of(choices: Sequence[Choice], last: int, *, sure: bool = False) -> Turn:
    """Return the turn after some choices, of a trial with a last generation; `sure` if it ends here."""
    return Turn(len(choices), last, all(len(choice.selected) == 1 for choice in choices), sure)


def _nearest(space: Space, sample: Sample, rng: np.random.Generator) -> tuple[Floats, tuple[str, ...]]:
    """Return nine faces as near to what is meant as is known, but not the same."""
    return means_of_many(space, sample, POPULATION - 1, IN_MEAN, rng), ("draws-mean",) * (POPULATION - 1)


def _asked(space: Space, sample: Sample, faces: Floats, turn: Turn) -> NDArray[np.intp]:
    """Return the indices of ten faces: the first one, once faces may be alike the second too, then those picked."""
    varied = turn.generation < VARIED
    given = 1 if varied else 2
    different = _different(faces)
    shown = faces[different]
    judged = utilities(space, shown, sample.genes, sample.metric) / np.exp(np.median(sample.log_tau))
    alike = utilities(space, shown, shown, np.full(len(shown), COSINE))
    limits = MOST_ALIKE[COSINE if composition_leads(sample) else VERTEX]
    most_alike = limits[turn.generation] if varied else 1.0
    worth = BestFace(judged) if turn.best_only else Disagreement(judged)
    chosen = picked(worth, given, POPULATION - given, alike, most_alike)
    return np.asarray(different[np.concatenate([np.arange(given), chosen])])


def _different(faces: Floats) -> NDArray[np.intp]:
    """Return the indices of different faces, the first two among them; of all, where there are hardly any."""
    _, first = np.unique(faces, axis=0, return_index=True)
    different: NDArray[np.intp] = np.union1d(first, [0, 1])
    return different if len(different) >= 2 * POPULATION else np.arange(len(faces))
