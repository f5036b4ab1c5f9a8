"""A pair is tried on random faces that have it, each with other genes and with the rules' correctives."""

import numpy as np
import pytest

from emogen_core.rigs.company import FACE, SIDE, Company
from emogen_core.rigs.quality import Gauge
from emogen_core.rigs.random_faces import GENES_A_FACE
from tests.emogen_core.rigs.patch import Patch, points

GAUGE = Gauge(points(), Patch().triangles)
# Gene i moves everything by 1 along z at vertex i alone, so that a mesh tells its genes' values.
COUNT = 9
GENES = {f"g{i}": np.eye(len(points()))[:, [i]] * (0, 0, 1) for i in range(COUNT)}
PAIR = ("g1", "g4")


def values(mesh):
    return mesh[:COUNT, 2]


def company(ruled=None, genes=None):
    return Company(points(), genes or GENES, ruled or {})


def test_faces_have_the_pair_evenly_and_as_many_genes_as_random_faces():
    trial = company().trial(PAIR, GAUGE)
    faces = np.array([values(mesh) for mesh in trial.meshes])
    assert (np.count_nonzero(faces, axis=1) == GENES_A_FACE).all()
    cells = np.floor(faces[:, [1, 4]] * SIDE).astype(int)
    assert len(np.unique(cells, axis=0)) == len(cells) == SIDE**2
    assert trial.weights == pytest.approx(faces[:, 1] * faces[:, 4])
    assert (np.count_nonzero(faces, axis=0) > 5).all()


def test_the_first_faces_are_the_same_ones_and_every_pair_has_its_own():
    few, all_of_them = company().trial(PAIR, GAUGE, 5), company().trial(PAIR, GAUGE)
    assert len(few.meshes) == 5
    assert np.array_equal(few.meshes, all_of_them.meshes[:5])
    other = company().trial(("g1", "g5"), GAUGE, 5)
    assert not np.array_equal(few.weights, other.weights)


def test_rules_come_with_the_product_of_their_genes_where_all_are_there():
    lift = np.full_like(points(), 1.0) * (0, 1, 0)
    faces = company({("g1", "g2"): lift}).trial(PAIR, GAUGE).meshes
    for mesh in faces:
        product = values(mesh)[1] * values(mesh)[2]
        assert mesh[:, 1] - points()[:, 1] == pytest.approx(np.full(len(mesh), product))
    assert any(values(mesh)[2] for mesh in faces)


def test_a_gain_counts_what_is_mended_and_the_faces_that_look_better():
    wide = points() * (4.0, 0, 0)
    trial = company(genes={"g1": wide, "g4": 0 * wide}).trial(PAIR, GAUGE)
    assert trial.gain(0 * wide) == 0
    # Added, all triangles are stretched by 1 + 4 u; nothing is flipped until a corrective turns everything round.
    broken = np.mean([GAUGE.damage(mesh).total for mesh in trial.meshes])
    assert broken == np.mean([len(GAUGE.triangles) * (1 + mesh_width > 3) for mesh_width in widths(trial)])
    turned = points() * (-80.0, 0, 0)
    after = [GAUGE.damage(mesh + w * turned) for mesh, w in zip(trial.meshes, trial.weights, strict=True)]
    harmed = np.mean([damage.flips > 0 for damage in after])
    assert 0.5 < harmed <= 1
    assert trial.gain(turned) == pytest.approx(broken - np.mean([d.total for d in after]) - FACE * harmed)


def widths(trial):
    return [(mesh[-1, 0] - mesh[0, 0]) / np.ptp(points()[:, 0]) - 1 for mesh in trial.meshes]
