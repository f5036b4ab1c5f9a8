import numpy as np
import pytest

import emogen_core.transfer.deformation as module
from emogen_core.transfer.deformation import Gradients, deformed, fitted_maps, rigged_by_example
from emogen_core.transfer.residuals import Evidence
from tests.emogen_core.transfer.heads import head, truth


@pytest.fixture
def free(monkeypatch):
    """As good as no anchor: what the triangles alone say."""
    monkeypatch.setattr(module, "_ANCHOR", 1e-9)


def test_gradients_of_a_linear_field_are_the_field_in_the_plane():
    linear = np.array([[0.2, 0.1, 0], [-0.3, 0.9, 0.2], [0, 0.1, 0.5]])
    found = Gradients(head().neutral, head().triangles).of((head().neutral @ linear.T)[None])[0]
    planes = module._planes(head().neutral[head().triangles])
    assert np.allclose(found, planes @ linear.T)


def test_offsets_come_back_from_their_gradients(free):
    gradients = Gradients(head().neutral, head().triangles)
    found = gradients.offsets(gradients.of(head().offsets), 0 * head().offsets)
    shift = (found - head().offsets).mean(1, keepdims=True)
    assert np.allclose(found - shift, head().offsets, atol=1e-3)


def published(neutral, moved, triangles, target):
    """As printed: a fourth vertex for each triangle, all unknown; the first vertex stays put."""

    def fourth(mesh):
        a, b, c = (mesh[triangles[:, i]] for i in range(3))
        normal = np.cross(b - a, c - a)
        return a + normal / np.sqrt(np.linalg.norm(normal, axis=1, keepdims=True))

    def frames(mesh):
        a, b, c = (mesh[triangles[:, i]] for i in range(3))
        return np.stack([b - a, c - a, fourth(mesh) - a], 2)

    count, faces = len(neutral), len(triangles)
    wanted = frames(moved) @ np.linalg.inv(frames(neutral))
    inverse = np.linalg.inv(frames(target))
    system, right = np.zeros((3 * faces + 1, count + faces)), np.zeros((3 * faces + 1, 3))
    for t, (a, b, c) in enumerate(triangles):
        for axis in range(3):
            row, slope = 3 * t + axis, inverse[t, :, axis]
            for vertex, share in zip((b, c, count + t), slope, strict=True):
                system[row, vertex] += share
            system[row, a] -= slope.sum()
            right[row] = wanted[t, :, axis]
    system[-1, 0], right[-1] = 1, target[0] + moved[0] - neutral[0]
    return np.linalg.lstsq(system, right)[0][:count] - target


def test_it_is_the_published_system_without_its_fourth_vertices(free):
    corner = np.arange(25 * 25).reshape(25, 25)[8:15, 8:15].ravel()
    place = np.full(625, -1)
    place[corner] = np.arange(len(corner))
    inside = head().triangles[(place[head().triangles] >= 0).all(1)]
    triangles, neutral, target = place[inside], head().neutral[corner], truth()[0][corner]
    moves = head().offsets[[0, 30], :][:, corner]
    for moved in moves:
        expected = published(neutral, neutral + moved, triangles, target)
        found = deformed(neutral, moved[None], triangles, target)[0]
        assert np.allclose(found - found[0], expected - expected[0], atol=1e-4)


def test_a_larger_head_moves_more(free):
    found = deformed(head().neutral, head().offsets, head().triangles, 2 * head().neutral)
    away = found - 2 * head().offsets
    assert np.allclose(away - away.mean(1, keepdims=True), 0, atol=1e-3)


def test_loose_parts_stay_where_they_are_anchored():
    loose = np.r_[head().neutral, head().neutral[:3] + 300]
    offsets = np.concatenate([head().offsets, np.full((53, 3, 3), 2.0)], 1)
    triangles = np.r_[head().triangles, [[625, 626, 627]]]
    found = deformed(loose, offsets, triangles, loose * [1.1, 1, 1])
    assert np.allclose(found[:, 625:], 2, atol=1e-6)


def test_triangles_without_area_are_harmless():
    flat = head().neutral.copy()
    flat[1] = flat[0]
    for a, b in ((flat, head().neutral), (head().neutral, flat)):
        found = deformed(a, head().offsets, head().triangles, b)
        assert np.isfinite(found).all()
        assert np.abs(found).max() < 3 * np.abs(head().offsets).max()


def test_examples_come_nearer_to_the_expressions_than_deformation_alone():
    neutral, _, training = truth()
    evidence = Evidence(training.weights, training.meshes - neutral)
    arguments = (head().neutral, head().offsets, head().triangles, neutral)
    away = [
        np.abs(np.tensordot(evidence.weights, found, 1) - evidence.shown).mean()
        for found in (deformed(*arguments), rigged_by_example(*arguments, evidence))
    ]
    assert away[1] < 0.7 * away[0]
    nothing = Evidence(np.zeros((0, 53)), np.zeros((0, 625, 3)))
    assert np.allclose(rigged_by_example(*arguments, nothing), deformed(*arguments))


def test_maps_are_where_the_published_energy_is_least():
    rng = np.random.default_rng(3)
    weights, prior = rng.random((2, 4)), 0.1 * rng.normal(size=(4, 6, 3, 3))
    shown = rng.normal(size=(2, 6, 3, 3))
    size = np.sqrt((prior**2).sum((2, 3)))
    held = 0.001 * ((1 + size) / (0.1 + size)) ** 2

    def energy(maps):
        missed = ((shown - np.tensordot(weights, maps, 1)) ** 2).sum()
        return missed + (held * ((maps - prior) ** 2).sum((2, 3))).sum()

    found = fitted_maps(prior, shown, weights)
    slope = [
        energy(found + 1e-3 * nudge) - energy(found - 1e-3 * nudge) for nudge in rng.normal(size=(20, *prior.shape))
    ]
    assert np.abs(slope).max() < 1e-9
