"""The sheet of heads shows every ladder, and heads that are drawn alone are drawn as on a rig that has them."""

from __future__ import annotations

import numpy as np
import pytest

from emogen_core.correctives.pipeline import face_weights
from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.space import ANCESTRIES
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rigs import head_sheet
from emogen_core.rigs.contact import CAPTION, PORTRAIT
from emogen_core.rigs.head_portrait import draw_head
from emogen_core.rigs.identities import preset
from emogen_core.rigs.random_heads import random_head

RIG, SPACE = load_bundled_rig(), load_bundled_space()
SMALL = RenderSettings(20, 24)


class Recorder:
    """A renderer that draws its number of faces so far and remembers what it was asked."""

    def __init__(self):
        self.worn, self.drawn = [], []

    def wear(self, head):
        self.worn.append(head)

    def drop(self, name):
        assert self.worn.pop().name == name

    def draw(self, identity, weights, settings):
        assert identity == self.worn[-1].name
        self.drawn.append((self.worn[-1], weights))
        return np.full((1, settings.height, settings.width, 3), len(self.drawn), np.uint8)


def test_a_head_at_rest_is_drawn_without_fitting_its_shapes_and_let_go():
    renderer = Recorder()
    draw_head(renderer, RIG, SPACE, preset("asian-male-young"), SMALL)
    ((head, weights),) = renderer.drawn
    assert renderer.worn == []
    assert head.adjustment is None
    assert not weights.any()
    assert head.style == "asian-male-young"


def test_an_emotion_is_drawn_as_a_study_would_correct_it():
    renderer = Recorder()
    draw_head(renderer, RIG, SPACE, preset("male"), SMALL, "happy")
    ((head, weights),) = renderer.drawn
    assert head.adjustment is not None
    wanted = face_weights(RIG, "male", RIG.emotion_genes("happy")[np.newaxis]).weights
    assert weights[:, : len(RIG.core_shapes)] == pytest.approx(wanted[:, : len(RIG.core_shapes)])
    with pytest.raises(InvalidInputError, match="bored"):
        draw_head(renderer, RIG, SPACE, preset("male"), SMALL, "bored")


def test_the_sheet_has_every_ladder_once_and_pairs_of_random_heads(monkeypatch):
    shown = []

    def draw(_renderer, _rig, _space, head, settings, emotion):
        SPACE.check(head.head)
        shown.append((head, emotion))
        return np.zeros((settings.height, settings.width, 3), np.uint8)

    monkeypatch.setattr(head_sheet, "draw_head", draw)
    sheet = head_sheet.head_sheet(Recorder(), RIG)
    rows, rest = divmod(len(shown), head_sheet.COLUMNS)
    assert rest == 0
    frame = PORTRAIT.settings
    assert sheet.size == (head_sheet.COLUMNS * frame.width, rows * (frame.height + CAPTION))
    heads = [head for head, _ in shown]
    for name in ("sex", "age", "weight", *ANCESTRIES, *head_sheet.DETAILS):
        values = {head.head.get(name) for head in heads}
        assert {SPACE.ranges[name].high} <= values or name == "age"
    randoms = [(head.name, emotion) for head, emotion in shown[-2 * head_sheet.RANDOM_HEADS :]]
    assert randoms[::2] == [(random_head(SPACE, seed).name, "") for seed in range(1, head_sheet.RANDOM_HEADS + 1)]
    assert randoms[1::2] == [(name, "happy") for name, _ in randoms[::2]]
