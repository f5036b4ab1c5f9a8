"""The named presets, as points of the space of heads.

`female` and `male` mix three ancestries; the other twelve are the corners ancestry, sex, age. They are graphic
presets of the source data, not anthropometrically validated.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.errors import IdentityError, expected
from emogen_core.face.identity import Identity
from emogen_core.face.space import AGES, ANCESTRIES, DEFAULT_MIX, SEXES

if TYPE_CHECKING:
    from collections.abc import Mapping

    Point = Mapping[str, float]


def _point(sex: str, age: str, mix: Mapping[str, float]) -> Point:
    return {"sex": float(SEXES.index(sex)), "age": AGES[age], **{name: mix.get(name, 0.0) for name in ANCESTRIES}}


IDENTITIES: Mapping[str, Point] = {
    **{sex: _point(sex, "young", DEFAULT_MIX) for sex in SEXES},
    **{
        f"{ancestry}-{sex}-{age}": _point(sex, age, {ancestry: 1.0})
        for ancestry in ANCESTRIES
        for sex in SEXES
        for age in ("young", "old")
    },
}


def preset(name: str) -> Identity:
    """Return a preset as an identity, the look left to its own style.

    Raises:
        IdentityError: there is no such preset.
    """
    if name not in IDENTITIES:
        raise IdentityError(f"identity: {expected(f'one of {sorted(IDENTITIES)}', name)}")
    return Identity(name, IDENTITIES[name])
