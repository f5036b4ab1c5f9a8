"""Names of expressions: sides taken off, and what they mean in the vocabulary of ARKit and ICT-FaceKit.

Heads that the product wrote have the bundled rig's names; those that mean one movement of ARKit's are read as that.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from emogen_core.landmarks.arkit import TABLE

ONE_SIDED = (
    "browDown", "browInnerUp", "browOuterUp", "cheekPuff", "cheekSquint", "eyeBlink", "eyeLookDown", "eyeLookIn",
    "eyeLookOut", "eyeLookUp", "eyeSquint", "eyeWide", "mouthDimple", "mouthFrown", "mouthLowerDown", "mouthPress",
    "mouthSmile", "mouthStretch", "mouthUpperUp", "noseSneer",
)  # fmt: skip
WHOLE = (
    "browInnerUp", "cheekPuff", "jawForward", "jawLeft", "jawOpen", "jawRight", "mouthClose", "mouthFunnel",
    "mouthLeft", "mouthPucker", "mouthRight", "mouthRollLower", "mouthRollUpper", "mouthShrugLower", "mouthShrugUpper",
    "tongueOut",
)  # fmt: skip
SIDEWAYS = (("jawLeft", "jawRight"), ("mouthLeft", "mouthRight"))
"""Movements of the whole mouth to one side or the other: mirror images, but never made together."""

_SIDE = re.compile(
    r"(?P<stem>.*?[a-z0-9])(?:[_.\- ]?(?P<word>Left|Right)|[_.\- ](?P<letter>[LRlr]|left|right)|(?P<bare>[LR]))"
)
_KNOWN = {name.lower(): name for name in (*ONE_SIDED, *WHOLE)}
# The bundled rig's shapes that are one of ARKit's movements and no more, by that name.
_BUNDLED = {
    shapes[0].lower(): name for name, shapes in TABLE.items() if len(shapes) == 1 and shapes[0].lower() not in _KNOWN
}


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a name says: its stem, ``L``, ``R`` or no side, and whether ARKit or ICT-FaceKit know it."""

    stem: str
    side: str
    known: bool

    @property
    def standard(self) -> str:
        """The name as ICT-FaceKit has it: ``eyeBlink_L``."""
        return f"{self.stem}_{self.side}" if self.side else self.stem


def meaning(name: str) -> Meaning:
    """Return what an expression's name says: ``eyeBlinkLeft``, ``eyeBlink_L``, ``face.EyeBlink_L`` alike.

    The left is that of the head. ``jawLeft`` and ``mouthLeft`` are directions, not sides.
    """
    whole = _without_owner(name)
    if whole.lower() in _KNOWN:
        return Meaning(_KNOWN[whole.lower()], "", known=True)
    found = _SIDE.fullmatch(whole)
    stem, side = (
        (found["stem"], (found["word"] or found["letter"] or found["bare"])[0].upper()) if found else (whole, "")
    )
    standard = _KNOWN.get(stem.lower())
    arkit = None if standard else _BUNDLED.get(f"{stem}.{side}".lower() if side else stem.lower())
    if arkit:
        return meaning(arkit)
    return Meaning(standard or stem, side, known=standard is not None)


def _without_owner(name: str) -> str:
    """Return a name without the object that exporters put before it: ``head_geo.jawOpen`` is ``jawOpen``."""
    owner, _, last = name.rpartition(".")
    side = last.lower() in ("l", "r", "left", "right")
    return last if owner and not side else name
