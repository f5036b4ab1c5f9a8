"""Legends: a sign for each series, apart without colour, and hidden from those who are read the names."""

import re

from server.charts.legend import bare_line, filled, legend


def test_signs_are_those_of_the_series_in_turn():
    signs = [sign for _, sign in legend([f"series {at}" for at in range(5)])]
    looks = [re.findall(r'class="(?:line|dot) s(\d)"', sign) for sign in signs]
    assert looks == [["1", "1"], ["2", "2"], ["3", "3"], ["4", "4"], ["1", "1"]]
    shapes = {re.search(r'd="([^"]+)" class="dot', sign)[1] for sign in signs[:4]}
    assert len(shapes) == 4


def test_lines_and_areas_have_signs_of_their_own():
    assert "dot" not in bare_line("median")[1]
    assert 'class="noise"' in filled("nine in ten", "noise")[1]
    for name, sign in (*legend(["one"]), bare_line("median"), filled("half", "band")):
        assert name and 'aria-hidden="true"' in sign
