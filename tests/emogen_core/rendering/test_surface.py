"""What the graphics card is given."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rendering.look import HAIR_DEPTH
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.setup import look_for
from emogen_core.rendering.surface import COLUMNS, NormalField, Surface

from .ball import ball_rig

rig = load_bundled_rig()


@pytest.fixture(scope="module")
def surface():
    return Surface(rig, look_for(rig))


def face(**genes):
    values = np.zeros((1, len(rig.genes)))
    for name, value in genes.items():
        values[0, rig.gene_names.index(name)] = value
    return shape_weights(rig, values)


def rows_of(surface, weights, identity="female"):
    return next(iter(surface.faces(identity, weights)))


def test_normals_of_a_ball_point_outward():
    rig = ball_rig()
    mesh = rig.neutral("ball")
    normals = NormalField(rig.triangles, len(mesh))(mesh)
    outward = mesh - mesh.mean(0)
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    middle = np.abs(outward[:, 1]) < 0.9
    assert np.einsum("ij,ij->i", normals, outward)[middle].min() > 0.97


@given(st.integers(0, 2**16))
@settings(deadline=None, max_examples=20)
def test_normals_turn_with_the_mesh(seed):
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    rig = ball_rig()
    field, mesh = NormalField(rig.triangles, rig.offsets.shape[1]), rig.neutral("ball")
    assert field((mesh @ turn.T).astype(np.float32)) == pytest.approx(field(mesh) @ turn.T, abs=1e-4)


def test_a_vertex_without_area_has_no_normal_and_no_nan():
    field = NormalField(np.array([[0, 1, 2]], np.int32), 4)
    normals = field(np.zeros((4, 3), np.float32))
    assert (normals == 0).all()


def test_rows_follow_the_mesh_but_for_the_hair(surface):
    weights = face(mouthSmile=1)
    mesh = vertices(rig, "female", weights)[0]
    rows = rows_of(surface, weights)
    for name, layer in surface.look.layers.items():
        assert rows[name].shape == (len(layer.source), COLUMNS)
        assert np.isfinite(rows[name]).all()
    hair = surface.look.bakes[surface.look.style("female").bake][:, 3]
    layer = surface.look.layers["skin"]
    lifted = np.linalg.norm(rows["skin"][:, :3] - mesh[layer.source], axis=1)
    assert lifted[hair == 0].max() == 0
    assert 2 < lifted.max() <= HAIR_DEPTH
    assert np.array_equal(rows["eyes"][:, :3], mesh[surface.look.layers["eyes"].source])


def test_faces_are_independent_of_their_batch(surface):
    weights = np.concatenate([face(mouthSmile=1), face(jawOpen=0.8), face()])
    together = list(surface.faces("male", weights))
    for row, rows in zip(weights, together, strict=True):
        alone = rows_of(surface, row[None], "male")
        assert all(np.allclose(alone[name], rows[name], atol=1e-4) for name in rows)


def test_an_open_mouth_lets_light_in(surface):
    inside = surface.look.layers["skin"].surface[:, 2] == 1
    light = [rows_of(surface, w)["skin"][inside, 10].mean() for w in (face(), face(lipsPart=0.5), face(jawOpen=0.6))]
    assert light[0] < 0.5 * light[2]
    assert light[0] <= light[1] <= light[2]


def test_lines_show_where_muscles_fold_the_skin(surface):
    layer = surface.look.layers["skin"]
    place = rig.neutral("female")[layer.source]
    calm, raised = (rows_of(surface, w)["skin"][:, 13] for w in (face(), face(browRaise=1, browInnerUp=1)))
    assert (calm == 0).all()
    assert place[raised > 0.2][:, 1].min() > -20
    assert raised.max() > 0.3
    old = rows_of(surface, face(), "caucasian-female-old")["skin"][:, 13]
    assert old.max() > 0.2


def test_lowered_lids_darken_the_eyes(surface):
    open_eyes, narrow = (rows_of(surface, w)["eyes"] for w in (face(lidUpperRaise=1), face(lidsSlit=1)))
    front = open_eyes[:, 5] > 0.9
    assert narrow[front, 10].mean() < open_eyes[front, 10].mean() - 0.05


def test_bad_weights_are_refused(surface):
    with pytest.raises(InvalidInputError):
        list(surface.faces("female", np.zeros((1, 3), np.float32)))
    with pytest.raises(InvalidInputError):
        list(surface.faces("nobody", face()))


def test_a_plain_look_needs_no_edges_and_no_lines():
    rig = ball_rig()
    surface = Surface(rig, plain_look(rig))
    rows = next(iter(surface.faces("ball", np.ones((1, 1), np.float32))))
    assert list(rows) == ["skin"]
    assert np.isfinite(rows["skin"]).all()
