"""Everything about the skin that all identities share: where blood, melanin and hair are, and the skin's fine grain."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import gaussian_filter

from emogen_core.rigs.look.canvas import step
from emogen_core.rigs.look.hair import hair_cover
from emogen_core.rigs.look.noise import band_noise, fractal, value_noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas


@dataclass(frozen=True)
class Zones:
    """(M,) fields over the texels of a canvas; see `make_zones`."""

    blood: NDArray[np.float32]
    mottle: NDArray[np.float32]
    melanin: NDArray[np.float32]
    yellow: NDArray[np.float32]
    under_eye: NDArray[np.float32]
    pores: NDArray[np.float32]
    freckles: NDArray[np.float32]
    spots: NDArray[np.float32]
    lips: NDArray[np.float32]
    lip_lines: NDArray[np.float32]
    ears: NDArray[np.float32]
    hair: NDArray[np.float32]
    receding: NDArray[np.float32]
    beard: NDArray[np.float32]
    lash_line: NDArray[np.float32]
    lid_rim: NDArray[np.float32]
    caruncle: NDArray[np.float32]
    cavity: NDArray[np.float32]


def make_zones(
    canvas: Canvas,
    lips: NDArray[np.float32],
    ears: NDArray[np.float32],
    rim: NDArray[np.float32],
    occlusion: NDArray[np.float32],
) -> Zones:
    """Lay out the zones.

    Args:
        canvas: the texels.
        lips: MakeHuman's mask of the lips, in base.obj's layout.
        ears: its mask of the ears.
        rim: (M,) distance to the edge of the lids, decimetres.
        occlusion: (M,) how open the place is to light, of the neutral base head.
    """
    ear = canvas.sample(ears) * canvas.is_part("skin")
    mouth = _lips(canvas, lips)
    pores = _image(canvas, np.minimum(band_noise(canvas.size, 1.3, 2.8, 1), 0.5))
    freckle = np.clip(_image(canvas, band_noise(canvas.size, 2.6, 6.5, 2)) - 1.55, 0, 1)
    grain = _image(canvas, gaussian_filter(band_noise(canvas.size, 1.4, 30, 3), (9 * canvas.size / 2048, 0)))
    return Zones(
        blood=_blood(canvas, ear),
        mottle=fractal(canvas.place, {5: 0.016, 13: 0.020, 31: 0.024, 80: 0.020}, 4),
        melanin=fractal(canvas.place, {6: 0.010, 17: 0.014, 47: 0.016, 90: 0.014}, 5),
        yellow=0.05 * canvas.spot(0.0, 0.50, 0.42, 0.20) + fractal(canvas.place, {4: 0.01, 12: 0.01}, 6),
        under_eye=canvas.spot(0.27, -0.155, 0.15, 0.055),
        pores=pores * step(canvas.y, -1.35, -1.05),
        freckles=freckle * (canvas.spot(0.24, -0.26, 0.30, 0.17) + 0.6 * canvas.spot(0.0, -0.22, 0.10, 0.18)),
        spots=_age_spots(canvas),
        lips=mouth,
        lip_lines=grain / max(float(grain.std()), 1e-6),
        ears=ear,
        hair=hair_cover(canvas.place, ear) * canvas.is_part("skin"),
        receding=hair_cover(canvas.place, ear, 0.30) * canvas.is_part("skin"),
        beard=_beard(canvas) * (1 - mouth),
        lash_line=np.exp(-((rim / 0.012) ** 2)) * canvas.is_part("skin"),
        lid_rim=np.exp(-((rim / 0.022) ** 2)),
        caruncle=np.exp(-(((np.abs(canvas.x) - 0.204) / 0.014) ** 2 + ((canvas.y + 0.012) / 0.018) ** 2))
        * step(canvas.z, 0.04, 0.08),
        cavity=np.clip(occlusion / 0.36, 0.02, 1).astype(np.float32),
    )


def _image(canvas: Canvas, image: NDArray[np.float32]) -> NDArray[np.float32]:
    return canvas.from_image(np.asarray(image, np.float32))


def _blood(canvas: Canvas, ear: NDArray[np.float32]) -> NDArray[np.float32]:
    """Where skin is redder: cheeks, nose and wings, ears, chin, lids; the forehead is paler."""
    spots = (
        (0.20, 0.40, -0.27, 0.21, 0.17), (0.22, 0.0, -0.385, 0.13, 0.11), (0.22, 0.15, -0.43, 0.06, 0.06),
        (0.14, 0.0, -0.93, 0.20, 0.13), (0.12, 0.30, 0.06, 0.17, 0.06), (0.09, 0.27, -0.15, 0.15, 0.06),
        (-0.10, 0.0, 0.50, 0.45, 0.20),
    )  # fmt: skip
    total = 0.18 * ear
    for amount, *where in spots:
        total = total + amount * canvas.spot(*where)
    return np.asarray(total, np.float32)


def _lips(canvas: Canvas, mask: NDArray[np.float32]) -> NDArray[np.float32]:
    soft = gaussian_filter(mask, 3.0)
    edge = canvas.sample(soft) + 0.05 * value_noise(canvas.place, 60, 8)
    return np.asarray(step(edge, 0.22, 0.70) * canvas.is_part("skin"), np.float32)


def _beard(canvas: Canvas) -> NDArray[np.float32]:
    x, y = np.abs(canvas.x), canvas.y
    jaw = step(y, -0.30, -0.75) * step(y, -1.27, -1.06) * step(canvas.z, -0.75, -0.45)
    cheek = step(0.42 - 0.75 * (y + 0.62) - x, 0.25, -0.15) * step(y, -0.45, -0.62)
    chin = np.exp(-((x / 0.30) ** 2 + ((y + 0.98) / 0.22) ** 2))
    lip = np.exp(-((x / 0.27) ** 2 + ((y + 0.535) / 0.055) ** 2))
    cover = np.maximum(np.maximum(jaw * np.maximum(step(y, -0.86, -1.02), cheek), chin), 0.85 * lip)
    noisy = cover * (1 + 0.15 * value_noise(canvas.place, 9, 10))
    return np.asarray(np.clip(noisy, 0, 1) * canvas.is_part("skin"), np.float32)


def _age_spots(canvas: Canvas) -> NDArray[np.float32]:
    noise = value_noise(canvas.place, 13, 12) + 0.5 * value_noise(canvas.place, 30, 13)
    face = step(canvas.y, -1.0, -0.7) * (1 - canvas.spot(0, 0.45, 0.30, 0.25))
    spots = step(noise, 1.9, 3.0) * face
    return np.asarray(spots, np.float32)
