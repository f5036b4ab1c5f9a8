"""Lids of a foreign head: closing that stops short is fitted to its eyeballs as the bundled head's is.

Artists close lids over the eyeballs that they look at, which may be drawn smaller, or moved by a bone. Where nothing
of an eyeball shows at weight 1 the closing is left as it is; lids are kept out of the eyeballs either way.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.rigs.fitting import CLOSING, LID_GENES, Head, clear_lids, closed_lids, gene_offsets
from emogen_core.rigs.lids import EDGE, VIEWS, lid_rings, visible_area
from emogen_core.rigs.topology import RigTopology

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.fitting import Members, Meshes
    from emogen_core.rigs.foreign.model import Findings
    from emogen_core.rigs.imported.gaze import Eyeball

# Changes of a gene below this, millimetres, are what its artist's rounding leaves: it stays as it is.
_NOTABLE = 0.5
# Square millimetres of an eyeball, about one line of sight, that may show between closed lids.
SHOWN = 0.1


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
    fitted, before = core, _shown(topology, head, core, members)
    if before > SHOWN:
        fitted = core | closed_lids(topology, head, core)
        fitted |= clear_lids(topology, head, fitted, {CLOSING: members[CLOSING]})
    after = _shown(topology, head, fitted, members)
    if after >= before > SHOWN:
        fitted, after = core, before
    elif before > SHOWN:
        findings.found.append(
            f"Closed lids let {before:.1f} mm2 of an eye be seen; they were lengthened, and {after:.1f} mm2 are left."
        )
    if after > SHOWN:
        findings.missing.append(f"{CLOSING}: {after:.1f} mm2 of an eye show between closed lids.")
    return fitted


def _shown(topology: RigTopology, head: Head, core: Meshes, members: Members) -> float:
    """Return how many square millimetres of the left eyeball show at full closing, the most of all views."""
    mesh = head.neutral + gene_offsets(core, {CLOSING: members[CLOSING]})[CLOSING]
    return max(visible_area(topology, mesh, head.eye_centre, view) for view in VIEWS)
