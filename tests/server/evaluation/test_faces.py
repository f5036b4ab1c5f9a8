"""Faces: three pictures a result, one scale a table that nothing goes beyond, targets drawn once."""

import base64
import io
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from emogen_core.face.evaluate import vertices
from emogen_core.rendering.heat import HeatArtist
from emogen_core.simulation.evaluation.table import Heat
from server.evaluation.faces import Gallery
from server.reporting.pictures import rounded_up
from tests.server.evaluation.tables import RIG, PlainRenderer, face, studio

BLANK = np.zeros((4, 4, 3), np.uint8)


def pixels(address):
    kind, _, data = address.partition(",")
    assert kind == "data:image/webp;base64"
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")).astype(int)


@pytest.fixture(scope="module")
def renderer():
    return PlainRenderer()


@pytest.fixture(scope="module")
def gallery(renderer):
    heats = Heat("near", face(0.9), face(1)), Heat("far", face(0, 0, 1), face(1)), Heat("same", face(1), face(1))
    return studio(renderer).gallery(heats)


def test_the_limit_holds_the_greatest_difference_of_the_table(gallery):
    meshes = vertices(RIG, "female", np.stack([face(0, 0, 1), face(1)]))
    greatest = float(np.linalg.norm(meshes[0] - meshes[1], axis=1).max())
    near, far, same = gallery.pictures
    assert far.greatest == pytest.approx(greatest)
    assert 0 == same.greatest < near.greatest < far.greatest <= gallery.limit == rounded_up(greatest)


def test_the_heat_is_of_the_difference_alone(gallery):
    near, far, same = ((np.ptp(pixels(one.apart), axis=2) > 40).sum() for one in gallery.pictures)
    assert same == 0 and far > near


def test_what_was_meant_and_what_was_found_do_not_change_places(gallery):
    near, far, same = gallery.pictures
    assert near.meant == far.meant == same.meant == same.found
    assert len({near.meant, near.found, far.found}) == 3
    assert pixels(near.meant).shape == (240, 200, 3)


def test_the_heat_lies_on_what_was_found(monkeypatch):
    drawn = []
    monkeypatch.setattr(HeatArtist, "draw", lambda _, mesh, values, limit: drawn.append((mesh, values, limit)) or BLANK)
    gallery = studio().gallery([Heat("open", face(0.7, 0.2), face(0, 0, 1))])
    ((mesh, values, limit),) = drawn
    found, meant = vertices(RIG, "female", np.stack([face(0.7, 0.2), face(0, 0, 1)]))
    np.testing.assert_array_equal(mesh, found)
    np.testing.assert_allclose(values, np.linalg.norm(found - meant, axis=1))
    assert limit == gallery.limit


def test_a_face_is_drawn_once(gallery, renderer):
    assert renderer.drawn == 3


def test_weights_beyond_their_range_are_drawn_at_its_end():
    beyond = Heat("beyond", face(1.0), face(1.0000001))
    assert studio().gallery([beyond]) == Gallery(
        1.0, (replace(studio().gallery([Heat("beyond", face(1), face(1))]).pictures[0]),)
    )
