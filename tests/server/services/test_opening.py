"""A house with drawing processes and one without name every portrait alike, so that one draws what the other stored."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.protocol import RenderSettings
from server.services.opening import open_house
from server.settings import Settings


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["pyrender", "software"])
def test_keys_agree_with_and_without_drawing_processes(tmp_path, renderer):
    settings = Settings(data_dir=tmp_path, renderer=renderer, render_workers=1)
    keys = []
    for drawing in (True, False):
        house = open_house(settings, drawing=drawing)
        try:
            weights = np.zeros(len(load_bundled_rig().shape_names), np.float32)
            keys.append(house.portraits.key("female", weights, RenderSettings()))
        finally:
            house.close()
    assert keys[0] == keys[1]
