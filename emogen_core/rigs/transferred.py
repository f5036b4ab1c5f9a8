"""A rig for a head that it was not made for: its shapes carried over (`emogen_core.transfer`) and fitted to the head.

Where the mesh is the bundled one, what the space of heads does for its own heads is done for this one as well: lids are
fitted to its eyes, lips that close are sealed. Elsewhere nothing is known of lids and lips, and the shapes stay as they
were carried over.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.pipeline import combined_weights
from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.space import topology_hash
from emogen_core.rigs.adapt import Fitter
from emogen_core.rigs.fitting import Head
from emogen_core.rigs.head_check import eye_centre
from emogen_core.rigs.target_head import aligned
from emogen_core.rigs.topology import RigTopology
from emogen_core.transfer.alignment import align
from emogen_core.transfer.blendshapes import Template, Training, check_meshes, transfer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace

    Mesh = NDArray[np.float64]

UNITS = {"mm": 1.0, "cm": 0.1, "inches": 1 / 25.4, "m": 0.001}
"""Unit -> how many of it make a millimetre."""
# Heads differ in size by less than this factor; else the unit is unknown.
_SIZES = 1.5
_EYES = ("eye_left", "eye_right")


@dataclass(frozen=True, eq=False)
class Target:
    """A head that a rig is to wear, in the frame of the rig.

    Attributes:
        neutral: (N, 3) millimetres.
        expressions: (E, N, 3) of it, millimetres.
        weights: (E, C) of the rig's core shapes in the expressions.
        unit: what it came in, one of `UNITS`, or ``unknown``: then it was made as large as the template.
    """

    neutral: Mesh
    expressions: Mesh
    weights: Mesh
    unit: str = "mm"


def posed(rig: Rig, neutral: Mesh, expressions: Mesh, weights: Mesh) -> Target:
    """Return a head in a rig's frame, whatever frame and unit it comes in; expressions move along with the neutral.

    Args:
        rig: the face model.
        neutral: (N, 3) its vertices in the rig's order.
        expressions: (E, N, 3) in the frame and unit of the neutral.
        weights: (E, C) of the core shapes.

    Raises:
        InvalidInputError: other vertices than the rig's, or in another order, or no head.
    """
    here = rig.neutral(rig.identities[0])
    check_meshes("target", neutral, here.shape)
    aligned(neutral, here)
    found = align(here, neutral)
    unit = min(UNITS, key=lambda name: abs(np.log(found.scale / UNITS[name])))
    known = abs(np.log(found.scale / UNITS[unit])) < np.log(_SIZES)
    sized = replace(found, scale=UNITS[unit] if known else found.scale)
    mesh = sized.onto_template(neutral)
    shift = _middle(rig, here) - _middle(rig, mesh)
    moved = sized.onto_template(expressions) + shift
    return Target(mesh + shift, moved, weights, unit if known else "unknown")


def transferred(
    rig: Rig, target: Target, name: str, *, method: str = "fields", space: IdentitySpace | None = None
) -> Rig:
    """Return the rig of one head: the template's, with all of its shapes carried over.

    Args:
        rig: the template, as its first identity wears it.
        target: the head, in the rig's frame.
        name: of the head, and of the rig after the template's.
        method: see `emogen_core.transfer.blendshapes`.
        space: the rig's space of heads; with it lids and lips are fitted.

    Raises:
        InvalidInputError: an array does not fit, no such method, or the space is of another mesh.
    """
    first = rig.identities[0]
    template = Template(rig.neutral(first), rig.shape_offsets(first), rig.triangles)
    training = Training(_worn(rig, target.weights), target.expressions) if len(target.weights) else None
    carried = transfer(template, target.neutral, training, method)
    made = replace(
        rig,
        name=f"{rig.name}-{name}",
        hash="",
        neutrals={name: target.neutral.astype(np.float32)},
        offsets=carried.astype(np.float32),
        adjustments={},
    )
    return _fitted(made, space) if space else made


def _worn(rig: Rig, core: Mesh) -> Mesh:
    """Return (E, K) weights of all shapes: who poses two that have a combinational corrective shows that as well."""
    worn: Mesh = combined_weights(rig, np.clip(np.nan_to_num(core), 0, 1)).astype(np.float64)
    worn[:, : core.shape[1]] = core
    return worn


def of_this_mesh(rig: Rig, space: IdentitySpace) -> bool:
    """Return whether a space of heads was made for a rig's mesh."""
    return topology_hash(rig.triangles, rig.mirror, rig.parts) == space.topology


def _fitted(rig: Rig, space: IdentitySpace) -> Rig:
    if not of_this_mesh(rig, space):
        raise InvalidInputError(f"rig: {expected('the mesh of the space of heads', rig.name)}")
    neutral = rig.neutral(rig.identities[0]).astype(np.float64)
    head = Head(neutral, eye_centre(RigTopology(rig), neutral))
    change = Fitter(rig, space).adjustment(head)
    offsets = rig.offsets.copy()
    offsets[change.shapes] += change.offsets
    return replace(rig, offsets=offsets)


def _middle(rig: Rig, mesh: NDArray[np.floating]) -> Mesh:
    """Return the (3,) point between the eyes, or of the whole mesh where the rig has no eyeballs."""
    if not set(_EYES) <= set(rig.parts):
        return np.asarray(mesh.mean(0), np.float64)
    eyes = np.unique(np.concatenate([rig.triangles[slice(*rig.parts[eye])].ravel() for eye in _EYES]))
    return np.asarray(mesh[eyes].mean(0), np.float64)
