"""The sliders of a head: each named once, with targets for every direction in which it goes."""

from __future__ import annotations

from collections import Counter

import pytest

from emogen_core.face.space import MACROS
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.detail_table import DETAILS

SPACE = load_bundled_space()


def test_every_slider_of_the_space_is_in_the_table_in_its_order():
    assert SPACE.details == tuple(detail.name for detail in DETAILS)
    for detail in DETAILS:
        known = SPACE.ranges[detail.name]
        assert (known.region, known.low, known.high, known.default) == (detail.region, detail.low, detail.high, 0.0)
        assert known.meaning == detail.meaning


def test_no_name_or_target_is_used_twice():
    names = Counter(detail.name for detail in DETAILS)
    targets = Counter(target for detail in DETAILS for sign in "+-" for target in detail.targets(sign))
    assert not [name for name, count in (names + targets).items() if count > 1]
    assert not set(names) & MACROS


@pytest.mark.parametrize("detail", DETAILS, ids=lambda detail: detail.name)
def test_a_slider_goes_where_it_has_targets(detail):
    assert detail.targets("+")
    assert bool(detail.targets("-")) == (detail.low == -1.0)
    assert 0 < detail.scale <= 1
    assert " to " in detail.meaning or detail.meaning.startswith(("with", "as it is"))


@pytest.mark.parametrize("detail", DETAILS, ids=lambda detail: detail.name)
def test_both_sides_of_the_head_move_alike(detail):
    for sign in "+-":
        names = detail.targets(sign)
        left = {name.replace("/l-", "/", 1) for name in names if "/l-" in name}
        right = {name.replace("/r-", "/", 1) for name in names if "/r-" in name}
        assert left == right
