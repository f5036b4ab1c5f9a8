"""A look survives its file, fits one topology, and dresses identities that it does not know."""

import json
import zipfile
from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError, RigFileError
from emogen_core.face.appearance import Appearance
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.container import write_container
from emogen_core.rendering.look import KIND, VERSION, load_look, save_look, topology_hash
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.setup import BUNDLED_LOOK, bundled_look, look_for

from .ball import ball_rig


def test_a_stored_look_reads_back_the_same(tmp_path):
    look = plain_look(ball_rig())
    digest = save_look(tmp_path / "a.look", look)
    again = load_look(tmp_path / "a.look")
    assert again.hash == digest
    assert again.styles == look.styles
    assert again.topology == look.topology
    assert again.wrinkle_rest == look.wrinkle_rest
    for name, layer in look.layers.items():
        for part in ("source", "triangles", "surface"):
            assert np.allclose(getattr(again.layers[name], part), getattr(layer, part), atol=1 / 255)
        assert again.layers[name].uv == pytest.approx(layer.uv, abs=1e-5)
    assert save_look(tmp_path / "b.look", again) == digest


def test_a_composed_style_survives_its_file(tmp_path):
    look = bundled_look().with_style("somebody", Appearance(skin_depth=0.7, iris_colour=(9, 8, 7)))
    save_look(tmp_path / "a.look", look)
    again = load_look(tmp_path / "a.look")
    assert again.style("somebody") == look.style("somebody")
    assert again.paint.keys() == look.paint.keys()
    assert all(np.array_equal(again.paint[name], look.paint[name]) for name in look.paint)


def test_a_look_with_a_broken_appearance_is_refused(tmp_path):
    look = bundled_look()
    worn = replace(look.style("female"), appearance=BrokenAppearance())
    save_look(tmp_path / "a.look", replace(look, styles={"female": worn}, default="female"))
    with pytest.raises(RigFileError, match=r"complete look.*appearance\.grey: expected a number from 0 to 1, got 7"):
        load_look(tmp_path / "a.look")


class BrokenAppearance:
    def to_document(self):
        return Appearance().to_document() | {"grey": 7}


def test_a_damaged_look_is_refused(tmp_path):
    path = tmp_path / "a.look"
    save_look(path, plain_look(ball_rig()))
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(bytes(data))
    with pytest.raises(RigFileError):
        load_look(path)


def test_an_incomplete_look_is_refused(tmp_path):
    path = tmp_path / "a.look"
    write_container(path, KIND, VERSION, {"name": "half"}, {})
    with pytest.raises(RigFileError, match="complete look"):
        load_look(path)


def test_a_missing_look_is_refused(tmp_path):
    with pytest.raises(RigFileError):
        load_look(tmp_path / "none.look")


def test_a_look_fits_only_its_topology():
    rig = ball_rig()
    look = plain_look(rig)
    look.check(rig)
    other = replace(rig, triangles=rig.triangles[:, [1, 2, 0]])
    assert topology_hash(other) != look.topology
    with pytest.raises(InvalidInputError, match="made for the rig"):
        look.check(other)


def test_an_unknown_identity_wears_the_default():
    look = bundled_look()
    assert look.style("somebody imported") == look.style(look.default)


def test_the_bundled_look_dresses_every_bundled_identity():
    rig, look = load_bundled_rig(), bundled_look()
    look.check(rig)
    assert set(rig.identities) <= set(look.styles)
    for identity in rig.identities:
        style = look.style(identity)
        assert style.appearance is not None
        assert look.bakes[style.bake].shape == (len(look.layers["skin"].source), 4)


def test_every_triangle_that_faces_the_camera_is_drawn_and_every_vertex_exists():
    rig, look = load_bundled_rig(), bundled_look()
    drawn = {tuple(row) for layer in look.layers.values() for row in layer.source[layer.triangles].tolist()}
    assert drawn <= {tuple(row) for row in rig.triangles.tolist()}
    for identity in rig.identities:
        a, b, c = np.moveaxis(rig.neutral(identity)[rig.triangles], 1, 0)
        facing = np.einsum("tk,tk->t", np.cross(b - a, c - a), np.array([0, -20, 700]) - a) > 0
        assert {tuple(row) for row in rig.triangles[facing].tolist()} <= drawn
    for layer in look.layers.values():
        assert layer.source.max() < rig.offsets.shape[1]
        assert layer.triangles.max() < len(layer.source)
        assert layer.uv.min() >= 0
        assert layer.uv.max() <= 1
    drivers = {name for group in look.wrinkle_drivers for name in group}
    assert drivers <= set(rig.shape_names)


def test_a_foreign_rig_gets_flat_colours():
    assert look_for(ball_rig()).name == "plain ball"
    assert look_for(load_bundled_rig()).name == "emogen head"


def test_the_file_holds_nothing_that_can_run():
    with zipfile.ZipFile(BUNDLED_LOOK) as archive:
        names = archive.namelist()
        json.loads(archive.read("content.json"))
    assert all(name.endswith((".npy", ".json")) for name in names)
