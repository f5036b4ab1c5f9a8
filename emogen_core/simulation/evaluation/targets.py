"""The faces that simulated participants have in mind (EmoGen 2021, figures 6 and 18).

The paper's rig is not public, so its targets are rebuilt from what is said of them: target 1 has one shape, an open
jaw; target 2 has twelve; target 3 is target 1 and two more, a wrinkled nose among them. Targets belong to the rig and
to the genes that a search may move, not to its other settings nor to a seed: settings are compared by the same faces.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    Genomes = NDArray[np.float64]
    Genes = Sequence[int]

TARGETS: Mapping[str, Mapping[str, float]] = {
    "target 1": {"jawOpen": 1.0},
    # Disgust and fear at once: twelve genes of which no emotion of the first faces has more than half.
    "target 2": {
        "browInnerUp": 0.6, "browKnit": 0.6, "lidsSlit": 0.4, "cheekRaise": 0.4, "noseWrinkle": 0.7,
        "noseWingRaise": 0.6, "upperLipRaise": 0.8, "upperLipElevate": 0.4, "mouthStretch": 0.6, "mouthDepress": 0.5,
        "lowerLipDown": 0.4, "lipsPart": 0.6,
    },
    "target 3": {"jawOpen": 1.0, "noseWrinkle": 0.9, "browDown": 0.6},
}  # fmt: skip
EMOTIONS = ("happy", "sad", "angry", "fearful")
"""The emotions that the paper's 240 participants had in mind."""
PEOPLE = 50
"""People in the target `people`, each with a face of their own."""
SEED = 2021
"""Of everything that belongs to the rig and not to an evaluation."""
_KEPT, _STRENGTH, _SHARE = 0.5, 0.2, 0.3
"""Chance that a person's face has a gene of the set; least strength of a face; least share of a gene in it."""
_OTHER_GENES, _OTHER_STRENGTH = (8, 20), 0.7
"""Least and most genes outside of its set that a person's face of an emotion has, and the most that one is at work."""
_TARGET_STREAM, _PEOPLE_STREAM = 1, 2


def targets(rig: Rig, active: Genes) -> dict[str, Genomes]:
    """Return the three targets as (G,) genomes, and `people`, the (50, G) faces of people with an emotion in mind.

    Args:
        rig: the face model.
        active: the genes that a search may move; all others stay 0 in every target.
    """
    some = [people(rig, active, emotion, -(-PEOPLE // len(EMOTIONS))) for emotion in EMOTIONS]
    crowd = np.stack(some, axis=1).reshape(-1, len(rig.genes))[:PEOPLE]
    return {**{name: _named(rig, active, genes) for name, genes in TARGETS.items()}, "people": crowd}


def _named(rig: Rig, active: Genes, genes: Mapping[str, float]) -> Genomes:
    """Return a target as far as the search can reach it.

    Where less than half of its genes can be reached, as on an imported rig, as many others are drawn once instead.
    """
    genome = np.zeros(len(rig.genes))
    index = {name: i for i, name in enumerate(rig.gene_names)}
    reached = {index[name]: strength for name, strength in genes.items() if index.get(name) in active}
    if 2 * len(reached) < len(genes):
        rng = np.random.default_rng((SEED, _TARGET_STREAM, len(genes)))
        reached = dict(zip(rng.permutation(active)[: len(genes)].tolist(), genes.values(), strict=False))
    genome[list(reached)] = list(reached.values())
    return genome


def people(rig: Rig, active: Genes, emotion: str, count: int) -> Genomes:
    """Return (count, G) faces that different people have in mind for an emotion; the first ones are always the same.

    Everybody's has the genes of the rig's emotion set, each at its strength or less, some left out, and some others:
    people agree on what matters and differ in the rest. How much they differ is set by what the paper tells of its
    people: the mean of what they made for "happy" has 32 shapes at .1 or more (on the bundled rig so has ours). For an
    emotion that the rig does not have, only the others.

    Args:
        rig: the face model.
        active: the genes that a search may move; all others stay 0.
        emotion: one of `EMOTIONS`.
        count: how many people.
    """
    strengths = np.zeros(len(rig.genes))
    if emotion in rig.emotion_sets:
        found = rig.emotion_sets[emotion]
        strengths[rig.gene_indices(found.genes)] = found.strengths
    stream = np.random.SeedSequence((SEED, _PEOPLE_STREAM, EMOTIONS.index(emotion)))
    made = [_person(strengths, active, np.random.default_rng(own)) for own in stream.spawn(count)]
    return np.stack(made)


def _person(strengths: Genomes, active: Genes, rng: np.random.Generator) -> Genomes:
    genome = strengths * (rng.random(len(strengths)) < _KEPT)
    genome *= _STRENGTH + (1 - _STRENGTH) * rng.random()
    genome *= _SHARE + (1 - _SHARE) * rng.random(len(strengths))
    least, most = _OTHER_GENES
    extra = rng.permutation(active)[: rng.integers(least, most + 1)]
    genome[extra] = np.maximum(genome[extra], _OTHER_STRENGTH * rng.random(len(extra)))
    genome[np.setdiff1d(np.arange(len(strengths)), active)] = 0
    return genome
