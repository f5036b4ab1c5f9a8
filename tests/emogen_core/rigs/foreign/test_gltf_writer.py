"""glTF out: the same vertices and offsets come back, and the file keeps the rules of the specification."""

import json
import struct

import numpy as np
import pytest
import trimesh

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.setup import bundled_look
from emogen_core.rigs.foreign.gltf import read_gltf
from emogen_core.rigs.foreign.gltf_writer import gltf_binary
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.foreign.texture import corner_uv
from tests.rig_factory import full_rig, small_rig

SIZES = {5121: 1, 5123: 2, 5125: 4, 5126: 4}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


def unpacked(data):
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def back(tmp_path, data):
    path = tmp_path / "head.glb"
    path.write_bytes(data)
    return read_gltf(path, Findings())


@pytest.mark.parametrize("identity", ["female", "male"])
@pytest.mark.parametrize("core", [False, True])
def test_vertices_and_offsets_come_back(tmp_path, identity, core):
    rig = full_rig()
    model = back(tmp_path, gltf_binary(rig, identity, core=core))
    names = rig.core_shapes if core else rig.shape_names
    assert tuple(model.expressions) == names
    assert np.abs(model.vertices * 1000 - rig.neutral(identity)).max() < 1e-6
    assert np.array_equal(model.triangles, rig.triangles)
    assert dict(model.parts) == dict(rig.parts)
    for name, offsets in zip(names, rig.shape_offsets(identity), strict=False):
        assert np.abs(model.expressions[name] * 1000 - offsets).max() < 1e-6


def test_the_bundled_head_comes_back_with_its_texture_coordinates(tmp_path):
    rig, look = load_bundled_rig(), bundled_look()
    model = back(tmp_path, gltf_binary(rig, "male", look=look))
    assert np.abs(model.vertices * 1000 - rig.neutral("male")).max() < 5e-5
    assert np.array_equal(model.triangles, rig.triangles)
    assert dict(model.parts) == dict(rig.parts)
    offsets = np.stack(list(model.expressions.values())) * 1000
    assert np.abs(offsets - rig.shape_offsets("male")).max() < 1e-5
    assert np.abs(model.uv - corner_uv(rig, look)).max() < 1e-6


def test_texture_coordinates_are_those_of_the_layers():
    rig, look = load_bundled_rig(), bundled_look()
    uv = corner_uv(rig, look)
    known = {
        (vertex, *np.round(place, 6))
        for layer in look.layers.values()
        for vertex, place in zip(layer.source.tolist(), layer.uv.astype(float), strict=True)
    }
    drawn = uv.any(axis=(1, 2))
    assert drawn.sum() == sum(len(layer.triangles) for layer in look.layers.values())
    found = {
        (vertex, *np.round(place, 6))
        for vertex, place in zip(
            rig.triangles[drawn].ravel().tolist(), uv[drawn].reshape(-1, 2).astype(float), strict=True
        )
    }
    assert found <= known
    with pytest.raises(InvalidInputError, match="look"):
        corner_uv(small_rig(), look)


def test_a_face_is_set_by_the_weights():
    rig = small_rig()
    weights = np.linspace(0, 1, len(rig.shape_names))
    document, _ = unpacked(gltf_binary(rig, "female", weights))
    assert np.allclose(document["meshes"][0]["weights"], weights)
    document, _ = unpacked(gltf_binary(rig, "female", weights, core=True))
    assert np.allclose(document["meshes"][0]["weights"], weights[: len(rig.core_shapes)])
    assert document["meshes"][0]["extras"]["targetNames"] == list(rig.core_shapes)
    document, _ = unpacked(gltf_binary(rig, "female"))
    assert not any(document["meshes"][0]["weights"])


@pytest.mark.parametrize("weights", [[0.5], [2.0] * 15, [float("nan")] * 15, [["a"]]])
def test_weights_that_are_not_the_rigs_are_refused(weights):
    with pytest.raises(InvalidInputError, match="weights"):
        gltf_binary(small_rig(), "female", weights)


def test_an_unknown_identity_is_refused():
    with pytest.raises(InvalidInputError, match="identity"):
        gltf_binary(small_rig(), "nobody")


def elements(document, data, place, count, width):
    view = document["bufferViews"][place["bufferView"]]
    assert view["byteOffset"] % 4 == 0
    assert view["byteOffset"] + view["byteLength"] <= document["buffers"][0]["byteLength"]
    dtype = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[place["componentType"]]
    assert count * width * SIZES[place["componentType"]] == view["byteLength"]
    return np.frombuffer(data, dtype, count * width, view["byteOffset"]).reshape(count, width)


def values(document, data, index):
    """Decode an accessor with no code of ours."""
    accessor = document["accessors"][index]
    count, width = accessor["count"], WIDTHS[accessor["type"]]
    if "sparse" not in accessor:
        return elements(document, data, accessor, count, width)
    sparse = accessor["sparse"]
    assert not any("target" in document["bufferViews"][sparse[kind]["bufferView"]] for kind in ("indices", "values"))
    rows = elements(document, data, sparse["indices"], sparse["count"], 1)[:, 0].astype(int)
    assert (np.diff(rows) > 0).all()
    assert 1 <= sparse["count"] <= count
    whole = np.zeros((count, width), np.float32)
    whole[rows] = elements(document, data, {"componentType": 5126, **sparse["values"]}, sparse["count"], width)
    return whole


@pytest.mark.parametrize("made", [lambda: (full_rig(), None), lambda: (load_bundled_rig(), bundled_look())])
def test_the_rules_of_the_specification(made):
    rig, look = made()
    file = gltf_binary(rig, "male", look=look)
    magic, version, length = struct.unpack_from("<4sII", file)
    assert (magic, version, length, length % 4) == (b"glTF", 2, len(file), 0)
    document, data = unpacked(file)
    assert len(data) - document["buffers"][0]["byteLength"] in range(4)
    mesh = document["meshes"][0]
    for primitive in mesh["primitives"]:
        position = document["accessors"][primitive["attributes"]["POSITION"]]
        assert len(primitive["targets"]) == len(mesh["weights"]) == len(mesh["extras"]["targetNames"])
        for index in (primitive["attributes"]["POSITION"], *(target["POSITION"] for target in primitive["targets"])):
            accessor, own = document["accessors"][index], values(document, data, index)
            assert accessor["count"] == position["count"]
            assert own.min(axis=0).tolist() == accessor["min"]
            assert own.max(axis=0).tolist() == accessor["max"]
        for index in primitive["attributes"].values():
            assert document["bufferViews"][document["accessors"][index]["bufferView"]]["target"] == 34962
        indices = document["accessors"][primitive["indices"]]
        assert document["bufferViews"][indices["bufferView"]]["target"] == 34963
        corners = values(document, data, primitive["indices"])
        assert corners.max() < position["count"]
        # The largest of a type restarts a strip.
        assert corners.max() < np.iinfo(corners.dtype).max


def test_another_library_reads_the_same_mesh(tmp_path):
    rig = load_bundled_rig()
    path = tmp_path / "head.glb"
    path.write_bytes(gltf_binary(rig, "female"))
    scene = trimesh.load(path)
    whole = rig.neutral("female") / 1000
    assert np.allclose(scene.bounds, [whole.min(axis=0), whole.max(axis=0)], atol=1e-6)
    assert sum(len(mesh.faces) for mesh in scene.geometry.values()) == len(rig.triangles)
