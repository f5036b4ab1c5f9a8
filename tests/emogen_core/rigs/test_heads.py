"""Every head, preset or not, rests neutral, closes its eyes and keeps its lips shut."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.errors import IdentityError, InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.face.identity import Identity
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.head_check import check_head
from emogen_core.rigs.identities import IDENTITIES, preset
from emogen_core.rigs.quality import Gauge
from emogen_core.rigs.random_heads import random_head
from emogen_core.rigs.rest import BROW_HEIGHT, LOWER_COVER, UPPER_COVER
from emogen_core.rigs.wear import fitter, nearest_preset, wear, worn_name
from tests.emogen_core.rigs.alike import must_be_alike
from tests.rig_factory import small_rig

RIG, SPACE = load_bundled_rig(), load_bundled_space()
LOW = SPACE.low.astype(np.float64)
FLESH = RIG.triangles[: RIG.parts["sockets"][1]]


HEADS = [preset(name) for name in IDENTITIES] + [random_head(SPACE, seed) for seed in range(2)]


@pytest.fixture(scope="module", params=HEADS, ids=lambda head: head.name)
def worn(request):
    if request.param.name in RIG.neutrals:
        return RIG, request.param.name
    return wear(RIG, SPACE, request.param)


@pytest.fixture(scope="module")
def report(worn):
    return check_head(*worn, LOW)


def test_lids_close_whatever_else_they_do_and_no_eyeball_comes_through(report):
    assert max(report["visible_mm2"].values()) <= 0.3
    assert report["visible_mm2"]["lidsClose"] <= 0.07
    assert report["poke_mm"] <= 0.1


def test_a_head_at_rest_is_neutral(report):
    assert UPPER_COVER[0] - 0.01 <= report["upper_lid_cover"] <= UPPER_COVER[1] + 0.01
    assert LOWER_COVER[0] - 0.01 <= report["lower_lid_cover"] <= LOWER_COVER[1] + 0.01
    assert report["brow_height_mm"] >= BROW_HEIGHT[0] - 0.1
    assert report["corner_height_mm"] > -1


def test_lips_meet_without_collision_and_show_no_tooth(report):
    assert report["teeth_mm2"] <= 0.1
    assert report["collision_mm"] <= 0.1


def test_a_head_is_symmetric_and_no_worse_folded_than_the_presets(worn):
    rig, name = worn
    mesh = rig.neutral(name).astype(np.float64)
    assert np.isfinite(mesh).all()
    assert np.abs(mesh[rig.mirror] * (-1, 1, 1) - mesh).max() < 0.02
    gauge = Gauge(RIG.neutral("female").astype(np.float64), FLESH)
    assert gauge.damage(mesh).flips <= 60


@pytest.mark.parametrize("name", ["male", "asian-female-old", "caucasian-male-young"])
def test_a_presets_point_gives_the_preset(name):
    neutral, adjustment = fitter(RIG, SPACE).fit(IDENTITIES[name])
    must_be_alike(neutral, RIG.neutral(name))
    stored = RIG.adjustments[name]
    assert adjustment.shapes.tolist() == stored.shapes.tolist()
    must_be_alike(adjustment.offsets, stored.offsets)


def test_wearing_adds_one_head_and_leaves_the_rig_alone():
    head = random_head(SPACE, 1)
    before = RIG.identities
    rig, name = wear(RIG, SPACE, head)
    assert name == worn_name(head, SPACE)
    assert rig.hash == RIG.hash
    assert rig.identities == (*before, name)
    assert RIG.identities == before
    assert rig.offsets is RIG.offsets
    assert wear(rig, SPACE, head) == (rig, name)
    assert np.isfinite(vertices(rig, name, np.full((1, len(rig.shape_names)), 0.5, np.float32))).all()


def test_children_need_to_be_allowed_and_other_meshes_are_refused():
    child = Identity("child", {"age": 11.0})
    with pytest.raises(IdentityError, match="children"):
        wear(RIG, SPACE, child)
    assert wear(RIG, SPACE, child, children=True)[1].startswith("custom-")
    with pytest.raises(InvalidInputError, match="of the space"):
        wear(small_rig(), SPACE, preset("male"))


def test_presets_are_points_and_nearest_to_themselves():
    assert all(nearest_preset(point, SPACE) == name for name, point in IDENTITIES.items())
    with pytest.raises(IdentityError, match="one of"):
        preset("martian")
