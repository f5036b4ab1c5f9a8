"""Tests of groups by permutation of people."""

from itertools import combinations, product

import numpy as np
import pytest
from scipy import stats

from emogen_core.analysis.comparisons import controlled, means_differ, values_differ
from emogen_core.analysis.groups import dispersions, grouped, intensities
from emogen_core.analysis.permutation import count
from emogen_core.designs.population import names
from emogen_core.errors import InvalidInputError
from emogen_core.similarity.cosine import cosine_distance
from tests.emogen_core.analysis.studies import drawn


def rng(seed=1):
    return np.random.default_rng(seed)


def dispersion_differs(groups, *rest):
    return values_differ(dispersions(groups), *rest)


def intensity_differs(groups, *rest):
    return values_differ(intensities(groups), *rest)


ALL = (means_differ, dispersion_differs, intensity_differs)


def apart(first, second):
    return float(cosine_distance(first.mean(0), second.mean(0)))


def test_between_people_all_ways_to_share_them_out_are_made():
    faces = rng(2).random((8, 5))
    found = means_differ([drawn(faces[:3]), drawn(faces[3:], names(5, "q"))], rng())
    null = [apart(faces[list(some)], np.delete(faces, list(some), 0)) for some in combinations(range(8), 3)]
    assert found.exact
    assert (found.design, found.permutations) == ("between", 56)
    assert found.statistic == pytest.approx(null[0], abs=1e-8)
    assert found.p == pytest.approx(np.mean(np.array(null) >= null[0] - 1e-9))
    assert (found.expected, found.z) == pytest.approx(
        (np.mean(null), (null[0] - np.mean(null)) / np.std(null)), abs=1e-6
    )


def test_within_people_every_swap_of_each_person_is_made():
    first, second = rng(3).random((2, 6, 5))
    found = means_differ([drawn(first), drawn(second[::-1], names(6)[::-1])], rng())
    null = []
    for swaps in product([False, True], repeat=6):
        swap = np.array(swaps)[:, None]
        null.append(apart(np.where(swap, second, first), np.where(swap, first, second)))
    assert (found.design, found.permutations, found.exact) == ("within", 64, True)
    assert found.p == pytest.approx(np.mean(np.array(null) >= null[0] - 1e-9))


@pytest.mark.parametrize(("design", "sizes"), [("between", (2, 3)), ("between", (2, 2, 2)), ("within", (3, 3, 3))])
def test_shufflings_are_counted(design, sizes):
    groups = [
        drawn(rng(i).random((n, 4)), names(n, "p" if design == "within" else f"g{i}")) for i, n in enumerate(sizes)
    ]
    found = means_differ(groups, rng())
    assert (found.permutations, found.exact) == (count(design, sizes), True)
    drawn_some = means_differ(groups, rng(), resamples=count(design, sizes) - 1)
    assert not drawn_some.exact


@pytest.mark.parametrize(("first", "second", "least"), [((3, 3), "between", 0.1), ((5, 5), "within", 0.0625)])
def test_what_cannot_be_shown_is_not_told(first, second, least):
    n, m = first
    groups = [drawn(np.eye(2)[[0] * n] + 0), drawn(np.eye(2)[[1] * m], names(m, "p" if second == "within" else "q"))]
    found = means_differ(groups, rng())
    assert found.statistic == 1
    assert (found.p, found.lacks.what) == (None, "distinguishable permutations")
    assert found.lacks.got == pytest.approx(1 / least)
    more = [
        drawn(np.vstack([one.weights, one.weights[:1]]), np.append(one.people, who))
        for one, who in zip(groups, ("x", "x" if second == "within" else "y"), strict=True)
    ]
    assert means_differ(more, rng()).p == pytest.approx(2 / count(second, (n + 1, m + 1)))


@pytest.mark.parametrize("test", ALL)
def test_groups_of_nobody_or_one_person_are_not_tested(test):
    for sizes in ((1, 6), (0, 6), (6, 0)):
        found = test([drawn(rng().random((n, 4)), names(n, f"g{n}")) for n in sizes], rng())
        assert (found.p, found.statistic, found.lacks.what, found.sizes) == (None, None, "people", sizes)
    with pytest.raises(InvalidInputError, match="at least two"):
        test([drawn(rng().random((4, 4)))], rng())


@pytest.mark.parametrize("test", ALL)
def test_faces_that_are_all_alike_do_not_differ(test):
    found = test([drawn(np.ones((6, 3))), drawn(np.ones((6, 3)), names(6, "q"))], rng())
    assert found.p in {None, 1.0}
    assert found.z is None


@pytest.mark.parametrize("test", ALL)
def test_the_order_of_groups_and_people_does_not_matter(test):
    first, second = drawn(rng(4).random((5, 4))), drawn(rng(5).random((4, 4)), names(4, "q"))
    one, other = test([first, second], rng()), test([second.take(np.arange(4)[::-1]), first], rng())
    assert (one.p, one.statistic) == pytest.approx((other.p, other.statistic))


