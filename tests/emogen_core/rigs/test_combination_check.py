"""The correctives of the bundled rig on random faces, against the bars; and what a report counts."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs import combination_check
from emogen_core.rigs.combination_check import combination_report, pooled
from emogen_core.rigs.random_faces import active_genes, random_genes

RIG = load_bundled_rig()


@pytest.fixture(autouse=True)
def few_are_searched_for_piercing_edges(monkeypatch):
    monkeypatch.setattr(combination_check, "PIERCED_FACES", 2)


def test_random_faces_are_less_broken_with_correctives():
    report = combination_report(RIG, "female", 200, 77)
    assert report["flips_fell"] >= 0.25
    assert report["stretched_fell"] >= 0.2
    assert report["faces_better"] >= 10 * report["faces_worse"]
    assert report["without"]["flips"] < 3


def test_a_rig_without_correctives_gains_nothing():
    core = len(RIG.core_shapes)
    bare = replace(RIG, combinations=(), collision_shapes=(), offsets=RIG.offsets[:core], adjustments={})
    report = combination_report(bare, "female", 6, 3)
    assert report["with"] == report["without"]
    assert report["flips_fell"] == report["piercing_fell"] == report["faces_better"] == report["faces_worse"] == 0


def test_a_report_is_of_its_seed_and_of_a_head_that_exists():
    assert combination_report(RIG, "female", 3, 4) == combination_report(RIG, "female", 3, 4)
    with pytest.raises(InvalidInputError, match="identity"):
        combination_report(RIG, "nobody", 3, 4)


def test_heads_are_pooled_face_by_face():
    one, other = (combination_report(RIG, head, 6, 4) for head in ("female", "male"))
    assert pooled([one]) == one
    both = pooled([one, other])
    assert both["with"]["flips"] == pytest.approx((one["with"]["flips"] + other["with"]["flips"]) / 2, abs=1e-3)
    assert both["flips_fell"] == pytest.approx(1 - both["with"]["flips"] / both["without"]["flips"], abs=1e-3)
    assert both["faces_better"] == one["faces_better"] + other["faces_better"]


def test_a_single_gene_is_untouched():
    weights = shape_weights(RIG, np.eye(len(RIG.genes)))
    assert not weights[:, len(RIG.core_shapes) :].any()


def test_two_genes_wake_exactly_their_pair():
    pairs = list(combinations(active_genes(RIG).tolist(), 2))
    genes = np.zeros((len(pairs), len(RIG.genes)))
    for row, (i, j) in zip(genes, pairs, strict=True):
        row[i], row[j] = 0.6, 0.9
    woken = shape_weights(RIG, genes)[:, len(RIG.core_shapes) :]
    parents = [frozenset(RIG.gene_indices(c.parents).tolist()) for c in RIG.combinations]
    for pair, row in zip(pairs, woken, strict=True):
        expected = [0.54 if frozenset(pair) == both else 0 for both in parents]
        assert row[: len(parents)] == pytest.approx(expected, abs=1e-6)


def test_weights_are_products_but_for_one_factor_a_family():
    genes = random_genes(RIG, 60, 5)
    weights = shape_weights(RIG, genes)[:, len(RIG.core_shapes) :]
    products = np.stack([genes[:, RIG.gene_indices(c.parents)].prod(1) for c in RIG.combinations], 1)
    families = {combination.family for combination in RIG.combinations}
    for name in families:
        columns = [i for i, c in enumerate(RIG.combinations) if c.family == name]
        weight, whole = weights[:, columns], products[:, columns]
        factor = weight.sum(1) / np.maximum(whole.sum(1), 1e-9)
        assert weight == pytest.approx(factor[:, None] * whole, abs=1e-5)
        assert factor.max() <= 1 + 1e-5
        assert name is not None or np.allclose(factor[whole.any(1)], 1)
