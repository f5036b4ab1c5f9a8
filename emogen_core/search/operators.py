"""The operators of EmoGen 2021, section III-B, on genes; random draws come in as arrays, so a batch is one call.

Symbols: ``G`` genes; ``...`` any leading batch axes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def crossover(
    first: NDArray[np.float64], second: NDArray[np.float64], coins: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Uniform crossover, eq. 7: the second parent's gene where the (..., G) coin in [0, 1) is below 1/2."""
    return np.where(coins < 0.5, second, first)


def mutate(genes: NDArray[np.float64], indices: NDArray[np.intp], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mutation, eq. 8: set the (..., m) indices, which may coincide, to the values; the last one drawn stays."""
    mutated = genes.copy()
    for column in range(indices.shape[-1]):  # in order: put_along_axis leaves open which of two equal indices wins
        np.put_along_axis(mutated, indices[..., column, None], values[..., column, None], axis=-1)
    return mutated


def average(genes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Whole arithmetic recombination, eq. 9: the mean of (..., S, G) over the S faces."""
    return np.asarray(genes.mean(axis=-2))


def scatter(count: int, indices: NDArray[np.intp], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Random face, eq. 10: (..., G = count) genomes that are zero but for the (..., x) distinct indices."""
    genes = np.zeros((*indices.shape[:-1], count))
    np.put_along_axis(genes, indices, values, axis=-1)
    return genes
