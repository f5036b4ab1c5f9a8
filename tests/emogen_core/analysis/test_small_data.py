"""However few faces there are, every function answers, without a warning, and never with NaN."""

from dataclasses import fields, is_dataclass

import numpy as np
import pytest

from emogen_core.analysis.cells import summaries
from emogen_core.analysis.comparisons import controlled, means_differ, values_differ
from emogen_core.analysis.distances import beside, distances_between, distances_within
from emogen_core.analysis.effects import effect
from emogen_core.analysis.enough import Result
from emogen_core.analysis.genes import gene_differences
from emogen_core.analysis.groups import dispersions, intensities
from emogen_core.analysis.icc import icc, icc_of_columns
from emogen_core.analysis.independence import agreement, head_effect
from emogen_core.analysis.matching import Judgements, match
from emogen_core.analysis.mixture import mixture
from emogen_core.analysis.process import process
from emogen_core.analysis.proxy import convergence, proxy
from emogen_core.analysis.recorded import joined
from emogen_core.analysis.reliability import reliability, retest
from emogen_core.designs.population import names
from tests.emogen_core.analysis.studies import Simulated, drawn


def numbers(told):
    """Yield every number that a result tells."""
    if is_dataclass(told):
        for one in fields(told):
            yield from numbers(getattr(told, one.name))
    elif isinstance(told, tuple | list):
        for one in told:
            yield from numbers(one)
    elif isinstance(told, dict):
        yield from numbers(list(told.values()))
    elif isinstance(told, np.ndarray) and told.dtype.kind == "f":
        yield from told.ravel().tolist()
    elif isinstance(told, float):
        yield told


def everything(first, second, rng):
    """Return what all functions say of two groups of faces."""
    groups, both = [first, second], joined(first, second)
    again = drawn(first.weights[::-1], first.people, repetitions=1)
    heads = joined(first, drawn(second.weights, second.people, identities="male"))
    comparisons = [means_differ(groups, rng), *(values_differ(of(groups), rng) for of in (intensities, dispersions))]
    pairs = retest(joined(first, again))
    named = np.arange(len(both)) % 2 == 0
    return [
        *comparisons, controlled(dict(enumerate(comparisons))), gene_differences(*groups, rng),
        *(effect(of(groups)) for of in (intensities, dispersions)),
        beside(distances_within(first, rng), Simulated()), distances_between(*groups, rng),
        proxy(first, Simulated()), convergence(first), *summaries(both, lambda _identity, genes: genes),
        reliability(pairs, rng, Simulated()), icc(np.stack([pairs.first[:, 0], pairs.second[:, 0]], 1)),
        *icc_of_columns(pairs.first, pairs.second), agreement(heads, rng), head_effect(heads, rng),
        match(Judgements(both.people, both.emotions, both.weights[::-1], named), both, rng, 99),
        mixture(both.weights, 1), *(process(path) for path in first.elites),
    ]  # fmt: skip


@pytest.mark.parametrize("kind", ["different", "alike", "neutral"])
@pytest.mark.parametrize("people", range(8))
@pytest.mark.parametrize("prefix", ["p", "q"])
def test_no_number_is_nan_and_what_is_missing_is_said(people, kind, prefix):
    faces = {"different": np.random.default_rng(1).random((2, people, 4)), "alike": np.full((2, people, 4), 0.3)}
    first, second = faces.get(kind, np.zeros((2, people, 4)))
    told = everything(drawn(first), drawn(second, names(people, prefix)), np.random.default_rng(2))
    assert np.isfinite(list(numbers(told))).all()
    for result in told:
        if isinstance(result, Result) and people < 2:
            assert not result.enough, result
        if isinstance(result, Result) and not result.enough:
            assert str(result.lacks).startswith("needs ")
            assert getattr(result, "p", None) is None
            assert getattr(result, "low", None) is None
