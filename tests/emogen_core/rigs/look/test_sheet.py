"""The sheet of appearances draws every tile, and the documentation's table is the dataclass."""

from pathlib import Path

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.composer.tones import REFERENCE_TONES
from emogen_core.rendering.setup import make_renderer
from emogen_core.rigs.look import sheet
from emogen_core.rigs.look.table import appearance_table

DOCS = (Path(__file__).parents[4] / "docs" / "look.md").read_text("utf-8")


def test_the_documentation_lists_every_parameter():
    assert "\n".join(appearance_table()) in DOCS


def test_the_documentation_names_every_tone_of_the_ladder():
    for name, colour in REFERENCE_TONES.items():
        assert f"| {name} | {colour} |" in DOCS


@pytest.mark.gl
def test_a_ladder_of_skin_gets_darker_from_tile_to_tile(monkeypatch):
    ladder = list(sheet._skins(sheet.Appearance()))[:1]
    for others in ("_eyes", "_brows", "_hair"):
        monkeypatch.setattr(sheet, others, lambda base: [])
    monkeypatch.setattr(sheet, "_skins", lambda base: ladder)
    renderer, _ = make_renderer("pyrender")
    picture = np.asarray(sheet.appearance_sheet(renderer, load_bundled_rig()), float)
    renderer.close()
    tiles = np.split(picture[:240], sheet.COLUMNS, axis=1)
    noses = [tile[100:130, 110:130].mean() for tile in tiles]
    assert (np.diff(noses) < -3).all()
