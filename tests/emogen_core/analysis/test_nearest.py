"""Nearest faces."""

import numpy as np
import pytest

from emogen_core.analysis.nearest import Neighbour, nearest
from emogen_core.errors import InvalidInputError
from emogen_core.similarity.catalogue import Material, metric
from emogen_core.similarity.cosine import cosine_distance
from tests.emogen_core.simulation.evaluation.laboratories import SMALL

FACES = np.array([[1.0, 0], [0.5, 0], [0, 1.0], [1.0, 1.0]])


def test_the_nearest_come_first_and_of_equals_the_one_recorded_first():
    found = nearest(FACES, np.array([0.4, 0]), cosine_distance, 3)
    assert found[:2] == (Neighbour(0, 0.0), Neighbour(1, 0.0))
    assert (found[2].face, len(found)) == (3, 3)
    assert len(nearest(FACES, FACES[0], cosine_distance, 99)) == 4
    equal = nearest(np.eye(2)[np.arange(99) % 2], np.array([1.0, 0]), cosine_distance, 50)
    assert [one.face for one in equal] == list(range(0, 99, 2))


@pytest.mark.parametrize("name", ["cosine", "vertex_rms", "euclidean_genes", "cosine_genes"])
def test_every_metric_of_the_catalogue_finds_the_face_itself(name):
    faces = np.random.default_rng(1).random((9, len(SMALL.shape_names))).astype(np.float32)
    own = metric(name, Material(SMALL.gene_to_core, len(SMALL.shape_names), lambda: SMALL.shape_offsets("female")))
    assert nearest(faces, faces[4], own, 1)[0].face == 4


def test_what_does_not_fit_is_refused():
    with pytest.raises(InvalidInputError, match="count: expected"):
        nearest(FACES, FACES[0], cosine_distance, 0)
    with pytest.raises(InvalidInputError, match="face: expected"):
        nearest(FACES, np.zeros(3), cosine_distance)
