"""Which studies share a search, and where it is simulated."""

import pytest

from server.reporting.noise import laboratory, search_key
from tests.conftest import small_study
from tests.rig_factory import small_rig


@pytest.mark.parametrize("changes", [{"generations": 5}, {"minimum": 2}, {"maximum": 4}, {"search": {"mutations": 3}}])
def test_what_changes_the_search_changes_its_key(changes):
    assert search_key(small_study(**changes)) != search_key(small_study())


@pytest.mark.parametrize("changes", [{"title": "Another"}, {"identities": ("male",)}, {"ratings": ["intensity"]}])
def test_nothing_else_does(changes):
    assert search_key(small_study(**changes)) == search_key(small_study())


def test_a_search_is_simulated_with_the_settings_of_the_study():
    rig = small_rig()
    made = laboratory(rig, small_study(generations=7, search={"mutations": 3}), 5)
    assert (made.rig, made.identity, made.seed) == (rig, rig.identities[0], 5)
    assert (made.params.generations, made.params.mutations) == (7, 3)
