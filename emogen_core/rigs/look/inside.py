"""What lies in the lower right of the skin's texture and is the same for all: mouth, tongue, teeth, eye sockets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.look.atlas import TEETH_A_JAW, teeth_box
from emogen_core.rigs.look.canvas import step
from emogen_core.rigs.look.noise import value_noise

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.look.canvas import Canvas

# Height and width of the corner, as shares of the texture.
CORNER = (208 / 1024, 544 / 1024)
_BAG, _TONGUE, _SOCKET = (np.array(c, np.float32) / 255 for c in ((150, 64, 60), (212, 136, 130), (196, 128, 118)))
_GUM = np.array([0.78, 0.49, 0.46], np.float32)
# Teeth from the front outward: central, lateral, canine, premolars, molar; canines are the yellowest.
_ENAMEL = np.array(
    [
        (0.955, 0.932, 0.898),
        (0.948, 0.923, 0.887),
        (0.932, 0.900, 0.852),
        (0.930, 0.900, 0.855),
        (0.920, 0.888, 0.842),
        (0.910, 0.878, 0.832),
    ],
    np.float32,
)


def paint_inside(canvas: Canvas) -> NDArray[np.float32]:
    """Return (M, 4): colour, and how much it is enamel."""
    out = np.zeros((len(canvas.at), 4), np.float32)
    mouth, tongue, socket = (canvas.is_part(name) for name in ("mouth", "tongue", "sockets"))
    deep = step(canvas.z, 0.20, -0.10)[:, None]
    blotched = (1 + 0.05 * value_noise(canvas.place, 12, 33))[:, None]
    out[mouth, :3] = (_BAG * blotched * (1 - deep * np.array([0.62, 0.72, 0.70])))[mouth]
    out[tongue, :3] = _tongue(canvas)[tongue]
    out[socket, :3] = _SOCKET
    for name in ("teeth_upper", "teeth_lower"):
        chosen = np.flatnonzero(canvas.is_part(name))
        out[chosen] = _teeth(canvas, chosen, name)
    return out


def _tongue(canvas: Canvas) -> NDArray[np.float32]:
    # A soft furrow with a finer one in it.
    groove = 1 - 0.06 * np.exp(-((canvas.x / 0.050) ** 2)) - 0.03 * np.exp(-((canvas.x / 0.012) ** 2))
    buds = 1 + 0.030 * value_noise(canvas.place, 90, 31) + 0.015 * value_noise(canvas.place, 40, 32)
    coated = step(canvas.z, 0.30, -0.05)[:, None] * np.array([0.04, 0.06, 0.05])
    return np.asarray((_TONGUE + coated) * (groove * buds)[:, None], np.float32)


def _teeth(canvas: Canvas, chosen: NDArray[np.intp], name: str) -> NDArray[np.float32]:
    left, bottom, right, top = teeth_box(name)
    u = (canvas.at[chosen] % canvas.size + 0.5) / canvas.size
    v = 1 - (canvas.at[chosen] // canvas.size + 0.5) / canvas.size
    along = (u - left) / (right - left) * TEETH_A_JAW
    tooth, across = np.floor(along), (along - np.floor(along)) * 2 - 1
    down = 2 - (v - bottom) / (top - bottom) * (2 - 0.34)
    half = TEETH_A_JAW // 2
    outward = np.clip(np.where(tooth < half, half - 1 - tooth, tooth - half), 0, half - 1).astype(int)
    enamel = _ENAMEL[outward] * _relief(tooth, across, down)
    back = (1 - 0.50 * ((np.abs(tooth + 0.5 - half) / half) ** 1.6))[:, None]
    line = 0.50 + 0.075 * across**2
    gum = _GUM * (1 - 0.30 * step(down, line - 0.03, line + 0.01))[:, None]
    cover = step(down, line + 0.03, line - 0.015)[:, None]
    return np.concatenate([(enamel + (gum - enamel) * cover) * back, 1 - cover], 1)


def _relief(
    tooth: NDArray[np.floating], across: NDArray[np.floating], down: NDArray[np.floating]
) -> NDArray[np.float32]:
    """Return (n, 3) factors: every tooth a little other, warm roots, clear edges, dark and warm gaps."""
    factor = np.ones((len(down), 3)) * (1 + 0.02 * np.sin(tooth * 7.3 + 2))[:, None]
    factor *= 1 - step(down, 0.86, 0.50)[:, None] * (0.015, 0.045, 0.075)
    # The cutting edge lets light through: a little darker and greyer, never blue.
    factor *= 1 - (step(down, 0.88, 0.99) * step(down, 1.4, 1.1))[:, None] * (0.045, 0.045, 0.035)
    factor *= 1 + 0.03 * (np.exp(-(((np.abs(across) - 0.42) / 0.16) ** 2)) * step(down, 1.1, 0.7))[:, None]
    gap = step(np.abs(across), 0.76, 1.0)[:, None] ** 1.8
    return np.asarray(factor * (1 - gap * (0.17, 0.24, 0.28)), np.float32)
