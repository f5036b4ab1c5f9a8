"""The skin's colour: a tone thinned by pigments, ``tone * exp(-(h H + m M + y Y))``, then lips, lids and beard.

Colours are (M, 3) float32 in gamma 2, which the shader squares; ``h, m, y`` are amounts of blood, melanin and yellow
at a texel, ``H, M, Y`` what they swallow of red, green and blue.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.composer.layers import smooth
from emogen_core.rendering.composer.tones import BLOOD, MELANIN, YELLOW, skin_tone

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.appearance import Appearance

GREY = np.array([178, 173, 166], np.float32) / 255
GREY_BROW = np.array([152, 142, 130], np.float32) / 255
_PINK = np.array([196, 132, 120], np.float32) / 255


def rgb(colour: tuple[int, int, int]) -> NDArray[np.float32]:
    """Return an sRGB colour in [0, 1]."""
    return np.divide(colour, 255, dtype=np.float32)


def over(below: NDArray[np.float32], above: NDArray[np.float32], cover: NDArray[np.floating]) -> None:
    """Lay ``above``, (M, 3) or (3,), over ``below`` in place, as far as (M,) ``cover`` says."""
    below += (above - below) * np.asarray(cover, np.float32)[:, None]


def deepness(look: Appearance) -> float:
    """Return how far skin is deep, 0 to 1: blood shows less, melanin varies more, pores show by their shine."""
    return float(smooth(np.array(look.skin_depth), 0.30, 0.80))


def bare_skin(fields: Mapping[str, NDArray[np.float32]], look: Appearance) -> NDArray[np.float32]:
    """Return the (M, 3) colour of skin without lips, lids and hair."""
    deep = deepness(look)
    red = 0.35 + 1.30 * look.redness
    blood = fields["blood"] * red + fields["mottle"] * (0.6 + 0.8 * look.redness)
    blood += fields["under_eye"] * 0.10 + fields["capillaries"] * (0.55 * look.spots)
    blood *= 1 - 0.35 * deep
    melanin = fields["melanin"] * (1 + 0.5 * look.spots) + fields["freckles"] * (0.85 * look.freckles)
    melanin += fields["spots"] * (0.26 * look.spots) + fields["under_eye"] * (0.06 + 0.05 * look.lines)
    melanin *= 1 - 0.30 * deep
    melanin += fields["mask"] * (0.15 * deep)
    tone = skin_tone(look.skin_depth, look.undertone)
    pores = 1 + fields["pores"] * np.float32(0.085 + 0.055 * deep + 0.02 * look.lines)
    colour = np.empty((len(blood), 3), np.float32)
    for channel in range(3):
        fade = BLOOD[channel] * blood + MELANIN[channel] * melanin + YELLOW[channel] * fields["yellow"]
        colour[:, channel] = tone[channel] * np.exp(-fade) * pores
    return colour


def lay_lips(colour: NDArray[np.float32], fields: Mapping[str, NDArray[np.float32]], look: Appearance) -> None:
    """Paint the lips, with lines across and a border that fades into the skin."""
    at = np.flatnonzero(fields["lips"] > 0.01)
    cover = fields["lips"][at]
    lines = 1 + 0.026 * fields["lip_lines"][at] + 1.1 * fields["mottle"][at]
    # Lips are the skin's own colour with more blood: half of the wanted colour comes through the skin.
    own = colour[at] * np.exp(-0.30 * BLOOD)
    wanted = 0.82 * rgb(look.lip_colour) + 0.18 * own
    lips = wanted * lines[:, None] * (1.03 - 0.10 * cover**3)[:, None]
    part = colour[at]
    over(part, np.asarray(lips, np.float32), 0.90 * cover)
    colour[at] = part


def lay_lids(colour: NDArray[np.float32], fields: Mapping[str, NDArray[np.float32]], look: Appearance) -> None:
    """Paint the wet rims, and the line where the lashes grow."""
    at = np.flatnonzero((fields["wet"] > 0.01) | (fields["lash_line"] > 0.01))
    part = colour[at]
    pink = np.asarray(_PINK * (1 - 0.34 * deepness(look)), np.float32)
    over(part, pink, 0.72 * fields["wet"][at])
    dark = np.float32(0.75) * mixed_grey(look.brow_colour, 0.5 * look.grey)
    over(part, dark, fields["lash_line"][at] * (0.45 + 0.45 * look.lashes))
    colour[at] = part


def lay_beard(colour: NDArray[np.float32], fields: Mapping[str, NDArray[np.float32]], look: Appearance) -> None:
    """Paint the shadow of a shaven beard and the ends of its hairs."""
    if not look.stubble:
        return
    at = np.flatnonzero(fields["beard"] > 0.01)
    cover, hairs = fields["beard"][at] * look.stubble, fields["stubble"][at]
    part = colour[at]
    # Hair under light skin looks bluish: it swallows red most.
    part *= 1 - cover[:, None] * np.array([0.115, 0.085, 0.060], np.float32) * (1 - 0.6 * look.grey)
    over(part, np.float32(0.9) * mixed_grey(look.hair_colour, look.grey), 0.85 * cover * hairs)
    colour[at] = part


def mixed_grey(colour: tuple[int, int, int], grey: float) -> NDArray[np.float32]:
    """Return the mean colour of hairs of which a share is grey."""
    own = rgb(colour)
    return np.asarray(own + (GREY - own) * grey, np.float32)
