"""What is found of metrics."""

import numpy as np
import pytest

from emogen_core.simulation.evaluation.evaluate import evaluate
from emogen_core.simulation.evaluation.metrics import _on_clusters, _on_drivers, _on_nearest
from emogen_core.simulation.evaluation.results import Spread
from tests.emogen_core.simulation.evaluation.laboratories import real_laboratory


@pytest.mark.parametrize(
    ("right", "holds"),
    [
        ((0.5, 0.6, 0.97), [True, True, True]),
        ((0.5, 0.6, 0.85), [False, True, True]),
        ((0.98, 0.6, 0.97), [False, True, False]),
        ((0.5, 0.8, 0.97), [True, False, True]),
        ((0.87, 0.6, 0.97), [True, True, False]),
    ],
)
def test_clusters(right, holds):
    found = _on_clusters(dict(zip(("euclidean_genes", "vertex_rms", "cosine"), right, strict=True)))
    assert [one.holds for one in found] == holds


DRIVERS = {
    "pca_euclidean": (0.52, 0.24), "pca_standardised": (0.45, 0.30), "vertex_mahalanobis": (0.47, 0.31),
    "cosine": (0.43, 0.23),
}  # fmt: skip


@pytest.mark.parametrize(
    ("changed", "holds"),
    [
        ({}, [True, True, True, True]),
        ({"pca_standardised": (0.51, 0.30)}, [False, True, True, True]),
        ({"pca_standardised": (0.45, 0.24)}, [True, False, True, True]),
        ({"vertex_mahalanobis": (0.6, 0.31)}, [True, True, False, True]),
        ({"pca_standardised": (0.38, 0.30)}, [True, True, True, False]),
        ({"cosine": (0.43, 0.28)}, [True, True, True, False]),
    ],
)
def test_drivers(changed, holds):
    last = {
        f"{metric}, target {at}": Spread(mean, 0.15, 0, 500)
        for metric, means in {**DRIVERS, **changed}.items()
        for at, mean in enumerate(means, 1)
    }
    assert [one.holds for one in _on_drivers(last)] == holds


@pytest.mark.parametrize(("rare", "common"), [(True, True), (True, False), (False, True)])
def test_nearest(rare, common):
    means = {
        ("rare", "pca_standardised"): 0.1, ("rare", "pca_euclidean"): 0.9 if rare else 0.05,
        ("common", "pca_euclidean"): 0.1, ("common", "pca_standardised"): 0.9 if common else 0.05,
    }  # fmt: skip
    assert [one.holds for one in _on_nearest(means)] == [rare, common]


def test_the_cosine_tells_the_targets_apart_on_the_bundled_rig_and_the_distance_of_meshes_does_not():
    (table,) = evaluate(real_laboratory(), ["separability"], 100)
    assert [one.holds for one in table.findings[:2]] == [True, True]
    right = np.array([row.ours for row in table.rows]).reshape(3, 3, 3)
    assert (right.sum(2) == 100).all(), "every search is in one cluster"
    for name, plane in table.maps.items():
        assert list(plane.clusters) == ["target 1", "target 2", "target 3"], name
        assert 0 < plane.explained[1] <= plane.explained[0] < 1


def test_the_nearest_faces_on_the_bundled_rig_differ():
    (table,) = evaluate(real_laboratory(), ["nearest"], 100)
    assert table.agreement == "agrees"
    assert [row.label for row in table.rows[:2]] == ["rare, pca_euclidean", "rare, pca_standardised"]
