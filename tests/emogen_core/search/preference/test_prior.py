"""What is believed before the first answer."""

from __future__ import annotations

from math import gamma

import numpy as np
import pytest

from emogen_core.search.preference.prior import LOG_TAU, birth_odds, drawn

GENES = 10


def chance_of(on: int) -> float:
    """Chance of one set of genes of this size, but for a constant."""
    return gamma(on + 1) * gamma(GENES - on + 3)


def test_odds_of_a_birth_are_those_of_the_beta_binomial() -> None:
    odds = birth_odds(GENES)
    wanted = [chance_of(on + 1) / chance_of(on) for on in range(GENES)]
    np.testing.assert_allclose(odds[:-1], wanted, rtol=1e-12)
    assert odds[-1] == 0, "no gene is left"


def test_draws_have_as_many_genes_as_the_prior_says() -> None:
    sample = drawn(np.random.default_rng(1).random((40_000, 3 + 2 * GENES)))
    sizes = np.bincount((sample.genes > 0).sum(axis=1), minlength=GENES + 1) / 40_000
    sets = np.array([chance_of(on) * gamma(GENES + 1) / gamma(on + 1) / gamma(GENES - on + 1) for on in range(11)])
    np.testing.assert_allclose(sizes, sets / sets.sum(), atol=0.008)


def test_strengths_noise_and_metrics_are_uniform() -> None:
    sample = drawn(np.random.default_rng(2).random((20_000, 3 + 2 * GENES)))
    on = sample.genes[sample.genes > 0]
    shares = (sample.log_tau - LOG_TAU[0]) / (LOG_TAU[1] - LOG_TAU[0])
    for values in (on, shares):
        np.testing.assert_allclose(np.quantile(values, [0.1, 0.5, 0.9]), [0.1, 0.5, 0.9], atol=0.02)
    assert sample.metric.mean() == pytest.approx(0.5, abs=0.02)
    assert set(sample.metric) == {0, 1}
