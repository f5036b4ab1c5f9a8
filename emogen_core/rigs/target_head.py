"""The head that reference expressions are drawn on: one that the rig wears, or a neutral from a file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from trimesh.registration import procrustes

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.files import read_limited
from emogen_core.rigs.foreign.obj import parse_obj

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.foreign.obj import ObjMesh

# Heads differ by a few percent of their size, vertices in another order by all of it.
_FURTHEST = 0.25


def target_head(rig: Rig, target: str) -> tuple[Rig, str]:
    """Return a rig that wears a head, and the name under which it does.

    Args:
        rig: the face model.
        target: one of its identities, the path of an OBJ file with the same vertices, or empty for its first identity.

    Raises:
        InvalidInputError: neither an identity nor such a file; as `read_mesh` and `aligned`.
    """
    if not target:
        return rig, rig.identities[0]
    if target in rig.neutrals:
        return rig, target
    if not Path(target).is_file():
        wanted = f"one of {list(rig.identities)} or an OBJ file"
        raise InvalidInputError(f"target: {expected(wanted, target)}")
    name = Path(target).stem
    mesh = aligned(read_mesh(Path(target)).vertices, rig.neutral(rig.identities[0]))
    return replace(rig, neutrals={**rig.neutrals, name: mesh.astype(np.float32)}), name


def read_mesh(path: Path, neutral: ObjMesh | None = None) -> ObjMesh:
    """Return a head from an OBJ file, in its order and unit, as an import of heads reads it.

    Args:
        path: the file.
        neutral: the same head at rest, whose vertices and faces it has to have.

    Raises:
        InvalidInputError: the file cannot be read or is no OBJ, a position is not finite, or the mesh is another.
    """
    mesh = parse_obj(read_limited(path), path.name, neutral)
    bad = np.flatnonzero(~np.isfinite(mesh.vertices).all(1))
    if len(bad):
        got = f"{mesh.vertices[bad[0]].tolist()} at vertex {bad[0]}, and {len(bad) - 1} more such"
        raise InvalidInputError(f"{path.name}: expected finite coordinates, got {got}; export it again")
    return mesh


def aligned(mesh: NDArray[np.float64], template: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return a mesh moved, turned and scaled onto a template, so that heads in any unit have the same place and size.

    Args:
        mesh: (n, 3).
        template: (N, 3), millimetres.

    Raises:
        InvalidInputError: the vertices are not those of the template, in the same order.
    """
    if len(mesh) != len(template):
        raise InvalidInputError(
            f"target: {expected(f'{len(template)} vertices', len(mesh))}; it has to be the rig's mesh, vertex by vertex"
        )
    size = float(np.sqrt(((template - template.mean(0)) ** 2).sum(1).mean()))
    moved: NDArray[np.float64]
    if not np.ptp(mesh, axis=0).any():
        raise InvalidInputError(f"target: {expected('a head', 'all vertices in one place')}")
    _, moved, _ = procrustes(mesh, template.astype(np.float64), reflection=False)
    away = float(np.sqrt(((moved - template) ** 2).sum(1).mean())) / size
    if away > _FURTHEST:
        wanted = expected(
            "the rig's vertices in the rig's order", f"vertices {100 * away:.0f} % of the head's size away"
        )
        raise InvalidInputError(f"target: {wanted}; export it without reordering vertices")
    return moved
