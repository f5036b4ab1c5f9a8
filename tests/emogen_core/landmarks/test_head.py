"""A head that feature points drive."""

import numpy as np
import pytest

from emogen_core.correctives.pipeline import face_weights
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.landmark_head import driven_head
from emogen_core.rigs.random_faces import random_genes


@pytest.fixture(scope="module", params=["female", "caucasian-male-old"])
def driven(request, head):
    return driven_head(head.rig, request.param)


def test_points_move_with_the_shapes_as_this_head_wears_them(driven):
    worn = driven.rig.shape_offsets(driven.identity)[:, driven.vertices]
    assert driven.offsets_at_points == pytest.approx(worn, abs=1e-5)
    assert driven.points.tolist() == driven.neutral[driven.vertices].tolist()


def test_a_face_is_that_of_a_study(driven):
    genes = random_genes(driven.rig, 4, 2)
    core = np.clip(genes @ driven.rig.gene_to_core, 0, 1)
    weights = face_weights(driven.rig, driven.identity, genes).weights
    assert driven.faces(core).tobytes() == weights.tobytes()
    assert driven.face(core[1]).tobytes() == weights[1].tobytes()
    mesh = vertices(driven.rig, driven.identity, weights[:1])[0]
    assert driven.surface(weights[0]) == pytest.approx(mesh - driven.neutral, abs=1e-6)


def test_genes_are_the_mean_of_both_sides(driven):
    genes = random_genes(driven.rig, 1, 3)[0]
    core = genes @ driven.rig.gene_to_core
    assert driven.genes(core) == pytest.approx(genes)
    assert driven.asymmetry(core) == pytest.approx(0, abs=1e-12)
    core[driven.rig.core_shapes.index("mouthSmile.L")] += 0.4
    wanted = genes.copy()
    wanted[driven.rig.gene_names.index("mouthSmile")] += 0.2
    assert driven.genes(core) == pytest.approx(wanted)
    assert driven.asymmetry(core) == pytest.approx(0.2)


def test_energy_is_where_a_shape_moves(driven):
    energy = driven.core_energy[driven.rig.core_shapes.index("jawOpen")]
    assert energy.shape == (len(driven.neutral),)
    assert driven.neutral[energy.argmax(), 1] < -60
    assert energy.max() == pytest.approx(34.6**2, rel=0.02)
