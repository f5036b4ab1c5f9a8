"""What cannot be posed is not asked for."""

from dataclasses import replace

import numpy as np

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.transfer.packing.made_up import Bump, both, face_bumps, made_up_face
from emogen_core.transfer.packing.of_rig import template_of
from emogen_core.transfer.packing.pack import Options, pack

FACE = made_up_face(face_bumps(), 41)


def rules(template, **options):
    found = pack(template, Options(**options)).rules
    named = [{frozenset(template.names[k] for k in pair) for pair in some} for some in (found.together, found.apart)]
    return named[0], named[1], {template.names[k]: template.names[held] for k, held in found.holds.items()}


def worn(template, **options):
    return [{template.names[k] for k in one.shapes} for one in pack(template, Options(**options)).expressions]


def test_eyes_look_the_same_way():
    together, apart, _ = rules(FACE)
    gaze = {pair for pair in together if any("Look" in name for name in pair)}
    assert gaze == {
        frozenset({"eyeLookIn_L", "eyeLookOut_R"}), frozenset({"eyeLookIn_R", "eyeLookOut_L"}),
        frozenset({"eyeLookUp_L", "eyeLookUp_R"}), frozenset({"eyeLookDown_L", "eyeLookDown_R"}),
    }  # fmt: skip
    assert {frozenset({"eyeLookIn_L", "eyeLookIn_R"}), frozenset({"eyeLookOut_L", "eyeLookOut_R"})} <= apart


def test_eyes_look_the_same_way_even_where_nothing_else_is_symmetric():
    together, _, _ = rules(FACE, symmetric=False)
    assert len(together) == 4
    for one in worn(FACE, symmetric=False):
        assert ("eyeLookIn_L" in one) == ("eyeLookOut_R" in one)
        assert not {"eyeLookIn_L", "eyeLookIn_R"} <= one


def test_an_eye_that_has_no_fellow_looks_alone():
    kept = [k for k, name in enumerate(FACE.names) if name != "eyeLookOut_R"]
    gaze = tuple(place for place, k in enumerate(kept) if k in FACE.gaze)
    template = replace(FACE, names=tuple(FACE.names[k] for k in kept), offsets=FACE.offsets[kept], gaze=gaze)
    together, apart, _ = rules(template)
    assert not any("eyeLookIn_L" in pair for pair in together)
    assert frozenset({"eyeLookIn_L", "eyeLookIn_R"}) in apart


def test_lips_are_closed_on_a_dropped_jaw_which_is_also_shown_alone():
    _, _, holds = rules(FACE)
    assert holds == {"mouthClose": "jawOpen"}
    packing = pack(FACE)
    jaw, close = FACE.names.index("jawOpen"), FACE.names.index("mouthClose")
    adding = {k: at for at, one in enumerate(packing.expressions) for unit in one.adds for k in unit}
    assert adding[jaw] < adding[close]
    assert packing.expressions[adding[close]].holds == (jaw,)
    assert {at for at, one in enumerate(packing.expressions) if jaw in one.shapes} == {adding[jaw], adding[close]}


def test_the_jaw_is_shown_alone_first_even_if_the_lips_are_more_important():
    jaw, lips = Bump("jawOpen", (0, -84), 38, (0, -32, -6)), Bump("mouthClose", (0, -80), 16, (0, 30, 5))
    template = made_up_face([jaw, lips], 41)
    offsets = template.offsets.copy()
    # All but the point of the chin goes down less than half as far.
    offsets[0][offsets[0, :, 1] > -29] *= 0.45
    packing = pack(replace(template, offsets=offsets), Options(alpha=1.0))
    assert packing.importance[1] > packing.importance[0]
    assert [(one.adds, one.holds) for one in packing.expressions] == [(((0,),), ()), (((1,),), (0,))]


def test_what_is_held_needs_its_room():
    """A shape on the chin would fit beside the closed lips, but not on the dropped jaw that they need."""
    jaw, lips = Bump("jawOpen", (0, -84), 38, (0, -32, -6)), Bump("mouthClose", (0, -58), 16, (0, 26, 4))
    template = made_up_face([jaw, lips, Bump("chin", (0, -105), 8, (0, 0, 3))], 41)
    assert sorted(map(sorted, worn(template, poseable=False))) == [["chin", "mouthClose"], ["jawOpen"]]
    assert sorted(map(sorted, worn(template))) == [["chin"], ["jawOpen"], ["jawOpen", "mouthClose"]]


def test_nothing_in_the_bundled_rig_closes_a_mouth_and_its_eyes_go_by_genes():
    rig = load_bundled_rig()
    together, apart, holds = rules(template_of(rig))
    assert holds == {}
    assert {frozenset(g.members) for g in rig.genes if "gaze" in g.flags and "disabled" not in g.flags} <= together
    assert {frozenset({"jawLeft", "jawRight"}), frozenset({"mouthLeft", "mouthRight"})} <= apart


def test_a_jaw_never_goes_both_ways():
    for template in (FACE, template_of(load_bundled_rig())):
        for options in ({}, {"symmetric": False}, {"order": "minimal"}, {"mu": 1.0}):
            for one in worn(template, **options):
                assert not {"jawLeft", "jawRight"} <= one


def test_the_published_procedure_pairs_what_squints():
    together, apart, holds = rules(FACE, poseable=False)
    assert frozenset({"eyeLookIn_L", "eyeLookIn_R"}) in together
    assert (apart, holds) == (set(), {})


def test_a_smaller_push_against_the_jaw_closes_nothing():
    lips = Bump("lipsUp", (0, -68), 22, (0, 6, 1))
    template = made_up_face(
        [Bump("jawOpen", (0, -84), 38, (0, -32, -6)), lips, *both(Bump("smile", (30, -50), 18, (7, 8, 2)))]
    )
    assert rules(template)[2] == {}
    assert np.linalg.norm(template.offsets, axis=2).max(1).argmax() == 0


def test_where_an_eye_looks_is_seen_from_the_front():
    """Lids that follow an eye outward go back along the head, those that follow the other one inward come forward."""
    turned = [
        Bump("look one", (31, 0), 9, (3, 0, -2.4)), Bump("look two", (-31, 0), 9, (3, 0, 2.4)),
        Bump("look three", (31, 0), 9, (-3, 0, 2.4)), Bump("look four", (-31, 0), 9, (-3, 0, -2.4)),
    ]  # fmt: skip
    template = replace(made_up_face(turned, 41), gaze=(0, 1, 2, 3))
    together, apart, _ = rules(template)
    assert together == {frozenset({"look one", "look two"}), frozenset({"look three", "look four"})}
    assert apart == {frozenset({"look one", "look four"}), frozenset({"look two", "look three"})}
