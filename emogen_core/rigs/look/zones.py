"""Everything about the skin that all heads share: where blood, melanin and hair are, and the skin's fine grain.

Fields are (M,) over the texels of a canvas and named as the composer's layers (`RANGES`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import gaussian_filter

from emogen_core.rigs.look.canvas import step
from emogen_core.rigs.look.noise import band_noise, fractal, value_noise

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas

# (amount, x, y, rx, ry): cheeks, nose and wings, chin, lids, inner corners; the forehead and round the mouth are paler.
_REDDER = (
    (0.17, 0.40, -0.28, 0.20, 0.17), (0.20, 0.0, -0.385, 0.12, 0.11), (0.20, 0.15, -0.43, 0.06, 0.06),
    (0.13, 0.0, -0.93, 0.18, 0.12), (0.06, 0.30, 0.06, 0.17, 0.06), (0.09, 0.22, -0.10, 0.12, 0.06),
    (-0.09, 0.0, 0.50, 0.45, 0.20), (-0.05, 0.30, -0.62, 0.12, 0.10),
)  # fmt: skip
# Where pores are widest: nose, inner cheeks, forehead, chin.
_PORED = ((0.9, 0.0, -0.34, 0.15, 0.14), (0.75, 0.26, -0.30, 0.18, 0.16), (0.45, 0.0, 0.42, 0.35, 0.20),
          (0.6, 0.0, -0.93, 0.20, 0.12))  # fmt: skip


def skin_fields(
    canvas: Canvas,
    lips: NDArray[np.float32],
    ears: NDArray[np.float32],
    lids: NDArray[np.float32],
    occlusion: NDArray[np.float32],
) -> Mapping[str, NDArray[np.float32]]:
    """Lay out the skin.

    Args:
        canvas: the texels.
        lips: MakeHuman's mask of the lips, in base.obj's layout.
        ears: its mask of the ears.
        lids: (3, M) distance to the inner edge of the lids, to the roots of upper and of lower lashes, decimetres.
        occlusion: (M,) how open the place is to light, of the neutral base head.
    """
    place, fine = canvas.place, canvas.spacing
    ear = canvas.sample(ears) * canvas.is_part("skin")
    mouth = _lips(canvas, lips)
    # Below the chin the skin of other heads is stretched, and so would blotches be.
    even = 0.35 + 0.65 * step(canvas.y, -1.35, -0.95)
    fields = {
        "blood": 0.17 * ear + _spots(canvas, _REDDER),
        "mottle": even * fractal(place, {5: 0.020, 13: 0.016, 31: 0.011, 75: 0.012}, 4, fine),
        "melanin": even * fractal(place, {6: 0.010, 17: 0.010, 47: 0.007, 90: 0.006}, 5, fine),
        "yellow": 0.05 * canvas.spot(0.0, 0.50, 0.42, 0.20) + even * fractal(place, {4: 0.010, 12: 0.008}, 6, fine),
        "mask": _mask(canvas),
        "under_eye": canvas.spot(0.26, -0.150, 0.14, 0.050),
        "pores": _pores(canvas) * (1 - mouth),
        "lip_lines": _lip_lines(canvas),
        "freckles": _freckles(canvas),
        "spots": _age_spots(canvas),
        "capillaries": _capillaries(canvas),
        "lips": mouth,
        "wet": _wet(canvas, lids),
        "lash_line": _lash_line(canvas, lids),
        "cavity": _cavity(canvas, lids, occlusion),
        "beard": _beard(canvas) * (1 - mouth),
    }
    return {name: np.asarray(values, np.float32) for name, values in fields.items()}


def _spots(canvas: Canvas, spots: tuple[tuple[float, ...], ...]) -> NDArray[np.float32]:
    return np.asarray(np.sum([amount * canvas.spot(*where) for amount, *where in spots], axis=0), np.float32)


def _image(canvas: Canvas, image: NDArray[np.floating]) -> NDArray[np.float32]:
    return canvas.from_image(np.asarray(image, np.float32))


def _mask(canvas: Canvas) -> NDArray[np.float32]:
    """Deep skin is darkest on the forehead's sides, round the eyes and the mouth, and on the neck."""
    spots = ((0.55, 0.42, 0.42, 0.22, 0.22), (0.48, 0.29, 0.02, 0.20, 0.13), (0.75, 0.0, -0.66, 0.34, 0.20),
             (-0.4, 0.36, -0.28, 0.16, 0.13))  # fmt: skip
    cloudy = 0.35 + _spots(canvas, spots) + 0.12 * value_noise(canvas.place, 7, 51)
    return np.asarray(np.clip(cloudy + 0.3 * step(canvas.y, -1.0, -1.4), 0, 1), np.float32)


def _pores(canvas: Canvas) -> NDArray[np.float32]:
    """Return pits (negative) between fine raised skin, widest on nose and cheeks."""
    pits = _image(canvas, band_noise(canvas.size, 1.3, 3.0, 1)) + 0.6 * _image(
        canvas, band_noise(canvas.size, 2.2, 5.0, 16)
    )
    pits = np.where(pits > 0, 0.40 * pits, pits)
    wide = np.clip(0.45 + _spots(canvas, _PORED), 0, 1.1)
    # Where texels are large pores would be, too;
    # and where they are drawn out, as at the temples, pores would be streaks.
    carried = step(canvas.spacing, 0.0050, 0.0032) * step(canvas.stretch, 2.6, 1.5)
    return np.asarray(np.clip(0.40 * pits * wide * carried, -1, 0.6) * canvas.is_part("skin"), np.float32)


