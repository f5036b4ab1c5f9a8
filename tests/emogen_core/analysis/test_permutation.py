"""Shuffling people."""

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.groups import grouped
from emogen_core.analysis.permutation import count, paired_t, pairing_p, ratio, shuffled, shuffled_mean, welch_t
from emogen_core.designs.population import names

VALUES = np.random.default_rng(1).random((9, 3))


def rng():
    return np.random.default_rng(2)


def people(sizes=(4, 5), prefixes="pq"):
    rows = np.split(VALUES[: sum(sizes)], np.cumsum(sizes)[:-1])
    return grouped(rows, [names(n, prefix) for n, prefix in zip(sizes, prefixes, strict=True)])


def difference(groups):
    return lambda places: np.abs(np.subtract(*(shuffled_mean(groups.values, place) for place in places)))


def test_numbers_of_one_statistic_share_their_shufflings():
    groups = people()
    found = shuffled(groups, difference(groups), rng())
    assert (found.null.shape, found.exact) == ((126, 3), True)
    for column in range(3):
        alone = shuffled(groups, lambda places, at=column: difference(groups)(places)[..., at : at + 1], rng())
        assert (alone.p[0], alone.least[0]) == (found.p[column], found.least[column])


def test_the_smallest_p_counts_all_shufflings_that_are_as_extreme():
    groups = people((4, 4))
    found = shuffled(groups, difference(groups), rng())
    assert found.least == pytest.approx([2 / 70] * 3), "exchanging both groups changes nothing"
    ties = shuffled(groups, lambda places: np.zeros((*places[0].shape[:-1], 1)), rng())
    assert (ties.p, ties.least) == (1, 1)


def test_no_shuffling_is_more_extreme_than_itself():
    groups = people()
    few = shuffled(groups, difference(groups), rng(), 99)
    assert (len(few.null), few.exact) == (99, False)
    assert ((few.p >= 1 / 100) & (few.p <= 1)).all()


def test_within_people_only_their_own_faces_are_exchanged():
    groups = people((3, 3), "pp")

    def strangers(places):
        pairs = np.sort(np.stack(places, -1), -1)
        return (pairs != [[0, 3], [1, 4], [2, 5]]).any((-1, -2)).astype(float)[..., None]

    assert shuffled(groups, strangers, rng()).null.max() == 0
    assert count("within", (3, 3)) == 8


def test_the_statistics_are_scipys():
    first, second = np.random.default_rng(3).normal(size=(2, 4, 7))
    assert welch_t(first, second[:, :5]) == pytest.approx(
        stats.ttest_ind(first, second[:, :5], axis=-1, equal_var=False).statistic
    )
    assert paired_t(first, second) == pytest.approx(stats.ttest_rel(first, second, axis=-1).statistic)
    assert ratio(np.array([0.0, 0.5, -0.5]), np.zeros(3)).tolist() == [0, 5e5, -5e5]


@pytest.mark.parametrize(("alternative", "p"), [("greater", 1 / 24), ("less", 1.0), ("two-sided", 2 / 24)])
def test_of_all_pairings_only_the_true_one_is_as_extreme(alternative, p):
    found, count, exact = pairing_p(np.diag([1.0, 2.0, 4.0, 8.0]), alternative, np.random.default_rng(1))
    assert (found, count, exact) == (pytest.approx(p), 24, True)


def test_partners_who_are_alike_cannot_be_told_apart():
    assert pairing_p(np.full((5, 5), 0.1), "less", np.random.default_rng(1))[0] == 1
