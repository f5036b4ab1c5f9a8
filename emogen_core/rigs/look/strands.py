"""Combed and coiled hair as grey pictures: noise smeared along the way that hair is combed.

Line integral convolution (Cabral and Leedom 1993, doi:10.1145/166117.166151): every texel takes the mean of white noise
along the streamline through it. We smear three noises, single hairs, strands and locks, and add them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import gaussian_filter

from emogen_core.rigs.look.canvas import step
from emogen_core.rigs.look.hair import combing
from emogen_core.rigs.look.noise import band_noise, fractal

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas

# Blur of the noise and steps each way (both in texels of a 1024 texture), weight.
_SCALES = ((0.35, 16, 0.52), (1.5, 26, 0.42), (4.0, 34, 0.34))
_KEY = np.array([-0.62, 0.62, 1.0]) / np.linalg.norm([-0.62, 0.62, 1.0])
_SPREAD = 0.17


def strands(canvas: Canvas, size: int, hair: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Return (size, size) in [0, 1], mean about a half: combed hair, light along the middle of strands.

    Only where (size, size) ``hair`` says so; elsewhere a half.
    """
    finer = canvas.size // size
    flow = _flow(canvas)[finer // 2 :: finer, finer // 2 :: finer]
    at = np.stack(np.nonzero(hair)).astype(np.float32)
    total = np.zeros(at.shape[1], np.float32)
    for number, (blur, reach, weight) in enumerate(_SCALES):
        white = np.random.default_rng([11, number]).standard_normal(hair.shape, np.float32)
        noise = gaussian_filter(white, blur * size / 1024, mode="wrap")
        smeared = _smeared(noise / noise.std(), flow, at, round(reach * size / 1024))
        total += weight * smeared / smeared.std()
    image = np.full(hair.shape, 0.5, np.float32)
    image[hair] = np.clip(0.5 + _SPREAD * total, 0, 1)
    return image


def coils(canvas: Canvas) -> NDArray[np.float32]:
    """Return (M,) in [0, 1]: tightly coiled hair, soft grains and winding threads of light over dark gaps.

    Threads run where smooth noise crosses zero, so they close into coils.
    """
    threads, grains, tufts = (
        canvas.from_image(band_noise(canvas.size, fine, coarse, seed))
        for fine, coarse, seed in ((2.0, 4.5, 81), (2.2, 6.0, 84), (5.0, 12.0, 82))
    )
    wound = np.exp(-((threads / 0.6) ** 2)) - 0.5
    clumps = fractal(canvas.place, {8: 0.04, 21: 0.05}, 83, canvas.spacing)
    return np.asarray(np.clip(0.5 + 0.14 * wound + 0.075 * grains + 0.07 * tufts + clumps, 0, 1), np.float32)


def sheen(canvas: Canvas) -> NDArray[np.float32]:
    """Return (M,) in [0, 1]: where combed hair mirrors the key light, as bands across the strands.

    Kajiya and Kay 1989 (doi:10.1145/74334.74361): ``sin(T, H)^p`` of the strand ``T`` and the half vector ``H``.
    """
    half = _KEY + np.array([0, 0, 1.0])
    half /= np.linalg.norm(half)
    along = combing(canvas.place, canvas.normal) @ half
    facing = step(canvas.normal @ half, 0.0, 0.6)
    return np.asarray(np.clip(1 - along**2, 0, 1) ** 14 * facing, np.float32)


def _flow(canvas: Canvas) -> NDArray[np.float32]:
    """Return (size, size, 2) unit steps (row, column) along the combing, from how places change over the texture."""
    place = canvas.to_image(canvas.place)
    wish = canvas.to_image(combing(canvas.place, canvas.normal))
    down, right = np.gradient(place, axis=0), np.gradient(place, axis=1)
    a, b, c = (np.einsum("ijk,ijk->ij", m, n) for m, n in ((down, down), (down, right), (right, right)))
    p, q = (np.einsum("ijk,ijk->ij", m, wish) for m in (down, right))
    step_to = np.stack([c * p - b * q, a * q - b * p], -1)
    length = np.linalg.norm(step_to, axis=-1, keepdims=True)
    return np.asarray(step_to / np.maximum(length, 1e-20), np.float32)


def _smeared(
    noise: NDArray[np.float32], flow: NDArray[np.float32], start: NDArray[np.float32], reach: int
) -> NDArray[np.float32]:
    """Return (n,) the mean of the noise along ``reach`` steps of the flow either way from (2, n) places."""
    total = np.zeros(start.shape[1], np.float32)
    for way in (1, -1):
        at = start.copy()
        for _ in range(reach):
            row, column = np.clip(np.round(at), 0, len(noise) - 1).astype(np.intp)
            total += noise[row, column]
            at += way * flow[row, column].T
    return total / np.float32(2 * reach)
