"""How good faces look: the two formulas, by another way."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.search.params import search_params
from emogen_core.search.preference.utility import COSINE, VERTEX, space_of, utilities
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.similarity.linear import vertex_rms
from tests.emogen_core.search.preference.beliefs import draws, faces
from tests.emogen_core.search.space import space as search
from tests.rig_factory import small_rig

RIG = small_rig()


def test_utilities_on_a_rig_are_the_catalogue_s_metrics_without_correctives() -> None:
    params = search_params(RIG)
    space, genes = space_of(params), len(params.active)
    targets, shown = draws(6, genes=genes), faces(20, genes=genes)
    targets.genes[:, 0] = 0.5
    whole = np.zeros((26, params.gene_count))
    whole[:, list(params.active)] = np.concatenate([targets.genes, shown])
    core = whole @ RIG.gene_to_core
    meant, seen = core[:6, None], core[None, 6:]
    rms = vertex_rms(RIG.offsets[: core.shape[1]])

    by_cosine = utilities(space, shown, targets.genes, np.full(6, COSINE))
    by_vertex = utilities(space, shown, targets.genes, np.full(6, VERTEX))
    np.testing.assert_allclose(by_cosine, 1 - cosine_distance(seen, meant), atol=1e-6)
    np.testing.assert_allclose(by_vertex, -rms(seen, meant) / rms(np.zeros_like(meant), meant), atol=1e-5)
    assert (by_cosine[:, 0] == 0).all(), "the neutral face has nothing of any target"
    assert by_vertex[:, 0] == pytest.approx(-1)


def test_each_target_is_judged_by_its_own_metric() -> None:
    space = space_of(search())
    targets, shown = draws(8, genes=space.genes), faces(10, genes=space.genes)
    mixed = utilities(space, shown, targets.genes, targets.metric)
    for metric in (COSINE, VERTEX):
        alone = utilities(space, shown, targets.genes, np.full(8, metric))
        assert np.array_equal(mixed[targets.metric == metric], alone[targets.metric == metric])


def test_a_space_of_a_rig_has_its_pairs_and_both_products_weigh_as_much() -> None:
    params = search_params(RIG)
    space = space_of(params)
    pairs = [len(RIG.genes[i].members) for i in params.active]
    assert space.multiplicities.tolist() == pairs
    assert np.trace(space.products[VERTEX]) == pytest.approx(sum(pairs))
