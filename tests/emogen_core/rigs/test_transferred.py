"""Rigs for heads that they were not made for."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from emogen_core.correctives.pipeline import combined_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig_file import check_rig_content
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.head_check import check_head
from emogen_core.rigs.transferred import UNITS, Target, of_this_mesh, posed, transferred
from tests.rig_factory import full_rig

HEAD = "african-male-young"


def nothing(rig):
    return np.zeros((0, *rig.offsets.shape[1:])), np.zeros((0, len(rig.core_shapes)))


@pytest.fixture(scope="module")
def rig():
    return load_bundled_rig()


@pytest.mark.parametrize("unit", UNITS)
def test_heads_come_in_any_unit_and_place(rig, unit):
    turn = Rotation.from_euler("xyz", [0.2, 1.0, -0.4]).as_matrix()
    own = rig.neutral(HEAD).astype(float)
    grin = own + rig.shape_offsets(HEAD)[3]
    there = [UNITS[unit] * mesh @ turn.T + [3, 4, 5] for mesh in (own, grin)]
    weights = np.eye(len(rig.core_shapes))[3:4]
    found = posed(rig, there[0], there[1][None], weights)
    assert found.unit == unit
    assert np.array_equal(found.weights, weights)
    apart = np.linalg.norm(own[::500, None] - own[::500], axis=2)
    assert np.allclose(np.linalg.norm(found.neutral[::500, None] - found.neutral[::500], axis=2), apart)
    assert np.allclose(np.linalg.norm(found.expressions[0] - found.neutral, axis=1), np.linalg.norm(grin - own, axis=1))
    # Where the eyes are is where the rig has them; how the head is held differs a little between heads.
    eyes = np.unique(rig.triangles[rig.parts["eye_left"][0] : rig.parts["eye_right"][1]])
    assert np.allclose(found.neutral[eyes].mean(0), rig.neutral("female")[eyes].mean(0), atol=1e-3)
    assert np.abs(found.neutral - own).max() < 25


def test_a_head_of_no_known_unit_is_made_as_large_as_the_template(rig):
    own = rig.neutral("female").astype(float)
    found = posed(rig, 0.02 * own, *nothing(rig))
    assert found.unit == "unknown"
    assert np.allclose(found.neutral, own, atol=1e-3)


def test_other_meshes_are_refused(rig):
    with pytest.raises(InvalidInputError, match=r"target: expected shape \(14528, 3\), got \(3, 3\)"):
        posed(rig, np.eye(3), *nothing(rig))
    shuffled = np.random.default_rng(1).permutation(rig.neutral("female")).astype(float)
    with pytest.raises(InvalidInputError, match="the rig's vertices in the rig's order"):
        posed(rig, shuffled, *nothing(rig))


def test_the_rigs_own_head_gets_the_rig_back():
    small = full_rig()
    made = transferred(small, Target(small.neutral("female").astype(float), *nothing(small)), "me")
    assert np.allclose(made.offsets, small.offsets, atol=1e-5)
    assert (made.name, made.identities, made.hash) == ("small-me", ("me",), "")
    assert not made.adjustments
    assert made.genes == small.genes
    check_rig_content(made)


def test_the_template_is_the_rig_as_its_first_head_wears_it():
    small = full_rig()
    turned = replace(small, neutrals=dict(reversed([*small.neutrals.items()])))
    made = transferred(turned, Target(turned.neutral("male").astype(float), *nothing(turned)), "me")
    assert np.allclose(made.offsets, small.shape_offsets("male"), atol=1e-5)


def test_expressions_teach_core_shapes_and_leave_correctives():
    small = full_rig()
    weights = np.eye(len(small.core_shapes))[:2]
    neutral = small.neutral("female").astype(float)
    shown = neutral + 1.2 * small.offsets[:2]
    made = transferred(small, Target(neutral, shown, weights), "me")
    assert np.allclose(made.offsets[:2], 1.2 * small.offsets[:2], atol=1e-2)
    assert np.allclose(made.offsets[2:], small.offsets[2:], atol=1e-5)


def test_an_expression_of_two_genes_shows_their_corrective_too():
    """Such an expression, as the rig itself makes it, teaches that nothing is different."""
    small = full_rig()
    first, second = (small.gene_to_core[row].argmax() for row in small.combination_parents[0])
    core = np.zeros((1, len(small.core_shapes)))
    core[0, [first, second]] = 1
    worn = combined_weights(small, core.astype(np.float32))
    assert worn[0, len(small.core_shapes) :].any()
    neutral = small.neutral("female").astype(float)
    shown = neutral + np.tensordot(worn.astype(float), small.offsets, 1)
    made = transferred(small, Target(neutral, shown, core), "me")
    assert np.allclose(made.offsets, small.offsets, atol=1e-4)


def test_a_space_of_another_mesh_is_refused(rig):
    small = full_rig()
    assert of_this_mesh(rig, load_bundled_space())
    assert not of_this_mesh(small, load_bundled_space())
    with pytest.raises(InvalidInputError, match="expected the mesh of the space of heads, got 'small-me'"):
        transferred(small, Target(small.neutral("male"), *nothing(small)), "me", space=load_bundled_space())


def test_lids_close_and_lips_meet_on_another_head(rig):
    """The bars of docs/face.md; carried over alone, 20 mm2 of the eyeball and 49 of the teeth show."""
    space = load_bundled_space()
    made = transferred(rig, Target(rig.neutral(HEAD).astype(float), *nothing(rig)), HEAD, space=space)
    found = check_head(made, HEAD, space.low.astype(float))
    assert found["visible_at_blink_mm2"] == 0
    assert found["visible_worst_mm2"] <= 0.5
    assert found["shut_teeth_mm2"] <= 0.5
    assert found["closed_emotion_teeth_mm2"] <= 6
