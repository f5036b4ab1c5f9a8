"""Noise: in the head's space, so that it knows no seams, and in texels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import gaussian_filter, map_coordinates

if TYPE_CHECKING:
    from numpy.typing import NDArray

_CELLS = 48


def value_noise(place: NDArray[np.float32], frequency: float, seed: int) -> NDArray[np.float32]:
    """Return (M,) smooth noise of mean 0 and deviation about 1, ``frequency`` bumps a unit of ``place``."""
    table = np.random.default_rng([seed, 1]).standard_normal((_CELLS,) * 3).astype(np.float32)
    table = gaussian_filter(table, 0.55, mode="wrap")
    table /= table.std()
    rows = np.asarray(place.T * frequency, np.float32)
    return np.asarray(map_coordinates(table, rows, order=1, mode="grid-wrap"), np.float32) * np.float32(1.25)


def fractal(
    place: NDArray[np.float32],
    amplitudes: dict[float, float],
    seed: int,
    spacing: NDArray[np.float32] | None = None,
) -> NDArray[np.float32]:
    """Return (M,) the sum of noises, frequency -> amplitude.

    With (M,) ``spacing``, the way between texels in units of ``place``, noise that a texel cannot carry is left out:
    it would show as streaks where the texture is stretched.
    """
    total = np.zeros(len(place), np.float32)
    for i, (frequency, amplitude) in enumerate(amplitudes.items()):
        octave = amplitude * value_noise(place, frequency, seed * 100 + i)
        total += octave if spacing is None else octave * np.clip(2 - 4 * frequency * spacing, 0, 1)
    return total


def band_noise(size: int, fine: float, coarse: float, seed: int) -> NDArray[np.float32]:
    """Return (size, size) noise between two scales (in texels of a 2048 texture), deviation 1."""
    white = np.random.default_rng([seed, 2]).standard_normal((size, size), np.float32)
    scale = size / 2048
    band = gaussian_filter(white, fine * scale, mode="wrap") - gaussian_filter(white, coarse * scale, mode="wrap")
    return np.asarray(band / band.std(), np.float32)
