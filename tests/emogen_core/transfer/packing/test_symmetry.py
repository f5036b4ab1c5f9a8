"""Mirror images are found by geometry, whatever shapes are called."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.transfer.packing.activity import displacements, reaches
from emogen_core.transfer.packing.made_up import Bump, both, face_bumps, made_up_face
from emogen_core.transfer.packing.of_rig import template_of
from emogen_core.transfer.packing.symmetry import find_mirrored, mirror_image

FACE = made_up_face(face_bumps(), 41)


def found(template):
    reach = reaches(displacements(template.offsets), template.visible)
    mirrored = find_mirrored(template.offsets, reach, mirror_image(template.neutral))
    named = [
        {frozenset(template.names[k] for k in pair) for pair in some} for some in (mirrored.pairs, mirrored.opposites)
    ]
    return named[0], named[1]


def lefts_and_rights(names):
    return {frozenset({name, f"{name[:-1]}R"}) for name in names if name[-2:] in {"_L", ".L"}}


def test_the_mirror_image_of_the_mirror_image_is_the_vertex_itself():
    mirror = mirror_image(FACE.neutral)
    np.testing.assert_array_equal(mirror[mirror], np.arange(len(mirror)))
    np.testing.assert_allclose(FACE.neutral[mirror], FACE.neutral * [-1, 1, 1], atol=1e-4)


def test_every_pair_of_the_made_up_face_is_found_and_nothing_else():
    pairs, opposites = found(FACE)
    assert pairs == lefts_and_rights(FACE.names)
    assert opposites == {frozenset({"jawLeft", "jawRight"}), frozenset({"mouthLeft", "mouthRight"})}


def test_neither_names_nor_order_nor_strength_matter():
    order = np.random.default_rng(2).permutation(len(FACE.names))
    names = tuple(f"shape {k}" for k in range(len(order)))
    pairs, _ = found(replace(FACE, names=names, offsets=FACE.offsets[order] * np.float32(0.02)))
    wanted = {tuple(sorted(FACE.names.index(name) for name in pair)) for pair in lefts_and_rights(FACE.names)}
    assert {tuple(sorted(int(order[int(name.split()[1])]) for name in pair)) for pair in pairs} == wanted


def test_a_head_that_is_not_quite_symmetric_will_do():
    noise = np.random.default_rng(3).normal(scale=0.4, size=FACE.neutral.shape).astype(np.float32)
    change = np.random.default_rng(4).uniform(0.9, 1.1, FACE.offsets.shape).astype(np.float32)
    pairs, _ = found(replace(FACE, neutral=FACE.neutral + noise, offsets=FACE.offsets * change))
    assert pairs == lefts_and_rights(FACE.names)


def test_a_left_without_a_right_stays_alone():
    kept = [k for k, name in enumerate(FACE.names) if name != "mouthSmile_R"]
    pairs, _ = found(replace(FACE, names=tuple(FACE.names[k] for k in kept), offsets=FACE.offsets[kept]))
    assert pairs == lefts_and_rights(FACE.names) - {frozenset({"mouthSmile_L", "mouthSmile_R"})}


def test_the_bundled_rig_has_the_pairs_that_its_genes_have():
    rig = load_bundled_rig()
    template = template_of(rig)
    pairs, opposites = found(template)
    two = {frozenset(g.members) for g in rig.genes if len(g.members) == 2 and set(g.members) <= set(template.names)}
    sideways = {frozenset({f"gaze{way}.L", f"gaze{way}.R"}) for way in ("Left", "Right")}
    squints = {frozenset({"gazeLeft.L", "gazeRight.R"}), frozenset({"gazeLeft.R", "gazeRight.L"})}
    assert pairs == (two - sideways) | squints
    assert opposites == {frozenset({"jawLeft", "jawRight"}), frozenset({"mouthLeft", "mouthRight"})}


@pytest.mark.parametrize("count", [1, 2])
def test_few_shapes_have_no_pairs_of_themselves(count):
    alone = replace(FACE, names=FACE.names[-count:], offsets=FACE.offsets[-count:])
    assert found(alone) == (set(), set())


def test_of_two_that_are_alike_the_better_one_is_the_partner():
    """A second smile on the left has no partner, though its mirror image is very like the smile on the right."""
    left, right = both(Bump("smile", (30, -50), 18, (7, 8, 2)))
    template = made_up_face([Bump("other", (31, -51), 17, (7, 7, 2)), left, right], 41)
    assert found(template) == ({frozenset({"smile_L", "smile_R"})}, set())


def test_what_is_merely_alike_is_no_pair():
    left = Bump("smile", (30, -50), 18, (7, 8, 2))
    template = made_up_face([left, Bump("frown", (-27, -60), 16, (-6, 5, 2))], 41)
    assert found(template) == (set(), set())
