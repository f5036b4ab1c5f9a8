"""Whole glTF files: meshes, nodes, targets and split vertices become one model."""

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign import gltf as module
from emogen_core.rigs.foreign.gltf import read_gltf
from emogen_core.rigs.foreign.model import Findings
from tests.emogen_core.rigs.foreign.heads import Gltf, gltf_of, made_head

POINTS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
SIDES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
MOVE = np.eye(4, 3, dtype=np.float32)


@pytest.fixture
def read(tmp_path):
    def read(made, findings=None):
        path = tmp_path / "head.glb"
        path.write_bytes(made if isinstance(made, bytes) else made.glb())
        return read_gltf(path, findings or Findings())

    return read


def body(made, points=POINTS, triangles=SIDES, targets=(MOVE,), **more):
    return {
        "attributes": {"POSITION": made.accessor(points)} | more.pop("attributes", {}),
        "indices": made.indices(triangles), "targets": [{"POSITION": made.accessor(one)} for one in targets], **more,
    }  # fmt: skip


def test_a_head_is_read_as_it_was_written(read):
    head = made_head()
    findings = Findings()
    model = read(gltf_of(head), findings)
    assert dict(model.parts) == head.parts
    assert list(model.expressions) == list(head.expressions)
    # The order of vertices may change, the mesh may not.
    assert np.array_equal(model.vertices[model.triangles], head.vertices[head.triangles])
    for name, offsets in head.expressions.items():
        assert np.array_equal(model.expressions[name][model.triangles], offsets[head.triangles])
    assert len(model.vertices) == len(head.vertices)
    assert "5 pieces with 13 morph targets" in findings.found[0]


def test_meshes_share_targets_by_name(read):
    made = Gltf()
    made.mesh(body(made, targets=(MOVE, 2 * MOVE)), names=["jawOpen", "eyeBlink_L"])
    made.mesh(body(made, points=POINTS + 5, targets=(3 * MOVE,)), names=["jawOpen"])
    made.mesh(body(made, points=POINTS - 5, targets=()))
    made.document["nodes"] = [
        {"children": [1, 2, 3]},
        {"mesh": 0, "name": "Head"},
        {"mesh": 1},
        {"mesh": 2, "name": "Hat"},
    ]
    model = read(made)
    assert model.expressions["jawOpen"].tolist() == np.vstack([MOVE, 3 * MOVE, 0 * MOVE]).tolist()
    assert model.expressions["eyeBlink_L"].tolist() == np.vstack([2 * MOVE, 0 * MOVE, 0 * MOVE]).tolist()
    assert list(model.parts) == ["Head", "mesh 1", "Hat"]


def test_nodes_move_turn_and_scale(read):
    made = Gltf()
    made.mesh(body(made), names=["jawOpen"])
    quarter = Rotation.from_euler("z", 90, degrees=True)
    scaled = np.diag([2.0, 2, 2, 1])
    scaled[:3, 3] = (7, 8, 9)
    made.document["nodes"] = [
        {"children": [1], "matrix": scaled.T.ravel().tolist()},
        {"mesh": 0, "rotation": quarter.as_quat().tolist(), "translation": [1, 2, 3], "scale": [1, 1, 4]},
    ]
    model = read(made)
    wanted = (quarter.apply(POINTS * (1, 1, 4)) + np.array((1, 2, 3))) * 2 + np.array((7, 8, 9))
    order = [int(np.abs(model.vertices - row).sum(1).argmin()) for row in wanted]
    assert np.allclose(model.vertices[order], wanted, atol=1e-6)
    assert np.allclose(model.expressions["jawOpen"][order], quarter.apply(MOVE * (1, 1, 4)) * 2, atol=1e-6)


def test_a_mirrored_node_turns_its_triangles(read):
    made = Gltf()
    made.mesh(body(made), names=["jawOpen"])
    made.document["nodes"] = [{"mesh": 0, "scale": [-1, 1, 1]}]
    corners = read(made).vertices[read(made).triangles].astype(float)
    volume = np.linalg.det(corners).sum()
    assert volume > 0
    made.document["nodes"] = [{"mesh": 0}]
    plain = read(made)
    assert np.linalg.det(plain.vertices[plain.triangles].astype(float)).sum() > 0


