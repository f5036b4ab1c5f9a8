"""What tells one identity's look from another's: colours by ancestry, lines and grey by age, beard and brows by sex.

The presets are graphic, chosen by eye; they are no anthropometric statement about any group.
"""

from __future__ import annotations

from dataclasses import dataclass

Colour = tuple[int, int, int]

# The paper's two heads wear what their nearest preset wears.
ALIASES = {"female": "caucasian-female-young", "male": "caucasian-male-young"}


@dataclass(frozen=True, slots=True)
class Preset:
    """Colours are sRGB, amounts are 0 to 1.

    Attributes:
        ancestry, sex, age: which preset of the rig.
        tone: skin where nothing reddens or darkens it.
        lips: colour of the lips.
        iris: colour of the iris.
        hair: colour of the hair on the scalp.
        brow: colour of the brows and lashes.
        deep: how deep the skin is; blood shows less and lips blend softer.
    """

    ancestry: str
    sex: str
    age: str
    tone: Colour
    lips: Colour
    iris: Colour
    hair: Colour
    brow: Colour
    deep: float

    @property
    def name(self) -> str:
        """The rig's name of this identity."""
        return f"{self.ancestry}-{self.sex}-{self.age}"

    @property
    def male(self) -> bool:
        """Whether it has a beard's shadow and a man's brows."""
        return self.sex == "male"

    @property
    def old(self) -> bool:
        """Whether it is grey and lined."""
        return self.age == "old"


# ancestry -> sex -> (tone, lips, iris, hair, brow)
_COLOURS: dict[str, dict[str, tuple[Colour, ...]]] = {
    "african": {
        "female": ((150, 104, 79), (150, 88, 82), (78, 48, 31), (46, 33, 27), (36, 26, 22)),
        "male": ((130, 89, 67), (120, 78, 68), (70, 43, 28), (38, 28, 24), (30, 22, 19)),
    },
    "asian": {
        "female": ((231, 190, 160), (198, 116, 108), (84, 54, 36), (44, 34, 30), (44, 34, 30)),
        "male": ((214, 171, 138), (176, 116, 104), (80, 52, 35), (40, 32, 29), (38, 30, 27)),
    },
    "caucasian": {
        "female": ((232, 190, 168), (200, 120, 112), (98, 124, 142), (112, 78, 52), (104, 74, 52)),
        "male": ((220, 175, 152), (182, 120, 108), (98, 114, 88), (86, 62, 44), (82, 60, 44)),
    },
}


def presets() -> list[Preset]:
    """Return the presets in the rig's order: ancestry, sex, age."""
    return [
        _preset(ancestry, sex, age, colours)
        for ancestry, sexes in _COLOURS.items()
        for sex, colours in sexes.items()
        for age in ("young", "old")
    ]


def _preset(ancestry: str, sex: str, age: str, colours: tuple[Colour, ...]) -> Preset:
    tone, lips, iris, hair, brow = colours
    if age == "old":
        tone = _shift(tone, 0.96, (7, 3, -2))
        lips = _shift(lips, 0.94, (4, 4, 4))
        hair, brow = (_grey(colour, 0.78) for colour in (hair, brow))
    return Preset(ancestry, sex, age, tone, lips, iris, hair, brow, 1.0 if ancestry == "african" else 0.0)


def _shift(colour: Colour, scale: float, add: Colour) -> Colour:
    red, green, blue = (max(0, min(255, round(c * scale + a))) for c, a in zip(colour, add, strict=True))
    return red, green, blue


def _grey(colour: Colour, share: float) -> Colour:
    red, green, blue = (round(c + (g - c) * share) for c, g in zip(colour, (172, 168, 162), strict=True))
    return red, green, blue