def test_many_people_are_shuffled_at_random_and_the_same_seed_gives_the_same_p():
    groups = [drawn(rng(6).random((30, 5))), drawn(rng(7).random((30, 5)), names(30, "q"))]
    one, again = (means_differ(groups, rng(), resamples=199) for _ in range(2))
    assert one == again
    assert (one.permutations, one.exact) == (199, False)
    assert one.p * 200 == pytest.approx(round(one.p * 200)), "(b + 1) / (m + 1)"
    far = means_differ([drawn(np.eye(3)[[0] * 30]), drawn(np.eye(3)[[1] * 30], names(30, "q"))], rng(), resamples=199)
    assert far.p == 1 / 200


def test_the_test_of_means_is_blind_to_intensity_and_that_of_intensity_sees_it():
    faces = rng(8).random((40, 6))
    weak, strong = drawn(faces[:20] * 0.3), drawn(faces[20:], names(20, "q"))
    assert means_differ([weak, strong], rng()).p > 0.05
    assert intensity_differs([weak, strong], rng()).p < 0.001


def test_the_test_of_dispersion_sees_spread_and_not_the_mean():
    middle = np.array([1.0, 0.5, 0.2, 0.7, 0.1])
    near, far = (np.abs(middle + sd * rng(i).normal(size=(20, 5))) for i, sd in ((9, 0.05), (10, 0.3)))
    other = np.abs(middle[::-1] + 0.05 * rng(11).normal(size=(20, 5)))
    assert dispersion_differs([drawn(near), drawn(far, names(20, "q"))], rng()).p < 0.001
    elsewhere = [drawn(near), drawn(other, names(20, "q"))]
    assert dispersion_differs(elsewhere, rng()).p > 0.05
    assert means_differ(elsewhere, rng()).p < 0.001


def test_small_groups_do_not_seem_less_dispersed():
    ratios = []
    for i in range(200):
        faces = 1 + 0.1 * rng(i).normal(size=(24, 40))
        people = dispersions([drawn(faces[:4]), drawn(faces[4:], names(20, "q"))])
        ratios.append(people.of(0).mean() / people.of(1).mean())
    assert np.mean(ratios) == pytest.approx(1, abs=0.03)


@pytest.mark.parametrize("design", ["between", "within"])
def test_numbers_are_compared_by_students_t(design):
    first, second = rng(12).normal(size=(2, 7))
    people = grouped([first, second], [names(7), names(7, "p" if design == "within" else "q")])
    found = values_differ(people, rng())
    told = stats.ttest_rel(first, second) if design == "within" else stats.ttest_ind(first, second, equal_var=False)
    assert found.statistic == pytest.approx(abs(told.statistic), abs=1e-8)
    assert found.p == pytest.approx(told.pvalue, abs=0.05)


@pytest.mark.parametrize("design", ["between", "within"])
def test_of_several_groups_the_pairs_that_differ_are_named(design):
    same = ["p", "p", "p"] if design == "within" else ["p", "q", "r"]
    base = rng(13).random((3, 12, 6)) * 0.4
    base[2, :, 0] += 3
    groups = [drawn(one, names(12, prefix)) for one, prefix in zip(base, same, strict=True)]
    found = means_differ(groups, rng(), resamples=999)
    assert [(one.first, one.second) for one in found.pairs] == [(0, 1), (0, 2), (1, 2)]
    assert found.p == 0.001
    assert [one.p <= 0.05 for one in found.pairs] == [False, True, True]
    assert found.statistic == max(one.statistic for one in found.pairs)
    assert found.p == min(one.p for one in found.pairs)
    total = means_differ(groups, rng(), over="sum", resamples=999)
    assert total.statistic == pytest.approx(sum(one.statistic for one in found.pairs))
    assert total.p == 0.001
    assert [one.p for one in total.pairs] == pytest.approx([one.p for one in found.pairs], abs=0.1)
    assert total.pairs[0].p > 0.05


def test_false_discoveries_are_controlled_over_the_tests_that_could_be_made():
    strong = means_differ(
        [drawn(np.eye(3)[[0] * 30]), drawn(np.eye(3)[[1] * 30], names(30, "q"))], rng(), resamples=199
    )
    weak = means_differ(
        [drawn(rng(1).random((9, 3))), drawn(rng(2).random((9, 3)), names(9, "q"))], rng(), resamples=199
    )
    none = means_differ([drawn(rng(1).random((1, 3))), drawn(rng(2).random((9, 3)), names(9, "q"))], rng())
    found = controlled({"strong": strong, "none": none, "weak": weak})
    told = stats.false_discovery_control([strong.p, weak.p])
    assert found == {"strong": told[0], "weak": told[1]}
    assert controlled({"none": none}) == {}
