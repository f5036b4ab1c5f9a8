"""What the graphics card is given."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rendering.camera import frame_head
from emogen_core.rendering.look import HAIR_DEPTH
from emogen_core.rendering.normals import NormalField
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.setup import look_for
from emogen_core.rendering.surface import COLUMNS, Surface

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


def test_without_expression_lines_nothing_else_changes(surface):
    bare = Surface(rig, replace(surface.look, styles=without_lines(surface.look)))
    weights = face(browRaise=1, mouthSmile=1, noseWrinkle=1)
    with_lines, without = rows_of(surface, weights), rows_of(bare, weights)
    assert (without["skin"][:, 13] == 0).all()
    assert with_lines["skin"][:, 13].max() > 0.3
    for name, rows in with_lines.items():
        columns = slice(0, 13) if name == "skin" else slice(None)
        assert np.array_equal(rows[:, columns], without[name][:, columns])


def without_lines(look):
    return {name: replace(style, wrinkles=0.0) for name, style in look.styles.items()}


@pytest.mark.parametrize("gene", [g.name for g in rig.genes if "disabled" not in g.flags])
def test_lines_deepen_with_a_gene_and_with_age(surface, gene):
    steps = [rows_of(surface, face(**{gene: value}))["skin"][:, 13] for value in (0, 0.5, 1)]
    old = rows_of(surface, face(**{gene: 1}), "caucasian-female-old")["skin"][:, 13]
    young = rows_of(surface, face(**{gene: 1}), "caucasian-female-young")["skin"][:, 13]
    assert (steps[0] == 0).all()
    assert (steps[1] <= steps[2] + 1e-6).all()
    assert (young <= old + 1e-6).all()
    assert steps[2].max() < 1


def test_symmetric_weights_give_mirrored_vertices_and_normals(surface):
    neutral = rig.neutral("female")
    distance, mirror = cKDTree(neutral).query(neutral * (-1, 1, 1))
    drawn = np.unique(np.concatenate([layer.source for layer in surface.look.layers.values()]))
    drawn = drawn[distance[drawn] < 1e-3]
    assert len(drawn) > 5000
    for weights in (face(mouthSmile=1, browDown=0.7, jawOpen=0.4), face(noseWrinkle=1, mouthFrown=0.8, lidsTight=1)):
        mesh = vertices(rig, "female", weights)[0]
        normals = surface.normals(mesh)
        assert mesh[mirror[drawn]] * (-1, 1, 1) == pytest.approx(mesh[drawn], abs=2e-2)
        turned = np.einsum("ij,ij->i", normals[mirror[drawn]] * (-1, 1, 1), normals[drawn])
        # Coincident vertices of different parts may be paired with each other's images.
        assert np.percentile(turned, 2) > 0.995


@pytest.mark.parametrize("identity", ["female", "asian-male-old"])
def test_every_gene_alone_gives_finite_rows(surface, identity):
    for gene in rig.genes:
        for rows in rows_of(surface, face(**{gene.name: 1}), identity).values():
            assert np.isfinite(rows).all(), gene.name


@pytest.mark.parametrize("identity", rig.identities)
def test_the_catchlight_stays_between_the_lids_and_goes_out_with_them(surface, identity):
    lids = (face(), face(lidsSlit=0.5), face(lidsClose=1), face(lidsClose=0.85))
    eyes = [rows_of(surface, w, identity)["eyes"] for w in lids]
    heights = [lamp(rows)[1] for rows in eyes]
    strengths = [rows[:, 12].max() for rows in eyes]
    assert heights[0] >= heights[1] - 1e-6
    assert strengths[0] == pytest.approx(1)
    assert strengths[1] > 0.3
    assert strengths[2] < 0.1
    assert strengths[3] < 0.1  # no white dot in a slit


def lamp(rows):
    """Return where the lamp's image lies on the left eye, in radii from its middle."""
    left = rows[rows[:, 0] > 0]
    low, high = left[:, :2].min(0), left[:, :2].max(0)
    place = (left[:, :2] - (low + high) / 2) / ((high[0] - low[0]) / 2) - left[:, 8:10]
    assert np.ptp(place, axis=0) == pytest.approx(0, abs=1e-4)
    return place.mean(0)


