"""What is lacking is said in a sentence."""

import pytest

from emogen_core.analysis.enough import (
    FACES,
    FEWEST_PEOPLE,
    VALUES,
    VARIETY,
    Lacking,
    Result,
    too_few,
    untestable,
)


def test_too_few_says_how_many_are_needed():
    assert str(too_few(3)) == "needs at least 5 people, got 3"
    assert too_few(FEWEST_PEOPLE) is None
    assert too_few(1, 2, "identities") == Lacking("identities", 2, 1)


def test_a_result_is_enough_unless_it_lacks_something():
    assert Result().enough
    assert not Result(lacks=too_few(0)).enough


@pytest.mark.parametrize(
    ("lacking", "reason"),
    [
        (too_few(3), "too few people"), (too_few(3, 40, FACES), "too few faces"),
        (too_few(1, 2, VALUES), "all values are the same"), (too_few(12, 40, VARIETY), "too many faces are the same"),
        (untestable(0.1, 0.1, varied=True), "too few people"), (untestable(0.5, 0.1, varied=False), "too few people"),
        (untestable(1, 0.001, varied=False), "all faces are the same"),
        (untestable(0.5, 0.001, varied=True), "too many are the same"),
    ],
)  # fmt: skip
def test_the_reason_is_too_little_data_only_where_it_is(lacking, reason):
    assert lacking.reason == reason


def test_what_is_the_same_is_no_matter_of_how_many():
    assert untestable(0.05, 0.001, varied=True) is None
    assert str(untestable(0.1, 0.1, varied=True)) == "needs at least 20 distinguishable permutations, got 10"
    assert str(untestable(1, 0.001, varied=False)) == "needs faces that differ, but all faces are the same"
    told = "needs at least 20 distinguishable permutations, got 2, since too many are the same"
    assert str(untestable(0.5, 0.001, varied=True)) == told
