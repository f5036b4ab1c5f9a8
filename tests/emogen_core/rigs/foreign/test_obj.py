"""One OBJ file: every dialect of the same mesh gives the same arrays."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign.obj import parse_obj, triangulated

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]])
V = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\n"
FACES = b"f 4 3 2 1\nf 1 2 5\nf 2 3 5\n"
TRIANGLES = [[3, 2, 1], [3, 1, 0], [0, 1, 4], [1, 2, 4]]


@pytest.mark.parametrize(
    "data",
    [
        V + FACES,
        b"# made by hand\n\nmtllib head.mtl\n" + V + b"s off\n" + FACES + b"\n\n",
        (V + FACES).replace(b"\n", b"\r\n"),
        V + b"f -2 -3 -4 -5\nf -5 -4 -1\nf -4 -3 -1\n",
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -1 -2 -3 -4\nv .5 .5 1\nf 1 2 5\nf 2 3 -1\n",
        V + b"vn 0 0 1\nf 4//1 3//1 2//1 1//1\nf 1//1 2//1 5//1\nf 2//1 3//1 5//1\n",
        V + b"vt 0 0\nvn 0 0 1\nf 4/1/1 3/1/1 2/1/1 1/1/1\nf 1/1 2/1 5/1\nf 2 3//1 5/-1/-1 # a mixture\n",
        V.replace(b"\n", b" 0.5 0.25 1\n") + FACES,
        V.replace(b"\n", b" 1.0\n") + FACES,
        V.replace(b"v ", b"  v\t") + b"f 4 3 \\\n2 1\nf 1 2 5\nf 2 3 5",
        V.replace(b"v 0 0 0", b"v 0.000000 0e0 -0 # origin") + FACES,
    ],
    ids=["plain", "comments", "crlf", "negative", "interleaved", "normals", "mixed", "colours", "w", "blanks", "forms"],
)
def test_every_dialect_is_the_same_mesh(data):
    mesh = parse_obj(data, "head.obj")
    assert np.array_equal(mesh.vertices, POINTS)
    triangles, _, parts = triangulated(mesh.polygons)
    assert triangles.tolist() == TRIANGLES
    assert parts == {"body": (0, 4)}


def test_a_polygon_becomes_a_fan_around_its_first_corner():
    angle = np.linspace(0, 2 * np.pi, 7)[:-1]
    points = "".join(f"v {np.cos(a)} {np.sin(a)} 0\n" for a in angle)
    triangles, _, _ = triangulated(parse_obj(f"{points}f 3 4 5 6 1 2\n".encode(), "x").polygons)
    assert triangles.tolist() == [[2, 3, 4], [2, 4, 5], [2, 5, 0], [2, 0, 1]]


@pytest.mark.parametrize("word", ["usemtl", "o", "g"])
def test_parts_come_together_however_often_a_name_returns(word):
    lines = (b"f 1 2 5", b"%s skin" % word.encode(), b"f 2 3 5", b"%s my teeth" % word.encode(), b"f 3 4 5",
             b"%s skin" % word.encode(), b"f 4 1 5")  # fmt: skip
    triangles, _, parts = triangulated(parse_obj(V + b"\n".join(lines), "x").polygons)
    assert parts == {"body": (0, 1), "skin": (1, 3), "my teeth": (3, 4)}
    assert triangles.tolist() == [[0, 1, 4], [1, 2, 4], [3, 0, 4], [2, 3, 4]]


def test_materials_outrank_groups():
    data = V + b"o head\ng left\nusemtl skin\nf 1 2 5\ng right\nf 2 3 5\n"
    assert parse_obj(data, "x").polygons.parts == ("skin",)


def test_texture_coordinates_belong_to_corners():
    mesh = parse_obj(V + b"vt 0 .25\nvt 1 .5 0\nf 1/1 2/2 5\n", "x")
    _, texture, _ = triangulated(mesh.polygons)
    assert mesh.uv.tolist() == [[0, 0.25], [1, 0.5]]
    assert texture.tolist() == [[0, 1, -1]]


@pytest.mark.parametrize("ending", [b"\n", b"\r\n"])
def test_the_same_text_of_faces_is_not_parsed_again(ending):
    plain, rest = (text.replace(b"\n", ending) for text in (b"# a\nmtllib a.mtl\no a\n" + V, b"usemtl a\n" + FACES))
    first = parse_obj(plain + rest, "x")
    moved = parse_obj(b"# other\n" + plain.replace(b".5", b".75") + rest, "y", like=first)
    assert moved.polygons is first.polygons
    assert moved.vertices.tolist() == [*POINTS[:4].tolist(), [0.75, 0.75, 1]]


@pytest.mark.parametrize(
    "data",
    [V.replace(b".5", b".25") + FACES + b"# end\n", b"f 4 3 2 1\n" + V + FACES[10:], V[8:] + FACES + V[:8],
     V.replace(b"v ", b"v\t") + FACES, V.replace(b"v 0 1", b"v 0 \\\n1") + FACES],
)  # fmt: skip
def test_another_text_is_parsed(data):
    first = parse_obj(V + FACES, "x")
    mesh = parse_obj(data, "y", like=first)
    assert mesh.polygons is not first.polygons
    assert np.array_equal(mesh.polygons.corners, first.polygons.corners)
    assert len(mesh.vertices) == 5


@pytest.mark.parametrize(
    ("data", "told"),
    [(V[8:] + FACES, "y: expected 5 vertices as in x, got 4"), (V + b"v 7 7 7\n" + FACES, "5 vertices as in x, got 6"),
     (V + FACES.replace(b"f 1 2 5", b"f 1 5 2"), "y: expected the 3 faces of x, got others"),
     (b"f 1 2 3\n" + V + FACES, "y: expected the 3 faces of x, got 4")],
)  # fmt: skip
def test_another_mesh_is_told_by_both_names_and_counts(data, told):
    # Four vertices that faces call five: not that an index is out of range.
    with pytest.raises(InvalidInputError) as refused:
        parse_obj(data, "y", like=parse_obj(V + FACES, "x"))
    assert told in str(refused.value)


def test_faces_between_vertices_are_always_parsed():
    data = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -1 -2 -3 -4\nv .5 .5 1\nf 1 2 5\n"
    first = parse_obj(data, "x")
    assert first.tail == b""
    assert parse_obj(data, "y", like=first).polygons is not first.polygons


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "got 0 and 0"),
        (V, "expected vertices"),
        (b"\x89PNG\r\n\x1a\n\0\0", "expected vertices"),
        (FACES, "expected vertices"),
        (V + b"f 1 2\n", "three corners"),
        (FACES[:10] + V + b"f 1 # 2 3\n", "three corners or more, got 'f 1 # 2 3'"),
        (V + b"f 1 2 6\n", "from 1 to 5.*got 6"),
        (V + b"f 1 2 0\n", "got 0"),
        (V + b"f 1 2 -6\n", "got -6"),
        (V + b"f 1 2 x\n", "whole numbers"),
        (V + b"f 1 2 3.5\n", "whole numbers"),
        (V + b"f 1 2 99999999999999999999\n", "whole numbers"),
        (V + b"f 1/1 2/1 3/1\n", "vt: expected indices from 1 to 0"),
        (V + b"v 1 2\n" + FACES, "3 numbers"),
        (V + b"v 1 2 one\n" + FACES, "3 numbers"),
        (b"mtllib /etc/passwd\n" + V + FACES, "without"),
        (b"mtllib ../head.mtl\n" + V + FACES, "without"),
        (b"mtllib C:\\head.mtl\n" + V + FACES, "without"),
    ],
)
def test_what_is_no_mesh_is_refused_by_name(data, why):
    with pytest.raises(InvalidInputError, match=why) as refused:
        parse_obj(data, "odd.obj")
    assert str(refused.value).startswith("odd.obj")