def test_the_catchlight_follows_the_gaze_a_part_of_its_way(surface):
    right, ahead, left = (lamp(rows_of(surface, w)["eyes"])[0] for w in (face(gazeRight=1), face(), face(gazeLeft=1)))
    assert ahead < 0  # the lamp stands on the head's right
    assert 0.05 < abs(left - ahead) < 0.4
    assert 0.05 < abs(right - ahead) < 0.4
    assert (left - ahead) * (right - ahead) < 0


@pytest.mark.parametrize("identity", rig.identities)
def test_eyes_are_darkest_under_the_lid_and_in_their_corners(surface, identity):
    rows, look = rows_of(surface, face(), identity)["eyes"], surface.look
    mesh = rig.neutral(identity)
    upper, lower = mesh[look.edges["left_upper"]], mesh[look.edges["left_lower"]]
    inside = rows[:, 0] > max(upper[0, 0], lower[0, 0])
    x, y = rows[inside, 0], rows[inside, 1]
    top, bottom = (np.interp(x, lid[:, 0], lid[:, 1]) for lid in (upper, lower))
    seen = (y < top) & (y > bottom)
    across = (x - upper[0, 0]) / np.ptp(upper[:, 0])
    middle = np.abs(across - 0.5) < 0.2
    light = rows[inside, 10]
    assert light[seen & ~middle].mean() < 0.9 * light[seen & middle & (y < (top + bottom) / 2)].mean()


# A smile rolls the lip in and draws it over the teeth: it shades them less.
@pytest.mark.parametrize(("pose", "share"), [({}, 0.85), ({"upperLipRaise": 1}, 0.85), ({"mouthSmileOpen": 1}, 0.95)])
def test_the_upper_lip_shades_the_teeth_behind_it(surface, pose, share):
    layer = surface.look.layers["skin"]
    weights = face(lowerLipRetract=1, **pose)
    rows = rows_of(surface, weights)["skin"]
    lip = vertices(rig, "female", weights)[0][surface.look.edges["mouth_upper"]]
    front = (layer.surface[:, 0] < 0.2) & (np.abs(rows[:, 0]) < 10) & (rows[:, 5] > 0.5)
    below = np.interp(rows[:, 0], lip[:, 0], lip[:, 1]) - rows[:, 1]
    near, far = front & (below > -1) & (below < 1.5), front & (below > 4) & (below < 9)
    assert near.any()
    assert far.any()
    for column in (8, 10):
        assert rows[near, column].mean() < share * rows[far, column].mean()


def test_a_tongue_put_out_comes_into_the_light(surface):
    tongue = np.isclose(surface.look.layers["skin"].surface[:, 0], 0.6, atol=1e-3)
    kept, out = (rows_of(surface, w)["skin"][tongue] for w in (face(jawOpen=0.5), face(jawOpen=0.5, tongueOut=1)))
    tip = out[:, 2] > np.percentile(out[:, 2], 90)
    assert out[tip, 10].mean() > 0.5
    assert out[tip, 10].mean() > 1.3 * kept[tip, 10].mean()


def test_lines_between_the_brows_hardly_show_at_rest(surface):
    look = surface.look
    drivers = [set(drivers) for drivers in look.wrinkle_drivers]
    glabella = next(g for g, names in enumerate(drivers) if {"browKnit.L", "browDown.L", "noseWrinkle.L"} <= names)
    everywhere = Surface(rig, replace(look, wrinkle_rest=()))
    at = look.wrinkle_masks[:, glabella] > 0.9
    calm, strong = (rows_of(s, face(), "caucasian-male-old")["skin"][at, 13].mean() for s in (surface, everywhere))
    assert 0 < calm < 0.7 * strong
    knit, same = (rows_of(s, face(browKnit=1), "female")["skin"][at, 13] for s in (surface, everywhere))
    assert np.array_equal(knit, same)


