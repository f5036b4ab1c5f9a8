"""Candidates, mean faces, and faces as they may be shown."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.search.preference.proposals import (
    CROSSED,
    FAINT,
    GRID,
    LEAST_STRONGEST,
    MOST_ACTIVE,
    PAIRS,
    PARTS,
    SPARSE,
    TRIPLES,
    mean_face,
    means_of_many,
    pool,
    shaped,
)
from emogen_core.search.preference.sample import Sample, from_rows
from emogen_core.search.preference.utility import COSINE, VERTEX
from tests.emogen_core.search.preference.beliefs import GENES, draws, space


def judged_by(sample: Sample, metric: int) -> Sample:
    return Sample(sample.genes, sample.log_tau, np.full_like(sample.metric, metric))


def test_the_pool_holds_every_kind_within_range() -> None:
    sample, elite = draws(48), np.linspace(0, 0.9, GENES)
    made, origins = pool(sample, elite, np.random.default_rng(0))
    wanted = {"draw": 48, "draws-mean": PAIRS + TRIPLES, "elite-draw": CROSSED, "part": PARTS, "random": SPARSE}
    assert Counter(origins) == wanted
    assert ((made >= 0) & (made < 1)).all()
    kinds = np.array(origins)
    assert ((made[kinds == "elite-draw"][:, None] == elite) | (made[kinds == "elite-draw"] != elite)[:, None]).all()
    parts, drawn = made[kinds == "part"], sample.genes
    assert (np.count_nonzero(parts, axis=1) <= 6).all()
    assert all(((part == drawn) | (part == 0)).all(axis=1).any() for part in parts)
    assert (np.count_nonzero(made[kinds == "random"], axis=1) <= 7).all()


def test_mixtures_take_every_gene_from_the_elite_or_from_one_draw() -> None:
    sample, elite = draws(48), np.linspace(0.01, 0.9, GENES)
    made, origins = pool(sample, elite, np.random.default_rng(0))
    mixed = made[np.array(origins) == "elite-draw"]
    fits = (mixed[:, None] == elite) | (mixed[:, None] == sample.genes)
    assert fits.all(axis=2).any(axis=1).all()
    assert (mixed == elite).mean() == pytest.approx(0.5, abs=0.15)


@pytest.mark.parametrize("metric", [COSINE, VERTEX])
def test_the_mean_face_has_the_direction_nearest_to_all_draws_and_their_median_norm(metric: int) -> None:
    sample = judged_by(draws(48), metric)
    sample.genes[:, 1] = 0.7
    mean, rng = mean_face(space(), sample), np.random.default_rng(1)
    form = space().products[metric]
    norms = np.sqrt(np.einsum("ca,ab,cb->c", sample.genes, form, sample.genes))
    assert np.sqrt(mean @ form @ mean) == pytest.approx(np.median(norms), rel=1e-6)
    others = np.concatenate([mean[None], sample.genes, np.clip(mean + rng.normal(0, 0.02, (200, GENES)), 0, 1)])
    lengths = np.sqrt(np.einsum("fa,ab,fb->f", others, form, others))
    alike = (others @ form @ (sample.genes / norms[:, None]).T).mean(axis=1) / lengths
    assert alike.argmax() == 0


def test_the_mean_face_of_equal_draws_is_that_draw() -> None:
    one = np.round(np.linspace(0, 0.9, GENES) * GRID) / GRID
    for metric in (COSINE, VERTEX):
        sample = judged_by(Sample(np.tile(one, (5, 1)), np.zeros(5), np.zeros(5, np.intp)), metric)
        np.testing.assert_allclose(mean_face(space(), sample), one, atol=2 / GRID)
        many = means_of_many(space(), sample, 3, 2, np.random.default_rng(0))
        np.testing.assert_allclose(many, np.tile(one, (3, 1)), atol=2 / GRID)


def test_faces_of_many_draws_come_nearer_to_the_mean_face() -> None:
    sample = judged_by(draws(48), COSINE)
    mean = mean_face(space(), sample)
    apart = [
        np.linalg.norm(means_of_many(space(), sample, 20, n, np.random.default_rng(0)) - mean, axis=1).mean()
        for n in (2, 12, 48)
    ]
    assert apart[0] > 2 * apart[1] > 4 * apart[2]
    assert apart[2] < 1e-6


@given(st.integers(0, 2**32), st.integers(1, 10), st.sampled_from([COSINE, VERTEX]))
def test_shown_faces_are_plausible(seed: int, generation: int, metric: int) -> None:
    rng = np.random.default_rng(seed)
    genes = rng.random((6, 40)) * rng.random((6, 1))
    genes[0] = 0
    made = shaped(judged_by(draws(3), metric), genes, generation)
    assert not made[0].any()
    assert ((made == 0) | (made >= FAINT - 1 / GRID)).all()
    assert np.array_equal(made, np.rint(made * GRID) / GRID)
    assert made.max() < 1
    if generation <= 7:
        assert (np.count_nonzero(made, axis=1) <= MOST_ACTIVE).all()
        assert (np.sort(genes, axis=1)[:, -MOST_ACTIVE] <= np.where(made > 0, genes, 1).min(axis=1) + 1e-12)[1:].all()
    if metric == COSINE:
        strongest = made.max(axis=1)
        assert ((strongest == 0) | (strongest >= LEAST_STRONGEST - 1 / GRID)).all()


def test_draws_survive_as_plain_rows() -> None:
    sample = draws(7)
    again = from_rows(sample.rows())
    assert np.array_equal(again.genes, sample.genes)
    assert np.array_equal(again.log_tau, sample.log_tau)
    assert np.array_equal(again.metric, sample.metric)