def test_a_mesh_on_a_skeleton_stands_where_its_joints_put_it(read):
    made = Gltf()
    made.mesh(body(made), names=["jawOpen"])
    inverse = np.eye(4)
    inverse[:3, 3] = (0, -1, 0)
    matrices = made.accessor(inverse.T.reshape(1, 16), "MAT4")
    made.document["nodes"] = [
        {"children": [1, 2]}, {"mesh": 0, "skin": 0, "translation": [9, 9, 9]},
        {"translation": [0, 1, 0], "scale": [2, 2, 2]},
    ]  # fmt: skip
    made.document["skins"] = [{"joints": [2], "inverseBindMatrices": matrices}]
    model = read(made)
    assert model.vertices.max(axis=0).tolist() == [2, 1, 2]
    del made.document["skins"][0]["inverseBindMatrices"]
    assert read(made).vertices.max(axis=0).tolist() == [2, 3, 2]


def test_vertices_that_were_split_are_one_again(read):
    made = Gltf()
    corners = np.array(SIDES)
    made.mesh(body(made, POINTS[corners.ravel()], np.arange(12), [MOVE[corners.ravel()]]), names=["jawOpen"])
    model = read(made)
    assert model.vertices.shape == (4, 3)
    assert np.array_equal(model.vertices[model.triangles], POINTS[corners])


def test_vertices_that_move_apart_stay_two(read):
    made = Gltf()
    points = np.vstack([POINTS, POINTS])
    made.mesh(body(made, points, [*SIDES, *(np.array(SIDES) + 4)], [np.vstack([MOVE, MOVE * 2])]), names=["jawOpen"])
    model = read(made)
    assert len(model.vertices) == 4 + 3  # only the one that neither moves is shared


def test_two_meshes_never_share_vertices(read):
    made = Gltf()
    made.mesh(body(made), names=["jawOpen"])
    made.document["nodes"] = [{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0}]
    model = read(made)
    assert len(model.vertices) == 8
    assert list(model.parts) == ["mesh 0", "mesh 0 2"]


def test_triangles_without_indices_and_points_between(read):
    made = Gltf()
    corners = np.array(SIDES).ravel()
    primitive = body(made, POINTS[corners], targets=[MOVE[corners]])
    del primitive["indices"]
    made.mesh({"attributes": {"POSITION": 0}, "mode": 0}, primitive, names=["jawOpen"])
    assert len(read(made).triangles) == 4


def test_a_target_without_positions_moves_nothing(read):
    made = Gltf()
    primitive = body(made)
    primitive["targets"].append({"NORMAL": 0})
    made.mesh(primitive, names=["jawOpen", "eyeBlink_L"])
    assert not read(made).expressions["eyeBlink_L"].any()


def test_texture_coordinates_count_from_below(read):
    made = Gltf()
    uv = made.accessor([[0, 0], [1, 0], [0, 0.25], [1, 1]], "VEC2")
    made.mesh(body(made, attributes={"TEXCOORD_0": uv}), names=["jawOpen"])
    assert read(made).uv[0].tolist() == [[0, 1], [0, 0.75], [1, 1]]


def test_names_of_parts_that_are_no_text_become_text(read):
    made = Gltf()
    made.mesh(body(made, material=0), body(made, material=1), names=["jawOpen"])
    made.document["materials"] = [{"name": 7}, {"name": ["a"]}]
    assert list(read(made).parts) == ["7", "['a']"]


def test_names_may_stand_at_the_primitive(read):
    made = Gltf()
    made.mesh(body(made, extras={"targetNames": ["jawOpen"]}))
    assert list(read(made).expressions) == ["jawOpen"]


def change(path, value):
    def apply(document):
        *most, last = path
        for step in most:
            document = document[step]
        document[last] = value

    return apply


