"""Lengths as steps: nothing is off by more than half a step, and what cannot be stored is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays as some

from emogen_core.errors import RigFileError
from emogen_core.face.arrays import integers, millimetres, steps

SCALES = st.sampled_from([64, 512, 1024])
LENGTHS = some(np.float32, st.integers(0, 20), elements=st.floats(-8000, 8000, width=32))


@given(LENGTHS, SCALES)
def test_a_length_comes_back_within_half_a_step(lengths, scale):
    back = millimetres(steps(lengths, scale), scale)
    assert np.abs(back - lengths).max(initial=0) <= 0.5001 / scale + np.abs(lengths).max(initial=0) * 2.0**-23


@given(LENGTHS, SCALES)
def test_what_was_stored_once_is_stored_as_it_is(lengths, scale):
    once = steps(lengths, scale)
    assert np.array_equal(steps(millimetres(once, scale), scale), once)


@given(st.integers(-(10**6), 10**6), SCALES)
def test_ties_go_one_way_whatever_the_last_bit_says(whole, scale):
    tie = np.float64(whole + 0.5) / scale
    near = np.array([np.nextafter(tie, -np.inf), tie, np.nextafter(tie, np.inf)])
    assert len(set(steps(near, scale).tolist())) == 1


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 2.0**24])
def test_what_is_no_length_is_refused(bad):
    with pytest.raises(RigFileError, match="lengths: expected finite ones below 33 m"):
        steps(np.array([0.0, bad]), 512)


def test_an_array_is_what_it_is_taken_for_or_refused():
    good = np.arange(6, dtype=np.int32).reshape(2, 3)
    assert integers({"a": good}, "a", 2, np.int32) is good
    for other in (good.astype(np.int64), good.astype(np.float32), good.astype(np.uint32), good.ravel()):
        with pytest.raises(RigFileError, match="arrays: expected a of int32 with 2 axes, got"):
            integers({"a": other}, "a", 2, np.int32)
    with pytest.raises(KeyError):
        integers({}, "a", 2, np.int32)
