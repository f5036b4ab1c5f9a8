"""Takes the last touches of lips and teeth out of the neutral heads.

Sealed lips touch, and on some heads a tooth stands in the lower lip. Then the neutral itself would be corrected,
and with it every face. The judge says where something collides; there, and only a few millimetres around, so
that no slit opens, the head is moved as the collision correctives would.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.distance import cdist

from emogen_core.correctives.collision.detect import detect
from emogen_core.correctives.collision.model import ZONES

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.correctives.collision.detect import Contacts
    from emogen_core.correctives.collision.regions import Anchors
    from emogen_core.face.rig import Rig

# Millimetres: less than what counts on a face, and what is added to a depth.
TOLERANCE = 0.07
MARGIN = 0.0
ROUNDS = 20
_REACH = 1.3


def settled(rig: Rig, neutral: NDArray[np.floating], anchors: Anchors, target: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return a (N, 3) neutral, of the rig's mesh, in which neither lips nor teeth collide.

    Args:
        rig: its collision correctives part what collides.
        neutral: (N, 3) millimetres.
        anchors: `judge_anchors` of the rig.
        target: `target_faces` of the rig.
    """
    mesh = neutral.astype(np.float64)
    lips, teeth = (_opening(part) for part in np.split(rig.offsets[-2 * ZONES :].astype(np.float64), 2))
    for _ in range(ROUNDS):
        points = anchors.sample(mesh[None])[0]
        found = detect(points, anchors.kind, mesh, target, tolerance=TOLERANCE)
        if not found.collides:
            break
        mesh += lips * _bump(mesh, points, found.lips) + teeth * _bump(mesh, points, found.teeth)
    return mesh


def _opening(correctives: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (N, 3) the motion of all zones together, scaled to part what collides by one millimetre."""
    together = correctives.sum(0)
    opening: NDArray[np.float64] = together / (together.max() - together.min())
    return opening


def _bump(mesh: NDArray[np.float64], points: NDArray[np.float64], contacts: Contacts) -> NDArray[np.float64]:
    """Return (N, 1) millimetres of opening: the depth at a contact, falling off within a few millimetres."""
    bump = np.zeros((len(mesh), 1))
    if not len(contacts):
        return bump
    places = points[contacts.anchor]
    reach = 4 * _REACH
    near = np.flatnonzero(((mesh > places.min(0) - reach) & (mesh < places.max(0) + reach)).all(1))
    away = cdist(mesh[near], places, "sqeuclidean")
    bump[near, 0] = ((contacts.depth + MARGIN) * np.exp(-away / (2 * _REACH**2))).max(1)
    return bump
