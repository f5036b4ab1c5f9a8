"""Balanced orders: every emotion once, every place and every neighbour equally often."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.services.config import DEMO, Evolve
from server.services.participation.order import emotions_of, latin_square, most_rows, ordered
from tests.conftest import small_study

WORDS = ("a", "b", "c", "d", "e")


@given(st.integers(1, 9))
def test_latin_squares_are_balanced(count):
    rows = latin_square(count)
    for place in range(count):
        seen = [row[place] for row in rows]
        assert all(seen.count(item) == len(rows) // count for item in range(count))
    pairs = [(row[i], row[i + 1]) for row in rows for i in range(count - 1)]
    assert len({pairs.count(pair) for pair in pairs}) <= 1
    assert len(set(pairs)) == count * (count - 1)


@pytest.mark.parametrize("way", ["latin", "random", "fixed"])
@given(row=st.integers(0, 50), seed=st.integers(0, 2**128))
def test_everybody_gets_everything_once(way, row, seed):
    order = ordered(WORDS, way, row, seed)
    assert sorted(order) == list(WORDS)
    assert order == ordered(WORDS, way, row, seed)
    assert way != "fixed" or order == list(WORDS)


def test_a_retest_asks_for_what_it_repeats():
    first = Evolve(kind="evolve", name="first", emotions=("angry",))
    again = Evolve(kind="evolve", name="again", retest_of="first")
    rest = Evolve(kind="evolve", name="rest")
    config = small_study(blocks=(first, again, rest))
    assert [emotions_of(config, block) for block in config.steps] == [("angry",), ("angry",), ("happy", "angry")]
    assert most_rows(config) == 2
    assert most_rows(DEMO) == 4
