"""Smiles push the cheeks up and show the upper teeth, an open jaw shows both rows."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.correctives.pipeline import face_weights
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.head_check import CLOSED_MOUTHS, check_head
from emogen_core.rigs.heights import highest

RIG = load_bundled_rig()
HEADS = pytest.mark.parametrize("identity", RIG.identities)
SOME = pytest.mark.parametrize("identity", ["female", "african-male-young", "asian-male-old"])
GRID = np.arange(-30.0, 30, 0.5), np.arange(-110.0, -40, 0.5)


def face(identity, genes):
    weights = face_weights(RIG, identity, genes[np.newaxis]).weights
    return vertices(RIG, identity, weights)[0].astype(np.float64)


def one(gene, weight=1.0):
    genes = np.zeros(len(RIG.genes))
    genes[RIG.gene_names.index(gene)] = weight
    return genes


def heights(mesh, *parts):
    return highest(np.concatenate([mesh[RIG.triangles[slice(*RIG.parts[part])]] for part in parts]), *GRID)


def seen(mesh, part):
    """Return (X, Y) where a part is seen from the front of all that lies in the mouth, on `GRID`."""
    own = heights(mesh, part)
    parts = ("skin", "mouth", "tongue", "teeth_upper", "teeth_lower")
    return np.isfinite(own) & (heights(mesh, *(name for name in parts if name != part)) < own)


def cheek(mesh):
    """Return the middle of the vertices that lie over the left cheek at rest, (3,)."""
    rest = RIG.neutrals["female"]
    skin = np.unique(RIG.triangles[slice(*RIG.parts["skin"])])
    away = np.hypot(rest[skin, 0] - 40, rest[skin, 1] + 36) + 1e3 * (rest[skin, 2] < 0)
    return mesh[skin[np.argsort(away)[:12]]].mean(0)


@HEADS
def test_a_felt_smile_raises_the_cheeks_and_pushes_them_forward(identity):
    _, up, forward = cheek(face(identity, RIG.emotion_genes("happy"))) - cheek(RIG.neutral(identity))
    assert up > 4
    assert forward > 2


@HEADS
def test_an_open_smile_shows_upper_teeth_under_one_curve_and_next_to_no_lower_ones(identity):
    mesh = face(identity, one("mouthSmileOpen"))
    upper = seen(mesh, "teeth_upper")
    assert upper.sum() / 4 > 150
    assert seen(mesh, "teeth_lower").sum() < 0.02 * upper.sum()
    # The lip's edge over the teeth is one curve: a parabola, but for the tubercle.
    columns = np.flatnonzero(upper.any(1) & (np.abs(GRID[0]) < 14))
    edge = np.array([GRID[1][upper[column]].max() for column in columns])
    curve = np.polynomial.Polynomial.fit(GRID[0][columns], edge, 2)(GRID[0][columns])
    assert np.abs(edge - curve).max() < 0.6


@HEADS
def test_an_open_jaw_shows_both_rows_of_teeth_and_the_tongue(identity):
    mesh = face(identity, one("jawOpen"))
    for part, least in (("teeth_upper", 4), ("teeth_lower", 30), ("tongue", 200)):
        assert seen(mesh, part).sum() / 4 > least


@SOME
def test_shut_mouths_show_no_tooth_once_collisions_are_corrected(identity):
    found = check_head(RIG, identity, load_bundled_space().low.astype(np.float64))
    assert found["shut_teeth_mm2"] <= 0.5
    assert found["closed_emotion_teeth_mm2"] <= 6
    assert set(CLOSED_MOUTHS) <= set(found["shut_teeth"])
