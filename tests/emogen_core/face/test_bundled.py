"""The head that comes with the package: what a study may rely on."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.bundled import BUNDLED_RIG, load_bundled_rig
from emogen_core.face.evaluate import vertices

PARTS = ["skin", "mouth", "sockets", "tongue", "teeth_upper", "teeth_lower", "lashes", "eye_left", "eye_right"]
ANCESTRIES = ("african", "asian", "caucasian")
GRID = {f"{a}-{s}-{age}" for a in ANCESTRIES for s in ("female", "male") for age in ("young", "old")}


@pytest.fixture(scope="module")
def rig():
    return load_bundled_rig()


def face(rig, identity="female", **genes):
    values = np.zeros((1, len(rig.genes)))
    values[0, rig.gene_indices(tuple(genes))] = list(genes.values())
    return vertices(rig, identity, shape_weights(rig, values))[0]


def symmetric_genes(rig):
    return [g for g in rig.genes if "lateral" not in g.flags and g.name not in {"gazeLeft", "gazeRight"}]


def corners(rig):
    """Return the vertices at the mouth's left corner: where skin and mouth meet, outermost."""
    mouth = np.unique(rig.triangles[slice(*rig.parts["mouth"])])
    rim = np.intersect1d(mouth, np.unique(rig.triangles[slice(*rig.parts["skin"])]))
    return rim[np.argsort(rig.neutrals["female"][rim, 0])[-3:]]


def test_it_has_the_numbers_of_the_paper(rig):
    active = [gene for gene in rig.genes if not gene.flags & {"lateral", "disabled"}]
    assert 45 <= len(active) <= 55
    assert 140 <= len(rig.shape_names) <= 155
    assert len(rig.collision_shapes) == 8
    assert BUNDLED_RIG.stat().st_size < 8_000_000


def test_it_has_both_defaults_and_the_grid(rig):
    assert rig.identities[:2] == ("female", "male")
    assert set(rig.identities[2:]) >= GRID


def test_the_parts_are_those_that_a_look_paints(rig):
    assert list(rig.parts) == PARTS
    assert 20_000 < len(rig.triangles) < 28_500


def test_lengths_are_millimetres_about_the_midpoint_of_the_eyes(rig):
    for mesh in rig.neutrals.values():
        eyes = mesh[np.unique(rig.triangles[rig.parts["eye_left"][0] :])]
        assert np.abs(eyes.mean(0)[:2]).max() < 0.01
        assert 25 < np.abs(eyes[:, 0]).mean() < 35
        assert 90 < mesh[:, 1].max() < 150


def test_every_set_of_an_emotion_has_a_source_and_active_genes(rig):
    assert set(rig.emotion_sets) == {"happy", "sad", "angry", "fearful", "surprised", "disgusted"}
    flags = {gene.name: gene.flags for gene in rig.genes}
    for kit in rig.emotion_sets.values():
        assert "Ekman & Friesen 1978" in kit.source
        assert not any(flags[name] & {"lateral", "disabled", "gaze"} for name in kit.genes)


def test_mouth_close_is_a_corrective_and_never_a_gene(rig):
    assert not any("mouthClose" in name for name in (*rig.gene_names, *rig.core_shapes))
    assert ("jawOpen", "mouthPress") in [c.parents for c in rig.combinations]


@pytest.mark.parametrize("identity", ["female", "male", "asian-female-old"])
def test_the_neutral_is_exact_and_symmetric(rig, identity):
    neutral = face(rig, identity)
    assert np.array_equal(neutral, rig.neutrals[identity])
    assert np.abs(neutral[rig.mirror] * (-1, 1, 1) - neutral).max() < 0.01


def test_symmetric_genes_give_symmetric_faces(rig):
    generator = np.random.default_rng(4)
    names = [gene.name for gene in symmetric_genes(rig)]
    for identity in ("female", "african-male-old"):
        chosen = generator.choice(names, 8, replace=False)
        mesh = face(rig, identity, **dict(zip(chosen, generator.random(8), strict=True)))
        assert np.abs(mesh[rig.mirror] * (-1, 1, 1) - mesh).max() < 0.05


@pytest.mark.parametrize(
    ("left", "right"), [("gazeLeft", "gazeRight"), ("jawLeft", "jawRight"), ("mouthLeft", "mouthRight")]
)
def test_lateral_genes_are_mirror_images(rig, left, right):
    turned = face(rig, **{left: 1})[rig.mirror] * (-1, 1, 1)
    assert np.abs(turned - face(rig, **{right: 1})).max() < 0.05


def test_gaze_is_conjugate_and_to_the_heads_left(rig):
    for part in ("eye_left", "eye_right"):
        pole = rig.triangles[rig.parts[part][0]].min()
        turned = (face(rig, gazeLeft=1) - face(rig))[pole]
        assert 4 < turned[0] < 8
        lifted = (face(rig, gazeUp=1) - face(rig))[pole]
        assert 2 < lifted[1] < 6


def test_five_smiles_at_once_still_smile(rig):
    smiles = ("mouthSmile", "mouthSmileSharp", "mouthSmileOpen", "mouthRetract", "mouthDimple")
    places = corners(rig)
    for share in (0.25, 0.5, 0.75, 1.0):
        rise = face(rig, **dict.fromkeys(smiles, share)) - face(rig)
        assert rise[places, 1].mean() > 4 * share
        assert rise[places, 0].mean() > 2 * share


def test_a_frown_turns_the_corners_down(rig):
    assert (face(rig, mouthFrown=1) - face(rig))[corners(rig), 1].mean() < -2


def test_a_raised_lid_gives_way_to_a_closing_one(rig):
    closed, both = face(rig, lidsClose=1), face(rig, lidsClose=1, lidUpperRaise=1)
    lashes = np.unique(rig.triangles[slice(*rig.parts["lashes"])])
    assert np.abs(closed - both)[lashes].max() < 0.2
