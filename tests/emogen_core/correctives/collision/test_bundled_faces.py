"""The collision stage on the bundled heads."""

import time
from functools import lru_cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emogen_core.correctives.collision import dense_depth, solve_collisions
from emogen_core.correctives.collision.detect import detect
from emogen_core.correctives.collision.model import collision_model
from emogen_core.correctives.collision.rays import OUT, UP, Target
from emogen_core.correctives.collision.regions import LIPS, TEETH, judge_anchors, solver_anchors
from emogen_core.correctives.collision.solve import DATA_WEIGHT, MARGIN, constraints, increments
from emogen_core.correctives.pipeline import face_weights, shape_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rigs.random_faces import random_genes
from tests.emogen_core.correctives.collision import slow

RIG = load_bundled_rig()
TWINS = [3, 2, 1, 0, 7, 6, 5, 4]
# What still may lie in the lower lip of a neutral, millimetres: lips that touch.
TOUCHING = 0.1
# Share of the front teeth's points that may be seen straight from the front: a slit below a pixel.
SLIT = 0.005


@lru_cache
def faces(identity="female", count=60, seed=11):
    weights = shape_weights(RIG, random_genes(RIG, count, seed))
    return weights, solve_collisions(RIG, identity, weights)


def neutral():
    return np.zeros((1, len(RIG.shape_names)), np.float32)


@pytest.mark.parametrize("identity", RIG.identities)
def test_neutrals_do_not_collide(identity):
    result = solve_collisions(RIG, identity, neutral())
    assert not result.weights.any()
    assert dense_depth(RIG, identity, neutral()).max() <= TOUCHING


@pytest.mark.parametrize("identity", RIG.identities)
def test_neutrals_show_no_teeth(identity):
    """Rays from the front teeth outward meet skin."""
    mesh = RIG.neutral(identity).astype(np.float64)
    anchors = judge_anchors(RIG)
    teeth = anchors.sample(mesh[None])[0][anchors.kind == TEETH]
    skin = RIG.triangles[: RIG.parts["mouth"][1]]
    near = skin[np.abs(mesh[skin][:, :, 1].mean(1) - teeth[:, 1].mean()) < 30]
    skin_ahead = Target(mesh, near)
    ahead = skin_ahead.cross(skin_ahead.see(teeth, OUT)).along(1)
    assert (ahead.count == 0).mean() < SLIT


def test_faces_without_collision_are_bit_identical():
    weights, result = faces()
    free = ~result.collided.any(1)
    corrected = face_weights(RIG, "female", random_genes(RIG, 60, 11)).weights
    assert free.sum() > 10
    assert not result.weights[free].any()
    assert corrected[free].tobytes() == weights[free].tobytes()
    first = np.flatnonzero(free)[:3]
    assert vertices(RIG, "female", corrected[first]).tobytes() == vertices(RIG, "female", weights[first]).tobytes()


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10**6), identity=st.sampled_from(RIG.identities), lateral=st.booleans())
def test_correction_never_deepens_and_faces_without_collision_keep_every_bit(seed, identity, lateral):
    genes = random_genes(RIG, 3, seed)
    if lateral:
        genes[:, RIG.gene_names.index("jawLeft")] = 0.5
    weights = shape_weights(RIG, genes)
    faces = face_weights(RIG, identity, genes)
    found, struck = faces.collisions, faces.collisions.collided.any(1)
    assert (found.depth_after <= found.depth_before).all()
    assert ((found.weights >= 0) & (found.weights <= 1)).all()
    assert faces.weights[~struck].tobytes() == weights[~struck].tobytes()
    before, after = (vertices(RIG, identity, w[~struck]).tobytes() for w in (weights, faces.weights))
    assert before == after
    judged = [dense_depth(RIG, identity, w[struck]).max(1) for w in (weights, faces.weights)]
    assert (judged[1] <= judged[0]).all()
    assert lateral or found.weights.tolist() == found.weights[:, TWINS].tolist()


def test_a_face_and_its_mirror_image_ask_for_mirrored_corrections():
    weights = neutral()
    names = RIG.shape_names
    for name, value in {"mouthPress.L": 1.0, "mouthSmile.L": 0.8, "chinRaise": 0.9, "mouthPucker": 0.4}.items():
        weights[0, names.index(name)] = value
    swapped = weights.copy()
    for name in ("mouthPress", "mouthSmile"):
        left, right = names.index(f"{name}.L"), names.index(f"{name}.R")
        swapped[0, [left, right]] = weights[0, [right, left]]
    one, other = (solve_collisions(RIG, "female", w) for w in (weights, swapped))
    assert one.collided[0, LIPS]
    assert one.weights[0, TWINS] == pytest.approx(other.weights[0], abs=0.02)


def test_most_depth_is_gone():
    weights, result = faces()
    corrected = weights.copy()
    corrected[:, -8:] = result.weights
    struck = result.depth_before > 1
    assert struck.sum() >= 5
    assert (dense_depth(RIG, "female", corrected).max(1)[struck] < 0.6).all()


