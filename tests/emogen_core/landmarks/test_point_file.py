"""Files of feature points."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from emogen_core.errors import InvalidInputError
from emogen_core.landmarks.point_file import are_points, read_points
from emogen_core.landmarks.points import NAMES
from emogen_core.landmarks.rows import read_rows

FIVE = ("2.1", "8.3", "8.4", "4.3", "4.4")
MOTIONS = "name,dx,dy,dz\n" + "".join(f"{name},0,{row + 1},-1\n" for row, name in enumerate(FIVE))


def read(text, unit="mm", points=None):
    return read_points(*read_rows(text), unit, np.zeros((56, 3)) if points is None else points)


def positions(frames, names=NAMES):
    rows = NAMES.index
    lines = [
        f"{frame},{name},{x},{y},{z}"
        for frame, places in frames.items()
        for name in names
        for x, y, z in [places[rows(name)].tolist()]
    ]
    return "\n".join(["frame,name,x,y,z", *lines])


def test_motions_are_read_as_they_stand():
    (frame,) = read(MOTIONS)
    assert frame.name == "1"
    assert [NAMES[row] for row in frame.motions.rows] == list(FIVE)
    assert frame.motions.vectors.tolist() == [[0, row + 1, -1] for row in range(5)]


@pytest.mark.parametrize(("unit", "factor"), [("mm", 1), ("cm", 10), ("m", 1000)])
def test_units_become_millimetres(unit, factor):
    small = MOTIONS.replace(",-1\n", f",{-1 / factor}\n")
    for row in range(5):
        small = small.replace(f",0,{row + 1},", f",0,{(row + 1) / factor},")
    (frame,) = read(small, unit)
    assert frame.motions.vectors == pytest.approx(read(MOTIONS)[0].motions.vectors)


def test_frames_stand_side_by_side():
    lines = [f"{frame},{name},1,2,3" for frame in ("smile", "frown") for name in FIVE]
    frames = read("\n".join(["frame,name,dx,dy,dz", *lines]))
    assert [frame.name for frame in frames] == ["smile", "frown"]


def test_a_recording_may_begin_at_rest():
    lines = [f"{frame},{name},{move},0,0" for frame, move in (("1", 0), ("2", 0.01), ("3", 4)) for name in FIVE]
    frames = read("\n".join(["frame,name,dx,dy,dz", *lines]))
    assert [float(frame.motions.lengths.max()) for frame in frames] == [0, 0.01, 4]
    with pytest.raises(InvalidInputError, match="say --unit m"):
        read("\n".join(["frame,name,dx,dy,dz", *lines[:10]]))


def test_another_head_and_camera_tell_the_same_motions(head):
    rng = np.random.default_rng(3)
    moved = rng.normal(size=(56, 3)) * 3
    turn = Rotation.from_euler("xyz", [0.4, -1.1, 2.0]).as_matrix()
    neutral, posed = (1.2 * (points @ turn.T) + (300, -20, 900) for points in (head.points, head.points + moved))
    (frame,) = read(positions({"neutral": neutral, "a": posed}), points=head.points)
    assert frame.motions.vectors == pytest.approx(moved, abs=1e-6)
    (again,) = read(positions({"neutral": neutral / 1000, "a": posed / 1000}), "m", head.points)
    assert again.motions.vectors == pytest.approx(moved, abs=1e-6)


def swapped(points):
    return points * (-1, 1, 1)


def with_one_off(points):
    moved = points.copy()
    moved[NAMES.index("9.3")] += (0, 60, 0)
    return moved


def not_a_number(points):
    broken = points.copy()
    broken[3, 1] = np.nan
    return broken


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda points: points / 1000, "another unit than millimetres"),
        (lambda points: points * 10, "another unit than millimetres"),
        (swapped, "left and right exchanged"),
        (with_one_off, r"points within 25 mm .*9\.3 \(\d+ mm\).*off the face"),
        (not_a_number, "finite numbers"),
        (lambda points: points * 1e200, "places within 1e.06 mm"),
    ],
)
def test_neutral_points_off_the_face_are_refused(head, change, said):
    neutral = change(head.points)
    text = positions({"neutral": neutral, "a": neutral + 2})
    with pytest.raises(InvalidInputError, match=said):
        read(text, points=head.points)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name,dx,dy\n8.3,1,2\n", "columns name,dx,dy,dz or frame,name,x,y,z, got 'name,dx,dy'"),
        ("name,x,y,z\n8.3,1,2,3\n", "columns name,dx,dy,dz or frame"),
        (MOTIONS + "8.3,1,2,3\n", "line 7: expected every point once in a frame, got '8.3'"),
        (MOTIONS.replace("8.3", "mouth"), r"frame 1: points: expected MPEG-4 names.*\['mouth'\]"),
        (MOTIONS.replace(",4,", ",four,"), "line 5: expected a number for dy, got 'four'"),
        (MOTIONS.replace(",4,", ",nan,"), "frame 1: points: expected finite numbers"),
        (MOTIONS.replace("\n2.1,0,1,-1", ""), "frame 1: points: expected at least 5"),
        ("frame,name,x,y,z\na,8.3,1,2,3\n", "a frame neutral and others"),
        ("frame,name,x,y,z\nneutral,8.3,1,2,3\n", "a frame neutral and others"),
        ("frame,name,x,y,z\nneutral,8.3,1,2,3\na,8.3,1,2,3\n", "frame neutral: expected at least 5 points, got 1"),
    ],
)
def test_what_is_no_file_of_points_is_refused(text, said):
    with pytest.raises(InvalidInputError, match=said):
        read(text)
    assert are_points(read_rows(text)[0])


def test_every_point_of_a_frame_needs_its_neutral(head):
    text = positions({"neutral": head.points}, NAMES[:-1]) + "\n" + positions({"a": head.points + 1}).split("\n", 1)[1]
    with pytest.raises(InvalidInputError, match=r"all points of frame a, got .none for \['11\.1'\]"):
        read(text, points=head.points)


def test_an_unknown_unit_is_refused():
    with pytest.raises(InvalidInputError, match=r"unit: expected one of .*got 'inch'"):
        read(MOTIONS, "inch")
