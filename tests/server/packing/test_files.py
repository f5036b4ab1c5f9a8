"""The files of a packing: whole, alone, and those of an earlier one gone."""

import csv
import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from server.packing import cards as cards_module
from server.packing.cards import SIZE, png
from server.packing.files import page, table, write
from server.packing.words import Movement
from tests.server.packing.made import DOCUMENT, MADE, RIG, studio

CARDS = MADE.drawn(studio())


def names(folder):
    return {path.name for path in folder.iterdir()}


def test_a_folder_has_everything(tmp_path):
    write(tmp_path / "new", MADE, CARDS, DOCUMENT, "proof")
    three = {f"expression-0{number}.png" for number in (1, 2, 3)}
    assert names(tmp_path / "new") == {"sheet.html", "weights.csv", "packing.json", *three}
    assert json.loads((tmp_path / "new" / "packing.json").read_text()) == DOCUMENT


def test_cards_of_an_earlier_packing_go_and_what_is_not_ours_stays(tmp_path):
    for name in ("expression-25.png", "expression-1x.png", "mine.png"):
        (tmp_path / name).write_text("old")
    write(tmp_path, MADE, CARDS, DOCUMENT, "proof")
    assert not (tmp_path / "expression-25.png").exists()
    assert {"expression-1x.png", "mine.png"} <= names(tmp_path)


def test_without_pictures_there_are_no_cards(tmp_path):
    write(tmp_path, MADE, MADE.cards, DOCUMENT, "proof")
    assert names(tmp_path) == {"sheet.html", "weights.csv", "packing.json"}
    assert "could not draw faces" in (tmp_path / "sheet.html").read_text()


def test_what_fails_leaves_an_earlier_packing_as_it_was(tmp_path, monkeypatch):
    write(tmp_path, MADE, CARDS, DOCUMENT, "proof")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    def fails(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("server.reporting.files.Path.write_bytes", fails)
    with pytest.raises(OSError, match="No space"):
        write(tmp_path, MADE, CARDS[:1], {**DOCUMENT, "rig": "other"}, "proof")
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_the_table_has_a_row_an_expression_and_a_column_a_shape():
    head, *rows = csv.reader(io.StringIO(table(MADE)))
    assert head == ["expression", *RIG.core_shapes]
    assert [row[0] for row in rows] == ["expression-01", "expression-02", "expression-03"]
    np.testing.assert_array_equal(np.array([row[1:] for row in rows], float), MADE.weights)


def test_the_page_stands_alone_and_shows_every_card():
    html = page(CARDS, DOCUMENT, "the proof")
    assert not re.findall(r'(?:src|href)="(?!data:|#)', html), "nothing is fetched from anywhere"
    assert html.count("<img") == 9
    assert all(movement.words in html for card in CARDS for movement in card.movements)
    assert "the proof" in html
    assert DOCUMENT["command"] in html
    assert "held" not in re.sub("<style>.*</style>", "", html, flags=re.DOTALL)


def test_what_is_held_is_explained_where_there_is_some():
    held = Movement(("jawOpen",), "jaw open", "", "#9aa2a5", held=True)
    html = page([replace(CARDS[0], movements=(*CARDS[0].movements, held))], DOCUMENT, "")
    assert "marked as held" in html
    assert "<b>jaw open</b> held" in html


def test_names_from_files_are_no_markup():
    bad = Movement(("x",), "<script>alert(1)</script>", "", "#9aa2a5")
    html = page([replace(CARDS[0], movements=(bad,))], {**DOCUMENT, "head": "<b>x", "command": "<i>"}, "")
    assert "<script>" not in html
    assert "<b>x" not in html


def test_a_card_is_a_picture_of_its_size():
    picture = Image.open(io.BytesIO(png(CARDS[0], "male")))
    assert (picture.size, picture.mode) == (SIZE, "RGB")
    pixels = np.asarray(picture).reshape(-1, 3)
    for movement in CARDS[0].movements:
        wanted = [int(movement.colour[at : at + 2], 16) for at in (1, 3, 5)]
        assert (pixels == wanted).all(1).sum() > 200, "its dot"


@pytest.mark.parametrize("count", [1, 7, 8, 14, 26])
def test_however_many_movements_there_are_they_fit(count):
    places = list(cards_module._places(count))
    assert len(set(places)) == count
    assert all(0 < x < x + width < SIZE[0] and 790 < y < SIZE[1] - 30 for x, y, width in places)
    steps = np.diff(sorted({y for _, y, _ in places}))
    assert (steps >= 40).all()


def test_long_names_keep_to_their_column():
    """Of three columns the middle one stays free of the first one's words."""
    long = Movement(("x",), "eye look in, right + eye look out, left", "AU 61", "#0b6b7b")
    short = Movement(("x",), "x", "", "#0b6b7b")
    pictures = []
    for first in (long, short):
        card = replace(CARDS[0], movements=(first, *[short] * 8))
        pictures.append(np.asarray(Image.open(io.BytesIO(png(card, "male")))).astype(int))
    apart = np.argwhere((pictures[0] != pictures[1]).any(2))
    left = [x for x, _, _ in cards_module._places(9)]
    assert apart[:, 1].max() < sorted(set(left))[1]
    assert len(apart) > 200


def test_a_pillow_without_the_font_writes_all_the_same(monkeypatch):
    real = cards_module.ImageFont.truetype

    def no_woff(font, *given, **more):
        if isinstance(font, Path):
            raise OSError("unknown file format")
        return real(font, *given, **more)

    monkeypatch.setattr(cards_module.ImageFont, "truetype", no_woff)
    assert Image.open(io.BytesIO(png(CARDS[1], "male"))).size == SIZE
