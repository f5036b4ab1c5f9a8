"""Painting one identity's skin: tone, blood, melanin, lips, hair, mouth and teeth.

Colours are laid down as light would see them: the tone, thinned by pigments, ``tone * exp(-(h H + m M + y Y))``, in
gamma 2, which the shader squares.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import gaussian_filter

from emogen_core.rigs.look.atlas import teeth_box
from emogen_core.rigs.look.canvas import step
from emogen_core.rigs.look.noise import value_noise
from emogen_core.rigs.look.strokes import brow_hairs, scalp_hairs, stubble

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas
    from emogen_core.rigs.look.presets import Preset
    from emogen_core.rigs.look.zones import Zones

# How strongly blood, melanin and yellow swallow red, green and blue.
_BLOOD = np.array([0.14, 0.56, 0.46], np.float32)
_MELANIN = np.array([0.42, 0.66, 0.92], np.float32)
_YELLOW = np.array([0.01, 0.045, 0.25], np.float32)
_STUBBLE_HAIRS = 26_000
_HEAD_BOX = (0.0, 0.2, 1.0, 1.0)


def paint_skin(canvas: Canvas, zones: Zones, preset: Preset) -> NDArray[np.uint8]:
    """Return the (size, size, 3) uint8 albedo of one identity."""
    colour = _tone(zones, preset)
    colour = _over(colour, _lip_colour(zones, preset), zones.lips * (0.80 if preset.deep else 0.86))
    colour = _lids(colour, zones, preset)
    if preset.male:
        colour *= _beard(canvas, zones, preset)
    colour = _scalp(colour, canvas, zones, preset)
    colour = _brows(colour, canvas, preset)
    colour = colour * zones.cavity[:, None] ** np.array([0.50, 0.74, 0.78], np.float32)
    colour = _inside(colour, canvas)
    return np.asarray(np.round(canvas.to_image(colour.clip(0, 1)) * 255), np.uint8)


def mean_tone(canvas: Canvas, picture: NDArray[np.uint8]) -> tuple[float, float, float]:
    """Return the mean colour of the cheeks, 0 to 1."""
    cheeks = canvas.spot(0.35, -0.35, 0.15, 0.15) > 0.5
    red, green, blue = picture.reshape(-1, 3)[canvas.at[cheeks]].mean(0) / 255
    return round(float(red), 4), round(float(green), 4), round(float(blue), 4)


def _rgb(colour: tuple[int, int, int]) -> NDArray[np.float32]:
    return np.divide(colour, 255, dtype=np.float32)


def _over(below: NDArray[np.float32], above: NDArray[np.float32], cover: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(below + (above - below) * cover[:, None], np.float32)


def _tone(zones: Zones, preset: Preset) -> NDArray[np.float32]:
    blood = (zones.blood + zones.mottle + 0.10 * zones.under_eye) * (0.70 if preset.deep else 1.0)
    melanin = zones.melanin + 0.09 * zones.under_eye
    if preset.old:
        melanin = melanin + 0.30 * zones.spots + 0.04 * zones.under_eye
        blood = blood + 0.04 * np.abs(zones.mottle) * 4
    if preset.ancestry == "caucasian":
        melanin = melanin + zones.freckles * (0.42 if preset.sex == "female" else 0.20)
    melanin = melanin * (0.65 if preset.deep else 1.0)
    fade = blood[:, None] * _BLOOD + melanin[:, None] * _MELANIN + zones.yellow[:, None] * _YELLOW
    pores = 1 + (0.060 if preset.deep else 0.052) * zones.pores
    return np.asarray(_rgb(preset.tone) * np.exp(-fade) * pores[:, None], np.float32)


def _lip_colour(zones: Zones, preset: Preset) -> NDArray[np.float32]:
    # Light comes from above and would make the upper lip maroon.
    lines = 1 + 0.035 * np.clip(zones.lip_lines, -2.5, 1.5)
    return np.asarray(_rgb(preset.lips) * lines[:, None] * (1 + 1.2 * zones.mottle[:, None]), np.float32)


def _lids(colour: NDArray[np.float32], zones: Zones, preset: Preset) -> NDArray[np.float32]:
    pink = np.array([208, 140, 128], np.float32) / 255 * (0.72 if preset.deep else 1.0)
    wet = np.maximum(0.55 * zones.lid_rim, 0.9 * zones.caruncle)
    colour = _over(colour, np.broadcast_to(pink, colour.shape), wet)
    lashes = _rgb(preset.brow) * (0.8 if not preset.old else 0.6)
    strength = zones.lash_line * (0.62 if preset.male or preset.old else 0.85)
    return _over(colour, np.broadcast_to(lashes, colour.shape), strength)


def _beard(canvas: Canvas, zones: Zones, preset: Preset) -> NDArray[np.float32]:
    """Return (M, 3) factors: a bluish shadow, and the ends of shaven hairs."""
    cover = zones.beard * (0.40 if preset.deep else 0.62 if preset.ancestry == "asian" else 1.0)
    rng = np.random.default_rng(17)
    rooted = rng.choice(len(canvas.at), _STUBBLE_HAIRS, p=zones.beard / zones.beard.sum())
    spot = canvas.at[rooted]
    uv = np.column_stack([spot % canvas.size + 0.5, canvas.size - spot // canvas.size - 0.5]) / canvas.size
    hairs = canvas.from_image(stubble(canvas.size, uv, 1))
    shadow = np.array([0.120, 0.094, 0.070], np.float32) * (0.6 if preset.old else 1.0)
    dark = np.array([0.22, 0.22, 0.20], np.float32) * (-0.35 if preset.old else 1.0)
    return np.asarray(1 - cover[:, None] * shadow - (cover * hairs)[:, None] * dark, np.float32)


def _scalp(colour: NDArray[np.float32], canvas: Canvas, zones: Zones, preset: Preset) -> NDArray[np.float32]:
    cropped = preset.male or preset.old
    detail = canvas.from_image(scalp_hairs(canvas.size, _HEAD_BOX, (4, 11) if cropped else (14, 40), int(cropped)))
    patchy = 0.5 + 0.10 * value_noise(canvas.place, 9, 21) + 0.08 * value_noise(canvas.place, 40, 22)
    strand = np.clip(1 + 1.5 * (detail - 0.5) + 0.5 * (patchy - 0.5), 0.35, 1.7)
    hair = _rgb(preset.hair) * strand[:, None]
    grown = zones.receding if preset.old and preset.male else zones.hair
    # Towards its edge the hair thins out hair by hair, not as a veil.
    ragged = step(grown + 3.6 * (detail - 0.5) * grown * (1 - grown), 0.30, 0.70)
    amount = ragged * (0.55 if preset.old and preset.male else 0.86 if cropped else 0.97)
    # Between cropped hairs the scalp shows.
    thin = np.clip(1 - (0.55 if cropped else 0.10) * np.clip(detail - 0.42, 0, 0.4) / 0.4, 0, 1)
    return _over(colour, np.asarray(hair, np.float32), np.asarray(amount * thin, np.float32))


def _brows(colour: NDArray[np.float32], canvas: Canvas, preset: Preset) -> NDArray[np.float32]:
    cover, shade = brow_hairs(canvas, preset)
    soft = canvas.from_image(gaussian_filter(cover, 5 * canvas.size / 2048))
    hair = _rgb(preset.brow) * (1 + (0.22 if preset.old else 0.30) * canvas.from_image(shade))[:, None]
    under = 0.24 if preset.old else 0.34
    colour = _over(colour, np.broadcast_to(_rgb(preset.brow), colour.shape), np.clip(soft * under, 0, 1))
    return _over(colour, np.asarray(hair, np.float32), 0.76 * canvas.from_image(cover))


def _inside(colour: NDArray[np.float32], canvas: Canvas) -> NDArray[np.float32]:
    mouth, tongue, socket = (canvas.is_part(name) for name in ("mouth", "tongue", "sockets"))
    deep = step(canvas.z, 0.18, -0.12)
    bag = np.array([152, 66, 62], np.float32) / 255 * (1 - 0.65 * deep[:, None])
    colour[mouth] = bag[mouth]
    groove = 1 - 0.28 * np.exp(-((canvas.x / 0.016) ** 2))
    bumps = 1 + 0.06 * value_noise(canvas.place, 90, 31) + 0.05 * value_noise(canvas.place, 40, 32)
    colour[tongue] = (np.array([188, 108, 104], np.float32) / 255 * (groove * bumps)[:, None])[tongue]
    colour[socket] = colour[socket] * 0.35 + np.array([205, 140, 130], np.float32) / 255 * 0.62
    for name in ("teeth_upper", "teeth_lower"):
        _teeth(colour, canvas, name)
    return colour


def _teeth(colour: NDArray[np.float32], canvas: Canvas, name: str) -> None:
    chosen = np.flatnonzero(canvas.is_part(name))
    left, bottom, right, top = teeth_box(name)
    u = (canvas.at[chosen] % canvas.size + 0.5) / canvas.size
    v = 1 - (canvas.at[chosen] // canvas.size + 0.5) / canvas.size
    along = (u - left) / (right - left) * 12
    tooth, across = np.floor(along), (along - np.floor(along)) * 2 - 1
    down = 2 - (v - bottom) / (top - bottom) * (2 - 0.34)
    far = np.abs(tooth + 0.5 - 6) / 6
    shade = 1 + 0.035 * np.sin(tooth * 7.3 + 2)
    enamel = np.stack([0.945 * shade, 0.915 * shade, 0.835 * shade], 1)
    root = step(down, 0.74, 0.52)[:, None]
    enamel *= 1 - root * (0.05, 0.09, 0.17)
    edge = (step(down, 0.90, 0.99) * step(down, 1.4, 1.1))[:, None]
    enamel *= 1 - edge * (0.10, 0.07, 0.03)
    enamel *= 1 - 0.46 * (step(np.abs(across), 0.72, 1.0) ** 1.5)[:, None] * (0.80, 0.95, 1.0)
    enamel *= (1 - 0.52 * far**1.6)[:, None]
    gum = np.array([0.74, 0.43, 0.42]) * (1 - 0.45 * far**1.6)[:, None]
    line = 0.50 + 0.07 * across**2
    cover = step(down, line + 0.025, line - 0.02)[:, None]
    colour[chosen] = enamel + (gum - enamel) * cover
