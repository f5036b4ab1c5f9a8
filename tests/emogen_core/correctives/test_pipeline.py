"""The order of the stages."""

import numpy as np
import pytest

from emogen_core.correctives.collision import solve_collisions
from emogen_core.correctives.pipeline import face_weights, shape_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.random_faces import random_genes
from tests.rig_factory import small_rig


def test_a_rig_without_collision_correctives_skips_the_stage():
    rig = small_rig()
    genes = np.full((2, len(rig.genes)), 0.3)
    faces = face_weights(rig, "male", genes)
    assert faces.collisions is None
    assert faces.weights.tolist() == shape_weights(rig, genes).tolist()
    with pytest.raises(InvalidInputError, match="8 collision correctives"):
        solve_collisions(rig, "male", faces.weights)


def test_collisions_are_solved_on_top_of_everything_else():
    rig = load_bundled_rig()
    genes = random_genes(rig, 12, 5)
    faces = face_weights(rig, "male", genes)
    plain = shape_weights(rig, genes)
    assert faces.collisions is not None
    assert faces.weights[:, :-8].tolist() == plain[:, :-8].tolist()
    assert faces.weights[:, -8:].tolist() == faces.collisions.weights.tolist()
    assert not plain[:, -8:].any()
    assert face_weights(rig, "male", genes[:0]).weights.shape == (0, plain.shape[1])


def test_what_collides_depends_on_the_head():
    rig = load_bundled_rig()
    genes = random_genes(rig, 20, 5)
    assert face_weights(rig, "male", genes).weights.tolist() != face_weights(rig, "female", genes).weights.tolist()
    with pytest.raises(InvalidInputError, match="identity"):
        face_weights(rig, "nobody", genes)


@pytest.mark.parametrize(
    ("genes", "said"),
    [
        (np.zeros((1, 7)), r"genes: expected shape \(faces, 8\), got \(1, 7\)"),
        (np.zeros(8), r"genes: expected shape \(faces, 8\), got \(8,\)"),
        (np.full((1, 8), np.nan), "genes: expected finite values in .0, 1., got nan"),
        (np.full((1, 8), 1.5), "got 1.5"),
        (np.full((1, 8), "smile"), "genes: expected numbers"),
    ],
)
def test_bad_genes_are_refused_with_what_was_got(genes, said):
    with pytest.raises(InvalidInputError, match=said):
        face_weights(small_rig(), "male", genes)


def test_a_face_does_not_depend_on_its_batch():
    rig = load_bundled_rig()
    genes = random_genes(rig, 10, 6)
    together = face_weights(rig, "female", genes).weights
    alone = np.concatenate([face_weights(rig, "female", row[None]).weights for row in genes])
    assert together.tobytes() == alone.tobytes()
