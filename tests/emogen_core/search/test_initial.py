"""The initial population as the paper's protocol says."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.search.initial import initial_population
from tests.emogen_core.search.space import GENES, SETS, space


@given(st.integers(0, 2**64))
def test_protocol_shows_every_set_one_arbitrary_and_one_neutral_face(seed: int) -> None:
    population = initial_population(space(activation=(3, 8)), seed, attempt=0)
    counts = Counter(population.origins)
    assert counts["arbitrary"] == counts["neutral"] == 1
    assert sum(counts[f"protocol:{face_set.name}"] for face_set in SETS) == 8
    for genes, origin in zip(population.genes, population.origins, strict=True):
        pool = {f"protocol:{face_set.name}": face_set.genes for face_set in SETS}.get(origin, range(GENES - 2))
        active = set(np.flatnonzero(genes))
        assert active <= set(pool)
        assert len(active) == 0 if origin == "neutral" else 3 <= len(active) <= 8


def test_faces_stand_in_random_order() -> None:
    places = {initial_population(space(), seed, 0).origins.index("neutral") for seed in range(200)}
    assert places == set(range(10))


def test_fixed_population_is_shown_as_given_but_for_genes_switched_off() -> None:
    given_genes = np.random.default_rng(5).random((10, GENES))
    fixed = tuple(map(tuple, given_genes.tolist()))
    population = initial_population(space(initialisation="fixed", fixed_population=fixed), 1, 0)
    assert np.array_equal(population.genes[:, :18], given_genes[:, :18])
    assert not population.genes[:, 18:].any()
    assert set(population.origins) == {"fixed"}


@pytest.mark.parametrize("activation", [(1, 3), (8, 16)])
def test_activation_range_is_kept(activation: tuple[int, int]) -> None:
    counts = {
        np.count_nonzero(genes)
        for seed in range(50)
        for genes, origin in zip(*_faces(seed, activation), strict=True)
        if origin == "arbitrary"
    }
    assert counts == set(range(activation[0], activation[1] + 1))


def _faces(seed: int, activation: tuple[int, int]) -> tuple[np.ndarray, tuple[str, ...]]:
    population = initial_population(space(activation=activation), seed, 0)
    return population.genes, population.origins
