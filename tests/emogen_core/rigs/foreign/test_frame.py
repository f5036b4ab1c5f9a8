"""Units and axes: however a head lies in its file, it comes out upright, in millimetres, its eyes at the origin."""

from dataclasses import replace
from itertools import pairwise, permutations, product

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign.frame import INFERRED, UNITS, placed
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.foreign.parts import eyeballs
from tests.emogen_core.rigs.foreign.heads import EYES, made_head

head = made_head()
TURNS = [
    matrix
    for order in permutations(range(3))
    for signs in product((1, -1), repeat=3)
    if np.linalg.det(matrix := np.eye(3)[list(order)] * np.array(signs)[:, None]) > 0
]


def moved(matrix, shift=(0, 0, 0), model=head):
    turn = np.asarray(matrix, np.float32)
    return replace(
        model,
        vertices=(model.vertices @ turn.T + np.array(shift)).astype(np.float32),
        expressions={name: offsets @ turn.T for name, offsets in model.expressions.items()},
        identity_modes={name: offsets @ turn.T for name, offsets in model.identity_modes.items()},
    )


def assert_same(model, wanted=head):
    assert np.abs(model.vertices - wanted.vertices).max() < 1e-3
    for name, offsets in wanted.expressions.items():
        assert np.abs(model.expressions[name] - offsets).max() < 1e-4


def test_a_head_in_place_is_left_exactly_as_it_is():
    model = placed(head, Findings())
    assert np.array_equal(model.vertices, head.vertices)
    assert all(np.array_equal(model.expressions[name], offsets) for name, offsets in head.expressions.items())


@pytest.mark.parametrize("turn", TURNS, ids=str)
def test_all_turns_are_undone(turn):
    findings = Findings()
    assert_same(placed(moved(turn, (5, 900, -40)), findings))
    assert any(sentence.startswith("Axes by what") for sentence in findings.found)


def test_identity_modes_turn_with_the_head():
    turned = moved(TURNS[5], model=replace(head, identity_modes={"identity000": head.vertices * 0.1}))
    assert np.abs(placed(turned, Findings()).identity_modes["identity000"] - head.vertices * 0.1).max() < 1e-3


@pytest.mark.parametrize("unit", UNITS)
def test_units_are_inferred_and_said(unit):
    findings = Findings()
    small = moved(np.eye(3) / UNITS[unit])
    assert_same(placed(small, findings))
    assert any(sentence.startswith(f"The unit is {unit}:") for sentence in findings.guessed)
    said = Findings()
    assert_same(placed(small, said, unit))
    assert not any("unit is" in sentence for sentence in said.guessed)


def test_no_height_is_in_two_units():
    ranges = sorted((INFERRED[0] / scale, INFERRED[1] / scale) for scale in UNITS.values())
    assert all(high < low for (_, high), (low, _) in pairwise(ranges))


@pytest.mark.parametrize("scale", [0.5, 0.012, 50])
def test_what_has_no_heads_size_is_refused(scale):
    with pytest.raises(InvalidInputError, match=r"size: expected a head.*--unit"):
        placed(moved(np.eye(3) * scale), Findings())


def test_a_unit_that_makes_it_no_head_is_refused():
    with pytest.raises(InvalidInputError, match="got 250 cm"):
        placed(head, Findings(), "cm")
    with pytest.raises(InvalidInputError, match=r"one of .*got 'feet'"):
        placed(head, Findings(), "feet")
    assert_same(placed(moved(np.eye(3) * 0.05), Findings(), "cm"), moved(np.eye(3) * 0.5))


def test_sides_that_are_swapped_are_refused():
    swapped = {
        n[:-1] + {"L": "R", "R": "L"}[n[-1]] if n[-2:] in ("_L", "_R") else n: o for n, o in head.expressions.items()
    }
    with pytest.raises(InvalidInputError, match="head's own left side"):
        placed(replace(head, expressions=swapped), Findings())


def test_without_sides_axes_are_taken_as_they_are():
    findings = Findings()
    only = replace(head, expressions={"jawOpen": head.expressions["jawOpen"]})
    assert np.array_equal(placed(only, findings).vertices, head.vertices)
    assert findings.guessed[0].startswith("Axes were taken")


def without_eyes():
    return replace(head, parts={name.replace("Eye", "Ball"): rows for name, rows in head.parts.items()})


def test_without_eyes_lids_tell_where_the_origin_is():
    findings = Findings()
    model = placed(moved(np.eye(3), (0, 100, 0), without_eyes()), findings)
    assert "The eyes are taken to be where the lids move." in findings.guessed
    shift = head.vertices - model.vertices
    assert np.ptp(shift, axis=0).max() < 1e-3
    assert np.abs(shift[0]).max() < 20
    none = replace(head, parts=without_eyes().parts, expressions={"jawOpen": head.expressions["jawOpen"]})
    assert np.array_equal(placed(none, findings).vertices, head.vertices)


def test_eyes_too_far_apart_are_doubted():
    findings = Findings()
    wide = moved(np.diag([1.6, 1, 1]))
    placed(wide, findings)
    assert any("about 62 mm" in sentence for sentence in findings.guessed)


def test_half_an_eyeball_has_the_centre_of_the_whole():
    front = head.vertices[:, 2] > -4
    keep = front[head.triangles].all(axis=1)
    counts = {name: int(keep[a:b].sum()) for name, (a, b) in head.parts.items()}
    ends = np.cumsum([0, *counts.values()])
    parts = {name: (int(a), int(b)) for name, a, b in zip(counts, ends[:-1], ends[1:], strict=True)}
    centres = eyeballs(replace(head, triangles=head.triangles[keep], parts=parts))
    assert np.allclose(sorted(centres, key=lambda c: -c[0]), EYES, atol=1e-3)


def test_one_eye_is_no_pair():
    parts = {"EyeLeft": head.parts["EyeLeft"]}
    assert eyeballs(replace(head, parts=parts)) is None
