"""The operators alone, on batches."""

from __future__ import annotations

import numpy as np

from emogen_core.search.operators import average, crossover, mutate, scatter

RNG = np.random.default_rng(0)


def test_crossover_takes_the_second_parent_below_one_half() -> None:
    child = crossover(np.zeros(4), np.ones(4), np.array([0.0, 0.4999, 0.5, 0.999]))
    assert child.tolist() == [1, 1, 0, 0]


def test_mutation_leaves_the_parents_alone_and_lets_the_last_of_equal_indices_win() -> None:
    genes = np.zeros((2, 5))
    mutated = mutate(genes, np.array([[3, 3], [0, 4]]), np.array([[0.1, 0.2], [0.3, 0.4]]))
    assert not genes.any()
    assert mutated.tolist() == [[0, 0, 0, 0.2, 0], [0.3, 0, 0, 0, 0.4]]


def test_batches_equal_single_calls() -> None:
    faces, indices, values = RNG.random((6, 3, 9)), RNG.integers(0, 9, (6, 2)), RNG.random((6, 2))
    batch = mutate(average(faces), indices, values)
    single = [mutate(average(f), i, v) for f, i, v in zip(faces, indices, values, strict=True)]
    assert np.array_equal(batch, np.stack(single))


def test_scatter_is_zero_but_for_the_indices() -> None:
    genes = scatter(6, np.array([4, 1]), np.array([0.5, 0.25]))
    assert genes.tolist() == [0, 0.25, 0, 0, 0.5, 0]