@pytest.mark.parametrize(
    ("apply", "why"),
    [
        (change(["meshes", 0, "extras"], {}), "1 different names"),
        (change(["meshes", 0, "extras", "targetNames"], ["a", "b"]), "1 different names"),
        (change(["meshes", 0, "extras", "targetNames"], [7]), "export shape keys"),
        (change(["meshes", 0, "extras", "targetNames"], [["a"]]), "export shape keys"),
        (change(["meshes", 0, "primitives", 0, "mode"], 5), "strips"),
        (change(["meshes", 0, "primitives"], []), "a mesh of triangles"),
        (change(["meshes", 0, "primitives", 0, "attributes"], {}), "complete glTF"),
        (change(["meshes", 0, "primitives", 0, "indices"], 99), "accessor"),
        (change(["accessors", 1, "count"], 11), "three a triangle"),
        (change(["accessors", 0, "count"], 3), "three a triangle"),
        (change(["accessors", 2, "count"], 3), "morph target jawOpen.*4 values"),
        (change(["meshes"], "text"), "complete glTF"),
        (change(["nodes", 0], {"children": [0]}), "a tree"),
        (change(["nodes", 0, "mesh"], 7), "complete glTF"),
        (change(["nodes", 0, "children"], [5]), "complete glTF"),
        (change(["scenes"], [{}]), "a mesh of triangles"),
        (change(["scene"], 4), "complete glTF"),
        (change(["nodes", 0, "matrix"], [1, 2]), "glTF"),
        (change(["nodes", 0, "rotation"], [0, 0, 0, 0]), "glTF"),
    ],
)
def test_what_contradicts_itself_is_refused(read, apply, why):
    made = Gltf()
    made.mesh(body(made), names=["jawOpen"])
    made.document = json.loads(json.dumps(made.document))
    apply(made.document)
    with pytest.raises(InvalidInputError, match=why):
        read(made)


def test_many_vertices_with_many_targets_are_refused_before_they_are_read(read, monkeypatch):
    made = Gltf()
    made.mesh(body(made, targets=(MOVE, MOVE)), names=["jawOpen", "eyeBlink_L"])
    monkeypatch.setattr(module, "MAX_MOVED", 12)
    read(made)
    monkeypatch.setattr(module, "MAX_MOVED", 11)
    with pytest.raises(InvalidInputError, match="at most 11 vertices times morph targets, got 12"):
        read(made)


def test_names_that_occur_twice_are_refused(read):
    made = Gltf()
    made.mesh(body(made, targets=(MOVE, MOVE)), names=["jawOpen", "jawOpen"])
    with pytest.raises(InvalidInputError, match="2 different names"):
        read(made)


@pytest.mark.parametrize("numbers", [[0, 1, 2, 4], [-1, 0, 1, 2], [0, 1, 2, 1e9], [0, 1, 2, np.nan]])
def test_numbers_of_vertices_that_leave_gaps_are_refused(read, numbers):
    made = Gltf()
    made.mesh(body(made, attributes={"_VERTEX": made.accessor(numbers, "SCALAR")}), names=["jawOpen"])
    with pytest.raises(InvalidInputError, match="all numbers below"):
        read(made)


@pytest.mark.parametrize("wrong", [-1, 4])
def test_corners_that_are_no_vertices_are_refused(read, wrong):
    made = Gltf()
    primitive = body(made)
    corners = np.array(SIDES).ravel()
    corners[5] = wrong
    primitive["indices"] = made.accessor(corners, "SCALAR", 5120, "<i1")
    made.mesh(primitive, names=["jawOpen"])
    with pytest.raises(InvalidInputError, match="indices: expected three a triangle, from 0 and below 4"):
        read(made)


def test_numbers_of_vertices_are_believed(read):
    made = Gltf()
    made.mesh(body(made, attributes={"_VERTEX": made.accessor([3, 2, 1, 0], "SCALAR")}), names=["jawOpen"])
    model = read(made)
    assert model.vertices.tolist() == POINTS[::-1].tolist()
    assert model.triangles.tolist() == (3 - np.array(SIDES)).tolist()
