"""Random faces use the genes that a study uses, so many of them, and the same ones for the same seed."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.random_faces import GENES_A_FACE, active_genes, random_genes
from tests.rig_factory import small_rig

RIG = load_bundled_rig()


def test_lateral_and_disabled_genes_stay_out_and_others_on_request():
    flags = [RIG.genes[i].flags for i in active_genes(RIG)]
    assert not any(found & {"lateral", "disabled"} for found in flags)
    assert any("gaze" in found for found in flags)
    fewer = active_genes(RIG, without={"gaze"})
    assert set(active_genes(RIG)) - set(fewer) == {i for i in active_genes(RIG) if "gaze" in RIG.genes[i].flags}


@pytest.mark.parametrize("without", [frozenset(), frozenset({"gaze"})])
def test_every_face_has_so_many_active_genes(without):
    genes = random_genes(RIG, 300, 1, without)
    assert genes.shape == (300, len(RIG.genes))
    assert ((genes >= 0) & (genes < 1)).all()
    assert (genes > 0).sum(1).tolist() == [GENES_A_FACE] * 300
    used = np.flatnonzero(genes.any(0))
    assert np.array_equal(used, active_genes(RIG, without)), "in 300 faces every gene takes part"


def test_more_faces_begin_with_the_same_ones():
    assert np.array_equal(random_genes(RIG, 3, 5), random_genes(RIG, 9, 5)[:3])
    assert not np.array_equal(random_genes(RIG, 3, 5), random_genes(RIG, 3, 6))


def test_a_rig_with_fewer_genes_uses_them_all():
    rig = small_rig(genes=4)
    assert (random_genes(rig, 5, 1) > 0).sum(1).tolist() == [4] * 5
