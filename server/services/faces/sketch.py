"""What a face is between the search and the drawing: weights, as they are computed and as they are stored."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.protocol import SURROUND_DARK, SURROUND_LIGHT, RenderSettings

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..config import StudyConfig


@dataclass(frozen=True, slots=True)
class Sketch:
    """A face that may be drawn: everything that its portrait depends on."""

    identity: str
    weights: NDArray[np.float32]
    settings: RenderSettings


def settings_of(config: StudyConfig) -> RenderSettings:
    """Return size and background of a study's portraits."""
    background = SURROUND_LIGHT if config.surround == "light" else SURROUND_DARK
    return RenderSettings(config.portrait.width, config.portrait.height, background)


def pack_genes(genes: NDArray[np.float64]) -> bytes:
    """Return genes as stored: float64, little-endian, so that a replay can be compared bit for bit."""
    return genes.astype("<f8").tobytes()


def pack_weights(weights: NDArray[np.float32]) -> bytes:
    """Return weights as stored: float32, little-endian."""
    return weights.astype("<f4").tobytes()


def unpack_genes(data: bytes) -> NDArray[np.float64]:
    """Return stored genes."""
    return np.frombuffer(data, "<f8").astype(np.float64)


def unpack_weights(data: bytes) -> NDArray[np.float32]:
    """Return stored weights."""
    return np.frombuffer(data, "<f4").astype(np.float32)
