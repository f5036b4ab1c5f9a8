"""The sheet shows every face twice: smooth and folded."""

import numpy as np
import pytest

from emogen_core.rendering.setup import make_renderer
from emogen_core.rigs.wrinkle_sheet import FACES, wrinkle_sheet


@pytest.mark.gl
def test_the_two_rows_differ_by_the_lines_alone():
    renderer, rig = make_renderer("pyrender")
    sheet = np.asarray(wrinkle_sheet(renderer, rig)).astype(int)
    renderer.close()
    assert sheet.shape == (960, 400 * len(FACES), 3)
    changed = np.abs(sheet[480:] - sheet[:480]).max(2) > 8
    for face in np.split(changed, len(FACES), axis=1):
        # Somewhere, but neither on the background nor on most of the face.
        assert 0.0002 < face.mean() < 0.10
        assert face[:30].sum() == 0
