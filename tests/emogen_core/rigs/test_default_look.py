"""A head without an appearance wears a blend of the presets' looks that follows its sliders without a jump."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError
from emogen_core.face.appearance import Appearance, parameters
from emogen_core.face.identity import Identity
from emogen_core.face.space import ANCESTRIES, DEFAULT_MIX
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.default_look import appearance_of, default_appearance
from emogen_core.rigs.identities import IDENTITIES
from emogen_core.rigs.look.presets import presets

SPACE = load_bundled_space()
AMOUNTS = [known["name"] for known in parameters() if "low" in known]
COLOURS = [known["name"] for known in parameters() if "low" not in known]
# How much an amount may change where a parameter crosses its whole range: five times for the inner place's share,
# once more for what it takes from the others, times a range of two.
STEEPEST = 12.0


def shares(first, second):
    """A point of the triangle, of two numbers in [0, 1]."""
    low, high = sorted((first, second))
    return dict(zip(ANCESTRIES, (low, high - low, 1 - high), strict=True))


UNIT = st.floats(0, 1)
points = st.builds(
    lambda sex, age, first, second: {"sex": sex, "age": age, **shares(first, second)},
    UNIT, st.floats(10, 90), UNIT, UNIT,
)  # fmt: skip


def numbers(look):
    """Amounts as they are, and colours as light, which is what is mixed."""
    light = [np.array(getattr(look, name)) ** 2 / 255**2 for name in COLOURS]
    return np.concatenate([[getattr(look, name) for name in AMOUNTS], *light])


@pytest.mark.parametrize("name", IDENTITIES)
def test_every_preset_wears_its_own(name):
    assert default_appearance(IDENTITIES[name], SPACE) == presets()[name]


def test_a_head_that_says_nothing_is_the_first_preset():
    assert default_appearance({}, SPACE) == presets()["female"]


@given(points, points, st.floats(0, 1e-2))
def test_a_small_step_changes_little(start, end, step):
    between = {name: (1 - step) * start[name] + step * end[name] for name in start}
    way = sum(abs(between[name] - start[name]) / (80 if name == "age" else 1) for name in start)
    jump = np.abs(numbers(default_appearance(between, SPACE)) - numbers(default_appearance(start, SPACE)))
    # A colour is rounded to whole numbers, up to 2 * 255 * 0.5 / 255 ** 2 of its square.
    assert jump.max() <= STEEPEST * way + 0.005


@given(points)
def test_a_look_lies_between_those_of_the_presets(point):
    known = [numbers(look) for look in presets().values()]
    found = numbers(default_appearance(point, SPACE))
    assert (found >= np.min(known, axis=0) - 0.005).all()
    assert (found <= np.max(known, axis=0) + 0.005).all()


@given(points, st.floats(-1, 1))
def test_only_sex_age_and_ancestry_count(point, value):
    other = {**point, "weight": value, "muscle": -value, "nose-width": value}
    assert default_appearance(other, SPACE) == default_appearance(point, SPACE)


@pytest.mark.parametrize("sex", [0.0, 0.5, 1.0])
def test_growing_old_goes_one_way(sex):
    ages = [default_appearance({"sex": sex, "age": float(years)}, SPACE) for years in range(25, 91, 5)]
    for name in ("grey", "lines", "spots", "balding", "teeth"):
        values = [getattr(look, name) for look in ages]
        assert all(np.diff(values) > 0), name


def test_from_one_ancestry_to_another_skin_gets_steadily_deeper():
    way = [{"asian": 1 - share, "african": share, "caucasian": 0.0} for share in np.linspace(0, 1, 21)]
    depths = [default_appearance(mix, SPACE).skin_depth for mix in way]
    assert np.allclose(np.diff(depths), (depths[-1] - depths[0]) / 20)


def test_shares_that_miss_one_by_little_are_shares_still():
    nearly = {name: 1.0005 * share for name, share in DEFAULT_MIX.items()}
    assert numbers(default_appearance(nearly, SPACE)) == pytest.approx(numbers(presets()["female"]), abs=1e-6)


def test_a_child_has_no_beard_and_looks_young():
    child, young = (default_appearance({"sex": 1.0, "age": age}, SPACE) for age in (10.0, 25.0))
    assert young.stubble > 0
    assert child == replace(young, stubble=0.0)


def test_a_look_of_its_own_wins():
    own = Appearance(skin_depth=0.9)
    assert appearance_of(Identity("x", {"age": 80.0}, own.to_document()), SPACE) == own
    assert appearance_of(Identity("x", {"age": 80.0}), SPACE) == default_appearance({"age": 80.0}, SPACE)
    with pytest.raises(InvalidInputError, match="appearance: expected no missing field"):
        appearance_of(Identity("x", {}, {"skin": 1}), SPACE)
