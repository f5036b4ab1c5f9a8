"""Names as people read them."""

import pytest

from emogen_core.face.bundled import load_bundled_rig
from server.packing.words import COLOURS, HELD, movements, spoken

RIG = load_bundled_rig()


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (["browInnerUp.L", "browInnerUp.R"], "brow inner up"),
        (["mouthSmile_L", "mouthSmile_R"], "mouth smile"),
        (["jawOpen"], "jaw open"),
        (["jawLeft"], "jaw left"),
        (["gazeLeft.L", "gazeLeft.R"], "gaze left"),
        (["eyeLookIn_R", "eyeLookOut_L"], "eye look in, right + eye look out, left"),
        (["mouthPress.L"], "mouth press, left"),
        (["lips_pressed_right"], "lips pressed, right"),
        (["AU12 left", "AU12 right"], "au12"),
    ],
)
def test_names_become_words(names, words):
    assert spoken(names) == words


def test_every_movement_has_its_colour_and_codes():
    names = [["browRaise.L", "browRaise.R"], ["cheekPuff.L", "cheekPuff.R"], ["noseTipDown"]]
    made = movements(RIG, names, ["jawOpen"])
    assert [(one.words, one.units, one.held) for one in made] == [
        ("brow raise", "AU 1+2", False), ("cheek puff", "AD 34", False), ("nose tip down", "", False),
        ("jaw open", "AU 26+27", True),
    ]  # fmt: skip
    assert [one.colour for one in made] == [*COLOURS[:3], HELD]
    assert made[0].shapes == ("browRaise.L", "browRaise.R")


def test_more_movements_than_colours_begin_again():
    made = movements(RIG, [[f"shape{k}"] for k in range(len(COLOURS) + 2)], [])
    assert [one.colour for one in made[-2:]] == list(COLOURS[:2])
    assert len(set(COLOURS)) == len(COLOURS)
