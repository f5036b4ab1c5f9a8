"""A head that feature points drive, with the correctives that faces get in a study."""

from __future__ import annotations

from typing import TYPE_CHECKING

from emogen_core.correctives.pipeline import combined_weights, corrected_weights
from emogen_core.landmarks.head import DrivenHead

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig


def driven_head(rig: Rig, identity: str = "") -> DrivenHead:
    """Return an identity of a rig, its first by default, ready for `emogen_core.landmarks`.

    Raises:
        InvalidInputError: the rig has no such identity.
    """
    who = identity or rig.identities[0]
    rig.neutral(who)
    return DrivenHead(
        rig,
        who,
        lambda core: combined_weights(rig, core),
        lambda weights: corrected_weights(rig, who, weights).weights,
    )
