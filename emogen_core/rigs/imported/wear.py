"""Puts a head of identity modes on the rig that they were imported with: mixed, placed, and its mouth put at rest."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.model_identity import known_as, model_document
from emogen_core.rendering.worn import WornHead
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.imported.heads import mixed_head
from emogen_core.rigs.imported.lying import EYES, front_of
from emogen_core.rigs.imported.mouth import freed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.model_identity import ModelIdentity
    from emogen_core.face.modes import ModeSpace
    from emogen_core.face.rig import Rig


def wear_modes(rig: Rig, space: ModeSpace, identity: ModelIdentity) -> WornHead:
    """Return a head as drawing processes and rigs take it in, named as studies name it.

    Its lips and teeth are freed at rest as an import does it; its shapes are the rig's.

    Args:
        rig: the one that was imported; its first head is what the modes are added to.
        space: its modes.
        identity: the head.

    Raises:
        RigFileError: the modes are of another rig.
        IdentityError: the head is none of these modes.
    """
    space.check_rig(rig)
    signed = model_document(identity, space)
    first = rig.identities[0]
    mixed = mixed_head(rig.neutral(first), space.modes, signed["modes"], _vertices(rig, *EYES))
    rested = freed(replace(rig, neutrals={first: mixed}), front_of(rig).drop, Findings())
    return WornHead(known_as(signed), rested.neutral(first), None, {}, first)


def _vertices(rig: Rig, *parts: str) -> NDArray[np.intp]:
    rows = [rig.triangles[slice(*rig.parts[name])].ravel() for name in parts if name in rig.parts]
    return np.unique(np.concatenate([np.zeros(0, np.int32), *rows])).astype(np.intp)
