"""The chains: what they keep up to date, what they converge to, and that chance comes in from outside."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.search import Choice
from emogen_core.search.preference.chains import NUMBERS, ROUND, Chains, Evidence
from emogen_core.search.preference.likelihood import arranged
from emogen_core.search.preference.sample import Sample
from emogen_core.search.preference.sampler import moved, resampled, weighed
from emogen_core.search.preference.utility import utilities
from tests.emogen_core.search.preference.beliefs import GENES, choice, draws, evidence, faces, space
from tests.emogen_core.search.preference.test_likelihood import answered

ALONE = np.zeros(24, np.intp)


def something(sample: Sample) -> Sample:
    """Draws that are not empty, as chains have them."""
    return sample.at(np.flatnonzero(sample.genes.any(axis=1)))


def numbers(rounds: int, chains: int = 24, seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).random((rounds, ROUND, NUMBERS, chains))


def test_likelihoods_of_draws_are_those_of_their_utilities() -> None:
    counts, sample = (2, 4, 1, 8), draws(60)
    looks = utilities(space(), faces(40), sample.genes, sample.metric) / np.exp(sample.log_tau)[:, None]
    usable = (np.ptp(looks, axis=1) < 60) & sample.genes.any(axis=1)  # beyond it, all chances are those of lapses
    plain = np.flatnonzero(usable)
    assert len(plain) >= 24
    sample, looks = sample.at(plain[:24]), looks[plain[:24]]
    wanted = [
        np.prod([answered(np.exp(look[10 * i :][:10]), choice(n, i)) for i, n in enumerate(counts)]) for look in looks
    ]
    np.testing.assert_allclose(weighed(space(), evidence(counts), sample, ALONE), wanted, rtol=5e-3)


def test_what_moves_keep_up_to_date_is_what_would_be_computed_from_scratch() -> None:
    chains = Chains(space(), evidence((2, 4, 4, 5)), draws(24), ALONE)
    for uniform in numbers(3):
        chains.round(uniform)
        kept = chains.dots.copy(), chains.square.copy(), chains.like.copy(), chains.on.copy()
        chains.refresh()
        for before, after in zip(kept, (chains.dots, chains.square, chains.like, chains.on), strict=True):
            np.testing.assert_allclose(before, after, rtol=1e-4, atol=1e-5)


def test_without_answers_that_tell_anything_the_chains_stay_at_the_prior() -> None:
    same = Evidence(np.zeros((1, 10, GENES)), [arranged([choice(4)])])
    before = something(draws(6000, seed=3))
    count = len(before.metric)
    after = moved(space(), same, before, np.zeros(count, np.intp), numbers(2, count))
    assert (after.genes != before.genes).any(axis=1).mean() > 0.99
    sizes = [np.bincount((one.genes > 0).sum(axis=1), minlength=GENES + 1) / count for one in (before, after)]
    np.testing.assert_allclose(sizes[1], sizes[0], atol=0.03)
    assert sizes[1][0] == 0
    on = after.genes[after.genes > 0]
    np.testing.assert_allclose(np.quantile(on, [0.1, 0.5, 0.9]), [0.1, 0.5, 0.9], atol=0.03)
    spread = [np.quantile(one.log_tau, [0.2, 0.8]) for one in (before, after)]
    np.testing.assert_allclose(spread[1], spread[0], atol=0.1)


def test_chains_from_anywhere_come_to_the_beliefs_of_weighted_draws_from_the_prior() -> None:
    meant = np.zeros((1, GENES))
    meant[0, [1, 4, 5]] = 0.9, 0.6, 0.3
    shown = faces(20, seed=7)
    ranks = [np.argsort(-looks) + 1 for looks in utilities(space(), shown, meant, np.zeros(1, np.intp)).reshape(2, 10)]
    counts = (2, 1)
    answers = [Choice(tuple(rank[:n].tolist()), int(rank[0])) for rank, n in zip(ranks, counts, strict=True)]
    told, many = Evidence(shown[None], [arranged(answers)]), draws(200_000, seed=4)
    weights = weighed(space(), told, many, np.zeros(200_000, np.intp))
    share = weights / weights.sum()
    assert 1 / (share**2).sum() > 500, "enough draws count"
    start = Sample(np.full((600, GENES), 0.5), np.full(600, -2.0), np.zeros(600, np.intp))
    after = moved(space(), told, start, np.zeros(600, np.intp), numbers(20, 600))
    for found, wanted in ((after.genes > 0, many.genes > 0), (after.genes, many.genes)):
        np.testing.assert_allclose(found.mean(axis=0), share @ wanted, atol=0.07)
    assert after.metric.mean() == pytest.approx(share @ many.metric, abs=0.08)
    assert after.log_tau.mean() == pytest.approx(share @ many.log_tau, abs=0.1)


def test_searches_in_step_go_where_each_goes_alone() -> None:
    told = [evidence((2, 4, 5), seed) for seed in (1, 2, 3)]
    together = Evidence(np.concatenate([one.faces for one in told]), [one.blocks[0] for one in told])
    begun, chance = [draws(8, seed) for seed in range(3)], [numbers(2, 8, seed) for seed in range(3)]
    joined = Sample(*(np.concatenate([getattr(one, name) for one in begun]) for name in ("genes", "log_tau", "metric")))
    after = moved(space(), together, joined, np.repeat(np.arange(3), 8), np.concatenate(chance, axis=3))
    for i in range(3):
        alone = moved(space(), told[i], begun[i], np.zeros(8, np.intp), chance[i])
        assert np.array_equal(after.genes[8 * i :][:8], alone.genes)
        assert np.array_equal(after.log_tau[8 * i :][:8], alone.log_tau)


def test_moved_genes_are_sums_and_copies_of_the_numbers_that_came_in() -> None:
    """A change of the last bit of the faces changes no draw: genes do not depend on what decides about them."""
    told, sample, chance = evidence((2, 4)), draws(24), numbers(2)
    after = moved(space(), told, sample, ALONE, chance)
    nudged = Evidence(told.faces * (1 + 2e-16), told.blocks)
    assert np.array_equal(moved(space(), nudged, sample, ALONE, chance).genes, after.genes)
    assert after.genes.min() >= 0
    assert after.genes.max() < 1


def test_resampling_takes_draws_in_proportion_to_their_weights() -> None:
    weights = np.array([0.0, 3.0, 1.0, 0.0, 4.0])
    assert resampled(weights, 8, 0.5).tolist() == [1, 1, 1, 2, 4, 4, 4, 4]
    counts = sum(np.bincount(resampled(weights, 3, u), minlength=5) for u in np.linspace(0, 1, 400, endpoint=False))
    np.testing.assert_allclose(counts / 1200, weights / 8, atol=0.01)
