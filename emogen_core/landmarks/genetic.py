"""The genetic algorithm of Zhu & Lee (2006, section 3), as published.

The population begins as the bank of examples. A generation draws three individuals; the one with the lowest fitness
(`mean_cosine`) is replaced by a child of the other two, by midpoint, line or BLX-alpha crossover. The child is scaled
so that its points move as far in total as those of the input. After 70 generations the best individual of all is the
answer.

Every individual is a sum of examples, so we breed the (n,) weights of that sum in the place of whole meshes: crossover
and scaling are linear, and the outcome is the same. Where the paper is silent: the first population counts as a
generation, and a member of it that wins is scaled to the input as a child is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.landmarks.fitness import mean_cosine

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

GENERATIONS = 70
DRAWN = 3
ALPHA = 0.2
"""The alpha of BLX-alpha that the authors found best."""
CROSSOVERS = ("midpoint", "line", "blx")


def evolve(examples: Floats, target: Floats, crossover: str, rng: np.random.Generator) -> Floats:
    """Return (n,) weights of the examples in the best expression.

    Args:
        examples: (n, m, 3) motions of the m moving points in n >= 3 examples.
        target: (m, 3) motions wanted, none of them zero.
        crossover: one of `CROSSOVERS`.
        rng: source of randomness; consumed.
    """
    drawn = rng.random((GENERATIONS, len(examples))).argsort(axis=1)[:, :DRAWN]
    shares = parent_shares(crossover, rng.random(GENERATIONS))
    population = np.eye(len(examples))
    fitness = mean_cosine(examples, target)
    best, best_fitness = population[fitness.argmax()].copy(), float(fitness.max())
    for three, share in zip(drawn, shares, strict=True):
        worst, *parents = three[fitness[three].argsort(kind="stable")]
        # The parents keep the order in which they were drawn.
        first, second = (one for one in three if one in parents)
        child = rescaled(share * population[first] + (1 - share) * population[second], examples, target)
        population[worst] = child
        fitness[worst] = mean_cosine(np.tensordot(child, examples, 1), target)
        if fitness[worst] > best_fitness:
            best, best_fitness = child, float(fitness[worst])
    return rescaled(best, examples, target)


def parent_shares(crossover: str, draws: Floats) -> Floats:
    """Return how much of the first parent each child has; ``draws`` are uniform in [0, 1).

    BLX-alpha with ``D = alpha (P2 - P1)`` is ``t (P1 - D) + (1 - t) (P2 + D)``: of the first parent
    ``t (1 + alpha) - (1 - t) alpha``, of the second what is left to 1.
    """
    if crossover == "midpoint":
        return np.full_like(draws, 0.5)
    alpha = ALPHA if crossover == "blx" else 0.0
    return draws * (1 + 2 * alpha) - alpha


def rescaled(weights: Floats, examples: Floats, target: Floats) -> Floats:
    """Return (n,) weights scaled so that the points move as far in total as in the target."""
    moved = np.linalg.norm(np.tensordot(weights, examples, 1), axis=-1).sum()
    if moved == 0:
        return weights
    scaled: Floats = weights * (np.linalg.norm(target, axis=-1).sum() / moved)
    return scaled
