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
    VISIBLE,
    mean_face,
    means_of_many,
    pool,
    shaped,
    visible,
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


def test_by_composition_the_mean_face_has_the_direction_nearest_to_all_draws() -> None:
    sample = judged_by(draws(48), COSINE)
    sample.genes[:, 1] = 0.7
    mean, rng = mean_face(space(), sample), np.random.default_rng(1)
    form = space().products[COSINE]
    norms = np.sqrt(np.einsum("ca,ab,cb->c", sample.genes, form, sample.genes))
    others = np.concatenate([mean[None], sample.genes, np.clip(mean + rng.normal(0, 0.02, (200, GENES)), 0, 1)])
    lengths = np.sqrt(np.einsum("fa,ab,fb->f", others, form, others))
    alike = (others @ form @ (sample.genes / norms[:, None]).T).mean(axis=1) / lengths
    assert alike.argmax() == 0


@pytest.mark.parametrize("count", [1, 2, 5, 11])
@pytest.mark.parametrize("scale", [0.97, 0.2])
def test_by_composition_mean_faces_are_as_strong_as_so_many_genes_are_beforehand(count: int, scale: float) -> None:
    several = np.random.default_rng(0).random((2000, count))
    strongest = 1 if count <= 10 else 2
    beforehand = np.sort(several, axis=1)[:, -strongest:].mean()
    faces = np.zeros((len(several), GENES))
    faces[:, :count] = several * scale
    found = np.array([mean_face(space(), Sample(face[None], np.zeros(1), np.array([COSINE]))) for face in faces])
    assert np.sort(found, axis=1)[:, -strongest:].mean() == pytest.approx(beforehand, abs=0.05)
    assert not found[:, count:].any()


def test_by_composition_a_little_of_genes_that_are_not_meant_changes_little() -> None:
    meant = np.zeros((1, GENES))
    meant[0, 0] = 0.5
    blurred = meant + 0.1 * (np.arange(GENES) % 4 == 1)
    alone, among = (mean_face(space(), Sample(genes, np.zeros(1), np.array([COSINE]))) for genes in (meant, blurred))
    assert alone[0] == 0.5
    assert among[0] == pytest.approx(0.5, abs=0.1)


def test_by_composition_a_dense_face_keeps_its_direction_but_for_its_strongest_genes() -> None:
    one = np.linspace(0.1, 0.9, GENES)
    mean = mean_face(space(), Sample(np.tile(one, (4, 1)), np.zeros(4), np.full(4, COSINE)))
    assert mean.max() < 1
    full = mean == mean.max()
    factors = mean[~full] / one[~full]
    assert factors == pytest.approx(factors[0], rel=1e-5)


def test_by_vertices_the_mean_face_is_as_strong_as_the_draws() -> None:
    sample = judged_by(draws(48), VERTEX)
    sample.genes[:, 1] = 0.7
    mean, pairs = mean_face(space(), sample), space().multiplicities
    assert mean[1] == pytest.approx(0.7, abs=2 / GRID)
    assert (mean**2 * pairs).sum() == pytest.approx((sample.genes**2 * pairs).sum(axis=1).mean(), rel=1e-6)
    assert (mean >= sample.genes.mean(axis=0) - 1 / GRID).all()


def test_the_mean_face_of_equal_draws_is_that_draw_or_by_composition_its_direction() -> None:
    one = np.round(np.linspace(0, 0.9, GENES) * GRID) / GRID
    for metric in (COSINE, VERTEX):
        sample = judged_by(Sample(np.tile(one, (5, 1)), np.zeros(5), np.zeros(5, np.intp)), metric)
        mean = mean_face(space(), sample)
        factor = mean.max() / one.max() if metric == COSINE else 1
        np.testing.assert_allclose(mean, one * factor, atol=2 / GRID)
        many = means_of_many(space(), sample, 3, 2, np.random.default_rng(0))
        np.testing.assert_allclose(many, np.tile(mean, (3, 1)), atol=2 / GRID)


def test_faces_of_many_draws_come_nearer_to_the_mean_face() -> None:
    sample = judged_by(draws(48), COSINE)
    mean = mean_face(space(), sample)
    apart = [
        np.linalg.norm(means_of_many(space(), sample, 20, n, np.random.default_rng(0)) - mean, axis=1).mean()
        for n in (2, 12, 48)
    ]
    assert apart[0] > 1.5 * apart[1] > 3 * apart[2]
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
    least = LEAST_STRONGEST if metric == COSINE else VISIBLE
    assert (made[1:].max(axis=1) >= least - 1 / GRID).all()
    assert all(visible(face) for face in made[1:]), "a face that was raised is not left out as elite"
    strong = genes.max(axis=1) >= least
    assert made[strong].max(axis=1) == pytest.approx(genes[strong].max(axis=1), abs=1 / GRID), "others stay as they are"


def test_a_mixture_with_a_neutral_elite_is_never_neutral() -> None:
    sample = Sample(np.eye(48, GENES) * 0.5 + np.eye(48, GENES, -12) * 0.5, np.zeros(48), np.zeros(48, np.intp))
    sample.genes[24:, 3] = 0.2
    made, origins = pool(sample, np.zeros(GENES), np.random.default_rng(0))
    mixed = made[np.array(origins) == "elite-draw"]
    assert mixed.any(axis=1).all()
    assert all((face == sample.genes).all(axis=1).any() for face in mixed[(mixed > 0).sum(axis=1) == 2])


def test_draws_survive_as_plain_rows() -> None:
    sample = draws(7)
    again = from_rows(sample.rows())
    assert np.array_equal(again.genes, sample.genes)
    assert np.array_equal(again.log_tau, sample.log_tau)
    assert np.array_equal(again.metric, sample.metric)
