"""What simulated people make before the runs of an evaluation: faces that metrics learn from, and the mean happy face.

As targets do, they belong to the rig and its genes: they are made by the published search, always of as many people.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.search.params import FaceSet, SearchParams
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.simulation.evaluation.targets import EMOTIONS, SEED, TARGETS, people
from emogen_core.simulation.runs import Experiment, simulate

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    Genomes = NDArray[np.float64]
    Faces = Callable[[Genomes], NDArray[np.float32]]

PARTICIPANTS = 240
"""How many people the paper's empirical metrics were learned from, for each of four emotions."""
HAPPY = EMOTIONS[0]
STARTS = {"fixed 1": (3, 8), "fixed 3": (16, 24)}
"""Fixed first populations by how many genes a face of them has; the paper's have 5.2 and 19.9 shapes on average."""
_SEARCH_STREAM, _START_STREAM = 3, 4


@dataclass(frozen=True, eq=False)
class Made:
    """What people of one emotion made.

    Attributes:
        genes: (240, G) genomes of the finished faces.
        elites: (240 generations, K) weights of the best face of every generation but the first.
    """

    genes: Genomes
    elites: NDArray[np.float32]


def made_by_people(rig: Rig, params: SearchParams, faces: Faces, emotion: str) -> Made:
    """Simulate people with an emotion in mind, each with a face of their own, by the published search.

    Args:
        rig: the face model.
        params: the search at hand, of which only the genes count.
        faces: from (B, G) genomes to (B, K) weights.
        emotion: one of `EMOTIONS`.
    """
    minds = people(rig, params.active, emotion, PARTICIPANTS)
    entropy = (SEED, _SEARCH_STREAM, EMOTIONS.index(emotion))
    elites = simulate(Experiment(published(params), faces, cosine_distance, minds), entropy, PARTICIPANTS)
    return Made(elites.genes, elites.weights[:, 1:].reshape(-1, elites.weights.shape[-1]))


def published(params: SearchParams) -> SearchParams:
    """Return the paper's settings over the genes of a search."""
    sets = params.initial_sets or (FaceSet("any", params.active),)
    return SearchParams(params.gene_count, params.active, sets, random_genes=min(6, len(params.active)))


def starts(rig: Rig, params: SearchParams) -> Mapping[str, Genomes]:
    """Return fixed first populations, (10, G), without the gene of target 1, as the paper's are."""
    return {name: _start(rig, params, counts) for name, counts in STARTS.items()}


def _start(rig: Rig, params: SearchParams, counts: tuple[int, int]) -> Genomes:
    avoided = {i for i, name in enumerate(rig.gene_names) if name in TARGETS["target 1"]}
    usable = [i for i in params.active if i not in avoided]
    rng = np.random.default_rng((SEED, _START_STREAM, *counts))
    population = np.zeros((10, params.gene_count))
    least, most = (min(count, len(usable)) for count in counts)
    for face in population:
        chosen = rng.permutation(usable)[: rng.integers(least, most + 1)]
        face[chosen] = rng.random(len(chosen))
    return population
