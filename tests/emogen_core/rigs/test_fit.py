"""Every identity closes its eyes and its mouth, seen from the front."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.heights import highest
from emogen_core.rigs.lids import EDGE, lid_rings
from emogen_core.rigs.topology import RigTopology

RIG = load_bundled_rig()
SKIN = ("skin", "mouth", "sockets")


def face(identity, **genes):
    values = np.zeros((1, len(RIG.genes)))
    values[0, RIG.gene_indices(tuple(genes))] = list(genes.values())
    return vertices(RIG, identity, shape_weights(RIG, values))[0].astype(np.float64)


def front(mesh, parts, x, y):
    triangles = np.concatenate([RIG.triangles[slice(*RIG.parts[part])] for part in parts])
    points = mesh[triangles]
    near = (points[:, :, 0].max(1) > x[0]) & (points[:, :, 1].max(1) > y[0]) & (points[:, :, 1].min(1) < y[-1])
    return highest(points[near], x, y)


def seen(mesh, parts, x, y):
    """Return how many lines of sight of a frontal grid (0.06 or 0.16 square millimetres each) meet the parts."""
    behind = front(mesh, parts, x, y)
    return int((np.isfinite(behind) & (front(mesh, SKIN, x, y) < behind)).sum())


EYE = np.arange(14.0, 46, 0.4), np.arange(-14.0, 14, 0.4)
MOUTH = np.arange(0.0, 32, 0.25), np.arange(-82.0, -50, 0.25)


@pytest.mark.parametrize("identity", RIG.identities)
def test_lids_close_every_eye_and_rest_open(identity):
    assert seen(face(identity), ("eye_left",), *EYE) > 300
    assert seen(face(identity, lidsClose=1), ("eye_left",), *EYE) == 0


@pytest.mark.parametrize(
    "others", [("lidsTight", "lidsSlit"), ("gazeDown",), ("lidUpperRaise",), ("gazeDown", "lidsSlit")]
)
def test_closed_eyes_stay_closed_whatever_else_the_lids_do(others):
    for identity in ("female", "male", "asian-male-old"):
        mesh = face(identity, lidsClose=1, **dict.fromkeys(others, 1))
        assert seen(mesh, ("eye_left",), *EYE) <= 2


@pytest.mark.parametrize("identity", RIG.identities)
def test_no_tooth_to_speak_of_shows_at_rest(identity):
    """At most one square millimetre, of which a slit at the corners is made: lips that touch nowhere leave one."""
    assert seen(face(identity), ("teeth_upper", "teeth_lower"), *MOUTH) <= 16


@pytest.mark.parametrize("gene", ["mouthPress", "mouthSmile", "mouthFrown", "chinRaise", "mouthPucker"])
def test_a_mouth_that_should_stay_shut_stays_shut(gene):
    for identity in ("female", "male"):
        assert seen(face(identity, **{gene: 1}), ("teeth_upper", "teeth_lower"), *MOUTH) <= 12


def test_an_open_mouth_shows_teeth():
    assert seen(face("female", mouthSmileOpen=1), ("teeth_upper",), *MOUTH) > 500


@pytest.mark.parametrize("genes", ["lidsTight", "lidsSlit", "cheekRaise", "gazeDown", "lidsTight cheekRaise"])
def test_lids_stay_outside_the_eyeball(genes):
    for identity in RIG.identities:
        rest, mesh = face(identity), face(identity, **dict.fromkeys(genes.split(), 1))
        ball = np.unique(RIG.triangles[slice(*RIG.parts["eye_left"])])
        centre = (rest[ball].min(0) + rest[ball].max(0)) * (0.5, 0.5, 0)
        covers = np.unique(np.concatenate([RIG.triangles[slice(*RIG.parts[p])] for p in ("skin", "lashes")]))
        # Behind its edge the skin of a lid runs on to the socket's lining, inside the eyeball.
        covers = covers[lid_rings(RigTopology(RIG))[covers] >= EDGE]
        before, after = (np.linalg.norm(m[covers] - centre, axis=1) for m in (rest, mesh))
        front_side = mesh[covers, 2] > 0
        assert (after >= np.minimum(before, 14.95) - 0.05)[front_side].all()
