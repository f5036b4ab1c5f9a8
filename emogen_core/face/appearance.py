"""What a head looks like apart from its shape: a point in a continuous space of skin, eyes and hair.

An `Appearance` is plain data: numbers between named bounds and sRGB colours. It says nothing about anybody: what goes
with which sex, age or ancestry is the choice of whoever sets it. There is no make-up in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from dataclasses import Field

Colour = tuple[int, int, int]


def _amount(meaning: str, low: float = 0.0, high: float = 1.0) -> dict[str, Any]:
    return {"meaning": meaning, "low": low, "high": high}


def _colour(meaning: str) -> dict[str, Any]:
    return {"meaning": meaning}


@dataclass(frozen=True, slots=True, kw_only=True)
class Appearance:
    """The look of a head. Amounts lie between the bounds in their field's metadata, colours are sRGB, 0 to 255.

    Raises:
        InvalidInputError: a number that is not finite or out of its bounds, or a colour that is not three whole
            numbers from 0 to 255; names the field.
    """

    skin_depth: float = field(default=0.25, metadata=_amount("from very light (0) to very dark (1), see the ladder"))
    undertone: float = field(default=0.0, metadata=_amount("from rosy (-1) to golden (1)", -1.0))
    redness: float = field(default=0.5, metadata=_amount("blood in cheeks, nose, ears and blotches"))
    freckles: float = field(default=0.0, metadata=_amount("freckles on nose and cheeks"))
    lines: float = field(default=0.0, metadata=_amount("lines at rest, and how sharply expressions fold the skin"))
    spots: float = field(default=0.0, metadata=_amount("age spots and small veins"))
    lip_colour: Colour = field(default=(188, 112, 104), metadata=_colour("colour of the lips"))
    iris_colour: Colour = field(default=(92, 64, 42), metadata=_colour("colour of the iris half-way out"))
    hair_colour: Colour = field(
        default=(62, 44, 33), metadata=_colour("colour of hair that is not grey, on scalp and chin")
    )
    hair_length: float = field(default=0.5, metadata=_amount("from shaven (0) to full and short (1)"))
    hair_curl: float = field(default=0.0, metadata=_amount("from straight (0) to tightly coiled (1)"))
    balding: float = field(default=0.0, metadata=_amount("how far the hairline has gone back, and the crown is bare"))
    grey: float = field(default=0.0, metadata=_amount("share of grey hairs, on scalp, brows and chin"))
    brow_colour: Colour = field(default=(56, 41, 32), metadata=_colour("colour of brow hairs that are not grey"))
    brow_density: float = field(default=0.6, metadata=_amount("how many of the brows' hairs there are"))
    brow_thickness: float = field(default=0.5, metadata=_amount("height of the brows, from thin to broad"))
    brow_arch: float = field(default=0.5, metadata=_amount("from low and straight to high and arched"))
    stubble: float = field(default=0.0, metadata=_amount("from clean shaven to three days' beard"))
    lashes: float = field(default=0.5, metadata=_amount("length of the lashes"))
    teeth: float = field(default=0.25, metadata=_amount("how yellow the teeth are"))

    def __post_init__(self) -> None:
        for each in fields(self):
            value = getattr(self, each.name)
            checked = _number(each, value) if "low" in each.metadata else _rgb(each.name, value)
            object.__setattr__(self, each.name, checked)

    def to_document(self) -> dict[str, Any]:
        """Return it as JSON data; `from_document` reads it back as an equal value."""
        values = {each.name: getattr(self, each.name) for each in fields(self)}
        return {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()}

    @classmethod
    def from_document(cls, document: object) -> Appearance:
        """Read what `to_document` wrote: every field, and no other.

        Raises:
            InvalidInputError: not an object, a field is missing, unknown or out of bounds.
        """
        if not isinstance(document, dict):
            raise InvalidInputError(f"appearance: {expected('an object', document)}")
        known = {each.name for each in fields(cls)}
        for problem, names in (("missing", known - document.keys()), ("unknown", document.keys() - known)):
            if names:
                raise InvalidInputError(f"appearance: {expected(f'no {problem} field', sorted(map(str, names)))}")
        return cls(**document)


def mixed(shares: Iterable[tuple[Appearance, float]]) -> Appearance:
    """Return the mean of appearances, weighted by shares; colours are mixed in gamma 2, as light would be.

    Args:
        shares: (appearance, share) pairs; shares are not negative and are brought to a sum of one.

    Raises:
        InvalidInputError: a negative share, or all are zero.
    """
    parts = list(shares)
    total = math.fsum(share for _, share in parts)
    if not total > 0 or min(share for _, share in parts) < 0:
        raise InvalidInputError(f"shares: {expected('positive numbers', [share for _, share in parts])}")
    weights = [share / total for _, share in parts]
    return Appearance(
        **{each.name: _mean([getattr(a, each.name) for a, _ in parts], weights, each) for each in _FIELDS}
    )


def parameters() -> list[dict[str, Any]]:
    """Return what the documentation tells of every field: name, default, meaning, and low and high of an amount."""
    return [{"name": each.name, "default": each.default, **each.metadata} for each in _FIELDS]


_FIELDS = fields(Appearance)


def _mean(values: Sequence[Any], weights: Sequence[float], each: Field[Any]) -> Any:
    if "low" in each.metadata:
        mean = math.fsum(value * weight for value, weight in zip(values, weights, strict=True))
        return min(each.metadata["high"], max(each.metadata["low"], mean))
    return tuple(_mean_light([value[channel] for value in values], weights) for channel in range(3))


def _mean_light(values: Sequence[int], weights: Sequence[float]) -> int:
    return round(math.sqrt(math.fsum(value**2 * weight for value, weight in zip(values, weights, strict=True))))


def _number(each: Field[Any], value: object) -> float:
    low, high = each.metadata["low"], each.metadata["high"]
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not low <= value <= high:
        raise InvalidInputError(f"appearance.{each.name}: {expected(f'a number from {low:g} to {high:g}', value)}")
    return float(value)


def _rgb(name: str, value: object) -> Colour:
    if not isinstance(value, (list, tuple)) or len(value) != 3 or not all(map(_is_byte, value)):
        raise InvalidInputError(f"appearance.{name}: {expected('three whole numbers from 0 to 255', value)}")
    red, green, blue = value
    return red, green, blue


def _is_byte(value: object) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= 255
