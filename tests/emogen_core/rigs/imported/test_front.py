"""Places of a face, read off the bundled heads."""

import numpy as np
import pytest

from emogen_core.rigs.imported.front import Front
from tests.emogen_core.rigs.imported.test_overlay import JAW, head, rig

DOWNWARDS = (
    "crown", "forehead 45", "nose root", "nose tip", "nose base", "upper lip", "lower lip", "chin fold",
)  # fmt: skip
HEADS = ("female", "male", "asian-female-old", "african-male-young")


@pytest.mark.parametrize("who", HEADS)
def test_places_lie_where_anatomy_has_them(who):
    at = head(who).landmarks()
    heights = [at[name][1] for name in DOWNWARDS]
    assert heights == sorted(heights, reverse=True)
    assert at["chin"][1] > at["under chin"][1]
    assert at["nose tip"][2] > max(at["nose root"][2], at["nose base"][2])
    for side, sign in (("left", 1), ("right", -1)):
        inner, outer = at[f"{side} inner corner"], at[f"{side} outer corner"]
        assert 0 < sign * inner[0] < sign * outer[0]
        assert at[f"{side} lid above 0.5"][1] > at[f"{side} lid below 0.5"][1]
        assert sign * at[f"{side} ear"][0] > 55
        assert 11 < sign * at[f"{side} nose wing"][0] < 24


@pytest.mark.parametrize("who", HEADS)
def test_both_halves_are_mirror_images(who):
    at = head(who).landmarks()
    for name in [name for name in at if name.startswith("left ")]:
        assert at[name] == pytest.approx(at[name.replace("left", "right")] * (-1, 1, 1), abs=1.5), name


@pytest.mark.parametrize("who", rig.identities)
def test_under_the_chin_is_no_neck(who):
    at = head(who).landmarks()
    assert at["chin"][2] - at["under chin"][2] < 14


def test_the_back_of_an_open_mouth_is_no_line_of_the_lips(monkeypatch):
    male = head("male")
    line, places = male.mouth_line(), male.landmarks()
    middle = len(line) // 2
    line[middle - 1 : middle + 1] -= (0, 0, 95)
    monkeypatch.setattr(Front, "mouth_line", lambda _: line)
    assert set(places) - set(male.landmarks()) == {"mouth 0.500"}


def test_lips_meet_along_the_line_of_the_mouth():
    line = head("male").mouth_line()
    assert (np.diff(line[:, 0]) > 0).all()
    assert line[0, 0] == pytest.approx(-line[-1, 0], abs=0.6)
    assert 30 < np.ptp(line[:, 0]) < 60


def test_edges_are_the_rims_of_lids_and_lips():
    edges = head("female").edges()
    neutral, closing = rig.neutral("female"), rig.offsets[rig.shape_names.index("lidsClose.L")]
    assert set(edges) == {f"{part}_{half}" for part in ("left", "right", "mouth") for half in ("upper", "lower")}
    for rows in edges.values():
        assert len(rows) >= 8
        assert (np.diff(neutral[rows, 0]) >= 0).all()
    middle = edges["left_upper"][len(edges["left_upper"]) // 2]
    assert closing[middle, 1] < -4
    assert JAW[edges["mouth_lower"]].min() > JAW[edges["mouth_upper"]].max() - 0.3


def test_a_head_without_eyes_or_jaw_has_the_other_places():
    whole = head("male")
    blind = type(whole)(whole.vertices, whole.skin, whole.eyes[:0], whole.drop)
    assert not any("lid" in name or "corner" in name for name in blind.landmarks())
    assert blind.edges() == {}
    mute = type(whole)(whole.vertices, whole.skin, whole.eyes, 0 * whole.drop)
    assert not any(name.startswith("mouth") for name in mute.landmarks())
    assert len(mute.mouth_line()) == 0
    assert {"nose tip", "crown", "left inner corner"} <= set(mute.landmarks())
