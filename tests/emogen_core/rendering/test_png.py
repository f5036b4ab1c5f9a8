"""PNG: what is encoded is what any reader decodes."""

import io
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image

from emogen_core.errors import InvalidInputError
from emogen_core.rendering.png import encode_png

pictures = st.tuples(st.integers(1, 40), st.integers(1, 40)).flatmap(lambda s: arrays(np.uint8, (*s, 3)))


def decode(png):
    with Image.open(io.BytesIO(png)) as picture:
        picture.load()
        assert picture.mode == "RGB"
        return np.asarray(picture)


@given(pictures)
@settings(deadline=None)
def test_every_picture_survives(picture):
    assert np.array_equal(decode(encode_png(picture)), picture)


def test_large_smooth_and_noisy_pictures_survive():
    smooth = np.linspace(0, 255, 792 * 660 * 3).reshape(792, 660, 3).astype(np.uint8)
    noisy = np.random.default_rng(1).integers(0, 256, (480, 400, 3), np.uint8)
    for picture in (smooth, noisy, smooth[::-1], noisy[:, ::-1]):
        assert np.array_equal(decode(encode_png(picture)), picture)
    assert len(encode_png(smooth)) < smooth.nbytes / 3


def test_every_chunk_has_its_length_and_checksum():
    png = encode_png(np.zeros((3, 5, 3), np.uint8))
    at, names = 8, []
    while at < len(png):
        length = int.from_bytes(png[at : at + 4], "big")
        body = png[at + 4 : at + 8 + length]
        assert int.from_bytes(png[at + 8 + length : at + 12 + length], "big") == zlib.crc32(body)
        names.append(body[:4])
        at += 12 + length
    assert names == [b"IHDR", b"IDAT", b"IEND"]


@pytest.mark.parametrize(
    "picture",
    [
        np.zeros((4, 4), np.uint8),
        np.zeros((4, 4, 4), np.uint8),
        np.zeros((4, 4, 3), np.float32),
        np.zeros((0, 4, 3), np.uint8),
    ],
)
def test_anything_else_is_refused(picture):
    with pytest.raises(InvalidInputError, match="expected"):
        encode_png(picture)
