"""What cannot become a rig is refused, and the message names the part or the shape."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign import check
from emogen_core.rigs.foreign.check import check_model
from emogen_core.rigs.foreign.model import Findings
from tests.emogen_core.rigs.foreign.heads import made_head

head = made_head()


def refusal(model):
    """What is said of a model that is refused."""
    with pytest.raises(InvalidInputError) as told:
        check_model(model, Findings())
    return str(told.value)


def with_triangles(part, change):
    triangles = head.triangles.copy()
    rows = slice(*head.parts[part])
    triangles[rows] = change(triangles[rows].copy())
    return replace(head, triangles=triangles)


def test_a_good_head_passes():
    findings = Findings()
    check_model(head, findings)
    assert findings == Findings()


def test_nothing_to_move():
    assert refusal(replace(head, expressions={})).startswith("made: expected expressions")


def test_nothing_to_see():
    bare = replace(head, triangles=head.triangles[:0], parts={})
    assert refusal(bare) == "made: expected triangles, got none"


@pytest.mark.parametrize("name", ["", "  ", "a\nb", "x" * 65, 7])
def test_names_that_are_none(name):
    named = replace(head, expressions={**head.expressions, name: head.expressions["jawOpen"]})
    assert refusal(named) == f"names: expected 1 to 64 letters, got {name!r}; name every expression"


def test_the_longest_name_is_one():
    check_model(replace(head, expressions={**head.expressions, "x" * 64: head.expressions["jawOpen"]}), Findings())


def test_names_of_which_none_is_known():
    unknown = {f"shape {i}": offsets for i, offsets in enumerate(head.expressions.values())}
    told = refusal(replace(head, expressions=unknown))
    assert told.startswith("names: expected names of ARKit")
    assert "shape 3" in told
    check_model(replace(head, expressions=unknown | {"jawOpen": head.expressions["jawOpen"]}), Findings())


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_not_finite(value):
    for field in ("expressions", "identity_modes"):
        values = head.expressions["jawOpen"].copy()
        values[17, 1] = value
        told = refusal(replace(head, **{field: {**head.expressions, "mine": values}}))
        assert told.startswith("mine: expected finite coordinates")
        assert "at vertex 17, and 0 more" in told
    vertices = head.vertices.copy()
    vertices[[3, 9]] = value
    told = refusal(replace(head, vertices=vertices))
    assert told.startswith("neutral: expected finite coordinates")
    assert "at vertex 3, and 1 more" in told


@pytest.mark.parametrize("field", ["expressions", "identity_modes"])
def test_movements_longer_than_the_head(field):
    far = head.expressions["jawOpen"] * np.float32(12.6)
    told = refusal(replace(head, **{field: {**head.expressions, "mine": far}}))
    assert told.startswith("mine: expected movements shorter than the head's 250, got 252;")
    check_model(replace(head, **{field: {**head.expressions, "mine": far / 1.02}}), Findings())


def test_most_of_a_head_stays_where_it_is():
    """Other units, places or orders of one file leave no vertex far away, and hardly one where it was."""
    order = np.random.default_rng(1).permutation(len(head.vertices))
    for field in ("expressions", "identity_modes"):
        for moved in (0.1 * head.vertices, head.vertices[order], head.vertices + np.float32(16)):
            told = refusal(replace(head, **{field: {**head.expressions, "mine": moved - head.vertices}}))
            assert told.startswith("mine: expected most vertices within 25 of where the neutral has them, got ")
        near = np.full_like(head.vertices, 14)
        check_model(replace(head, **{field: {**head.expressions, "mine": near}}), Findings())


def test_edges_of_three_triangles():
    def change(rows):
        rows[1] = rows[0][[0, 1, 2]]
        rows[2] = rows[0]
        return rows

    told = refusal(with_triangles("EyeLeft", change))
    assert told.startswith("part EyeLeft: expected edges of one or two triangles, got 3 edges")


def test_one_triangle_that_faces_the_other_way():
    def change(rows):
        rows[5] = rows[5][::-1]
        return rows

    told = refusal(with_triangles("TeethUpper", change))
    assert told.startswith("part TeethUpper: expected neighbours that face the same way, got 3 edges")


def test_a_triangle_with_a_corner_twice():
    def change(rows):
        rows[5, 1] = rows[5, 0]
        return rows

    told = refusal(with_triangles("EyeRight", change))
    assert told == "part EyeRight: expected triangles of three vertices, got 1 with one twice; mend it"


@pytest.mark.parametrize("part", ["Face", "EyeLeft", "TeethLower"])
def test_a_part_inside_out(part):
    told = refusal(with_triangles(part, lambda rows: rows[:, ::-1]))
    assert told.startswith(f"part {part}: expected its front outside")


@pytest.mark.parametrize("part", ["EyeLeft", "TeethLower"])
def test_open_eyes_and_teeth_are_judged(part):
    last = head.parts[part][1]
    opened = with_triangles(part, lambda rows: rows[:, ::-1]).triangles
    opened = np.concatenate([opened[: last - 3], opened[last:]])
    parts = {name: (a - 3 * (a >= last), b - 3 * (b >= last)) for name, (a, b) in head.parts.items()}
    told = refusal(replace(head, triangles=opened, parts=parts))
    assert told.startswith(f"part {part}: expected its front outside")


def test_open_skin_is_judged_and_the_lining_of_a_mouth_is_not():
    first, last = head.parts["Face"]
    opened = head.triangles.copy()
    opened[first:last] = opened[first:last, ::-1]
    keep = np.ones(len(opened), bool)
    keep[first : first + 3] = False
    parts = {"Face": (0, last - 3), **{n: (a - 3, b - 3) for n, (a, b) in head.parts.items() if n != "Face"}}
    told = refusal(replace(head, triangles=opened[keep], parts=parts))
    assert told.startswith("part Face: expected its front outside")
    # The same surface as the lining of a mouth, which rightly faces inwards.
    lining = {"mouth" if name == "Face" else name: rows for name, rows in parts.items()} | {"skin": (0, 0)}
    check_model(replace(head, triangles=opened[keep], parts=lining), Findings())


@pytest.mark.parametrize(("limit", "what"), [("MAX_VERTICES", "{} vertices"), ("MAX_SHAPES", "vertices and {} shapes")])
def test_a_head_may_be_as_large_as_the_limits_and_no_larger(monkeypatch, limit, what):
    size = {"MAX_VERTICES": len(head.vertices), "MAX_SHAPES": len(head.expressions)}[limit]
    monkeypatch.setattr(check, limit, size)
    check_model(head, Findings())
    monkeypatch.setattr(check, limit, size - 1)
    assert what.format(size - 1) in refusal(head)


def test_a_mirror_image_is_inside_out_until_its_triangles_turn():
    flipped = replace(head, vertices=head.vertices * np.float32([-1, 1, 1]))
    assert refusal(flipped).startswith("part Face: expected its front outside")
    check_model(replace(flipped, triangles=head.triangles[:, ::-1]), Findings())


def test_what_is_too_small_for_a_head():
    few = replace(head, vertices=head.vertices[:3], triangles=np.array([[0, 1, 2]], np.int32), parts={"a": (0, 1)})
    assert refusal(few) == "made: expected a head of at least 100 vertices, got 3; is it the right file?"


def test_a_movement_twice_under_two_names():
    names = {**head.expressions, "eyeBlinkLeft": head.expressions["eyeBlink_L"]}
    told = refusal(replace(head, expressions=names))
    assert told == "names: expected every movement once, got eyeBlink_L and eyeBlinkLeft; leave out one"


def test_expressions_that_are_all_the_neutral():
    still = {name: 0 * offsets for name, offsets in head.expressions.items()}
    told = refusal(replace(head, expressions=still))
    assert told.startswith("made: expected expressions that move the neutral's vertices, got none that does;")


def test_what_moves_nothing_is_said():
    findings = Findings()
    check_model(replace(head, expressions={**head.expressions, "tongueOut": 0 * head.vertices}), findings)
    assert findings.missing == ["1 expressions move nothing: tongueOut."]
