"""The bundled head on a foreign one: what of either is compared, and whether enough of a face is found."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.imported.front import Front
from emogen_core.rigs.imported.gaze import SIDES
from emogen_core.rigs.imported.mouth import drop_of
from emogen_core.rigs.imported.overlay import LEAST_SHARED, Skin, laid_over
from emogen_core.rigs.imported.parts import FLESH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.foreign.model import Findings

JAW = "jawOpen"
EYES = tuple(f"eye_{side}" for side in SIDES)


def front_of(rig: Rig, identity: str = "") -> Front:
    """Return a head of a rig, its first by default, as it is compared with others."""
    neutral = rig.neutral(identity or rig.identities[0]).astype(np.float64)
    flesh = _triangles(rig, *FLESH)
    shapes = {JAW: rig.offsets[rig.shape_names.index(JAW)]} if JAW in rig.shape_names else {}
    drop = drop_of(shapes, np.unique(flesh).astype(np.intp), len(neutral))
    return Front(neutral, flesh, _triangles(rig, *EYES), drop)


def skin_of(front: Front) -> Skin:
    """Return the surface of a head that another one is laid over."""
    return Skin(front.vertices, front.skin, front.drop)


def bundled_on(template: Rig, wears: str, front: Front, findings: Findings) -> Skin | None:
    """Return a bundled head's flesh, lying on a foreign head's; none where too little of a face is found.

    Args:
        template: the bundled rig.
        wears: which of its heads.
        front: the foreign head.
        findings: is told by how many places of a face.
    """
    own = front_of(template, wears)
    places, goals = own.landmarks(), front.landmarks()
    shared = len(set(places) & set(goals))
    if shared < LEAST_SHARED:
        findings.missing.append(
            f"Only {shared} of {len(places)} places of a face were found, for want of eyes and jaw: its look is in flat"
            " colours, and nothing is known of its mouth."
        )
        return None
    findings.guessed.append(f"The bundled head was laid over it by {shared} of {len(places)} places of a face.")
    return laid_over(skin_of(own), skin_of(front), places, goals)


def _triangles(rig: Rig, *parts: str) -> NDArray[np.int32]:
    rows = [rig.triangles[slice(*rig.parts[name])] for name in parts if name in rig.parts]
    return np.concatenate([np.zeros((0, 3), np.int32), *rows])
