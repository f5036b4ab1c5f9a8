"""Which genes build which emotion, from the FACS literature.

Prototypes are hypotheses about faces, not ground truth (Barrett et al. 2019, doi:10.1177/1529100619832930).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.face.rig import EmotionSet

if TYPE_CHECKING:
    from collections.abc import Mapping

_TABLE = "Ekman & Friesen 1978, Facial Action Coding System, table 11-1"
_GUIDE = "Ekman, Friesen & Hager 2002, FACS Investigator's Guide, prototypes and variants"


def _emotion(action_units: str, genes: str, table: str, guide: str) -> EmotionSet:
    source = f"{_TABLE}: {table}; {_GUIDE}: {guide}"
    return EmotionSet(tuple(genes.split()), tuple(action_units.split()), source)


EMOTION_SETS: Mapping[str, EmotionSet] = {
    "happy": _emotion(
        "6 12 25",
        "mouthSmile cheekRaise mouthSmileOpen mouthSmileSharp lidsTight lipsPart",
        "6+12+25",
        "6+12",
    ),
    "sad": _emotion(
        "1 4 15",
        "browInnerUp browOblique browKnit mouthFrown mouthDepress chinRaise lidsSlit",
        "1+4+15",
        "1+4+15, with 11, 17 or 6",
    ),
    "angry": _emotion(
        "4 5 7 23 24",
        "browDown browKnit lidUpperRaise lidsTight mouthPress chinRaise upperLipRaise nostrilFlare funnelLower",
        "4+5+7+24",
        "4+5+7+10+22+23+25, 4+5+7+17+24 and variants",
    ),
    "fearful": _emotion(
        "1 2 4 5 20 25",
        "browInnerUp browOuterUp browRaise browKnit lidUpperRaise lidsTight mouthStretch mouthRetract lipsPart "
        "jawOpen neckTighten",
        "1+2+4+5+20+25",
        "1+2+4+5+20+25, 26 or 27",
    ),
    "surprised": _emotion(
        "1 2 5 26",
        "browInnerUp browOuterUp browRaise browArch lidUpperRaise jawOpen lipsPart",
        "1+2+5+26",
        "1+2+5+26 or 27",
    ),
    "disgusted": _emotion(
        "4 10 17",
        "noseWrinkle noseWingRaise upperLipRaise upperLipElevate chinRaise mouthFrown lowerLipDown browKnit lidsTight",
        "10+17+4",
        "9, 9+16+15, 9+17, 10 and variants",
    ),
}
