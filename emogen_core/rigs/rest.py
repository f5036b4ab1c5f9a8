"""The rest pose: a rule that makes a neutral head read as neutral, whatever its sex and age.

The source's male and old heads droop: the upper lid hides half of the iris, brows press on the eyes, the mouth's
corners hang. To a rater that is sleepy, stern or sad. In the FACS manual's neutral the upper lid just covers the top
of the iris (Ekman, Friesen & Hager 2002). So every head is brought into the same bands, and no further than their
edge: a head inside stays as it is, and skin, folds and lines, which tell its age, stay on every head.

The upper lid moves along the unit that raises it, the brows along the unit that raises them; the lower lid turns
about the eyeball and the corners of the mouth rise by a bell.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.features import IRIS_RADIUS, brow_height, corner_height, lid_covers
from emogen_core.rigs.lips import mouth_rim

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.fitting import Head
    from emogen_core.rigs.topology import Topology

    Mesh = NDArray[np.float64]

UPPER_COVER = (0.10, 0.23)
LOWER_COVER = (0.05, 0.16)
BROW_HEIGHT = (14.6, 30.0)
CORNER_HEIGHT = (1.0, 2.5)

# The rig's region with the vertices under the brows.
BROWS = "brows"
UPPER_LID_GENE, BROW_GENE = "lidUpperRaise", "browRaise"
_LARGEST_SHARE = 1.2
_LARGEST_LIFT = 4.0
_ROUNDS = 3
_STEPS = 12
_LID_REACH = 7.0
# The bell about the mouth's corner: how far outside of it, and half widths, millimetres.
_CORNER_OUT, _CORNER_WIDTHS, _CORNER_DEPTH = 2.0, (11.0, 10.0), 25.0


def rest_pose(
    topology: Topology,
    low: NDArray[np.float64],
    brows: NDArray[np.integer],
    head: Head,
    genes: Mapping[str, Mesh],
) -> Mesh:
    """Return the (N, 3) neutral with lids, brows and corners of the mouth inside their bands.

    Args:
        topology: the mesh's triangles and parts.
        low: (N,) 0 on the upper, 1 on the lower lip.
        brows: vertices under the brows.
        head: a neutral (N, 3), millimetres, and its left eyeball's centre.
        genes: gene -> (N, 3) offsets at 1 of `UPPER_LID_GENE` and `BROW_GENE`.
    """
    neutral, eye_centre = head.neutral, head.eye_centre
    mesh = neutral + _brow_share(neutral, brows, eye_centre, genes[BROW_GENE]) * genes[BROW_GENE]
    for _ in range(_ROUNDS):
        mesh = _lower_lids_moved(topology, mesh, eye_centre)
        mesh = mesh + _lid_share(topology, mesh, eye_centre, genes[UPPER_LID_GENE]) * genes[UPPER_LID_GENE]
    return corners_lifted(topology, low, mesh)


def corners_lifted(topology: Topology, low: NDArray[np.float64], mesh: Mesh) -> Mesh:
    """Return the (N, 3) mesh with the corners of the mouth inside their band."""
    for _ in range(_ROUNDS):
        missing = -_outside(corner_height(topology, low, mesh), CORNER_HEIGHT)
        lift = np.clip(missing, -_LARGEST_LIFT, _LARGEST_LIFT)
        mesh = mesh + np.array([0, lift, 0]) * corner_bell(topology, mesh)[:, None]
    return mesh


def corner_bell(topology: Topology, mesh: Mesh) -> NDArray[np.float64]:
    """Return (N,) a bell about both corners of the mouth on the skin and in the mouth, 1 in its middle."""
    corner = mesh[_mouth_corner(topology, mesh)]
    across = (np.abs(mesh[:, 0]) - corner[0] - _CORNER_OUT) / _CORNER_WIDTHS[0]
    along = (mesh[:, 1] - corner[1]) / _CORNER_WIDTHS[1]
    bell = np.zeros(len(mesh))
    flesh = topology.part_vertices("skin", "mouth")
    front = mesh[flesh, 2] > corner[2] - _CORNER_DEPTH
    bell[flesh] = np.exp(-(across[flesh] ** 2) - along[flesh] ** 2) * front
    return bell


def _brow_share(mesh: Mesh, brows: NDArray[np.integer], eye_centre: NDArray[np.float64], raised: Mesh) -> float:
    missing = _outside(brow_height(mesh, brows, eye_centre), BROW_HEIGHT)
    return -missing / float(raised[brows, 1].mean())


def _lid_share(topology: Topology, mesh: Mesh, eye_centre: NDArray[np.float64], raised: Mesh) -> float:
    """Return how much of the raised lid brings the upper lid to the edge of its band."""
    upper = lid_covers(topology, mesh, eye_centre)[0]
    excess = _outside(upper, UPPER_COVER)
    if excess == 0:
        return 0.0
    goal = upper - excess
    least, most = (0.0, _LARGEST_SHARE) if excess > 0 else (-_LARGEST_SHARE, 0.0)
    for _ in range(_STEPS):
        middle = (least + most) / 2
        hidden = lid_covers(topology, mesh + middle * raised, eye_centre)[0]
        least, most = (middle, most) if hidden > goal else (least, middle)
    return (least + most) / 2


def _lower_lids_moved(topology: Topology, mesh: Mesh, eye_centre: NDArray[np.float64]) -> Mesh:
    """Return the mesh with the lower lids turned about the eyeballs, fading below and above the rim."""
    lower = lid_covers(topology, mesh, eye_centre)[1]
    excess = _outside(lower, LOWER_COVER)
    if excess == 0:
        return mesh
    rim = (2 * lower - 1) * IRIS_RADIUS
    moved = mesh.copy()
    soft = topology.part_vertices("skin", "sockets", "lashes")
    for side in (1, -1):
        place = mesh[soft] - eye_centre * (side, 1, 1)
        angle = excess * 2 * IRIS_RADIUS / np.hypot(place[:, 1], place[:, 2]) * _lid_fade(place, rim)
        turned_y = np.cos(angle) * place[:, 1] - np.sin(angle) * place[:, 2]
        turned_z = np.cos(angle) * place[:, 2] + np.sin(angle) * place[:, 1]
        moved[soft, 1] += turned_y - place[:, 1]
        moved[soft, 2] += turned_z - place[:, 2]
    return moved


def _lid_fade(place: Mesh, rim: float) -> NDArray[np.float64]:
    """Return (n,) 1 on the lower lid's rim, falling off below it, towards the corners, and fast above it."""
    from_rim = place[:, 1] - rim
    fall = np.where(from_rim > 0, _LID_REACH / 2, _LID_REACH)
    fade: NDArray[np.float64] = np.exp(-((from_rim / fall) ** 2) - (place[:, 0] / 13) ** 4)
    return fade * (place[:, 2] > 0)


def _mouth_corner(topology: Topology, mesh: Mesh) -> int:
    rim = mouth_rim(topology)
    return int(rim[mesh[rim, 0].argmax()])


def _outside(value: float, band: tuple[float, float]) -> float:
    """Return how far a value lies above (or, negative, below) a band."""
    return max(value - band[1], 0.0) + min(value - band[0], 0.0)
