"""Targets of a complexity, and distances relative to them."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.search.params import search_params
from emogen_core.similarity.linear import vertex_rms
from emogen_core.simulation.complexity import COUNT, NOTABLE, PURPOSES, Relative, drawn, name_of, named
from tests.rig_factory import small_rig

RIG = small_rig(genes=24)
ACTIVE = search_params(RIG, gaze=False).active


@pytest.mark.parametrize("genes", [1, 3, 12])
def test_sparse_targets_have_as_many_genes_and_every_second_those_of_an_emotion(genes: int) -> None:
    targets = drawn(RIG, ACTIVE, genes, 8, seed=1)
    assert (np.count_nonzero(targets, axis=1) == genes).all()
    assert not targets[:, [i for i in range(24) if i not in ACTIVE]].any()
    assert targets[::2][targets[::2] > 0].min() >= 0.4
    assert targets.max() < 1
    for number, emotion in enumerate(RIG.emotion_sets.values()):
        own = RIG.gene_indices(emotion.genes)
        assert np.count_nonzero(targets[2 * number + 1, own]) == min(genes, len(own))


def test_rich_targets_use_every_gene_and_have_as_many_notable_ones() -> None:
    targets = drawn(RIG, ACTIVE, 21, 6, seed=1)
    assert (np.count_nonzero(targets, axis=1) == len(ACTIVE)).all()
    assert ((targets >= NOTABLE - 1e-12).sum(axis=1) >= 21).all()
    assert targets.max() <= 1


def test_another_seed_is_another_set_of_targets() -> None:
    assert np.array_equal(drawn(RIG, ACTIVE, 3, 4, seed=1), drawn(RIG, ACTIVE, 3, 4, seed=1))
    assert not np.array_equal(drawn(RIG, ACTIVE, 3, 4, seed=1), drawn(RIG, ACTIVE, 3, 4, seed=2))


def test_relative_distances_are_1_for_the_neutral_face_and_free_of_units() -> None:
    rng = np.random.default_rng(0)
    shapes = len(RIG.shape_names)
    weights, target = rng.random((5, shapes)), rng.random((1, shapes))
    weights[0] = 0
    near, far = (Relative(vertex_rms(scale * RIG.offsets))(weights, target) for scale in (1, 1000))
    np.testing.assert_allclose(near, far, rtol=1e-6)
    assert near[0] == pytest.approx(1)
    assert Relative(vertex_rms(RIG.offsets))(target, target)[0] == 0


def test_named_targets_are_those_of_their_purpose() -> None:
    found = {name: named(RIG, ACTIVE, name) for name in (name_of(3, "tuning"), name_of(3, "held-out"))}
    for purpose, seed in PURPOSES.items():
        assert np.array_equal(found[name_of(3, purpose)], drawn(RIG, ACTIVE, 3, COUNT, seed))
    assert len(set(PURPOSES.values())) == 2
    with pytest.raises(KeyError):
        named(RIG, ACTIVE, "reported, 3 genes")
