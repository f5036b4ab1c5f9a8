"""Lids of a foreign head: closing that stops short is lengthened where it does, and kept out of the eyeballs.

Artists close lids over the eyeballs that they look at, which may be drawn smaller, or moved by a bone. Looked at column
by column across the eye, closing at weight 1 is lengthened by what is still open, so that the line of the lids is the
artist's wherever they meet.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import maximum_filter1d

from emogen_core.rigs.eyeballs import RADIUS
from emogen_core.rigs.fitting import CLOSING, LID_GENES, Head, clear_lids, cleared, gene_offsets
from emogen_core.rigs.lids import EDGE, VIEWS, eye_depths, lid_rings, visible_area
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.fitting import Members, Mesh, Meshes
    from emogen_core.rigs.foreign.model import Findings
    from emogen_core.rigs.imported.gaze import Eyeball

# Changes of a gene below this, millimetres, are what its artist's rounding leaves: it stays as it is.
_NOTABLE = 0.5
# Square millimetres of an eyeball, about one line of sight, that may show between closed lids.
SHOWN = 0.1

# Between lines of sight, millimetres.
_PITCH = 0.25
# Lids that are lengthened end up to so far beyond each other, millimetres, in so many rounds, and by no larger share.
_OVERLAP, _ROUNDS, _MOST = 0.2, 6, 0.4
# Columns over which a change fades.
_FADE = 21


def head_of(neutral: NDArray[np.floating], eyes: Mapping[str, Eyeball]) -> Head:
    """Return a (N, 3) head whose lids are kept out of its eyeballs; of none if it has no eyes."""
    left, mesh = eyes.get("left"), neutral.astype(np.float64)
    return Head(mesh, np.zeros(3), 0.0) if left is None else Head(mesh, left.centre, left.radius)


def with_fitted_lids(rig: Rig, eyes: Mapping[str, Eyeball], findings: Findings) -> Rig:
    """Return a bare rig whose lids close on its first head and stay out of the eyeballs.

    Args:
        rig: without correctives.
        eyes: ``left`` and ``right``; lids of a head without them are left alone.
        findings: is told how much of an eye showed between closed lids, and shows now.
    """
    topology = RigTopology(rig)
    members = {gene.name: gene.members for gene in rig.genes if gene.name in LID_GENES}
    if not members or len(eyes) < 2 or not (lid_rings(topology) == EDGE).any():
        return rig
    head = head_of(rig.neutral(rig.identities[0]), eyes)
    core = {name: offsets.astype(np.float64) for name, offsets in zip(rig.core_shapes, rig.offsets, strict=True)}
    if len(members.get(CLOSING, ())) == 2:
        core = _closing(topology, head, core, members, findings)
    cleared = clear_lids(topology, head, core, {gene.name: gene.members for gene in rig.genes})
    core |= {name: moved for name, moved in cleared.items() if np.abs(moved - core[name]).max() > _NOTABLE}
    return replace(rig, offsets=np.stack([core[name] for name in rig.core_shapes]).astype(np.float32))


def _closing(topology: RigTopology, head: Head, core: Meshes, members: Members, findings: Findings) -> Meshes:
    """Return the core shapes with lids that close, as far as they can be made to."""
    pair = members[CLOSING]
    before = _shown(topology, head, core, pair)
    if before <= SHOWN:
        return core
    scale = _lengthened(topology, head, core[pair[0]] + core[pair[1]])
    fitted = core | {name: scale * core[name] for name in pair}
    fitted |= clear_lids(topology, head, fitted, {CLOSING: pair})
    after = _shown(topology, head, fitted, pair)
    if after < before:
        longest = 100 * (scale.max() - 1)
        findings.found.append(
            f"Closed lids let {before:.1f} mm2 of an eye be seen; they were lengthened by up to {longest:.0f} %, and"
            f" {after:.1f} mm2 are left."
        )
    if min(before, after) > SHOWN:
        findings.missing.append(f"{CLOSING}: {min(before, after):.1f} mm2 of an eye show between closed lids.")
    return fitted if after < before else core


def _lengthened(topology: RigTopology, head: Head, closing: Mesh) -> Mesh:
    """Return (N, 1) by how much (N, 3) closing offsets of both eyes must be longer so that the lids meet."""
    across, columns = np.abs(head.neutral[:, 0]), head.eye_centre[0] + np.arange(-RADIUS, RADIUS, _PITCH)
    # Lids travel as far at the corners as in the middle, though less is open there.
    travel = max(_openings(topology, head, head.neutral).max(), _OVERLAP)
    longer, scale = np.zeros(len(columns)), np.ones((len(across), 1))
    for _ in range(_ROUNDS):
        opened = _openings(topology, head, head.neutral + cleared(topology, head, scale * closing))
        if not opened.any():
            break
        longer += _faded((opened + _OVERLAP * (opened > 0)) / travel)
        scale = 1 + np.interp(across, columns, np.minimum(longer, _MOST))[:, None]
    return scale


def _openings(topology: RigTopology, head: Head, mesh: Mesh) -> NDArray[np.float64]:
    """Return (columns,) how many millimetres of the left eyeball show, the most of all views."""
    views = [eye_depths(topology, mesh, head.eye_centre, view, _PITCH) for view in VIEWS]
    shown = [(np.isfinite(ball) & (skin < ball)).sum(1) for ball, skin in views]
    return np.asarray(_PITCH * np.max(shown, axis=0), np.float64)


def _faded(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (columns,) values that change slowly from column to column, none less than it was."""
    kernel = np.hanning(_FADE + 2)[1:-1]
    padded = np.pad(maximum_filter1d(values, _FADE), _FADE // 2, mode="edge")
    return np.convolve(padded, kernel / kernel.sum(), "valid")


def _shown(topology: RigTopology, head: Head, core: Meshes, pair: tuple[str, ...]) -> float:
    """Return how many square millimetres of the left eyeball show at full closing, the most of all views."""
    mesh = head.neutral + gene_offsets(core, {CLOSING: pair})[CLOSING]
    return max(visible_area(topology, mesh, head.eye_centre, view) for view in VIEWS)
