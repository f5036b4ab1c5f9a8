"""Settings that the algorithm cannot run with are refused by name."""

from __future__ import annotations

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.search import STRATEGIES, strategy
from tests.emogen_core.search.space import GENES, space


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("generations", 0),
        ("minimum", 0),
        ("maximum", 11),
        ("mutations", -1),
        ("random_genes", 0),
        ("random_genes", GENES),
        ("random_faces", 8),
        ("activation", (5, 4)),
        ("fixed_population", ((0.5,) * GENES,) * 10),
    ],
)
def test_impossible_settings_name_the_field(option: str, value: object) -> None:
    with pytest.raises(InvalidInputError, match=option):
        space(**{option: value})


@pytest.mark.parametrize("genomes", [(), ((0.5,) * GENES,) * 9, ((1.0,) * GENES,) * 10])
def test_fixed_start_needs_ten_whole_genomes(genomes: tuple[tuple[float, ...], ...]) -> None:
    with pytest.raises(InvalidInputError, match="fixed_population"):
        space(initialisation="fixed", fixed_population=genomes)


def test_unknown_strategy_lists_the_known_ones() -> None:
    with pytest.raises(InvalidInputError, match="emogen"):
        strategy("simulated annealing")
    assert all(name == strategy(name).NAME for name in STRATEGIES)
