"""Distances of people's faces."""

import numpy as np
import pytest
from scipy import stats
from scipy.spatial.distance import cdist

from emogen_core.analysis.distances import (
    beside,
    cosine_matrix,
    distances_between,
    distances_within,
    share_beyond,
)
from emogen_core.designs.population import names
from tests.emogen_core.analysis.studies import Simulated, drawn


def rng():
    return np.random.default_rng(1)


FACES = np.random.default_rng(5).random((12, 6))


def test_the_matrix_is_scipys_and_neutral_faces_share_nothing():
    other = FACES[:4] * 0.3
    assert cosine_matrix(FACES, other) == pytest.approx(cdist(FACES, other, "cosine"), abs=1e-12)
    assert cosine_matrix(np.zeros((1, 6)), np.vstack([FACES[:1], np.zeros((1, 6))])).tolist() == [[1, 1]]


def test_within_a_cell_every_two_people_count_once():
    found = distances_within(drawn(FACES), rng())
    told = cdist(FACES, FACES, "cosine")[np.triu_indices(12, 1)]
    assert (found.pairs, found.mean, found.sd) == (66, pytest.approx(told.mean()), pytest.approx(told.std(ddof=1)))
    assert found.low < found.mean < found.high


def test_faces_of_one_person_make_no_pair():
    twice = distances_within(drawn(np.vstack([FACES, FACES]), np.tile(names(12), 2)), rng())
    once = distances_within(drawn(FACES), rng())
    assert twice.mean == pytest.approx(once.mean)
    assert (twice.people, twice.pairs) == (12, 66)


def test_between_cells_somebody_in_both_makes_no_pair_with_themselves():
    first, second = drawn(FACES[:6]), drawn(FACES[6:])
    found = distances_between(first, second, rng())
    told = cdist(FACES[:6], FACES[6:], "cosine")
    assert found.mean == pytest.approx(told[~np.eye(6, dtype=bool)].mean())
    assert (found.people, found.pairs) == (6, 30)
    strangers = distances_between(first, drawn(FACES[6:], names(6, "q")), rng())
    assert (strangers.mean, strangers.people, strangers.pairs) == (pytest.approx(told.mean()), 12, 36)
    assert strangers.low < strangers.mean < strangers.high


@pytest.mark.parametrize("count", [0, 1, 4])
def test_few_people_have_no_interval(count):
    found = distances_within(drawn(FACES[:count]), rng())
    assert (found.low, found.high, found.lacks.got) == (None, None, count)
    assert (found.mean is None) == (count < 2)
    assert distances_between(drawn(FACES[:count]), drawn(FACES, names(12, "q")), rng()).low is None


def test_distances_beside_simulated_ones():
    found = distances_within(drawn(FACES), rng())
    assert beside(found, Simulated(mean=found.mean - 0.1)).excess == pytest.approx(0.1)
    assert beside(found, Simulated(mean=found.low - 0.01)).above is True
    assert beside(found, Simulated(mean=(found.low + found.mean) / 2)).above is False
    few = beside(distances_within(drawn(FACES[:3]), rng()), Simulated())
    assert (few.above, few.enough) == (None, False)


def test_the_share_beyond_the_noise_has_an_exact_interval():
    values = np.array([0.6, 0.7, *[0.1] * 8])
    found = share_beyond(values, Simulated())
    low = stats.beta.ppf(0.025, 2, 9)
    assert (found.share, found.low) == (0.2, pytest.approx(low))
    assert found.p == pytest.approx(1 - 0.95**10 - 10 * 0.05 * 0.95**9)
    assert share_beyond(np.zeros(100), Simulated()).p == 1, "few beyond are no finding"
    few = share_beyond(values[:4], Simulated())
    assert (few.beyond, few.count, few.share, few.low, few.p) == (2, 4, 0.5, None, None)
    assert share_beyond(values[:0], Simulated()).share is None
