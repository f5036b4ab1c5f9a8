"""A head that feature points drive, with the correctives that faces get in a study."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import combined_weights, corrected_weights
from emogen_core.landmarks.head import DrivenHead
from emogen_core.landmarks.points import FeaturePoint, bundled_points, is_bundled_mesh
from emogen_core.rigs.imported.points import placed_points

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.face.rig import Rig


def driven_head(rig: Rig, identity: str = "", points: Sequence[FeaturePoint] = ()) -> DrivenHead:
    """Return an identity of a rig, its first by default, ready for `emogen_core.landmarks`.

    Args:
        rig: the face model.
        identity: one of its heads.
        points: its feature points, where they are known already.

    Raises:
        InvalidInputError: the rig has no such identity; or, once points are asked for, no face on which they are found.
    """
    who = identity or rig.identities[0]
    rig.neutral(who)
    return DrivenHead(
        rig,
        who,
        lambda core: combined_weights(rig, core),
        lambda weights: corrected_weights(rig, who, weights).weights,
        lambda: np.array([point.vertex for point in points or feature_points(rig)], np.intp),
    )


def feature_points(rig: Rig) -> tuple[FeaturePoint, ...]:
    """Return the 56 points on a rig: by number on the bundled mesh, by laying the bundled head over any other.

    Raises:
        InvalidInputError: too little of a face is found.
    """
    return bundled_points(rig) if is_bundled_mesh(rig) else placed_points(rig)
