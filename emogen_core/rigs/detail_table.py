"""The sliders of a head: which of MakeHuman's detail targets each direction uses."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class Detail:
    """A slider: targets of either direction (left and right are moved together), and how far it may go.

    ``scale`` multiplies the targets so that 1 is the end of the slider's range.
    """

    name: str
    region: str
    minus: tuple[str, ...]
    plus: tuple[str, ...]
    meaning: str
    scale: float = 1.0

    def scaled(self, scale: float) -> Detail:
        """Return the slider with so much of its targets at the end of its range."""
        return replace(self, scale=scale)

    def targets(self, sign: str) -> tuple[str, ...]:
        """Return the targets of one direction, ``"+"`` or ``"-"``."""
        return self.plus if sign == "+" else self.minus

    @property
    def low(self) -> float:
        """Least value: -1, or 0 for a slider with one direction."""
        return -1.0 if self.minus else 0.0

    @property
    def high(self) -> float:
        """Largest value."""
        return 1.0


def _one(name: str, region: str, stem: str, ends: tuple[str, str], meaning: str) -> Detail:
    minus, plus = ((f"{stem}-{end}",) for end in ends)
    return Detail(name, region, minus, plus, meaning)


def _pair(name: str, region: str, stem: str, ends: tuple[str, str], meaning: str) -> Detail:
    folder, stem = stem.split("/")
    minus, plus = (tuple(f"{folder}/{side}-{stem}-{end}" for side in "lr") for end in ends)
    return Detail(name, region, minus, plus, meaning)


def _only(name: str, region: str, target: str, meaning: str) -> Detail:
    return Detail(name, region, (), (target,), meaning)


_SIZE = ("decr", "incr")
_UP = ("down", "up")

DETAILS: tuple[Detail, ...] = (
    _one("head-width", "head", "head/head-scale-horiz", _SIZE, "narrow to wide").scaled(0.6),
    _one("head-height", "head", "head/head-scale-vert", _SIZE, "low to high").scaled(0.6),
    _one("head-depth", "head", "head/head-scale-depth", _SIZE, "flat to deep").scaled(0.6),
    _one("head-fat", "head", "head/head-fat", _SIZE, "bony to full").scaled(0.7),
    _only("head-oval", "head", "head/head-oval", "as it is to oval").scaled(0.6),
    _only("head-round", "head", "head/head-round", "as it is to round").scaled(0.6),
    _only("head-square", "head", "head/head-square", "as it is to square").scaled(0.5),
    Detail(
        "head-taper", "head", ("head/head-invertedtriangular",), ("head/head-triangular",), "narrow jaw to heavy jaw"
    ),
    _one("forehead-height", "head", "forehead/forehead-scale-vert", _SIZE, "low to high").scaled(0.3),
    _one("forehead-slope", "head", "forehead/forehead-trans", ("backward", "forward"), "sloping to upright"),
    _one("temple-width", "head", "forehead/forehead-temple", _SIZE, "hollow to full"),
    _one("brow-height", "brow", "eyebrows/eyebrows-trans", _UP, "low to high"),
    _one("brow-ridge", "brow", "eyebrows/eyebrows-trans", ("backward", "forward"), "flat to strong").scaled(0.4),
    _pair("eye-size", "eye", "eyes/eye-scale", _SIZE, "small to large"),
    _pair("eye-height", "eye", "eyes/eye-height2", _SIZE, "narrow to round opening"),
    _pair("eye-spacing", "eye", "eyes/eye-trans", ("in", "out"), "close to wide set"),
    _pair("eye-level", "eye", "eyes/eye-trans", _UP, "low to high"),
    _pair("eye-slant", "eye", "eyes/eye-corner2", _UP, "outer corner low to high"),
    _pair("eye-inner-corner", "eye", "eyes/eye-corner1", _UP, "inner corner low to high"),
    _pair("eye-epicanthus", "eye", "eyes/eye-epicanthus", ("in", "out"), "with to without epicanthic fold"),
    _pair("eye-fold", "eye", "eyes/eye-eyefold", _UP, "upper fold low to high"),
    _pair("eye-bag", "eye", "eyes/eye-bag", _SIZE, "without to with bags"),
    _one("nose-width", "nose", "nose/nose-scale-horiz", _SIZE, "narrow to wide"),
    _one("nose-length", "nose", "nose/nose-scale-vert", _SIZE, "short to long").scaled(0.7),
    _one("nose-depth", "nose", "nose/nose-scale-depth", _SIZE, "flat to prominent").scaled(0.6),
    _one("nose-hump", "nose", "nose/nose-hump", _SIZE, "without to with hump"),
    _one("nose-bridge", "nose", "nose/nose-greek", _SIZE, "low to high root"),
    _one("nose-tip", "nose", "nose/nose-point", _UP, "hanging to turned up").scaled(0.5),
    _one("nose-tip-width", "nose", "nose/nose-point-width", _SIZE, "pointed to broad"),
    _one("nose-nostrils", "nose", "nose/nose-nostrils-width", _SIZE, "narrow to wide").scaled(0.6),
    _one("nose-volume", "nose", "nose/nose-volume", _SIZE, "slight to full").scaled(0.7),
    _one("mouth-width", "mouth", "mouth/mouth-scale-horiz", _SIZE, "narrow to wide").scaled(0.7),
    _one("mouth-level", "mouth", "mouth/mouth-trans", _UP, "low to high").scaled(0.4),
    _one("mouth-depth", "mouth", "mouth/mouth-trans", ("backward", "forward"), "set back to prominent").scaled(0.35),
    _one("lip-upper", "mouth", "mouth/mouth-upperlip-height", _SIZE, "thin to full upper lip"),
    _one("lip-lower", "mouth", "mouth/mouth-lowerlip-height", _SIZE, "thin to full lower lip"),
    _one("lip-bow", "mouth", "mouth/mouth-cupidsbow", _SIZE, "flat to marked bow"),
    _one("philtrum", "mouth", "mouth/mouth-philtrum-volume", _SIZE, "flat to full"),
    _pair("cheek-bones", "cheek", "cheek/cheek-bones", _SIZE, "flat to prominent").scaled(0.6),
    _pair("cheek-volume", "cheek", "cheek/cheek-volume", _SIZE, "hollow to full"),
    _pair("cheek-inner", "cheek", "cheek/cheek-inner", _SIZE, "hollow to full beside the nose"),
    _one("chin-width", "chin", "chin/chin-width", _SIZE, "narrow to wide").scaled(0.6),
    _one("chin-height", "chin", "chin/chin-height", _SIZE, "short to long").scaled(0.45),
    _one("chin-prominence", "chin", "chin/chin-prominent", _SIZE, "receding to prominent").scaled(0.7),
    _one("chin-cleft", "chin", "chin/chin-cleft", _SIZE, "without to with cleft"),
    _one("jaw-width", "chin", "chin/chin-bones", _SIZE, "narrow to wide angle of the jaw").scaled(0.6),
    _one("jaw-position", "chin", "chin/chin-prognathism", _SIZE, "set back to forward").scaled(0.35),
    _pair("ear-size", "ear", "ears/ear-scale", _SIZE, "small to large").scaled(0.7),
    _pair("ear-wing", "ear", "ears/ear-wing", _SIZE, "flat to standing out").scaled(0.6),
    _pair("ear-lobe", "ear", "ears/ear-lobe", _SIZE, "small to large lobe").scaled(0.7),
    _one("neck-width", "neck", "neck/neck-scale-horiz", _SIZE, "slender to wide").scaled(0.7),
    _one("neck-fullness", "neck", "neck/neck-double", _SIZE, "taut to double chin").scaled(0.6),
)
