"""Hair on the scalp: where it grows, what it looks like, and by how much it stands off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rendering.composer.layers import smooth
from emogen_core.rendering.composer.skin import GREY, mixed_grey, over, rgb

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.appearance import Appearance

# Columns of the stored (R, 4) scalp: hairline and bald as in `RANGES`, lift and tufts in [0, 1].
HAIRLINE, BALD, LIFT, TUFTS = range(4)
_FULL = 24.0  # millimetres on the crown
# From how far outside of the hairline to where, decimetres, its fine hairs and shadow tint the skin, and how much.
_ROOTS, _ROOTS_TINT, _UNDER = (-0.16, 0.02), 0.45, (0.0, 0.2)


def lay_hair(colour: NDArray[np.float32], fields: Mapping[str, NDArray[np.float32]], look: Appearance) -> None:
    """Paint the hair over the (M, 3) skin: strand by strand at its edge, grey by strands."""
    inside = fields["hairline"] - look.balding * fields["bald"]
    at = np.flatnonzero(inside > -0.09)
    strands = fields["strands"][at] * (1 - look.hair_curl) + fields["coils"][at] * look.hair_curl
    long = look.hair_length
    # Towards its edge the hair thins out strand by strand, not as a veil.
    grown = smooth(inside[at], -0.085, 0.075 + 0.03 * (1 - long) + 0.10 * look.balding)
    cover = smooth(grown + 4.6 * (strands - 0.5) * grown * (1 - grown), 0.20, 0.82)
    sparse = (0.50 * (1 - long) + 0.30 * look.balding) * (1 - 0.6 * look.hair_curl)
    cover = cover * (1 - sparse * smooth(strands, 0.66, 0.28)) * min(1.0, 0.62 + 1.6 * long)
    _shade_roots(colour, inside, look)
    own = rgb(look.hair_colour)
    # Combed hair turns grey strand by strand; in coils grey and dark hairs are too fine to be told apart.
    apart = strands - 0.5 if not look.hair_curl else (1 - 0.75 * look.hair_curl) * (strands - 0.5)
    turned = smooth(apart + 2.0 * look.grey - 1.0, -0.60, 0.60)[:, None] if look.grey else np.float32(0)
    hair: NDArray[np.floating] = own + (GREY - own) * turned
    contrast = (1.15 - 0.55 * look.grey) * (1 - 0.35 * look.hair_curl * look.grey)
    # Gaps between strands are darker than strands are light: that is what hair is told from a cap by.
    hair = hair * (1 + contrast * np.where(strands < 0.5, 1.7, 1.1) * (strands - 0.5))[:, None].clip(0.25)
    gleam = (
        fields["sheen"][at] * strands**2 * (0.25 + 0.75 * long) * (1 - 0.75 * look.hair_curl) * (1 - 0.7 * look.grey)
    )
    hair = hair + gleam[:, None] * (0.10 + 0.55 * own)
    part = colour[at]
    over(part, np.asarray(hair, np.float32), cover)
    colour[at] = part


def _shade_roots(colour: NDArray[np.float32], inside: NDArray[np.float32], look: Appearance) -> None:
    """Tint the skin along the hairline and under the hair in place, as fine short hairs and shadow do."""
    at = np.flatnonzero(inside > _ROOTS[0])
    veil = _ROOTS_TINT * smooth(inside[at], *_ROOTS) ** 2 + (0.9 - _ROOTS_TINT) * smooth(inside[at], *_UNDER)
    veil *= smooth(np.array(look.hair_length), 0.0, 0.7)
    part = colour[at]
    over(part, np.float32(0.7) * mixed_grey(look.hair_colour, look.grey), veil * (1 - 0.8 * look.balding))
    colour[at] = part


def thickness(scalp: NDArray[np.float32], look: Appearance) -> NDArray[np.float32]:
    """Return (R,) millimetres by which hair lifts the skin off the scalp, from the stored (R, 4) ``scalp``."""
    inside = scalp[:, HAIRLINE] - look.balding * scalp[:, BALD]
    long = look.hair_length
    edge = 0.10 + 0.10 * (1 - long) + 0.25 * look.balding
    ramp = smooth(inside, -0.01, edge)
    reach = _FULL * long**1.25 * (1 - 0.55 * look.balding)
    uneven = 1 + (scalp[:, TUFTS] - 0.5) * (0.25 + 0.25 * look.hair_curl)
    return np.asarray(reach * scalp[:, LIFT] * ramp * uneven, np.float32)
