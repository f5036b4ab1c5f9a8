"""What a head looks like whose document says nothing of it: a blend of the presets' appearances by its parameters.

Every preset has its place in the space of heads, and wears exactly its own appearance there. Between them shares are
products, as the shares of the targets that mix the shape: ``share(sex) * share(age) * share(ancestry)``. Young heads
have a fourth place inside the triangle of ancestries, that of `female` and `male` at the shares ``m`` of
`DEFAULT_MIX`; the triangle is cut into three there, so that the blend stays continuous::

    inner = min_i(p_i / m_i),    outer_i = p_i - inner * m_i

for a head with the ancestry shares ``p``. A child has what a young head of its kind has, without a beard.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from emogen_core.face.appearance import Appearance, mixed
from emogen_core.face.space import ANCESTRIES, DEFAULT_MIX, SEXES, age_shares
from emogen_core.rigs.look.presets import presets

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from emogen_core.face.identity import Identity
    from emogen_core.face.space import IdentitySpace


def appearance_of(identity: Identity, space: IdentitySpace) -> Appearance:
    """Return the look of an identity: its own, or the default of its head.

    Raises:
        InvalidInputError: its own is no appearance.
    """
    if identity.appearance:
        return Appearance.from_document(dict(identity.appearance))
    return default_appearance(identity.head, space)


def default_appearance(point: Mapping[str, float], space: IdentitySpace) -> Appearance:
    """Return the appearance of a head that has none of its own; continuous in sex, age and shares of ancestry.

    Args:
        point: parameter -> value, a point of the space; what is not named has its default.
        space: the space of heads.
    """
    value = {name: point.get(name, known.default) for name, known in space.ranges.items()}
    worn = presets()
    young, corners = _places(value)
    kinds = {"child": young, "young": young, "old": corners}
    return mixed(
        (_at(age, worn[name]), of_sex * of_age * share)
        for sex, of_sex in zip(SEXES, (1 - value["sex"], value["sex"]), strict=True)
        for age, of_age in age_shares(value["age"]).items()
        for name, share in _named(kinds[age], sex, "old" if age == "old" else "young")
    )


def _places(value: Mapping[str, float]) -> tuple[dict[str, float], dict[str, float]]:
    """Return a head's shares of the places of young heads, "" the inner one, and of the corners alone."""
    total = sum(value[name] for name in ANCESTRIES)
    corners = {name: value[name] / total for name in ANCESTRIES}
    inner = min(corners[name] / DEFAULT_MIX[name] for name in ANCESTRIES)
    outer = {name: max(0.0, corners[name] - inner * DEFAULT_MIX[name]) for name in ANCESTRIES}
    return {"": inner, **outer}, corners


def _named(shares: Mapping[str, float], sex: str, age: str) -> Iterator[tuple[str, float]]:
    for ancestry, share in shares.items():
        yield f"{ancestry}-{sex}-{age}" if ancestry else sex, share


def _at(age: str, look: Appearance) -> Appearance:
    return replace(look, stubble=0.0) if age == "child" else look
