"""A portrait's name depends on everything that its pixels depend on, and on nothing else."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from emogen_core.rendering.keys import portrait_key
from emogen_core.rendering.protocol import SURROUND_DARK, RenderSettings

FACE = ("rig", "look", "pyrender", "female", np.array([0, 0.5, 1], np.float32), RenderSettings())


def key(**changes):
    names = ("rig_hash", "look_hash", "backend", "identity", "weights", "settings")
    return portrait_key(**{**dict(zip(names, FACE, strict=True)), **changes})


def test_every_part_counts():
    others = [
        key(),
        key(rig_hash="rig2"),
        key(look_hash="look2"),
        key(backend="software"),
        key(identity="male"),
        key(weights=np.array([0, 0.5, 0.999], np.float32)),
        key(settings=RenderSettings(401, 480)),
        key(settings=RenderSettings(400, 481)),
        key(settings=RenderSettings(background=SURROUND_DARK)),
    ]
    assert len(set(others)) == len(others)
    assert all(len(k) == 64 and set(k) <= set("0123456789abcdef") for k in others)


def test_the_packing_of_the_weights_does_not_count():
    strided = np.array([0, 9, 0.5, 9, 1, 9], np.float32)[::2]
    assert key(weights=strided) == key() == key(weights=np.array([0, 0.5, 1], np.float64))


def test_neighbouring_fields_cannot_be_mistaken_for_each_other():
    assert key(rig_hash="ab", look_hash="c") != key(rig_hash="a", look_hash="bc")


@given(st.lists(st.floats(0, 1, width=32), min_size=3, max_size=3))
def test_equal_faces_have_equal_keys(values):
    weights = np.array(values, np.float32)
    assert key(weights=weights) == key(weights=weights.copy())
