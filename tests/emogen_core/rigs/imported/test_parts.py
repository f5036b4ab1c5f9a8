"""Parts sorted by what they are, every triangle once."""

import numpy as np

from emogen_core.rigs.imported.parts import ORDER, pieces, sort_parts
from tests.emogen_core.rigs.foreign.heads import made_head

MODEL = made_head()
UPPER = MODEL.part_vertices("TeethUpper")


def sorted_rows(triangles):
    return np.sort(np.sort(triangles, axis=1), axis=0)


def test_every_triangle_is_in_one_part():
    parts = sort_parts(MODEL, UPPER)
    triangles, rows = parts.sorted()
    assert np.array_equal(sorted_rows(triangles), sorted_rows(MODEL.triangles))
    assert [*rows] == [name for name in ORDER if name in rows]
    assert {name: last - first for name, (first, last) in rows.items()} == {
        "skin": 1280, "mouth": 0, "sockets": 0, "teeth_upper": 80, "teeth_lower": 80, "eye_left": 320, "eye_right": 320,
    }  # fmt: skip
    for name, (first, last) in rows.items():
        assert np.array_equal(triangles[first:last], parts.of(name)), name


def test_sides_and_jaws_are_told_apart():
    parts = sort_parts(MODEL, UPPER)
    assert np.array_equal(parts.vertices("teeth_upper"), UPPER)
    assert (MODEL.vertices[parts.vertices("eye_left"), 0] > 0).all()
    assert (MODEL.vertices[parts.vertices("eye_right"), 0] < 0).all()


def test_parts_of_the_mouth_by_their_names():
    rows = MODEL.parts
    renamed = {
        {"TeethUpper": "Tongue", "TeethLower": "MouthBag", "EyeRight": "eyeSocket"}.get(n, n): r
        for n, r in rows.items()
    }
    parts = sort_parts(made_head(parts=renamed), UPPER[:0])
    assert parts.named == {"skin", "mouth"}
    assert len(parts.of("tongue")) == len(parts.of("mouth")) == 80


def test_other_flesh_takes_the_place_of_the_old():
    parts = sort_parts(MODEL, UPPER)
    skin = parts.of("skin")
    split = parts.with_flesh({"skin": skin[:1000], "mouth": skin[1000:], "sockets": skin[:0]})
    assert np.array_equal(split.of("skin", "mouth"), skin)
    assert split.sorted()[1]["mouth"] == (1000, 1280)
    assert np.array_equal(split.of("eye_left"), parts.of("eye_left"))


def test_pieces_are_what_hangs_together():
    number = pieces(np.concatenate([MODEL.triangles[slice(*MODEL.parts[name])] for name in ("EyeLeft", "EyeRight")]))
    assert len(set(number[:320])) == len(set(number[320:])) == 1
    assert number[0] != number[-1]
