"""Motions are checked before anything is made of them."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.landmarks.motions import STILL, check_scale, make_motions
from emogen_core.landmarks.points import NAMES

FIVE = ["8.3", "8.4", "8.1", "8.2", "2.1"]


def vectors(**changes):
    moved = np.ones((5, 3))
    for row, value in changes.items():
        moved[int(row[1:])] = value
    return moved


def test_motions_keep_the_order_in_which_they_were_given():
    motions = make_motions(FIVE, vectors(v2=0, v3=STILL / 2))
    assert [NAMES[row] for row in motions.rows] == FIVE
    assert motions.moving.tolist() == [True, True, False, False, True]
    assert motions.lengths[0] == pytest.approx(3**0.5)
    chosen = np.zeros(56, bool)
    chosen[motions.rows[[1, 4]]] = True
    assert motions.among(chosen).rows.tolist() == motions.rows[[1, 4]].tolist()


def test_emphasis_scales_every_motion():
    motions = make_motions(FIVE, vectors())
    assert np.array_equal(motions.emphasised(1.4).vectors, 1.4 * motions.vectors)
    for level in (0, -1, np.nan, 11):
        with pytest.raises(InvalidInputError, match="emphasis: expected a number above 0"):
            motions.emphasised(level)


@pytest.mark.parametrize(
    ("names", "moved", "said"),
    [
        (FIVE, vectors(v1=np.nan), r"finite numbers, got \"?'?others at \['8\.4'\]"),
        (FIVE, vectors(v0=np.inf), r"others at \['8\.3'\]"),
        (FIVE[:4], vectors()[:4], "at least 5 of the 56, got 4"),
        ([], np.zeros((0, 3)), "at least 5 of the 56, got 0"),
        (["lip", *FIVE[1:]], vectors(), r"MPEG-4 names.*got \['lip'\]"),
        (FIVE, vectors(v4=1e300), "leave the face"),
        (FIVE, vectors(v4=80), r"at most 100 mm.*\['2\.1'\].*leave the face"),
        (FIVE, vectors()[:4], "one for each of 5 points, got 4"),
    ],
)
def test_what_no_face_does_is_refused(names, moved, said):
    with pytest.raises(InvalidInputError, match=said):
        make_motions(names, moved)


def test_the_unit_is_judged_by_all_frames_together():
    still, small, plain = (make_motions(FIVE, vectors() * factor) for factor in (0, 0.001, 1))
    check_scale([still, small, plain])
    with pytest.raises(InvalidInputError, match="a point that moves"):
        check_scale([still, still])
    with pytest.raises(InvalidInputError, match="if these are metres, say --unit m"):
        check_scale([still, small])
