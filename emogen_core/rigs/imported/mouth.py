"""The mouth of a foreign head: what keeps its lips and teeth apart, by the bundled rig's own procedures."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.detect import detect
from emogen_core.correctives.collision.regions import ANCHORED, LOWER_LIP, has_regions
from emogen_core.rendering.normals import NormalField
from emogen_core.rigs.canvas import smoothstep
from emogen_core.rigs.collision_bake import TOLERANCE
from emogen_core.rigs.collision_shapes import COLLISION_SHAPES, collision_offsets, mouth_regions
from emogen_core.rigs.shut_mouth import shut_mouth
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.foreign.model import Findings

    Floats = NDArray[np.float64]

# From this to that share of the chin's way with an open jaw, skin goes from the upper lip to the lower one.
_LOW = (0.155, 0.57)
# Teeth whose normal leads so far inwards, millimetres times its length, belong to the inner side.
_INNER = -3.0
# Moved by more than this, millimetres, a neutral was changed.
_MOVED = 0.01
_ROUNDS = 4


def drop_of(shapes: Mapping[str, NDArray[np.float32]], flesh: NDArray[np.intp], count: int) -> Floats:
    """Return (N,) how far an open jaw takes every vertex down, as a share of the farthest; zeros without a jaw."""
    if "jawOpen" not in shapes:
        return np.zeros(count)
    down = -shapes["jawOpen"][:, 1].astype(np.float64)
    farthest = float(down[flesh].max(initial=0))
    return np.clip(down / farthest, 0, 1) if farthest > 0 else np.zeros(count)


def lower_side(drop: Floats) -> Floats:
    """Return (N,) 0 on the upper, 1 on the lower lip and jaw."""
    return np.asarray(smoothstep(drop, *_LOW), np.float64)


def with_collision_correctives(rig: Rig, drop: Floats, findings: Findings) -> Rig:
    """Return a rig with regions and the eight collision correctives, or as it was where its mesh has no such mouth.

    Args:
        rig: without collision correctives, its first head with closed lips.
        drop: (N,) as `drop_of`.
        findings: is told what the mouth lacks.
    """
    topology, low = RigTopology(rig), lower_side(drop)
    neutral = rig.neutral(rig.identities[0]).astype(np.float64)
    lacking = [name for name in ("mouth", "teeth_upper", "teeth_lower") if not _has(rig, name)]
    if not drop.any():
        lacking.append("jawOpen")
    if lacking:
        findings.missing.append(f"Collisions of the lips are not corrected: no {', '.join(lacking)}.")
        return rig
    regions = mouth_regions(topology, low, neutral, _outside(topology, neutral))
    empty = [name for name in (LOWER_LIP, *ANCHORED) if not len(regions[name])]
    if empty:
        findings.missing.append(f"Collisions of the lips are not corrected: no {', '.join(empty)} was found.")
        return rig
    offsets = collision_offsets(topology, low, neutral).astype(np.float32)
    findings.guessed.extend(f"{name}: {len(rows)} vertices." for name, rows in regions.items())
    return replace(
        rig,
        collision_shapes=COLLISION_SHAPES,
        offsets=np.concatenate([rig.offsets, offsets]),
        regions={**rig.regions, **regions},
    )


def freed(rig: Rig, drop: Floats, findings: Findings) -> Rig:
    """Return a rig whose heads neither collide nor show a tooth at rest, or every face of theirs would be corrected."""
    if not has_regions(rig):
        return rig
    mouth = shut_mouth(rig, lower_side(drop))
    anchors = mouth.anchors
    neutrals, told = {}, []
    for name, neutral in rig.neutrals.items():
        mesh = mouth.freed(neutral.astype(np.float64), _ROUNDS)
        moved = float(np.abs(mesh - neutral).max())
        if moved > _MOVED:
            told.append(f"{name} by {moved:.2f} mm")
        left = detect(anchors.sample(mesh[None])[0], anchors.kind, mesh, mouth.target, tolerance=TOLERANCE)
        if left.collides:
            findings.missing.append(f"{name}: lips or teeth still touch at rest; close its lips before importing it.")
        neutrals[name] = mesh.astype(np.float32)
    if told:
        findings.found.append(f"Lips that touched or showed teeth at rest were moved: {', '.join(told)}.")
    return replace(rig, neutrals=neutrals)


def _outside(topology: RigTopology, neutral: Floats) -> NDArray[np.bool_]:
    """Return (N,) which vertices of teeth face away from the middle of the jaw, edges included."""
    outside = np.zeros(len(neutral), bool)
    normals = NormalField(topology.triangles, len(neutral))(neutral.astype(np.float32))
    for jaw in ("teeth_upper", "teeth_lower"):
        rows = topology.part_vertices(jaw)
        middle = neutral[rows].mean(0) * (0, 1, 1)
        outside[rows] = (normals[rows] * (neutral[rows] - middle) * (1, 0, 1)).sum(1) > _INNER
    return outside


def _has(rig: Rig, part: str) -> bool:
    first, last = rig.parts.get(part, (0, 0))
    return last > first
