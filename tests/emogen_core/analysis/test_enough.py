"""What is lacking is said in a sentence."""

from emogen_core.analysis.enough import FEWEST_PEOPLE, Lacking, Result, too_few


def test_too_few_says_how_many_are_needed():
    assert str(too_few(3)) == "needs at least 5 people, got 3"
    assert too_few(FEWEST_PEOPLE) is None
    assert too_few(1, 2, "identities") == Lacking("identities", 2, 1)


def test_a_result_is_enough_unless_it_lacks_something():
    assert Result().enough
    assert not Result(lacks=too_few(0)).enough
