"""An appearance is plain data: it survives a document, refuses what is out of bounds, and can be mixed."""

import json
from dataclasses import fields, replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.errors import InvalidInputError
from emogen_core.face.appearance import Appearance, mixed, parameters

AMOUNTS = {p["name"]: (p["low"], p["high"]) for p in parameters() if "low" in p}
COLOURS = [p["name"] for p in parameters() if "low" not in p]
colours = st.tuples(*[st.integers(0, 255)] * 3)
appearances = st.fixed_dictionaries(
    {name: st.floats(*bounds) for name, bounds in AMOUNTS.items()} | dict.fromkeys(COLOURS, colours)
).map(lambda values: Appearance(**values))


@given(appearances)
def test_a_document_gives_the_appearance_back_through_json(look):
    document = json.loads(json.dumps(look.to_document(), allow_nan=False))
    assert Appearance.from_document(document) == look
    assert list(document) == [field.name for field in fields(Appearance)]


@pytest.mark.parametrize("name", AMOUNTS)
@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -1.01, 1.01, "0.5", None, True])
def test_an_amount_out_of_bounds_is_named(name, bad):
    with pytest.raises(InvalidInputError, match=rf"appearance\.{name}: expected a number from .* to 1, got"):
        replace(Appearance(), **{name: bad})


@pytest.mark.parametrize("name", COLOURS)
@pytest.mark.parametrize("bad", [(1, 2), (1, 2, 3, 4), (0, 0, 256), (0, -1, 0), (0.5, 0, 0), (True, 0, 0), "red", 7])
def test_a_colour_that_is_none_is_named(name, bad):
    with pytest.raises(
        InvalidInputError, match=rf"appearance\.{name}: expected three whole numbers from 0 to 255, got"
    ):
        replace(Appearance(), **{name: bad})


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d.pop("grey"), r"expected no missing field, got \['grey'\]"),
        (lambda d: d.update(hat=1), r"expected no unknown field, got \['hat'\]"),
        (lambda d: d.update(grey=2), r"appearance\.grey: expected a number from 0 to 1, got 2"),
    ],
)
def test_a_document_holds_every_field_and_no_other(change, message):
    document = Appearance().to_document()
    change(document)
    with pytest.raises(InvalidInputError, match=message):
        Appearance.from_document(document)


@pytest.mark.parametrize("bad", [None, [], "look", 3])
def test_a_document_is_an_object(bad):
    with pytest.raises(InvalidInputError, match="appearance: expected an object, got"):
        Appearance.from_document(bad)


def test_whole_numbers_become_amounts_and_lists_colours():
    look = Appearance(grey=1, lip_colour=[1, 2, 3])
    assert isinstance(look.grey, float)
    assert look.lip_colour == (1, 2, 3)


@given(appearances, appearances, st.floats(0, 1))
def test_a_mixture_lies_between_its_parts(one, other, share):
    mixture = mixed([(one, share), (other, 1 - share)])
    for name in AMOUNTS:
        low, high = sorted((getattr(one, name), getattr(other, name)))
        assert low - 1e-9 <= getattr(mixture, name) <= high + 1e-9
    for name in COLOURS:
        for k in range(3):
            low, high = sorted((getattr(one, name)[k], getattr(other, name)[k]))
            assert low <= getattr(mixture, name)[k] <= high


@given(appearances)
def test_one_head_alone_mixes_to_itself(look):
    assert mixed([(look, 2.0), (Appearance(), 0.0)]) == look


@pytest.mark.parametrize("shares", [[], [0.0], [-1.0, 2.0]])
def test_shares_must_be_positive(shares):
    with pytest.raises(InvalidInputError, match="shares: expected positive numbers, got"):
        mixed((Appearance(), share) for share in shares)
