"""ARKit's 52 blendshape coefficients, as phones and MediaPipe give them, to the rig's core shapes.

1 is the strongest expression of either side, so coefficients are taken over as they are. A table, not a fit: what the
rig has no shape for is named. Left and right are the person's own, in ARKit as here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

    Floats = NDArray[np.float64]

# ARKit name -> core shapes; {ARKit}Left goes to {shape}.L, {ARKit}Right to {shape}.R.
_SIDED = {
    "eyeBlink": "lidsClose",
    "eyeLookDown": "gazeDown",
    "eyeLookUp": "gazeUp",
    "eyeSquint": "lidsTight",
    "eyeWide": "lidUpperRaise",
    "mouthSmile": "mouthSmile",
    "mouthFrown": "mouthFrown",
    "mouthDimple": "mouthDimple",
    "mouthStretch": "mouthStretch",
    "mouthPress": "mouthPress",
    "mouthLowerDown": "lowerLipDown",
    "mouthUpperUp": "upperLipRaise",
    "browDown": "browDown",
    "browOuterUp": "browOuterUp",
    "cheekSquint": "cheekRaise",
    "noseSneer": "noseWrinkle",
}
_WHOLE = {
    "eyeLookInLeft": ("gazeRight.L",),
    "eyeLookOutLeft": ("gazeLeft.L",),
    "eyeLookInRight": ("gazeLeft.R",),
    "eyeLookOutRight": ("gazeRight.R",),
    "jawForward": ("jawThrust",),
    "jawLeft": ("jawLeft",),
    "jawRight": ("jawRight",),
    "jawOpen": ("jawOpen",),
    "mouthFunnel": ("funnelUpper", "funnelLower"),
    "mouthPucker": ("mouthPucker",),
    "mouthLeft": ("mouthLeft",),
    "mouthRight": ("mouthRight",),
    "mouthRollLower": ("lipRollLower",),
    "mouthRollUpper": ("lipRollUpper",),
    "mouthShrugLower": ("chinRaise",),
    "mouthShrugUpper": ("upperLipShrug",),
    "mouthClose": (),
    "browInnerUp": ("browInnerUp.L", "browInnerUp.R"),
    "cheekPuff": ("cheekPuff.L", "cheekPuff.R"),
    "tongueOut": ("tongueOut",),
}
TABLE: dict[str, tuple[str, ...]] = _WHOLE | {
    f"{name}{side}": (f"{shape}.{side[0]}",) for name, shape in _SIDED.items() for side in ("Left", "Right")
}
"""ARKit name -> the core shapes that take its coefficient; none for ``mouthClose``, which no gene of the rig does."""
_ANY_CASE = {name.lower(): name for name in TABLE}
_EXCESS = 0.5
"""Calibrated phones report a little less than 0 and more than 1; so much is cut off, more is an error."""


def arkit_name(column: str) -> str | None:
    """Return the ARKit name that a column means, in whatever case (phones write ``EyeBlinkLeft``), or none."""
    return _ANY_CASE.get(column.lower())


def core_weights(rig: Rig, coefficients: Mapping[str, float]) -> Floats:
    """Return (C,) weights of the core shapes in [0, 1].

    Args:
        rig: a face model with shapes of the bundled rig, or with shapes that have ARKit's own names.
        coefficients: ARKit name -> coefficient; what is missing is 0.

    Raises:
        InvalidInputError: an unknown name, a coefficient that is none, or a rig without any of their shapes.
    """
    _check(coefficients)
    served = {name: rows for name in coefficients if (rows := _rows(rig, name))}
    if coefficients and not served:
        wanted = expected("shapes named as the bundled rig's or as ARKit's", f"none for {[*coefficients][:5]}")
        raise InvalidInputError(f"rig: {wanted}")
    core = np.zeros(len(rig.core_shapes))
    for name, rows in served.items():
        core[rows] = min(max(coefficients[name], 0.0), 1.0)
    return core


def unserved(rig: Rig, coefficients: Iterable[str]) -> list[str]:
    """Return which ARKit names a rig has no shape for."""
    return [name for name in coefficients if not _rows(rig, name)]


def _check(coefficients: Mapping[str, float]) -> None:
    for name, value in coefficients.items():
        if name not in TABLE:
            raise InvalidInputError(f"coefficients: {expected('ARKit names, as jawOpen', name)}")
        if not -_EXCESS <= value <= 1 + _EXCESS:
            raise InvalidInputError(f"{name}: {expected('a coefficient in [0, 1]', value)}")


def _rows(rig: Rig, name: str) -> list[int]:
    """Return the core shapes that take a coefficient: those of the table that a rig has, else the one of that name."""
    own = [shape for shape in TABLE[name] if shape in rig.core_shapes]
    named = [name] if name in rig.core_shapes else []
    return [rig.core_shapes.index(shape) for shape in own or named]
