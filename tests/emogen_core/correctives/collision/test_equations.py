"""Equations 2 to 5 of EmoGen 2021 against the same written out on the whole mesh, one number at a time."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from emogen_core.correctives.collision.detect import Contacts, Detection, detect
from emogen_core.correctives.collision.model import collision_model
from emogen_core.correctives.collision.rays import OUT, UP
from emogen_core.correctives.collision.regions import LIPS, TEETH, solver_anchors, target_faces
from emogen_core.correctives.collision.solve import DATA_WEIGHT, MARGIN, constraints, increments
from emogen_core.correctives.pipeline import shape_weights
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.random_faces import random_genes

RIG = load_bundled_rig()
HEAD = "african-female-young"
MODEL = collision_model(RIG, HEAD)
ANCHORS, TARGET = solver_anchors(RIG), target_faces(RIG)
UNITS = RIG.shape_offsets(HEAD)[-8:].astype(float)
FACES = shape_weights(RIG, random_genes(RIG, 80, 4))
NOTHING = Contacts(np.zeros(0, int), np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))


def found(row):
    patch, anchors = MODEL.evaluate(FACES[row])
    return detect(anchors, MODEL.kind, patch, MODEL.triangles)


DETECTED = [found(row) for row in range(len(FACES))]


def eq_2(unit, corners, shares):
    """Delta B(P) = B(P) - B0(P), at a barycentric point."""
    return sum(share * UNITS[unit][corner] for share, corner in zip(shares, corners, strict=True))


def a_and_b(contacts, axis):
    """Eqs. 3 and 4, and the depths, by loops."""
    rows = []
    for anchor, face, shares in zip(contacts.anchor, contacts.face, contacts.corners, strict=True):
        row = []
        for unit in range(8):
            own = eq_2(unit, ANCHORS.corners[anchor], ANCHORS.shares[anchor])[axis]
            lower = eq_2(unit, TARGET[face], shares)[axis]
            row.append(own - lower if axis == UP else lower - own)
        rows.append(row)
    return np.array(rows).reshape(-1, 8), contacts.depth + MARGIN


def eq_5(a, b, upper, count):
    """argmin w1 |A w - b|^2 + (1 - w1) M |w|^2 by a general solver."""
    stacked = np.concatenate([np.sqrt(DATA_WEIGHT) * a, np.sqrt((1 - DATA_WEIGHT) * count) * np.eye(a.shape[1])])
    goal = np.concatenate([np.sqrt(DATA_WEIGHT) * b, np.zeros(a.shape[1])])
    return lsq_linear(stacked, goal, (np.zeros(len(upper)), upper), tol=1e-13, method="bvls").x


def test_eq_2_and_the_face_itself_are_those_of_the_whole_mesh():
    mesh = vertices(RIG, HEAD, FACES[:3]).astype(float)
    for row in range(3):
        patch, anchors = MODEL.evaluate(FACES[row])
        some = np.arange(0, len(anchors), 53)
        assert anchors[some] == pytest.approx(ANCHORS.sample(mesh[row : row + 1])[0][some], abs=1e-4)
        assert patch[MODEL.triangles] == pytest.approx(mesh[row][TARGET], abs=1e-4)
    for unit in range(8):
        for anchor in range(0, len(ANCHORS.kind), 211):
            wanted = eq_2(unit, ANCHORS.corners[anchor], ANCHORS.shares[anchor])
            assert MODEL.unit_anchors[unit, anchor] == pytest.approx(wanted, abs=1e-6)


@pytest.mark.parametrize(("kind", "axis"), [(LIPS, UP), (TEETH, OUT)])
def test_eqs_3_and_4(kind, axis):
    for detected in DETECTED:
        contacts = (detected.lips, detected.teeth)[kind]
        some = slice(0, 12)
        few = Contacts(contacts.anchor[some], contacts.face[some], contacts.corners[some], contacts.depth[some])
        for got, wanted in zip(constraints(MODEL, few, axis), a_and_b(few, axis), strict=True):
            assert got.ravel() == pytest.approx(wanted.ravel(), abs=1e-6)


@pytest.mark.parametrize("kind", [LIPS, TEETH])
def test_eq_5_where_one_type_collides(kind):
    faces = [d for d in DETECTED if len((d.lips, d.teeth)[kind]) and not len((d.lips, d.teeth)[1 - kind])]
    assert len(faces) >= 2
    own, axis = (slice(0, 4), UP) if kind == LIPS else (slice(4, 8), OUT)
    before = np.linspace(0, 0.6, 8)
    for detected in faces[:4]:
        a, b = a_and_b((detected.lips, detected.teeth)[kind], axis)
        step, left = increments(MODEL, detected, before)
        assert step[own] == pytest.approx(eq_5(a[:, own], b, 1 - before[own], len(b)), abs=1e-4)
        assert left == pytest.approx((b - MARGIN - a @ step).max(), abs=1e-6)
        assert not np.delete(step, np.r_[own]).any()


def test_eq_5_where_both_collide_each_type_moves_only_its_own_and_counts_the_others_as_constant():
    """At the solution neither type can do better with its own correctives, the other's share taken as it is."""
    lipped = [d.lips for d in DETECTED if len(d.lips)]
    toothed = [d.teeth for d in DETECTED if len(d.teeth)]
    assert min(len(lipped), len(toothed)) >= 3
    # Contacts of different faces: together they are a face that bites and presses at once.
    for own_lips, own_teeth in zip(lipped[:3], toothed[:3], strict=True):
        detected = Detection(own_lips, own_teeth, (1.0, 1.0))
        lips, teeth = a_and_b(detected.lips, UP), a_and_b(detected.teeth, OUT)
        count = len(lips[1]) + len(teeth[1])
        step, _ = increments(MODEL, detected, np.zeros(8))
        for (a, b), own, other in ((lips, slice(0, 4), slice(4, 8)), (teeth, slice(4, 8), slice(0, 4))):
            wanted = eq_5(a[:, own], b - a[:, other] @ step[other], np.ones(4), count)
            assert step[own] == pytest.approx(wanted, abs=2e-3)


def test_nothing_found_asks_for_nothing():
    step, left = increments(MODEL, Detection(NOTHING, NOTHING, (0.0, 0.0)), np.zeros(8))
    assert not step.any()
    assert left == 0
