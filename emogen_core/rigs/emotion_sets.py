"""Which genes build which emotion, and how strongly, from the FACS literature.

The strengths are ours: Ekman and Friesen name action units, not millimetres. They were set by eye so that the set at
full strength shows the prototype on every identity. Prototypes are hypotheses about faces, not ground truth (Barrett et
al. 2019, doi:10.1177/1529100619832930).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.face.rig import EmotionSet

if TYPE_CHECKING:
    from collections.abc import Mapping

TABLE = "Ekman & Friesen 1978, Facial Action Coding System, table 11-1"
GUIDE = "Ekman, Friesen & Hager 2002, FACS Investigator's Guide, prototypes and variants"


def _emotion(action_units: str, table: str, guide: str, **strengths: float) -> EmotionSet:
    source = f"{TABLE}: {table}; {GUIDE}: {guide}"
    return EmotionSet(tuple(strengths), tuple(strengths.values()), tuple(action_units.split()), source)


EMOTION_SETS: Mapping[str, EmotionSet] = {
    "happy": _emotion(
        "6 12 25",
        "6+12+25",
        "6+12",
        mouthSmile=0.5,
        cheekRaise=1.0,
        mouthSmileOpen=1.0,
        mouthSmileSharp=0.1,
        lidsTight=0.45,
        lipsPart=0.1,
    ),
    "sad": _emotion(
        "1 4 15 17",
        "1+4+15",
        "1+4+11+15, 1+4+15, 6+15, 1+4+15+17 and variants",
        browInnerUp=0.6,
        browOblique=0.8,
        browKnit=0.4,
        mouthFrown=0.9,
        mouthDepress=0.3,
        chinRaise=0.4,
        lidsSlit=0.25,
    ),
    "angry": _emotion(
        "4 5 7 24",
        "4+5+7+24",
        "4+5+7+10+22+23+25, 4+5+7+17+23, 4+5+7+17+24, 4+5+7+23, 4+5+7+24 and variants",
        browDown=1.0,
        browKnit=1.0,
        lidUpperRaise=0.3,
        lidsTight=1.0,
        mouthPress=1.0,
        nostrilFlare=0.7,
    ),
    "fearful": _emotion(
        "1 2 4 5 20 25",
        "1+2+4+5+20+25",
        "1+2+4+5+20+25, 26 or 27, and variants",
        browInnerUp=0.9,
        browRaise=0.5,
        browKnit=0.8,
        lidUpperRaise=1.0,
        lidsTight=0.2,
        mouthStretch=0.8,
        mouthRetract=0.5,
        lowerLipDown=0.2,
        lipsPart=0.4,
        lipRollUpper=0.2,
        upperLipRaise=0.2,
        neckTighten=0.2,
    ),
    "surprised": _emotion(
        "1 2 5 26",
        "1+2+5+26",
        "1+2+5+26 or 27, and variants",
        browInnerUp=0.7,
        browOuterUp=0.7,
        browRaise=0.8,
        browArch=0.1,
        lidUpperRaise=0.75,
        jawOpen=0.75,
        lipsPart=0.1,
    ),
    "disgusted": _emotion(
        "4 9 10 17",
        "10+17+4",
        "9, 9+16+15, 9+17, 10, 10+16+25, 10+17 and variants",
        noseWrinkle=1.0,
        noseWingRaise=0.9,
        upperLipRaise=1.0,
        upperLipElevate=0.3,
        chinRaise=0.5,
        mouthFrown=0.4,
        browDown=0.1,
        browKnit=0.15,
        lidsTight=0.6,
        cheekRaise=0.4,
    ),
}
