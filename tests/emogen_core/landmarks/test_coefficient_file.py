"""Files of phones and of MediaPipe."""

import json

import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.landmarks.arkit import TABLE
from emogen_core.landmarks.coefficient_file import read_mediapipe, read_recording
from emogen_core.landmarks.rows import read_rows

ANGLES = [f"{what}{angle}" for what in ("Head", "LeftEye", "RightEye") for angle in ("Yaw", "Pitch", "Roll")]
HEADER = ["Timecode", "BlendShapeCount", *(name[0].upper() + name[1:] for name in TABLE), *ANGLES]


def phone(*rows):
    return "\n".join([",".join(HEADER), *(",".join(map(str, row)) for row in rows)])


def frame(time, *values):
    given = list(values) + [0] * (52 - len(values))
    return [time, 61, *given, *[0.1] * 9]


def read(text):
    return read_recording(*read_rows(text))


def test_a_recording_of_a_phone():
    first, *_ = TABLE
    recording = read(phone(frame("10:00:00:01.001", 0.25), frame("10:00:00:02.002", 0.5)))
    assert [one.name for one in recording.frames] == ["10:00:00:01.001", "10:00:00:02.002"]
    assert [one.values[first] for one in recording.frames] == [0.25, 0.5]
    assert set(recording.frames[0].values) == set(TABLE)
    assert recording.unknown == recording.missing == ()


def test_frames_without_a_face_are_left_out():
    lost = ["10:00:00:02.002", 0]
    recording = read(phone(frame("a"), lost, frame("c")))
    assert [one.name for one in recording.frames] == ["a", "c"]
    with pytest.raises(InvalidInputError, match="a frame with a face, got '1 without values'"):
        read(phone(lost))


def test_columns_are_told():
    recording = read("Timecode,JawOpen,EyebrowTwist\n1,0.5,0.2\n")
    assert recording.unknown == ("EyebrowTwist",)
    assert len(recording.missing) == 51
    assert "jawOpen" not in recording.missing


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Timecode,Wink\n1,0.5\n", "columns of feature points .* or ARKit names"),
        (phone(frame("a", "much")), "line 2: expected a number for .*, got 'much'"),
        ("JawOpen,EyeBlinkLeft\n0.5\n", "line 2: expected a number for eyeblinkleft, got ''"),
    ],
)
def test_what_is_no_recording_is_refused(text, said):
    with pytest.raises(InvalidInputError, match=said):
        read(text)


def result(key, name, *scores):
    categories = [{"index": i, "score": score, name: word} for i, (word, score) in enumerate(scores)]
    return {key: [{"categories": categories, "headIndex": -1}] if name == "categoryName" else [categories]}


SCORES = (("_neutral", 0.01), ("jawOpen", 0.6), ("mouthSmileLeft", 0.2))


@pytest.mark.parametrize(("key", "name"), [("faceBlendshapes", "categoryName"), ("face_blendshapes", "category_name")])
def test_results_of_mediapipe(key, name):
    one = result(key, name, *SCORES)
    recording = read_mediapipe(json.dumps(one))
    assert recording.frames[0].values == {"jawOpen": 0.6, "mouthSmileLeft": 0.2}
    assert recording.unknown == ()
    assert [frame.name for frame in read_mediapipe(json.dumps([one, one])).frames] == ["1", "2"]


def test_results_without_a_face_are_left_out():
    one, none = result("faceBlendshapes", "categoryName", *SCORES), {"faceBlendshapes": [], "faceLandmarks": []}
    assert [frame.name for frame in read_mediapipe(json.dumps([none, one])).frames] == ["2"]


TWO_FACES = {"faceBlendshapes": result("faceBlendshapes", "categoryName", *SCORES)["faceBlendshapes"] * 2}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "file: expected JSON"),
        ("[" * 100_000, "file: expected JSON"),
        ("[]", "a result with a face, got '0 without'"),
        ('{"faceBlendshapes": []}', "a result with a face, got '1 without'"),
        ('{"faceBlendshapes": [{}]}', "categories with categoryName and score"),
        ('{"faceLandmarks": [[]]}', "result 1: expected faceBlendshapes"),
        ("[3]", "result 1: expected faceBlendshapes"),
        (json.dumps(TWO_FACES), "result 1: expected one face, got 2"),
        ('{"faceBlendshapes": [[{"score": 1}]]}', "categories with categoryName and score, got 'KeyError'"),
        ('{"faceBlendshapes": [3]}', "categories with categoryName and score"),
        ('{"faceBlendshapes": 3}', "result 1: expected"),
        (json.dumps(result("faceBlendshapes", "categoryName", ("grin", 1))), r"ARKit names, got \['grin'\]"),
    ],
)
def test_other_json_is_refused(text, said):
    with pytest.raises(InvalidInputError, match=said):
        read_mediapipe(text)
