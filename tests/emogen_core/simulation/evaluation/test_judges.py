"""Judges beyond the catalogue."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.similarity.catalogue import Material
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.similarity.linear import vertex_rms
from emogen_core.simulation.evaluation.judges import RESCALED, VERTEX, judge
from tests.rig_factory import small_rig

RIG = small_rig()
OFFSETS = RIG.shape_offsets("female")
MATERIAL = Material(RIG.gene_to_core, len(RIG.shape_names), lambda: OFFSETS)
FACES = np.random.default_rng(3).random((6, len(RIG.shape_names)))
TARGET = np.linspace(0.1, 0.9, len(RIG.shape_names))


def test_distances_are_in_units_of_how_far_the_target_is_from_neutral():
    plain = vertex_rms(OFFSETS)
    own = judge(VERTEX, MATERIAL)(FACES, TARGET)
    np.testing.assert_allclose(own, plain(FACES, TARGET) / plain(np.zeros_like(TARGET), TARGET))
    assert judge(VERTEX, MATERIAL)(np.zeros_like(TARGET), TARGET) == 1


def test_a_rescaled_one_weighs_both_sides_of_a_gene_by_one_factor():
    several = [judge(f"{RESCALED}{number}", MATERIAL) for number in (1, 1, 2)]
    one, same, other = (each(FACES, TARGET) for each in several)
    np.testing.assert_array_equal(one, same)
    assert not np.allclose(one, other)
    ratios = np.linalg.norm(several[0].metric.basis, axis=1) / np.linalg.norm(vertex_rms(OFFSETS).basis, axis=1)
    drives = RIG.gene_to_core
    for gene in drives:
        assert np.ptp(ratios[: drives.shape[1]][gene > 0]) < 1e-9
    np.testing.assert_allclose(ratios[drives.shape[1] :], 1, err_msg="correctives are as they are")
    assert 0.2 < np.log(ratios[: drives.shape[1]]).std() < 1


def test_all_others_are_of_the_catalogue():
    assert judge("cosine", MATERIAL) is cosine_distance
    with pytest.raises(InvalidInputError, match="metric: expected one of"):
        judge("nearness", MATERIAL)
