"""The layers that all heads share, as `head.look` stores them: what is where, without any colour.

Skin layers are grey pictures on the skin's texture, kept as JPEG in 8 bits over the range in `RANGES`. The builder
(`emogen_core.rigs.look`) makes them, the composer mixes them; this module is all that the two have to agree on.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from emogen_core.errors import RigFileError, expected

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

# Layer -> its least and greatest value. Lengths in decimetres, all else without unit.
RANGES: Mapping[str, tuple[float, float]] = {
    "blood": (-0.2, 0.6),  # where skin is redder
    "mottle": (-0.2, 0.2),  # blotches of blood
    "melanin": (-0.2, 0.2),  # blotches of melanin
    "yellow": (-0.1, 0.2),
    "mask": (0.0, 1.0),  # what is darker than the cheeks on deep skin: forehead, round the mouth
    "under_eye": (0.0, 1.0),
    "pores": (-1.0, 1.0),
    "lip_lines": (-2.0, 2.0),
    "freckles": (0.0, 1.0),
    "spots": (0.0, 1.0),  # of age
    "capillaries": (0.0, 1.0),
    "lips": (0.0, 1.0),
    "wet": (0.0, 1.0),  # rims of the lids, corners of the eyes
    "lash_line": (0.0, 1.0),
    "cavity": (0.0, 1.0),  # how open to light
    "beard": (0.0, 1.0),
    "stubble": (0.0, 1.0),  # single hairs of the beard
    "hairline": (-0.4, 0.6),  # how far inside the hair
    "bald": (0.0, 1.6),  # by how much the hairline goes back here
    "strands": (0.0, 1.0),
    "coils": (0.0, 1.0),
    "sheen": (0.0, 1.0),  # of combed hair under the key light
}
# Fine grain suffers less from compression than slopes do.
_QUALITY: Mapping[str, int] = {"pores": 84, "strands": 88, "coils": 84, "stubble": 84, "hairline": 95, "lips": 94}
_USUAL = 88


def pack(name: str, image: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return a (size, size) layer as the bytes of a file."""
    low, high = RANGES[name]
    grey = np.round(255 * np.clip((image - low) / (high - low), 0, 1)).astype(np.uint8)
    return pack_grey(grey, _QUALITY.get(name, _USUAL))


class Layers(Mapping[str, "NDArray[np.float32]"]):
    """The skin layers of a look by name, (size * size,) float32 each; kept in 8 bits, for every worker has them."""

    def __init__(self, paint: Mapping[str, NDArray[np.generic]]) -> None:
        """Decode the files. Raises `RigFileError` where one is missing."""
        self._bytes = {name: unpack_grey(np.asarray(needed(paint, name), np.uint8)).ravel() for name in RANGES}

    def __getitem__(self, name: str) -> NDArray[np.float32]:
        low, high = RANGES[name]
        values: NDArray[np.float32] = self._bytes[name] * np.float32((high - low) / 255)
        values += np.float32(low)
        return values

    def __iter__(self) -> Iterator[str]:
        return iter(self._bytes)

    def __len__(self) -> int:
        return len(self._bytes)

    def grey(self, name: str) -> NDArray[np.uint8]:
        """Return a layer as it is stored, 0 to 255 from the least to the greatest value."""
        return self._bytes[name]


def pack_grey(grey: NDArray[np.uint8], quality: int) -> NDArray[np.uint8]:
    """Return a (h, w) grey picture as the bytes of a file."""
    buffer = io.BytesIO()
    Image.fromarray(grey).save(buffer, "JPEG", quality=quality, optimize=True)
    return np.frombuffer(buffer.getvalue(), np.uint8)


def unpack_grey(data: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the (h, w) values of a grey picture."""
    with Image.open(io.BytesIO(data.tobytes())) as picture:
        return np.asarray(picture.convert("L"))


def needed(paint: Mapping[str, NDArray[np.generic]], name: str) -> NDArray[np.generic]:
    """Return one of the stored layers.

    Raises:
        RigFileError: it is not there.
    """
    if name not in paint:
        raise RigFileError(f"look: {expected(f'a layer {name!r}', sorted(paint))}")
    return paint[name]


def smooth(t: NDArray[np.floating], low: float, high: float) -> NDArray[np.floating]:
    """Return smoothstep of ``t``: 0 at ``low``, 1 at ``high``, which may be the lower one."""
    s = np.clip((t - np.float32(low)) * np.float32(1 / (high - low)), 0, 1)
    return np.asarray(s * s * (3 - 2 * s))
