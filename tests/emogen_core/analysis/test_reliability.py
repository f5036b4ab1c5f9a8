"""Test and retest."""

from itertools import permutations

import numpy as np
import pytest

from emogen_core.analysis.reliability import Retest, ranks, reliability, retest
from emogen_core.designs.population import names
from tests.emogen_core.analysis.studies import Simulated, drawn


def rng():
    return np.random.default_rng(1)


BASE = np.random.default_rng(3).random((6, 8))
FIRST = BASE + 0.2 * np.random.default_rng(4).random((6, 8))
SECOND = BASE + 0.6 * np.random.default_rng(5).random((6, 8))


def test_people_who_made_both_are_matched():
    people = np.array(["a", "b", "c", "b", "a", "d", "b"])
    faces = drawn(np.arange(14.0).reshape(7, 2), people, repetitions=[0, 0, 0, 1, 1, 1, 0])
    found = retest(faces)
    assert found.people.tolist() == ["a", "b"]
    assert found.first.tolist() == [[0, 1], [7, 8]], "two first faces count by their mean"
    assert found.second.tolist() == [[8, 9], [6, 7]]
    assert retest(faces, "genes").first.tolist() == found.first.tolist()


def test_its_numbers_are_those_of_the_table():
    pairs = Retest(names(6), FIRST, SECOND)
    found, table = reliability(pairs, rng()), pairs.distances
    away = ~np.eye(6, dtype=bool)
    assert found.own.mean == pytest.approx(np.diag(table).mean())
    assert found.others == pytest.approx(table[away].mean())
    assert found.identified == pytest.approx((table.argmin(1) == np.arange(6)).mean())
    nearer = [table[i, j] > table[i, i] for i in range(6) for j in range(6) if i != j]
    assert found.discriminability == pytest.approx(np.mean(nearer))
    own = [ranks(table)[np.arange(6), list(order)].mean() for order in permutations(range(6))]
    assert (found.exact, found.permutations) == (True, 720)
    assert found.p == pytest.approx(np.mean(np.array(own) <= own[0] + 1e-9))
    assert found.rank == pytest.approx(own[0])


def test_the_ideal_and_nothing_at_all():
    ideal = reliability(Retest(names(6), np.eye(6), np.eye(6)), rng())
    assert (ideal.own.mean, ideal.others, ideal.identified, ideal.rank, ideal.discriminability) == (0, 1, 1, 1, 1)
    assert ideal.p == pytest.approx(1 / 720)
    alike = reliability(Retest(names(6), np.ones((6, 2)), np.ones((6, 2))), rng())
    assert (alike.own.low, alike.identified, alike.rank, alike.p) == (None,) * 4
    assert alike.lacks.reason == "all distances are the same"


def test_own_distances_beside_simulated_ones():
    pairs = Retest(names(6), FIRST, SECOND)
    own = np.diag(pairs.distances)
    found = reliability(pairs, rng(), Simulated(mean=0.01, most=float(np.median(own))))
    assert found.excess == pytest.approx(own.mean() - 0.01)
    assert found.beyond.beyond == 3
    assert reliability(pairs, rng()).beyond is None


@pytest.mark.parametrize("count", [0, 1, 4])
def test_few_people_are_not_told_apart(count):
    found = reliability(Retest(names(count), FIRST[:count], SECOND[:count]), rng(), Simulated())
    assert (found.p, found.identified, found.own.low, found.lacks.got) == (None, None, None, count)
    assert (found.own.mean is None) == (count == 0)


def test_many_people_are_shuffled_at_random():
    faces = np.random.default_rng(7).random((12, 4))
    found = reliability(Retest(names(12), faces, faces), rng(), resamples=199)
    assert (found.exact, found.permutations, found.p) == (False, 199, 1 / 200)
