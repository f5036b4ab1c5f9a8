"""Contact sheets show everything."""

import numpy as np
import pytest
from PIL import Image

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rigs.sheets import make_sheets


@pytest.mark.gl
def test_all_sheets_are_drawn(tmp_path):
    paths = make_sheets(tmp_path / "new" / "folder")
    assert [p.name for p in paths] == ["genes.jpg", "identities.jpg", "emotions.jpg", "random.jpg"]
    rig = load_bundled_rig()
    tiles = {"genes": 2 * (1 + len(rig.genes)), "identities": 14, "emotions": 7 * 14, "random": 20}
    for path in paths:
        with Image.open(path) as sheet:
            pixels = np.asarray(sheet.convert("RGB"))
        assert pixels.std() > 20
        width, height = (220, 282) if path.stem in {"genes", "emotions"} else (320, 402)
        assert pixels.shape[0] * pixels.shape[1] >= tiles[path.stem] * width * height
