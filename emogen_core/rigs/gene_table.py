"""The genes of the bundled rig: from which units each is made, what it means, and how strong it is.

Units come from two CC0 sets that do not duplicate each other above a cosine of 0.9: ``ak`` is Face Units (named
as in ARKit), ``mh`` is MakeHuman's own expression units. Action units are the rig maker's reading of the
shapes, not certified FACS coding (Ekman, Friesen & Hager 2002). Scales bring units that are too weak or too
strong to a face's range.

Left out, with the reason: ``mouthClose`` (alone it folds the lip over the nose: it became a corrective), ``eyeBlink``
(overshoots; ``eye-closure`` instead), ``eye-opened-up``, ``mouth-pursing``, ``mouth-compression``, ``mouth-part-later``
and ``mouth-open`` (near doubles of others, or torn).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from emogen_core.face.rig import Gene

_NOTHING: frozenset[str] = frozenset()
_GAZE = frozenset({"gaze"})
_LIDS = frozenset({"lids"})
_LATERAL = frozenset({"lateral"})
_DISABLED = frozenset({"disabled"})


@dataclass(frozen=True, slots=True)
class Recipe:
    """How a gene is made.

    ``unit`` names the target as ``set:name`` with ``{side}`` or ``{Side}`` for pairs. A ``pair`` has one target a
    side; a ``split`` is one symmetric target cut into halves; ``one`` is a single symmetric shape; ``left`` is the
    head's left version of a lateral shape and ``right`` its mirror image; ``eyes`` turns the eyeballs. A pair without
    a target is made in `repairs.py`.
    """

    name: str
    unit: str
    kind: Literal["pair", "split", "one", "left", "right", "eyes"]
    action_units: tuple[str, ...]
    region: str
    scale: float = 1.0
    flags: frozenset[str] = _NOTHING

    @property
    def members(self) -> tuple[str, ...]:
        """Names of the core shapes."""
        if self.kind in {"pair", "split", "eyes"}:
            return (f"{self.name}.L", f"{self.name}.R")
        return (self.name,)

    @property
    def gene(self) -> Gene:
        """The gene as the rig knows it."""
        return Gene(self.name, self.members, self.action_units, self.region, self.flags)


RECIPES: tuple[Recipe, ...] = (
    Recipe("browInnerUp", "ak:browInnerUp", "split", ("1",), "brow", 1.7),
    Recipe("browOuterUp", "ak:browOuterUp{Side}", "pair", ("2",), "brow", 1.1),
    Recipe("browDown", "ak:browDown{Side}", "pair", ("4",), "brow"),
    Recipe("browKnit", "mh:eyebrows-{side}-down", "pair", ("4",), "brow"),
    Recipe("browOblique", "mh:eyebrows-{side}-inner-up", "pair", ("1",), "brow"),
    Recipe("browArch", "mh:eyebrows-{side}-extern-up", "pair", ("2",), "brow"),
    Recipe("browRaise", "mh:eyebrows-{side}-up", "pair", ("1", "2"), "brow"),
    Recipe("lidsClose", "mh:eye-{side}-closure", "pair", ("43",), "lid", flags=_LIDS),
    Recipe("lidsTight", "ak:eyeSquint{Side}", "pair", ("7",), "lid"),
    Recipe("lidsSlit", "mh:eye-{side}-slit", "pair", ("42",), "lid", flags=_LIDS),
    Recipe("lidUpperRaise", "ak:eyeWide{Side}", "pair", ("5",), "lid", 1.3),
    Recipe("gazeUp", "ak:eyeLookUp{Side}", "pair", ("63",), "gaze", flags=_GAZE),
    Recipe("gazeDown", "ak:eyeLookDown{Side}", "pair", ("64",), "gaze", flags=_GAZE),
    Recipe("gazeLeft", "ak:eyeLook", "eyes", ("61",), "gaze", flags=_GAZE),
    Recipe("gazeRight", "ak:eyeLook", "eyes", ("62",), "gaze", flags=_GAZE),
    Recipe("pupilDilate", "", "eyes", (), "gaze", flags=_GAZE | _DISABLED),
    Recipe("cheekRaise", "ak:cheekSquint{Side}", "pair", ("6",), "cheek"),
    Recipe("cheekPuff", "ak:cheekPuff", "split", ("AD34",), "cheek"),
    Recipe("cheekSuck", "ak:cheekPuff", "split", ("AD35",), "cheek", -0.45, _DISABLED),
    Recipe("noseWrinkle", "ak:noseSneer{Side}", "pair", ("9",), "nose", 1.5),
    Recipe("nostrilFlare", "mh:nose-{side}-dilatation", "pair", ("38",), "nose", 1.8),
    Recipe("nostrilPinch", "", "pair", ("39",), "nose"),
    Recipe("noseWingRaise", "mh:nose-{side}-elevation", "pair", ("9", "10"), "nose"),
    Recipe("noseTipDown", "mh:nose-depression", "one", (), "nose"),
    Recipe("jawOpen", "ak:jawOpen", "one", ("26", "27"), "jaw", 0.8),
    Recipe("jawThrust", "ak:jawForward", "one", ("AD29",), "jaw"),
    Recipe("mouthSmile", "ak:mouthSmile{Side}", "pair", ("12",), "mouth", 0.65),
    Recipe("mouthSmileSharp", "mh:mouth-corner-puller", "one", ("13",), "mouth"),
    Recipe("mouthSmileOpen", "mh:mouth-upward-retraction", "one", ("12", "25"), "mouth"),
    Recipe("mouthFrown", "ak:mouthFrown{Side}", "pair", ("15",), "mouth"),
    Recipe("mouthDepress", "mh:mouth-depression", "one", ("15", "17"), "mouth"),
    Recipe("mouthDimple", "ak:mouthDimple{Side}", "pair", ("14",), "mouth"),
    Recipe("mouthStretch", "ak:mouthStretch{Side}", "pair", ("20",), "mouth", 1.2),
    Recipe("mouthRetract", "mh:mouth-retraction", "one", ("14", "20"), "mouth"),
    Recipe("mouthPress", "ak:mouthPress{Side}", "pair", ("24",), "mouth"),
    Recipe("funnelUpper", "ak:mouthFunnel", "one", ("22",), "mouth"),
    Recipe("funnelLower", "ak:mouthFunnel", "one", ("22",), "mouth"),
    Recipe("mouthPucker", "ak:mouthPucker", "one", ("18",), "mouth"),
    Recipe("mouthProtrude", "mh:mouth-protusion", "one", ("22", "25"), "mouth", 0.7),
    Recipe("lowerLipEvert", "mh:mouth-eversion", "one", ("17", "22"), "mouth"),
    Recipe("lipRollUpper", "ak:mouthRollUpper", "one", ("28",), "mouth"),
    Recipe("lipRollLower", "ak:mouthRollLower", "one", ("28",), "mouth"),
    Recipe("chinRaise", "ak:mouthShrugLower", "one", ("17",), "mouth"),
    Recipe("upperLipShrug", "ak:mouthShrugUpper", "one", ("10", "17"), "mouth"),
    Recipe("upperLipRaise", "ak:mouthUpperUp{Side}", "pair", ("10",), "mouth"),
    Recipe("upperLipElevate", "mh:mouth-elevation", "one", ("10", "25"), "mouth"),
    Recipe("lowerLipDown", "ak:mouthLowerDown{Side}", "pair", ("16",), "mouth"),
    Recipe("lowerLipRetract", "mh:mouth-depression-retraction", "one", ("16", "20", "25"), "mouth"),
    Recipe("lipsPart", "mh:mouth-parling", "one", ("25",), "mouth"),
    Recipe("neckTighten", "mh:neck-platysma", "one", ("21",), "neck"),
    Recipe("tongueOut", "ak:tongueOut", "one", ("AD19",), "mouth", flags=_DISABLED),
    Recipe("jawLeft", "ak:jawLeft", "left", ("AD30",), "jaw", flags=_LATERAL),
    Recipe("jawRight", "ak:jawRight", "right", ("AD30",), "jaw", flags=_LATERAL),
    Recipe("mouthLeft", "ak:mouthLeft", "left", (), "mouth", flags=_LATERAL),
    Recipe("mouthRight", "ak:mouthRight", "right", (), "mouth", flags=_LATERAL),
)
