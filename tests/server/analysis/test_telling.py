"""Numbers in sentences."""

import pytest

from emogen_core.analysis.enough import VARIETY, Result, too_few
from server.analysis.telling import (
    NAMED,
    bounded,
    cells,
    counted,
    each_or_all,
    interval,
    lacking,
    listed,
    p_is,
    p_range,
    span,
    untold,
)


@pytest.mark.parametrize(
    ("p", "told"),
    [(0.0001, "p < .001"), (0.000999, "p < .001"), (0.001, "p = .001"), (0.05, "p = .050"), (1, "p = 1.000")],
)
def test_probabilities_have_no_zero_before_their_point(p, told):
    assert p_is(p) == told


def test_bounded_numbers_have_none_either():
    assert [bounded(value) for value in (0.5, -0.25, 1.0)] == [".50", "-.25", "1.00"]


def test_intervals_ranges_and_lists():
    assert interval(0.1, 0.25, 2) == ", 95 % CI [0.10, 0.25]"
    assert interval(None, None) == interval(None, 1.0) == ""
    assert span([0.3, None, 0.1]) == "0.100 to 0.300" and span([0.1001, 0.1]) == "0.100"
    assert [listed(list(words)) for words in ("a", "ab", "abc")] == ["a", "a and b", "a, b and c"]
    assert (counted(1, "test"), counted(1200, "test")) == ("1 test", "1,200 tests")
    assert (counted(1, "pair of cells"), counted(3, "pair of cells")) == ("1 pair of cells", "3 pairs of cells")


def test_ranges_of_probabilities_and_sizes_of_cells():
    assert p_range([0.2, None, 0.0001]) == "p < .001 to p = .200" and p_range([0.5, 0.5]) == "p = .500"
    assert (cells([5, 12]), cells([4])) == ("2 cells (n = 5 to 12)", "1 cell (n = 4)")


def test_few_are_told_one_by_one_and_many_together():
    told = [each_or_all(range(count), str, lambda all_: f"{len(all_)} in all") for count in (0, 2, NAMED, NAMED + 1)]
    assert told == [(), ("0", "1"), tuple(map(str, range(NAMED))), (f"{NAMED + 1} in all",)]


def test_what_is_not_told_is_said():
    enough, few, same = Result(), Result(lacks=too_few(4)), Result(lacks=too_few(1, 2, VARIETY))
    assert untold([enough] * 3, "p") == ()
    assert untold([enough, few, enough], "p") == ("No p is told for 1 of 3 cells: too few people.",)
    assert untold([same] * 3, "p") == ("No p is told for any of 3 cells: all faces are the same.",)
    assert untold([few, same], "p", "pair of cells") == (
        "No p is told for any of 2 pairs of cells: too few people, or all faces are the same.",
    )


def test_what_lacks_the_same_is_told_together_and_once():
    few, fewer, enough = Result(lacks=too_few(4)), Result(lacks=too_few(3)), Result()
    told = lacking([("a", few), ("b", fewer), ("a", few), ("c", enough), ("d", few)], "an interval")
    assert told == (
        "a; d: an interval needs at least 5 people, got 4.", "b: an interval needs at least 5 people, got 3.",
    )  # fmt: skip
    assert lacking([("a", enough)], "an interval") == ()
    many = [(str(at), few) for at in range(NAMED + 1)]
    assert lacking(many, "it") == (f"All {NAMED + 1}: it needs at least 5 people, got 4.",)
    assert lacking([*many, ("x", enough)], "it") == ("0; 1; 2; 3; 4: it needs at least 5 people, got 4.",)
