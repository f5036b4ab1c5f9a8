"""One head laid over another: where the vertices of both are known, they meet."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.imported.front import Front
from emogen_core.rigs.imported.match import nearest
from emogen_core.rigs.imported.mouth import drop_of
from emogen_core.rigs.imported.overlay import Skin, laid_over

rig = load_bundled_rig()
FLESH = rig.triangles[: rig.parts["sockets"][1]]
JAW = drop_of({"jawOpen": rig.offsets[rig.shape_names.index("jawOpen")]}, np.unique(FLESH), rig.offsets.shape[1])


def head(who):
    neutral = rig.neutral(who).astype(np.float64)
    eyes = np.concatenate([rig.triangles[slice(*rig.parts[name])] for name in ("eye_left", "eye_right")])
    return Front(neutral, FLESH, eyes, JAW)


def skin(who):
    return Skin(rig.neutral(who).astype(np.float64), FLESH, JAW)


def face(who):
    """Vertices of the skin in front, from brows to chin."""
    x, y, z = rig.neutral(who).T
    own = np.isin(np.arange(len(x)), rig.triangles[slice(*rig.parts["skin"])])
    return np.flatnonzero(own & (np.abs(x) < 55) & (z > -15) & (y > -100) & (y < 40))


@pytest.mark.parametrize("who", ["asian-male-old", "african-female-young"])
def test_vertices_come_to_lie_on_their_likes(who):
    laid = laid_over(skin("female"), skin(who), head("female").landmarks(), head(who).landmarks())
    rows = face(who)
    before = np.linalg.norm(rig.neutral("female")[rows] - rig.neutral(who)[rows], axis=1)
    after = np.linalg.norm(laid.vertices[rows] - rig.neutral(who)[rows], axis=1)
    assert np.median(after) < 2.2
    assert np.quantile(after, 0.95) < 6.5
    assert np.median(after) < np.median(before) / 2
    # On the surface they lie closer than to their likes.
    placed = nearest(skin(who), laid.features()[rows], laid.vertices[rows])
    away = np.linalg.norm(placed.of(rig.neutral(who)) - laid.vertices[rows], axis=1)
    assert np.quantile(away, 0.95) < 1.5


def test_a_head_lies_on_itself():
    laid = laid_over(skin("male"), skin("male"), head("male").landmarks(), head("male").landmarks())
    assert np.abs(laid.vertices[face("male")] - rig.neutral("male")[face("male")]).max() < 0.02


def test_too_few_places_are_refused():
    few = dict(list(head("male").landmarks().items())[:5])
    with pytest.raises(InvalidInputError, match="head: expected 20 places of a face"):
        laid_over(skin("male"), skin("male"), few, few)


def test_a_place_on_a_surface_is_found_again():
    surface = skin("male")
    generator = np.random.default_rng(3)
    first, last = rig.parts["skin"]
    rows = generator.choice(np.arange(first, last), 400, replace=False)
    shares = generator.dirichlet((2, 2, 2), 400)
    corners = rig.triangles[rows]
    points = np.einsum("nc,ncd->nd", shares, surface.vertices[corners])
    features = np.einsum("nc,ncd->nd", shares, surface.features()[corners])
    placed = nearest(surface, features, points)
    assert np.abs(placed.of(surface.vertices) - points).max() < 1e-3
    assert (placed.corners == corners).all(1).mean() > 0.95