def test_detection_is_the_slow_one():
    model = collision_model(RIG, "female")
    for row in np.flatnonzero(faces()[1].collided.any(1))[:3]:
        patch, anchors = model.evaluate(faces()[0][row])
        full = detect(anchors, model.kind, patch, model.triangles)
        some = np.unique(
            np.concatenate([full.lips.anchor[:6], full.teeth.anchor[:6], np.arange(0, len(model.kind), 97)])
        )
        quick = detect(anchors[some], model.kind[some], patch, model.triangles)
        for kind, found in ((LIPS, quick.lips), (TEETH, quick.teeth)):
            wanted, worst = slow.contacts(anchors[some], model.kind[some], kind, patch, model.triangles)
            assert quick.depths[kind] == pytest.approx(worst)
            assert [pair[:2] for pair in wanted] == list(zip(found.anchor, found.face, strict=True))
            assert found.depth == pytest.approx([pair[3] for pair in wanted])


def test_a_look_at_some_anchors_finds_what_a_look_at_all_finds_of_them():
    model = collision_model(RIG, "female")
    for row in np.flatnonzero(faces()[1].collided.any(1))[:8]:
        patch, anchors = model.evaluate(faces()[0][row])
        full = detect(anchors, model.kind, patch, model.triangles)
        quick = detect(anchors, model.kind, patch, model.triangles, among=full.met)
        assert quick.met.tolist() == full.met.tolist()
        assert quick.depth >= full.depth
        for seen, wanted in ((quick.lips, full.lips), (quick.teeth, full.teeth)):
            assert set(seen.anchor) >= set(wanted.anchor)


@pytest.mark.parametrize("identity", ["female", "caucasian-female-young"])
def test_the_depth_that_is_told_is_that_of_all_anchors(identity):
    """Rounds in between look at few anchors; what is kept is judged by all of them."""
    weights, result = faces(identity)
    model = collision_model(RIG, identity)
    assert (result.rounds > 1).sum() >= 3
    for row in np.flatnonzero(result.rounds):
        patch, anchors = model.evaluate(np.append(weights[row, :-8], result.weights[row]))
        found = detect(anchors, model.kind, patch, model.triangles)
        assert found.depth == pytest.approx(result.depth_after[row], abs=1e-3)


def test_eqs_3_and_4_are_what_a_unit_of_a_corrective_opens():
    model = collision_model(RIG, "female")
    weights, result = faces()
    row = int(np.argmax(result.depth_before))
    patch, anchors = model.evaluate(weights[row])
    found = detect(anchors, model.kind, patch, model.triangles)
    for contacts, axis, sign in ((found.lips, UP, 1), (found.teeth, OUT, -1)):
        jacobian, b = constraints(model, contacts, axis)
        assert b == pytest.approx(contacts.depth + MARGIN)
        for unit in range(8):
            gap = []
            for step in (0, 1):
                moved, points = patch + step * model.unit_patch[unit], anchors + step * model.unit_anchors[unit]
                hit = (moved[model.triangles[contacts.face]] * contacts.corners[:, :, None]).sum(1)
                gap.append(sign * (points[contacts.anchor] - hit)[:, axis])
            assert jacobian[:, unit] == pytest.approx(gap[1] - gap[0], abs=1e-9)


def test_increments_minimise_eq_5():
    model = collision_model(RIG, "female")
    weights, result = faces()
    row = int(np.argmax(result.depth_before * ~result.collided[:, TEETH]))
    patch, anchors = model.evaluate(weights[row])
    found = detect(anchors, model.kind, patch, model.triangles)
    jacobian, b = constraints(model, found.lips, UP)
    step, _ = increments(model, found, np.zeros(8))

    def cost(w):
        return DATA_WEIGHT * ((jacobian[:, :4] @ w - b) ** 2).sum() + (1 - DATA_WEIGHT) * len(b) * (w**2).sum()

    assert not step[4:].any()
    rng = np.random.default_rng(0)
    for size in (0.001, 0.01, 0.1):
        for nudge in rng.normal(size=(50, 4)) * size:
            assert cost(step[:4]) <= cost(np.clip(step[:4] + nudge, 0, 1)) + 1e-9


def test_anchors_are_mirrored_and_the_judge_has_five_times_as_many():
    anchors = solver_anchors(RIG)
    faces_of = {frozenset(row) for row in anchors.corners.tolist()}
    assert {frozenset(RIG.mirror[list(row)].tolist()) for row in faces_of} == faces_of
    judge = np.bincount(judge_anchors(RIG).kind)
    assert (judge >= 5 * np.bincount(anchors.kind)).all()


def test_the_first_face_of_a_head_keeps_nobody_waiting():
    """Nothing is compiled: what is prepared once a head costs less than drawing a page of faces."""
    collision_model.cache_clear()
    start = time.process_time()
    solve_collisions(RIG, "male", neutral())
    assert time.process_time() - start < 2


def test_bad_input_is_refused():
    with pytest.raises(InvalidInputError, match="identity"):
        solve_collisions(RIG, "nobody", neutral())
    with pytest.raises(InvalidInputError, match="shape"):
        solve_collisions(RIG, "female", neutral()[:, :-1])