def _freckles(canvas: Canvas) -> NDArray[np.float32]:
    dots = np.clip(_image(canvas, band_noise(canvas.size, 2.6, 6.5, 2)) - 1.45, 0, 1.2) / 1.2
    more = np.clip(_image(canvas, band_noise(canvas.size, 3.6, 9.0, 15)) - 1.75, 0, 1)
    where = canvas.spot(0.24, -0.24, 0.32, 0.19) + 0.6 * canvas.spot(0.0, -0.22, 0.12, 0.20)
    where = where + 0.35 * canvas.spot(0.0, 0.42, 0.45, 0.25)
    return np.asarray((dots + more) * np.clip(where, 0, 1), np.float32)


def _age_spots(canvas: Canvas) -> NDArray[np.float32]:
    noise = value_noise(canvas.place, 11, 12) + 0.5 * value_noise(canvas.place, 30, 13)
    face = (
        step(canvas.y, -1.0, -0.7) * (1 - 0.8 * canvas.spot(0, 0.35, 0.30, 0.25)) * (1 - canvas.spot(0, -0.6, 0.3, 0.2))
    )
    return np.asarray(step(noise, 1.75, 2.9) * face, np.float32)


def _capillaries(canvas: Canvas) -> NDArray[np.float32]:
    """Small red veins: where smooth noise crosses zero, on wings and cheeks."""
    threads = np.exp(-((value_noise(canvas.place, 24, 61) / 0.11) ** 2)) * step(
        value_noise(canvas.place, 9, 62), 0.1, 1
    )
    where = canvas.spot(0.34, -0.30, 0.16, 0.12) + canvas.spot(0.13, -0.42, 0.06, 0.07)
    return np.asarray(threads * np.clip(where, 0, 1), np.float32)


def _lip_lines(canvas: Canvas) -> NDArray[np.float32]:
    scale = canvas.size / 2048
    grain = gaussian_filter(band_noise(canvas.size, 1.6, 30, 3), (11 * scale, 0))
    lines = _image(canvas, grain)
    return np.asarray(np.clip(lines / max(float(lines.std()), 1e-6), -2, 1.4), np.float32)


def _lips(canvas: Canvas, mask: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the red of the lips: full inside, running out over a millimetre."""
    soft = canvas.sample(gaussian_filter(mask, 5.0 * mask.shape[0] / 2048))
    edge = soft + 0.045 * value_noise(canvas.place, 45, 8)
    return np.asarray(step(edge, 0.24, 0.82) * canvas.is_part("skin"), np.float32)


def _cavity(canvas: Canvas, lids: NDArray[np.float32], occlusion: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return how open a place is: dark in folds, ears and, most of all, nostrils and the creases of their wings."""
    open_ = np.clip(occlusion / (0.36 + 0.26 * canvas.spot(0.09, -0.46, 0.11, 0.065)), 0.02, 1)
    # The eyeball hides the lids' edges from the sky, but a viewer looks at them.
    return np.asarray(np.maximum(open_, 0.85 * step(lids.min(0), 0.06, 0.03)), np.float32)


def _wet(canvas: Canvas, lids: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the moist edge between lashes and eyeball, and the corner of the eye."""
    rim, _, lower = lids
    corner = np.exp(-(((np.abs(canvas.x) - 0.204) / 0.017) ** 2 + ((canvas.y + 0.012) / 0.022) ** 2))
    edge = np.maximum(0.80 * np.exp(-((rim / 0.017) ** 2)), 0.60 * np.exp(-((lower / 0.024) ** 2)))
    return np.asarray(np.maximum(edge, corner * step(canvas.z, 0.04, 0.08)), np.float32)


def _lash_line(canvas: Canvas, lids: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the dark of the lashes' roots: dense above, loose below.

    Roots lie a little inside the edge that is seen, so the line is drawn wider than it looks.
    """
    _, upper, lower = lids
    line = np.maximum(np.exp(-((upper / 0.029) ** 2)), 0.30 * np.exp(-((lower / 0.020) ** 2)))
    return np.asarray(line * step(np.abs(canvas.x), 0.205, 0.245) * canvas.is_part("skin"), np.float32)


def _beard(canvas: Canvas) -> NDArray[np.float32]:
    x, y = np.abs(canvas.x), canvas.y
    jaw = step(y, -0.30, -0.75) * step(y, -1.27, -1.06) * step(canvas.z, -0.75, -0.45)
    cheek = step(0.42 - 0.75 * (y + 0.62) - x, 0.25, -0.15) * step(y, -0.45, -0.62)
    chin = np.exp(-((x / 0.30) ** 2 + ((y + 0.98) / 0.22) ** 2))
    lip = np.exp(-((x / 0.27) ** 2 + ((y + 0.535) / 0.055) ** 2))
    # Below the corners of the mouth it is thin.
    bare = 1 - 0.55 * np.exp(-(((x - 0.20) / 0.07) ** 2 + ((y + 0.80) / 0.07) ** 2))
    cover = np.maximum(np.maximum(jaw * np.maximum(step(y, -0.86, -1.02), cheek), chin), 0.85 * lip) * bare
    noisy = cover * (1 + 0.15 * value_noise(canvas.place, 9, 10))
    return np.asarray(np.clip(noisy, 0, 1) * canvas.is_part("skin"), np.float32)
