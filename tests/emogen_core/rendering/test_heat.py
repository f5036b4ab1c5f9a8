"""Differences as colour on the face."""

import numpy as np

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.heat import STOPS, HeatArtist, colours
from emogen_core.rendering.protocol import RenderSettings

rig = load_bundled_rig()
SMALL = RenderSettings(100, 120)


def picture(values, limit=1.0):
    start, end = rig.parts["skin"]
    mesh = rig.neutral("female")
    skin = mesh[np.unique(rig.triangles[start:end])]
    return HeatArtist(skin, rig.triangles, SMALL).draw(mesh, values, limit).astype(int)


def test_lightness_falls_as_the_number_grows_and_the_limit_holds():
    lightness = colours(np.linspace(0, 1, 50), 1.0) @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(lightness) < 0).all()
    np.testing.assert_array_equal(colours(np.array([1.0, 7.0]), 1.0), STOPS[[-1, -1]])


def test_a_face_without_difference_is_grey():
    plain = picture(np.zeros(len(rig.neutral("female"))))
    assert np.ptp(plain, axis=2).max() <= 4


def test_colour_is_where_the_difference_is():
    mesh = rig.neutral("female")
    left = picture((mesh[:, 0] > 10).astype(float))
    coloured = np.ptp(left, axis=2) > 40
    assert coloured[:, 60:].sum() > 500
    assert coloured[:, :45].sum() == 0
    assert (left[0, 0] == SMALL.background).all()


def test_any_colours_can_be_painted():
    mesh = rig.neutral("female")
    skin = mesh[np.unique(rig.triangles[slice(*rig.parts["skin"])])]
    artist = HeatArtist(skin, rig.triangles, SMALL)
    values = np.linspace(0, 1, len(mesh))
    np.testing.assert_array_equal(artist.paint(mesh, colours(values, 1.0)), artist.draw(mesh, values, 1.0))
    red = artist.paint(mesh, np.tile([1.0, 0.0, 0.0], (len(mesh), 1)))
    assert red[60, 50, 0] > 120
    assert red[60, 50, 1:].max() == 0