def test_the_mouth_grows_dark_behind_the_lips(surface):
    rows = rows_of(surface, face(jawOpen=1))["skin"]
    inside = surface.look.layers["skin"].surface[:, 2] == 1
    lips = rig.neutral("female")[surface.look.edges["mouth_upper"], 2].max()
    behind = lips - rows[:, 2]
    assert rows[inside & (behind > 45), 10].mean() < 0.5 * rows[inside & (behind < 12), 10].mean()


@pytest.mark.parametrize("identity", rig.identities)
def test_what_is_left_out_of_the_frame_has_faded_on_every_face(surface, identity):
    camera = frame_head(surface.neutral_skin(identity))
    framed = surface.framed_skin(identity, camera)
    layer = surface.look.layers["skin"]
    assert 0.8 * len(layer.triangles) < len(framed) <= len(layer.triangles)
    shown = {tuple(row) for row in framed.tolist()}
    dropped = np.array([row for row in layer.triangles.tolist() if tuple(row) not in shown])
    _, gone, sideward = camera.fade
    for weights in (face(), face(neckTighten=1, jawOpen=1), face(mouthDepress=1, chinRaise=1)):
        x, y = rows_of(surface, weights, identity)["skin"][:, :2].T
        assert ((y - sideward * x**2)[dropped] < gone).all()


def test_lowered_lids_darken_the_eyes(surface):
    open_eyes, narrow = (rows_of(surface, w)["eyes"] for w in (face(lidUpperRaise=1), face(lidsSlit=1)))
    front = open_eyes[:, 5] > 0.9
    assert narrow[front, 10].mean() < open_eyes[front, 10].mean() - 0.05


@pytest.mark.parametrize("value", [np.nan, np.inf, -0.01, 1.01])
def test_a_weight_that_is_none_is_refused(surface, value):
    weights = face()
    weights[0, 3] = value
    with pytest.raises(InvalidInputError, match="finite values in"):
        list(surface.faces("female", weights))


def test_wrong_counts_and_unknown_heads_are_refused(surface):
    for weights in (np.zeros((1, 3), np.float32), face()[0], np.zeros((1, len(rig.shape_names) + 1), np.float32)):
        with pytest.raises(InvalidInputError, match="expected shape"):
            list(surface.faces("female", weights))
    with pytest.raises(InvalidInputError, match="nobody"):
        list(surface.faces("nobody", face()))


def test_a_plain_look_needs_no_edges_and_no_lines():
    rig = ball_rig()
    surface = Surface(rig, plain_look(rig))
    rows = next(iter(surface.faces("ball", np.ones((1, 1), np.float32))))
    assert list(rows) == ["skin"]
    assert np.isfinite(rows["skin"]).all()


def test_a_turned_head_is_the_same_head_turned(surface):
    """Its nose goes to the viewer's right; what is lit by what is as it was."""
    turned = Surface(rig, look_for(rig), 30)
    weights = face(jawOpen=1, gazeUp=0.5)
    plain, other = rows_of(surface, weights), rows_of(turned, weights)
    angle = np.deg2rad(30)
    for name, rows in plain.items():
        for columns, away in ((slice(0, 3), 1e-3), (slice(3, 6), 1e-5)):
            x, y, z = rows[:, columns].T
            wanted = np.stack([x * np.cos(angle) + z * np.sin(angle), y, z * np.cos(angle) - x * np.sin(angle)], -1)
            np.testing.assert_allclose(other[name][:, columns], wanted, atol=away)
        np.testing.assert_array_equal(other[name][:, 6:], rows[:, 6:])
    nose = plain["skin"][:, 2].argmax()
    assert other["skin"][nose, 0] > plain["skin"][nose, 0] + 5
    np.testing.assert_array_equal(turned.neutral_skin("female"), surface.neutral_skin("female"))


def test_a_turned_bust_is_drawn_as_far_as_it_shows(surface):
    camera = frame_head(surface.neutral_skin("female"))
    turned = Surface(rig, look_for(rig), 30)
    shown = turned.framed_skin("female", camera)
    rows = rows_of(turned, face())["skin"]
    above = rows[:, 1] - camera.fade[2] * rows[:, 0] ** 2 > camera.fade[1]
    assert set(np.flatnonzero(above)) <= set(shown.ravel())
