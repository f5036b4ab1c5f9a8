"""Contact sheets show everything."""

import numpy as np
import pytest
from PIL import Image

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.contact import FACE, MOUTH, PORTRAIT, arranged, captioned
from emogen_core.rigs.sheets import FOUR, SHEETS, make_sheets

TILES = {"identities": 14, "random": 20, "emotions": 7 * len(FOUR)}


@pytest.mark.gl
def test_sheets_are_drawn(tmp_path):
    paths = make_sheets(tmp_path / "new" / "folder", only=list(TILES))
    assert [path.stem for path in paths] == list(TILES)
    for path in paths:
        with Image.open(path) as sheet:
            pixels = np.asarray(sheet.convert("RGB"))
        assert pixels.std() > 20
        assert pixels.shape[0] * pixels.shape[1] >= TILES[path.stem] * 300 * 300


def test_an_unknown_sheet_is_refused(tmp_path):
    with pytest.raises(InvalidInputError, match=r"'genes'.*'collisions'.*got .'nose'"):
        make_sheets(tmp_path, only=["nose"])
    assert {"genes", "identities", "heads", "emotions", "random", "combinations", "collisions"} <= set(SHEETS)


@pytest.mark.parametrize("frame", [FACE, MOUTH, PORTRAIT])
def test_a_frame_is_as_wide_as_it_says(frame):
    settings = frame.settings
    cut = frame.cut(np.zeros((settings.height, settings.width, 3), np.uint8))
    assert abs(cut.shape[1] - frame.width) <= 1
    assert frame.width >= 260


def test_tiles_fill_rows_from_the_left():
    tiles = [captioned([np.full((10, 20, 3), value, np.uint8)] * 2, "") for value in (10, 20, 30)]
    sheet = np.asarray(arranged(tiles, 2))
    assert sheet.shape == (2 * tiles[0].height, 40, 3)
    assert [sheet[0, 0, 0], sheet[0, 20, 0], sheet[tiles[0].height, 0, 0]] == [10, 20, 30]
