"""A head file gives the head that was saved, to the bit, or an error that says what does not fit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import RigFileError
from emogen_core.face.appearance import Appearance
from emogen_core.face.container import write_container
from emogen_core.face.rig import Adjustment
from emogen_core.rendering.head_file import load_head, save_head
from emogen_core.rendering.worn import WornHead
from tests.rig_factory import VERTICES, small_rig

RIG = small_rig()
RANDOM = np.random.default_rng(5)
NEUTRAL = RANDOM.normal(size=(VERTICES, 3)).astype(np.float32)
OFFSETS = RANDOM.normal(size=(2, VERTICES, 3)).astype(np.float32)
HEAD = WornHead(
    "custom-0123456789ab", NEUTRAL, Adjustment(np.array([3, 1]), OFFSETS), Appearance(grey=0.5).to_document(), "male"
)


@pytest.mark.parametrize("head", [HEAD, replace(HEAD, adjustment=None), replace(HEAD, appearance={})])
def test_a_head_comes_back_to_the_bit(tmp_path, head):
    path = tmp_path / "a.head"
    save_head(head, RIG, path)
    back = load_head(path, RIG)
    assert (back.name, back.like, back.appearance) == (head.name, head.like, head.appearance)
    assert back.neutral.tobytes() == head.neutral.tobytes()
    assert (back.adjustment is None) == (head.adjustment is None)
    if head.adjustment is not None:
        assert back.adjustment.shapes.tolist() == [3, 1]
        assert back.adjustment.offsets.tobytes() == head.adjustment.offsets.tobytes()


@pytest.mark.parametrize(
    ("head", "why"),
    [
        (replace(HEAD, neutral=NEUTRAL[1:]), "a neutral mesh"),
        (replace(HEAD, neutral=NEUTRAL * np.float32(np.nan)), "finite"),
        (replace(HEAD, neutral=NEUTRAL.astype(np.float64)), "float32"),
        (replace(HEAD, like="nobody"), "the light of one of"),
        (replace(HEAD, adjustment=Adjustment(np.array([3, 3]), OFFSETS)), "each once"),
        (replace(HEAD, adjustment=Adjustment(np.array([3, 99]), OFFSETS)), "shapes of the rig"),
        (replace(HEAD, adjustment=Adjustment(np.array([3]), OFFSETS)), "offsets"),
    ],
)
def test_what_does_not_fit_the_rig_is_not_stored(tmp_path, head, why):
    with pytest.raises(RigFileError, match=f"head: expected .*{why}"):
        save_head(head, RIG, tmp_path / "a.head")
    assert list(tmp_path.iterdir()) == []


def test_a_head_of_another_rig_is_refused(tmp_path):
    save_head(HEAD, RIG, tmp_path / "a.head")
    with pytest.raises(RigFileError, match=f"fitted to the rig {small_rig(8).hash}, got '{RIG.hash}'"):
        load_head(tmp_path / "a.head", small_rig(8))


def test_what_is_no_head_is_refused(tmp_path):
    path = tmp_path / "a.head"
    path.write_bytes(b"no zip")
    with pytest.raises(RigFileError, match="expected a readable head file"):
        load_head(path, RIG)
    write_container(path, "head", 1, {"name": "a", "rig": RIG.hash, "like": "male"}, {"neutral": NEUTRAL})
    with pytest.raises(RigFileError, match="expected a complete head"):
        load_head(path, RIG)
    write_container(path, "rig", 1, {}, {})
    with pytest.raises(RigFileError, match="head"):
        load_head(path, RIG)
