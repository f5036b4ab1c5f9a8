"""What is different between two versions is named field by field."""

from server.services.config.difference import NOTHING, Change, changes
from tests.conftest import small_study


def test_the_same_study_has_no_difference():
    assert changes(small_study(), small_study()) == ()


def test_every_change_is_named_with_both_values():
    first, second = {"kind": "evolve", "name": "first"}, {"kind": "evolve", "name": "second", "retest_of": "first"}
    before = small_study(blocks=[first])
    after = small_study(generations=3, search={"activation": (2, 3), "random_genes": 4}, blocks=[first, second])
    found = {change.field: change for change in changes(before, after)}
    assert found["generations"] == Change("generations", 2, 3)
    assert found["search.random_genes"] == Change("search.random_genes", 3, 4)
    assert found["blocks.2"].before == NOTHING
    assert found["blocks.2"].after["name"] == "second"
    assert len(found) == 3
    assert {change.field for change in changes(after, before)} == set(found)
