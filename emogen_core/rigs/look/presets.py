"""The appearance of each of the rig's own heads.

The presets are graphic, chosen by eye; they are no anthropometric statement about any group. Whoever needs another
face for one of these heads gives it another `Appearance`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from emogen_core.face.appearance import Appearance, mixed
from emogen_core.face.space import DEFAULT_MIX

if TYPE_CHECKING:
    from collections.abc import Mapping

_YOUNG: Mapping[str, Appearance] = {
    "african-female": Appearance(
        skin_depth=0.66, undertone=0.15, redness=0.42, lip_colour=(140, 82, 76), iris_colour=(80, 50, 33),
        hair_colour=(44, 34, 29), hair_length=0.62, hair_curl=1.0, brow_colour=(34, 26, 23), brow_density=0.62,
        brow_thickness=0.36, brow_arch=0.66, lashes=0.9, teeth=0.12,
    ),
    "african-male": Appearance(
        skin_depth=0.78, undertone=0.05, redness=0.42, lip_colour=(114, 74, 66), iris_colour=(70, 43, 28),
        hair_colour=(38, 30, 26), hair_length=0.30, hair_curl=1.0, brow_colour=(28, 22, 20), brow_density=0.68,
        brow_thickness=0.56, brow_arch=0.32, stubble=0.35, lashes=0.5, teeth=0.15,
    ),
    "asian-female": Appearance(
        skin_depth=0.22, undertone=0.45, redness=0.40, lip_colour=(196, 112, 106), iris_colour=(78, 50, 33),
        hair_colour=(42, 33, 30), hair_length=1.0, brow_colour=(46, 36, 31), brow_density=0.55,
        brow_thickness=0.40, brow_arch=0.42, lashes=0.55, teeth=0.18,
    ),
    "asian-male": Appearance(
        skin_depth=0.36, undertone=0.55, redness=0.42, lip_colour=(176, 112, 102), iris_colour=(74, 48, 32),
        hair_colour=(40, 32, 29), hair_length=0.45, brow_colour=(36, 29, 26), brow_density=0.60,
        brow_thickness=0.58, brow_arch=0.20, stubble=0.22, lashes=0.3, teeth=0.25,
    ),
    "caucasian-female": Appearance(
        skin_depth=0.14, undertone=-0.15, redness=0.55, freckles=0.45, lip_colour=(198, 116, 110),
        iris_colour=(100, 128, 146), hair_colour=(118, 80, 52), hair_length=0.95, brow_colour=(104, 74, 52),
        brow_density=0.62, brow_thickness=0.36, brow_arch=0.66, lashes=0.75, teeth=0.15,
    ),
    "caucasian-male": Appearance(
        skin_depth=0.24, undertone=-0.05, redness=0.58, freckles=0.12, lip_colour=(182, 118, 108),
        iris_colour=(96, 112, 84), hair_colour=(88, 62, 43), hair_length=0.50, brow_colour=(82, 60, 44),
        brow_density=0.62, brow_thickness=0.60, brow_arch=0.30, stubble=0.45, lashes=0.4, teeth=0.22,
    ),
}  # fmt: skip


def presets() -> Mapping[str, Appearance]:
    """Return identity -> appearance for all the rig's heads, in the rig's order."""
    corners = {
        f"{kind}-{age}": young if age == "young" else _aged(young, male=kind.endswith("-male"))
        for kind, young in _YOUNG.items()
        for age in ("young", "old")
    }
    return {"female": _default("female"), "male": _default("male"), **corners}


def _default(sex: str) -> Appearance:
    """Return the blend of the three young heads; curls of a fifth would look like none, so hair is the first's."""
    blend = mixed((_YOUNG[f"{ancestry}-{sex}"], share) for ancestry, share in DEFAULT_MIX.items())
    brown = (96, 84, 58) if sex == "male" else (98, 84, 60)
    hair = (84, 58, 41) if sex == "female" else (66, 48, 36)
    return replace(blend, iris_colour=brown, hair_colour=hair, hair_curl=0.0, freckles=0.2 * (sex == "female"))


def _aged(young: Appearance, *, male: bool) -> Appearance:
    """Return the same head at some seventy years."""
    red, green, blue = (round(0.93 * c + 3) for c in young.lip_colour)
    return replace(
        young,
        lines=1.0, spots=0.8, freckles=0.5 * young.freckles, redness=young.redness + 0.08,
        lip_colour=(red, green, blue),
        grey=0.88 if male else 0.80,
        hair_length=0.35 if male else 0.68,
        hair_curl=0.8 * young.hair_curl,
        balding=0.85 if male else 0.05,
        brow_density=young.brow_density - 0.14, lashes=0.6 * young.lashes, teeth=young.teeth + 0.40,
    )  # fmt: skip
