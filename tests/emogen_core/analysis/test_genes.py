"""Which genes differ."""

import numpy as np
import pytest

from emogen_core.analysis.comparisons import values_differ
from emogen_core.analysis.genes import gene_differences
from emogen_core.analysis.groups import grouped
from emogen_core.designs.population import names
from tests.emogen_core.analysis.studies import drawn


def rng(seed=1):
    return np.random.default_rng(seed)


def genes(seed, count=6):
    values = rng(seed).random((count, 5)) * (rng(seed + 50).random((count, 5)) < 0.7)
    values[:, 3] = 0
    return values


@pytest.mark.parametrize("second", ["p", "q"])
def test_every_gene_is_tested_as_it_would_be_alone(second):
    groups = [drawn(genes(1)), drawn(genes(2, 6 if second == "p" else 4), names(6 if second == "p" else 4, second))]
    found = gene_differences(*groups, rng())
    assert found.still == (3,)
    assert sorted([*(one.gene for one in found.genes), *found.rare]) == [0, 1, 2, 4]
    for gene in found.rare:
        alone = grouped([group.genes[:, gene] for group in groups], [group.people for group in groups])
        assert values_differ(alone, rng()).lacks.what == "distinguishable permutations"
    for one in found.genes:
        alone = grouped([group.genes[:, one.gene] for group in groups], [group.people for group in groups])
        assert one.p == pytest.approx(values_differ(alone, rng()).p)
        assert one.q >= one.p


def test_the_gene_that_differs_is_found_and_its_effect_has_the_right_sign():
    first, second = genes(3, 20), genes(4, 20)
    second[:, 2] += 2
    found = gene_differences(drawn(first), drawn(second, names(20, "q")), rng(), 999)
    assert [one.gene for one in found.genes if one.q <= 0.05] == [2]
    own = found.genes[2]
    assert own.effect.high < 0
    assert own.effect.difference == pytest.approx(first[:, 2].mean() - second[:, 2].mean())


@pytest.mark.parametrize(
    ("count", "second", "what"),
    [
        (3, "q", "distinguishable permutations"),
        (5, "p", "distinguishable permutations"),
        (1, "q", "people"),
        (0, "q", "people"),
    ],
)
def test_few_people_show_nothing(count, second, what):
    found = gene_differences(drawn(genes(1, count)), drawn(genes(2, count), names(count, second)), rng())
    assert (found.genes, found.lacks.what) == ((), what)


def test_faces_that_are_all_alike_have_only_still_genes():
    found = gene_differences(drawn(np.ones((6, 2))), drawn(np.ones((6, 2)), names(6, "q")), rng())
    assert (found.genes, found.still) == ((), (0, 1))
    assert str(found.lacks) == "needs faces that differ, but all faces are the same"
