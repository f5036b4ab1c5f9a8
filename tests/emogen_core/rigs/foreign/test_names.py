"""What names say, in every spelling that exporters have."""

import pytest

from emogen_core.landmarks.arkit import TABLE
from emogen_core.rigs.foreign.names import ONE_SIDED, WHOLE, Meaning, meaning


@pytest.mark.parametrize("stem", ONE_SIDED)
def test_sides_in_every_spelling(stem):
    for side, word in (("L", "Left"), ("R", "Right")):
        spellings = (f"_{side}", f".{side}", f"-{side}", f" {side}", word, f"_{word}", f".{word.lower()}", side)
        for ending in (*spellings, f"_{side.lower()}"):
            assert meaning(stem + ending) == Meaning(stem, side, known=True), ending


@pytest.mark.parametrize("name", WHOLE)
def test_names_without_a_side(name):
    assert meaning(name) == Meaning(name, "", known=True)
    assert meaning(name[0].upper() + name[1:]) == meaning(name)
    assert meaning(f"blendShape1.{name}") == meaning(name)


def test_directions_are_no_sides():
    assert meaning("jawLeft").side == meaning("mouthRight").side == ""
    assert meaning("jawLeft").standard == "jawLeft"


@pytest.mark.parametrize(
    ("name", "stem", "side"),
    [("browKnit.L", "browKnit", "L"), ("AU12_R", "AU12", "R"),
     ("smile", "smile", ""), ("L", "L", ""), ("AUL", "AUL", ""),
     ("head.squeeze_L", "squeeze", "L"), ("Key 1", "Key 1", "")],
)  # fmt: skip
def test_others_keep_their_names(name, stem, side):
    assert meaning(name) == Meaning(stem, side, known=False)


def test_the_bundled_rigs_names_are_read_as_arkits():
    expected = {"lidsClose.L": "eyeBlink_L", "lidsClose_R": "eyeBlink_R", "gazeLeft.R": "eyeLookIn_R",
                "gazeRight.R": "eyeLookOut_R", "gazeUp.L": "eyeLookUp_L", "jawThrust": "jawForward",
                "Head.lipRollUpper": "mouthRollUpper", "cheekRaise.L": "cheekSquint_L"}  # fmt: skip
    assert {name: meaning(name).standard for name in expected} == expected
    assert all(meaning(name).known for name in expected)


def test_every_bundled_shape_that_arkit_has_alone_is_known():
    shapes = {listed[0]: name for name, listed in TABLE.items() if len(listed) == 1}
    assert {shape: meaning(shape) for shape in shapes} == {shape: meaning(name) for shape, name in shapes.items()}
