"""Settings that the algorithm cannot run with are refused by name."""

from __future__ import annotations

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.search import STRATEGIES, Choice, strategy
from emogen_core.search.params import search_params
from tests.emogen_core.search.space import GENES, space
from tests.rig_factory import small_rig


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("generations", 0),
        ("stop_at", 0.0),
        ("stop_at", 0.51),
        ("stop_at", float("nan")),
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


@pytest.mark.parametrize("least", [0, 6])
def test_a_trial_that_may_end_early_has_a_first_generation_on_which_it_may(least: int) -> None:
    with pytest.raises(InvalidInputError, match="least_generations"):
        space(generations=5, stop_at=0.1, least_generations=least)
    assert space(generations=2).least_generations > 2, "of no concern to a trial that does not"


@pytest.mark.parametrize("genomes", [(), ((0.5,) * GENES,) * 9, ((1.0,) * GENES,) * 10])
def test_fixed_start_needs_ten_whole_genomes(genomes: tuple[tuple[float, ...], ...]) -> None:
    with pytest.raises(InvalidInputError, match="fixed_population"):
        space(initialisation="fixed", fixed_population=genomes)


def test_unknown_strategy_lists_the_known_ones() -> None:
    with pytest.raises(InvalidInputError, match="emogen"):
        strategy("simulated annealing")
    assert all(name == strategy(name).NAME for name in STRATEGIES)


def test_a_search_over_few_genes_draws_all_of_them_unless_it_says_how_many() -> None:
    rig = small_rig()
    few = rig.gene_names[4:]
    assert search_params(rig).random_genes == 6
    assert search_params(rig, excluded=few).random_genes == 4
    with pytest.raises(InvalidInputError, match="random_genes"):
        search_params(rig, excluded=few, random_genes=6)


@pytest.mark.parametrize("name", STRATEGIES)
def test_only_what_weighs_all_answers_has_an_estimate_and_not_before_the_first(name: str) -> None:
    search, params = strategy(name), space()
    state = search.init(params, 5)
    assert search.estimate(params, state) is None
    face = search.estimate(params, search.tell(params, state, Choice((2, 3), 2)))
    assert (face is not None) == (name == "preference")
    assert face is None or (face.shape == (GENES,) and face.any() and ((face >= 0) & (face < 1)).all())
