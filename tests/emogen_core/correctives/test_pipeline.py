"""The order of the stages."""

import numpy as np
import pytest

from emogen_core.correctives.collision import solve_collisions
from emogen_core.correctives.pipeline import (
    combined_weights,
    core_face_weights,
    corrected_weights,
    face_weights,
    shape_weights,
)
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


def test_faces_given_by_core_shapes_are_those_given_by_genes():
    rig = load_bundled_rig()
    genes = random_genes(rig, 6, 5)
    core = genes.astype(np.float32) @ rig.gene_to_core
    both = core_face_weights(rig, "male", core), face_weights(rig, "male", genes)
    assert both[0].weights.tolist() == both[1].weights.tolist()


def test_one_side_alone_is_a_face():
    rig = load_bundled_rig()
    core = np.zeros((1, len(rig.core_shapes)))
    core[0, rig.core_shapes.index("mouthSmile.L")] = 1
    weights = core_face_weights(rig, "female", core).weights
    assert weights[0, : len(rig.core_shapes)].tolist() == core[0].tolist()
    for wrong, said in (
        (core[:, 1:], "core shapes: expected shape"),
        (core * 2, "core shapes: expected finite values"),
    ):
        with pytest.raises(InvalidInputError, match=said):
            core_face_weights(rig, "female", wrong)
    with pytest.raises(InvalidInputError, match="identity"):
        core_face_weights(rig, "nobody", core)


def test_faces_with_two_sides_go_through_the_same_stages():
    rig = load_bundled_rig()
    genes = random_genes(rig, 5, 9)
    core = np.clip(genes.astype(np.float32) @ rig.gene_to_core, 0, 1)
    assert combined_weights(rig, core).tobytes() == shape_weights(rig, genes).tobytes()
    plain = shape_weights(rig, genes)
    before = plain.copy()
    corrected = corrected_weights(rig, "male", plain)
    assert corrected.weights.tobytes() == face_weights(rig, "male", genes).weights.tobytes()
    assert plain.tobytes() == before.tobytes()
    with pytest.raises(InvalidInputError, match=r"core shapes: expected shape \(faces, 85\)"):
        combined_weights(rig, core[:, :-1])
