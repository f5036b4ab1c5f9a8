"""How often the tests of the published designs are significant in 200 studies.

Without an effect, as often as a nominal 5 % allows: within the 99 % bounds of the binomial distribution. With a known
one, in most.
"""

from functools import cache

import pytest
from scipy import stats

from emogen_core.designs.naming import Answering
from emogen_core.designs.published import BY_OWN, BY_TYPICAL, Outcome, Published
from tests.emogen_core.analysis.studies import population

STUDIES = 200
TESTS = ("mean faces", "intensity", "dispersion", "any gene")


@cache
def published():
    return Published(population(), STUDIES)


@cache
def equal_groups():
    return published().equal_groups()


def significant(ps):
    assert len(ps) == STUDIES
    return sum(p is not None and p <= 0.05 for p in ps)


def near_nominal(ps):
    """Return whether as many p are at most .05 as chance makes."""
    least, most = stats.binom.ppf([0.005, 0.995], len(ps), 0.05)
    return least <= significant(ps) <= most


@pytest.mark.parametrize("within", [False, True])
@pytest.mark.parametrize("test", TESTS[:3])
def test_equal_groups_are_told_apart_no_more_often_than_chance_allows(test, within):
    assert near_nominal(published().compared(equal_groups(), test, within=within))


@pytest.mark.parametrize("within", [False, True])
def test_equal_groups_have_genes_that_differ_no_more_often_than_chance_allows(within):
    found = significant(published().compared(equal_groups(), "any gene", within=within))
    assert found <= stats.binom.ppf(0.995, STUDIES, 0.05)


@cache
def thirty():
    """Return fifty studies of groups of thirty, and their people who mean different emotions."""
    made = Published(population(), 50, group=30)
    return made, made.different_groups()


@pytest.mark.parametrize("within", [False, True])
def test_groups_that_mean_different_emotions_are_told_apart(within):
    larger, faces = thirty()
    assert sum(p <= 0.05 for p in larger.compared(faces, "mean faces", within=within)) > 0.75 * larger.studies


@pytest.mark.parametrize("within", [False, True])
def test_a_group_that_shares_a_face_is_less_dispersed(within):
    assert significant(published().compared(published().spread_groups(), "dispersion", within=within)) > 0.5 * STUDIES


def test_people_who_share_a_template_are_not_known_by_their_retest():
    assert near_nominal(published().retested(shared=True))


def test_people_with_templates_of_their_own_are():
    assert significant(published().retested(shared=False)) > 0.9 * STUDIES


@pytest.mark.parametrize("answering", [Answering(), BY_TYPICAL])
def test_no_match_is_found_if_people_answer_by_chance_or_by_what_is_typical(answering):
    assert near_nominal(published().matched(answering))


def test_a_match_is_found_if_people_go_by_their_own_face():
    assert significant(published().matched(BY_OWN)) > 0.5 * STUDIES


def test_heads_with_faces_of_their_own_do_not_agree():
    assert near_nominal(published().on_heads(shared=False))


def test_heads_with_the_same_faces_do():
    assert significant(published().on_heads(shared=True)) > 0.9 * STUDIES


def test_a_share_has_its_exact_interval():
    # Clopper and Pearson's interval of 0 of n ends at 1 - .025^(1/n).
    share, low, high = Outcome("", "", "", effect=False, studies=20, significant=0).share
    assert (share, low, high) == (0, 0, pytest.approx(1 - 0.025 ** (1 / 20)))
