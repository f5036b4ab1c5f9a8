"""What of a rig there is to pack."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.transfer.packing.template import Template

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


def template_of(rig: Rig, target: NDArray[np.floating] | None = None) -> Template:
    """Return a rig's core shapes on its first identity; correctives follow from them, and are never posed.

    Shapes of disabled genes are left out: the rig has them switched off, and some of them (pupils) nobody can pose. So
    are shapes that move nothing. What is inside of the mouth or behind the lids does not count where the rig has a part
    ``skin``.

    Args:
        rig: the face model.
        target: (N, 3) neutral of the head that expressions are made for, millimetres; the rig's own without it.

    Raises:
        InvalidInputError: no shape is left.
    """
    gene_of = {member: gene for gene in rig.genes for member in gene.members}
    flags = [gene_of[name].flags if name in gene_of else frozenset[str]() for name in rig.core_shapes]
    packed = [k for k, known in enumerate(flags) if "disabled" not in known and rig.offsets[k].any()]
    if not packed:
        raise InvalidInputError(f"shapes: {expected('core shapes that move something', 0)}; pack a rig that has some")
    names = tuple(rig.core_shapes[k] for k in packed)
    gaze = tuple(place for place, k in enumerate(packed) if "gaze" in flags[k])
    neutral = rig.neutral(rig.identities[0])
    return Template(names, neutral, rig.offsets[packed], rig.triangles, target, _visible(rig), gaze)


def _visible(rig: Rig) -> NDArray[np.bool_] | None:
    if "skin" not in rig.parts:
        return None
    visible = np.zeros(rig.offsets.shape[1], bool)
    visible[rig.triangles[slice(*rig.parts["skin"])]] = True
    return visible
