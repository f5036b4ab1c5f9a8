"""Accessors: every packing of the same numbers gives the same array; none reaches out of its buffer."""

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.rigs.foreign.accessors import Accessors
from tests.emogen_core.rigs.foreign.heads import Gltf

VALUES = np.arange(12, dtype=np.float32).reshape(4, 3)


def read(made, index=0, kind="VEC3"):
    return Accessors(made.document, [made.data], "head.glb").read(index, kind)


def test_packed():
    made = Gltf()
    made.accessor(VALUES)
    assert np.array_equal(read(made), VALUES)


def test_interleaved_with_offsets():
    made = Gltf()
    rows = np.zeros((4, 8), "<f4")
    rows[:, 2:5] = VALUES
    view = made.view(b"skip" + rows.tobytes(), byteStride=32)
    made.document["bufferViews"][view] |= {"byteOffset": 4, "byteLength": rows.nbytes}
    made.raw({"bufferView": view, "byteOffset": 8, "componentType": 5126, "count": 4, "type": "VEC3"})
    assert np.array_equal(read(made), VALUES)


def test_the_last_element_may_end_before_its_stride_does():
    made = Gltf()
    view = made.view(np.arange(7, dtype="<f4").tobytes(), byteStride=16)
    made.raw({"bufferView": view, "componentType": 5126, "count": 2, "type": "VEC3"})
    assert read(made).tolist() == [[0, 1, 2], [4, 5, 6]]


@pytest.mark.parametrize(("base", "start"), [(True, VALUES), (False, np.zeros((4, 3)))])
def test_sparse_over_something_or_nothing(base, start):
    made = Gltf()
    accessor = {"componentType": 5126, "count": 4, "type": "VEC3"}
    if base:
        accessor["bufferView"] = made.view(VALUES.tobytes())
    indices = made.view(np.array([1, 3], "<u1").tobytes())
    values = made.view(np.full((2, 3), 7, "<f4").tobytes())
    accessor["sparse"] = {
        "count": 2, "indices": {"bufferView": indices, "componentType": 5121}, "values": {"bufferView": values},
    }  # fmt: skip
    made.raw(accessor)
    wanted = np.array(start)
    wanted[[1, 3]] = 7
    assert np.array_equal(read(made), wanted)
    made.document["accessors"][0]["count"] = 3
    with pytest.raises(InvalidInputError, match="sparse accessor"):
        read(made)


@pytest.mark.parametrize(
    ("component", "dtype", "low", "high"),
    [(5120, "<i1", -1, 127), (5121, "<u1", 0, 255), (5122, "<i2", -1, 32767), (5123, "<u2", 0, 65535)],
)
def test_whole_numbers_that_mean_fractions(component, dtype, low, high):
    made = Gltf()
    given = np.array([[np.iinfo(dtype).min, 0, np.iinfo(dtype).max]])
    made.accessor(given, component=component, dtype=dtype, normalized=True)
    made.accessor(given, component=component, dtype=dtype)
    assert read(made).tolist() == [[low, 0, 1]]
    assert read(made, 1).tolist() == given.tolist()


@pytest.mark.parametrize(
    ("place", "changes"),
    [
        (("accessors", 0), {"count": 5}),
        (("accessors", 0), {"count": -1}),
        (("accessors", 0), {"count": 10**12}),
        (("accessors", 0), {"byteOffset": 1}),
        (("accessors", 0), {"byteOffset": -1}),
        (("accessors", 0), {"type": "VEC4"}),
        (("accessors", 0), {"componentType": 5130}),
        (("accessors", 0), {"bufferView": 1}),
        (("accessors", 0), {"bufferView": -1}),
        (("bufferViews", 0), {"byteLength": 47}),
        (("bufferViews", 0), {"byteOffset": 1}),
        (("bufferViews", 0), {"byteOffset": -4}),
        (("bufferViews", 0), {"byteStride": 16}),
        (("bufferViews", 0), {"byteStride": -12}),
        (("bufferViews", 0), {"byteStride": 0}),
        (("bufferViews", 0), {"buffer": 1}),
    ],
)
def test_nothing_reaches_out_of_its_buffer(place, changes):
    made = Gltf()
    made.accessor(VALUES)
    made.document[place[0]][place[1]] |= changes
    with pytest.raises(InvalidInputError, match=r"head\.glb"):
        read(made)


@pytest.mark.parametrize("index", [1, -1])
def test_an_accessor_that_is_not_there(index):
    made = Gltf()
    made.accessor(VALUES)
    with pytest.raises(InvalidInputError, match="below 1"):
        read(made, index)
