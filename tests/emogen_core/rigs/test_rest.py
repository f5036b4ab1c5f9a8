"""The rest pose, the lids and the lips, moved and measured on the bundled head."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.eyeballs import RADIUS
from emogen_core.rigs.features import corner_height, lid_covers
from emogen_core.rigs.fitting import Head, cleared, cleared_neutral, gene_offsets
from emogen_core.rigs.head_check import eye_centre
from emogen_core.rigs.lids import EDGE, lid_rings, opening_ends, turned_below, visible_area
from emogen_core.rigs.lips import close_slits, teeth_area
from emogen_core.rigs.quality import Gauge
from emogen_core.rigs.rest import BROWS, UPPER_COVER, corner_bell, rest_pose
from emogen_core.rigs.topology import RigTopology

RIG = load_bundled_rig()
TOPOLOGY = RigTopology(RIG)
LOW = load_bundled_space().low.astype(np.float64)
NEUTRAL = RIG.neutral("female").astype(np.float64)
HEAD = Head(NEUTRAL, eye_centre(TOPOLOGY, NEUTRAL))
GENES = gene_offsets({name: RIG.offsets[i].astype(np.float64) for i, name in enumerate(RIG.core_shapes)})


def rested(mesh):
    return rest_pose(TOPOLOGY, LOW, RIG.regions[BROWS], replace(HEAD, neutral=mesh), GENES)


def test_a_sleepy_head_wakes_up_and_an_awake_one_hardly_moves():
    sleepy = NEUTRAL + 0.4 * GENES["lidsClose"]
    assert lid_covers(TOPOLOGY, sleepy, HEAD.eye_centre)[0] > 0.4
    assert lid_covers(TOPOLOGY, rested(sleepy), HEAD.eye_centre)[0] == pytest.approx(UPPER_COVER[1], abs=0.02)
    startled = NEUTRAL + 0.8 * GENES["lidUpperRaise"]
    assert lid_covers(TOPOLOGY, rested(startled), HEAD.eye_centre)[0] >= UPPER_COVER[0] - 0.02
    lids = np.flatnonzero(np.abs(NEUTRAL[:, 1]) < 12)
    assert np.abs(rested(NEUTRAL) - NEUTRAL)[lids].max() < 0.2


def test_hanging_corners_are_lifted():
    hanging = NEUTRAL - np.array([0, 2.0, 0]) * corner_bell(TOPOLOGY, NEUTRAL)[:, None]
    low, high = (corner_height(TOPOLOGY, LOW, mesh) for mesh in (hanging, rested(hanging)))
    assert low < -1
    assert high > low + 1


def test_an_eye_that_is_shut_hides_its_iris_and_shows_nothing():
    shut = NEUTRAL + GENES["lidsClose"]
    assert lid_covers(TOPOLOGY, shut, HEAD.eye_centre) == (1, 1)
    assert visible_area(TOPOLOGY, shut, HEAD.eye_centre) == 0
    assert visible_area(TOPOLOGY, NEUTRAL, HEAD.eye_centre) > 100


def test_what_is_turned_shows_its_underside():
    assert turned_below(np.array([[0.0, -1, 0]]), 90) == pytest.approx(np.array([[0, 0, 1.0]]))
    assert turned_below(np.array([[3.0, 4, 5]]), 0) == pytest.approx(np.array([[3.0, 4, 5]]))


def test_the_rings_of_a_lid_count_from_its_lining():
    rings = lid_rings(TOPOLOGY)
    lining = TOPOLOGY.part_vertices("sockets")
    assert (rings[np.intersect1d(lining, TOPOLOGY.part_vertices("skin"))] == 0).all()
    assert (rings[RIG.mirror] == rings).all()
    depth = [np.linalg.norm(NEUTRAL[(rings == k) & (NEUTRAL[:, 0] > 0)] - HEAD.eye_centre, axis=1) for k in range(4)]
    assert [float(d.mean()) for d in depth] == sorted(float(d.mean()) for d in depth)


def test_skin_is_pushed_out_of_the_eyeball_and_a_straight_path_goes_round_it():
    outer = np.flatnonzero((lid_rings(TOPOLOGY) > EDGE) & (NEUTRAL[:, 0] > 0))
    outer = outer[np.isin(outer, TOPOLOGY.part_vertices("skin"))]
    sunk = NEUTRAL - (0, 0, 2.0) * (np.abs(NEUTRAL[:, :1] - HEAD.eye_centre[0]) < 12)
    out = cleared_neutral(TOPOLOGY, replace(HEAD, neutral=sunk))[outer] - HEAD.eye_centre
    assert np.linalg.norm(out[out[:, 2] > 4], axis=1).min() >= RADIUS
    swing = cleared(TOPOLOGY, HEAD, 1.5 * GENES["lidsClose"])
    for share in (0.3, 0.5, 0.7, 1.0):
        place = (NEUTRAL + share * swing)[outer] - HEAD.eye_centre
        assert np.linalg.norm(place[place[:, 2] > 4], axis=1).min() >= RADIUS - 0.1


def test_a_lid_that_is_pushed_out_is_not_turned_over():
    """Its lining, which needs no push itself, goes along."""
    sinking = -np.array([0, 0, 1.5]) * (np.abs(NEUTRAL[:, :1]) < 50) * (np.abs(NEUTRAL[:, 1:2]) < 16)
    sinking[NEUTRAL[:, 2] < 0] = 0
    pushed = np.linalg.norm(cleared(TOPOLOGY, HEAD, sinking) - sinking, axis=1)
    left = np.linalg.norm(NEUTRAL - HEAD.eye_centre, axis=1) < 1.1 * RADIUS
    soft = np.isin(np.arange(len(NEUTRAL)), TOPOLOGY.part_vertices("skin"))
    front = left & soft & (NEUTRAL[:, 2] > 8)
    assert np.median(pushed[front & (lid_rings(TOPOLOGY) == EDGE - 1)]) > 0.3
    assert np.median(pushed[front & (lid_rings(TOPOLOGY) == EDGE)]) > 0.3
    gauge = Gauge(NEUTRAL, RIG.triangles[: RIG.parts["sockets"][1]])
    assert gauge.damage(NEUTRAL + GENES["gazeDown"]).flips == 0
    assert gauge.damage(NEUTRAL + GENES["lidsClose"]).flips <= 12


def test_the_opening_of_an_eye_ends_on_both_sides_of_its_middle_and_nowhere_if_shut():
    middle = HEAD.eye_centre[0]
    first, last = opening_ends(TOPOLOGY, NEUTRAL, HEAD.eye_centre)
    assert middle - RADIUS < first < middle - 6 < middle + 6 < last < middle + RADIUS
    assert opening_ends(TOPOLOGY, NEUTRAL + GENES["lidsClose"], HEAD.eye_centre) == (middle, middle)


def test_a_slit_between_the_lips_is_closed():
    low = LOW[:, None] * (NEUTRAL[:, 2:] > 15)
    apart = NEUTRAL - (0, 0.8, 0) * low * corner_bell(TOPOLOGY, NEUTRAL)[:, None]
    assert teeth_area(TOPOLOGY, apart) > 1
    assert teeth_area(TOPOLOGY, close_slits(TOPOLOGY, LOW, apart)) <= 0.2
