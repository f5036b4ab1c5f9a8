"""An emotion set at full strength shows on every head what its action units say."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.heights import highest

RIG = load_bundled_rig()
HEADS = pytest.mark.parametrize("identity", RIG.identities)
REST = RIG.neutrals["female"]
SKIN = np.unique(RIG.triangles[slice(*RIG.parts["skin"])])


def near(x, y, count=6):
    """Return the frontal skin vertices of the default head that are nearest to a place (x, y), left side."""
    away = np.hypot(REST[SKIN, 0] - x, REST[SKIN, 1] - y) + 1e3 * (REST[SKIN, 2] < 0)
    return SKIN[np.argsort(away)[:count]]


INNER, OUTER, CHIN, UPPER_LIP = near(12, 15), near(44, 17), near(0, -100), near(6, -58)
WING = near(16, -38)


def corners():
    mouth = np.unique(RIG.triangles[slice(*RIG.parts["mouth"])])
    rim = np.intersect1d(mouth, SKIN)
    return rim[np.argsort(REST[rim, 0])[-3:]]


def motion(identity, emotion, place):
    """Return how far a place moves outwards, up and forwards, millimetres."""
    meshes = vertices(RIG, identity, shape_weights(RIG, np.stack([0 * genes(emotion), genes(emotion)])))
    return (meshes[1] - meshes[0])[place].mean(0)


def genes(emotion):
    return RIG.emotion_genes(emotion)


def teeth_seen(identity, emotion):
    """Return (upper, lower) square millimetres of teeth seen from the front."""
    mesh = vertices(RIG, identity, shape_weights(RIG, genes(emotion)[np.newaxis]))[0].astype(np.float64)
    grid = np.arange(-30.0, 30, 0.5), np.arange(-100.0, -45, 0.5)
    parts = [("skin", "mouth", "sockets"), ("teeth_upper",), ("teeth_lower",)]
    skin, upper, lower = (
        highest(np.concatenate([mesh[RIG.triangles[slice(*RIG.parts[p])]] for p in names]), *grid) for names in parts
    )
    return tuple(float((np.isfinite(t) & (skin < t)).sum()) / 4 for t in (upper, lower))


@HEADS
def test_a_happy_face_smiles_with_its_upper_teeth_and_cheeks(identity):
    out, up, _ = motion(identity, "happy", corners())
    assert up > 5
    assert out > 4
    upper, lower = teeth_seen(identity, "happy")
    assert upper > 60
    assert upper > lower
    assert abs(motion(identity, "happy", INNER)[1]) < 1


@HEADS
def test_a_sad_face_lifts_its_inner_brows_and_drops_its_corners(identity):
    assert motion(identity, "sad", INNER)[1] > 3 + motion(identity, "sad", OUTER)[1]
    assert motion(identity, "sad", corners())[1] < -2
    assert max(teeth_seen(identity, "sad")) < 12


@HEADS
def test_an_angry_face_draws_its_brows_down_and_together_over_a_closed_mouth(identity):
    out, up, _ = motion(identity, "angry", INNER)
    assert out < -2
    assert up < -3
    assert sum(teeth_seen(identity, "angry")) < 25
    assert motion(identity, "angry", corners())[1] < 1.5


@HEADS
def test_a_fearful_face_raises_its_brows_straight_and_together(identity):
    out, up, _ = motion(identity, "fearful", INNER)
    assert out < -1
    assert up > 2
    assert motion(identity, "fearful", corners())[0] > 2.5
    assert sum(teeth_seen(identity, "fearful")) > 20


@HEADS
def test_a_surprised_face_raises_whole_brows_and_drops_its_jaw(identity):
    inner, outer = (motion(identity, "surprised", place) for place in (INNER, OUTER))
    assert min(inner[1], outer[1]) > 4
    assert inner[0] > -1
    assert motion(identity, "surprised", CHIN)[1] < -10


@HEADS
def test_a_disgusted_face_lifts_its_nose_and_upper_lip_and_lowers_its_brows(identity):
    assert motion(identity, "disgusted", WING)[1] > 2.5
    assert motion(identity, "disgusted", UPPER_LIP)[1] > 3
    assert motion(identity, "disgusted", INNER)[1] < -2


def test_a_weaker_emotion_is_the_same_genome_scaled():
    assert np.array_equal(RIG.emotion_genes("sad", 0.5), 0.5 * RIG.emotion_genes("sad"))
    assert not RIG.emotion_genes("sad", 0).any()
    kit = RIG.emotion_sets["sad"]
    assert RIG.emotion_genes("sad")[RIG.gene_indices(kit.genes)].tolist() == list(kit.strengths)
    assert (RIG.emotion_genes("sad") > 0).sum() == len(kit.genes)


@pytest.mark.parametrize(("emotion", "strength"), [("bored", 1), ("sad", 1.1), ("sad", -0.1), ("sad", float("nan"))])
def test_bad_emotions_are_refused(emotion, strength):
    with pytest.raises(InvalidInputError, match="expected"):
        RIG.emotion_genes(emotion, strength)
