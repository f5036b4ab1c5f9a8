"""The sheet shows every face twice, smooth and folded, and lines show on every skin."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import load_dressed, make_renderer, renderer_for
from emogen_core.rigs.wrinkle_sheet import FACES, wrinkle_sheet

# Steps of 255: what a participant sees without looking for it.
SEEN = 16


@pytest.mark.gl
def test_the_two_rows_differ_by_the_lines_alone():
    renderer, rig = make_renderer("pyrender")
    sheet = np.asarray(wrinkle_sheet(renderer, rig)).astype(int)
    renderer.close()
    assert sheet.shape == (960, 400 * len(FACES), 3)
    changed = np.abs(sheet[480:] - sheet[:480]).max(2) > SEEN
    for face in np.split(changed, len(FACES), axis=1):
        # Somewhere, but neither on the background nor on most of the face.
        assert 0.0002 < face.mean() < 0.10
        assert face[:30].sum() == 0


@pytest.mark.gl
def test_every_emotion_folds_young_skin_from_light_to_deep_visibly():
    rig, look = load_dressed()
    smooth = replace(look, styles={name: replace(style, wrinkles=0.0) for name, style in look.styles.items()})
    heads, emotions = ("female", "caucasian-female-young", "african-male-young"), rig.emotion_sets
    pictures = []
    for worn in (smooth, look):
        renderer = renderer_for("pyrender", rig, worn)
        for head, emotion in itertools.product(heads, emotions):
            weights = face_weights(rig, head, rig.emotion_genes(emotion)[np.newaxis]).weights
            pictures.append(renderer.draw(head, weights, RenderSettings(400, 480))[0].astype(int))
        renderer.close()
    without, folded = np.split(np.array(pictures), 2)
    assert ((np.abs(folded - without).max(3) > SEEN).mean((1, 2)) > 0.0002).all()
