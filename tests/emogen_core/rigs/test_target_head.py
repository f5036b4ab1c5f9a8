"""Other heads for the cards: from the rig, or from an OBJ of its mesh."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.target_head import aligned, read_mesh, target_head

RIG = load_bundled_rig()
MALE = RIG.neutral("male").astype(np.float64)


def obj(path, mesh, line="v {:.6f} {:.6f} {:.6f}", tail=("vn 0 0 1", "f 1 2 3 4")):
    path.write_text("\n".join(["# a head", "mtllib x.mtl", *(line.format(*row) for row in mesh), *tail, ""]))
    return path


def turned(mesh):
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    return 0.1 * mesh @ turn + [3, 150, -8]


def test_without_a_target_it_is_the_first_identity():
    assert target_head(RIG, "") == (RIG, RIG.identities[0])


def test_an_identity_of_the_rig_is_worn_as_it_is():
    rig, name = target_head(RIG, "asian-male-old")
    assert (rig is RIG, name) == (True, "asian-male-old")


def test_an_obj_is_worn_under_its_own_name(tmp_path):
    rig, name = target_head(RIG, str(obj(tmp_path / "actor.obj", MALE)))
    assert (name, rig.identities) == ("actor", (*RIG.identities, "actor"))
    np.testing.assert_allclose(rig.neutral("actor"), aligned(MALE, RIG.neutral("female")), atol=1e-4)


def test_place_size_and_turn_do_not_matter(tmp_path):
    template = RIG.neutral("female")
    np.testing.assert_allclose(aligned(turned(MALE), template), aligned(MALE, template), atol=1e-6)
    np.testing.assert_allclose(aligned(turned(template.astype(float)), template), template, atol=1e-3)


@pytest.mark.parametrize("line", ["v {} {} {}", "v  {}  {} {} 1.0", "v {} {} {} 0.2 0.3 0.4", "v\t{}\t{}\t{}"])
def test_dialects_are_read(tmp_path, line):
    mesh = MALE[:5].round(4)
    np.testing.assert_allclose(read_mesh(obj(tmp_path / "a.obj", mesh, line)).vertices, mesh)


@pytest.mark.parametrize(
    ("mesh", "said"),
    [
        (MALE[:-1], "target: expected 14528 vertices, got 14527; it has to be the rig's mesh"),
        (MALE[:0], r"a.obj: expected vertices \(v\) and faces \(f\), got 0"),
        (MALE[::-1], "target: expected the rig's vertices in the rig's order, got .* % of the head's size away"),
        (
            np.where(np.arange(len(MALE))[:, None] == 3, np.nan, MALE),
            r"a.obj: expected finite coordinates, got .*vertex 3",
        ),
        (np.ones_like(MALE), "target: expected a head, got 'all vertices in one place'"),
    ],
)
def test_another_mesh_is_refused(tmp_path, mesh, said):
    with pytest.raises(InvalidInputError, match=f"^{said}"):
        target_head(RIG, str(obj(tmp_path / "a.obj", mesh)))


@pytest.mark.parametrize("text", ["v 1 2\nv 1 2 3\nf 1 2 1\n", "v a b c\nf 1 1 1\n", "v 1 2 3\nv 1 2\nf 1 1 2\n"])
def test_what_is_no_number_is_refused(tmp_path, text):
    (tmp_path / "a.obj").write_text(text)
    with pytest.raises(InvalidInputError, match=r"^a.obj: expected"):
        target_head(RIG, str(tmp_path / "a.obj"))


def test_a_name_that_is_neither_is_refused(tmp_path):
    for name in ("nobody", str(tmp_path)):
        with pytest.raises(InvalidInputError, match=r"^target: expected one of \['female'.* or an OBJ file, got"):
            target_head(RIG, name)


def test_a_mirrored_head_is_another_mesh(tmp_path):
    with pytest.raises(InvalidInputError, match="in the rig's order"):
        aligned(MALE * [-1, 1, 1], RIG.neutral("female"))
