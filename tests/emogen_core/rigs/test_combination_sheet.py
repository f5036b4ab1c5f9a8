"""Pairs and faces before and after are drawn with what broke in each."""

import numpy as np
import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.setup import make_renderer
from emogen_core.rigs import combination_sheet as sheet
from emogen_core.rigs.combination_sheet import _chosen, combination_sheet
from emogen_core.rigs.contact import CAPTION


@pytest.fixture(autouse=True)
def few_faces(monkeypatch):
    monkeypatch.setattr(sheet, "SEARCHED", 8)
    monkeypatch.setattr(sheet, "FACES", 2)


def test_the_chosen_are_mended_most_first():
    rig = load_bundled_rig()
    captions, before, after = _chosen(rig, "female", 1)
    assert len(captions) == len(before) == len(after) == sheet.PAIRS + 2
    assert not before[:, len(rig.core_shapes) :].any()
    assert np.array_equal(before[:, : len(rig.core_shapes)], after[:, : len(rig.core_shapes)])
    gains = [int(a) - int(b) for a, b in (caption.rsplit(": ", 1)[1].split(" then ") for caption in captions)]
    assert gains[: sheet.PAIRS] == sorted(gains[: sheet.PAIRS], reverse=True)
    assert min(gains[: sheet.PAIRS]) > 0


@pytest.mark.gl
def test_above_and_below_differ():
    renderer, rig = make_renderer("pyrender")
    pixels = np.asarray(combination_sheet(renderer, rig).convert("L")).astype(float)
    renderer.close()
    height = pixels.shape[0] // 3
    assert pixels.std() > 20
    tile = pixels[:height, : pixels.shape[1] // 5]
    half = (height - CAPTION) // 2
    assert np.abs(tile[:half] - tile[half : 2 * half]).mean() > 0.3
