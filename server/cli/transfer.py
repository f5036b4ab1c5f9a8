"""`emogen rig transfer`: a rig's shapes on another head of the same mesh, better the more expressions it shows."""

from __future__ import annotations

import csv
import re
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from threadpoolctl import threadpool_limits

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.container import check_writable
from emogen_core.face.rig_file import save_rig
from emogen_core.face.space_file import load_bundled_space

from ..packing.files import WEIGHTS
from .common import Json, plainly, report_text, rig_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace
    from emogen_core.rigs.foreign.obj import ObjMesh
    from emogen_core.rigs.transferred import Target

    Mesh = NDArray[np.float64]

_METHODS = "fields, ridge, warp, examples, deformation or copy"
Heads = Annotated[
    list[str],
    typer.Argument(
        metavar="[TEMPLATE] TARGET_NEUTRAL",
        help="A rig file, the bundled one if left out; and an OBJ file of its mesh, or the name of one of its heads.",
    ),
]
Expressions = Annotated[
    Path | None, typer.Option(help=f"Folder with {WEIGHTS} of `emogen rig pack` and an OBJ for each expression made.")
]
Out = Annotated[Path, typer.Option("--out", help="Rig file to write.")]
Method = Annotated[str, typer.Option(help=f"{_METHODS}.")]
Name = Annotated[str, typer.Option(help="Of the head; the name of the file if left out.")]
Fit = Annotated[bool, typer.Option("--fit/--no-fit", help="Fit lids and lips, where the mesh is the bundled one.")]

_CHECKED = ("visible_at_blink_mm2", "visible_worst_mm2", "shut_teeth_mm2", "closed_emotion_teeth_mm2", "lip_gap_mm")


def transfer(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    heads: Heads, out: Out, expressions: Expressions = None, method: Method = "fields",
    name: Name = "", fit: Fit = True, json_: Json = False,
) -> None:  # fmt: skip
    """Carry a rig's shapes over to another head, and write that as a rig of its own."""
    making = import_module("emogen_core.rigs.transferred")
    with plainly(), threadpool_limits(1):
        rig, target = _template_and_target(heads)
        check_writable(out)
        head = _target(rig, target, expressions)
        space = load_bundled_space()
        known = making.of_this_mesh(rig, space)
        fitted = known and fit
        called = _slug(name or Path(target).stem)
        made = making.transferred(rig, head, called, method=method, space=space if fitted else None)
        saved = save_rig(made, out)
        report = _report(rig, saved, head, method) | {"lids_and_lips_fitted": fitted}
        report |= _checked(saved, space) if known else {}
    shown = report_text(report, as_json=json_)
    typer.echo(shown if json_ else f"{shown}\n{out}")


def _template_and_target(heads: list[str]) -> tuple[Rig, str]:
    if len(heads) > 2:
        raise InvalidInputError(f"arguments: {expected('a template and a target', heads)}")
    *template, target = heads
    return rig_of(Path(template[0]) if template else None), target


def _slug(name: str) -> str:
    """Return a name as a rig may have it: letters, digits, ``-`` and ``_``."""
    return re.sub(r"[^A-Za-z0-9_-]+", "-", name).strip("-") or "head"


def _report(template: Rig, made: Rig, head: Target, method: str) -> dict[str, Any]:
    shown = int((head.weights > 0).any(0).sum())
    return {
        "rig": made.name,
        "hash": made.hash,
        "template": template.name,
        "template_hash": template.hash,
        "head": made.identities[0],
        "method": method,
        "unit_of_target": head.unit,
        "expressions": len(head.weights),
        "core_shapes_shown": shown,
        "core_shapes": len(made.core_shapes),
    }


def _checked(made: Rig, space: IdentitySpace) -> dict[str, Any]:
    """Return whether lids close and lips meet, as `emogen rig check` measures it."""
    check = import_module("emogen_core.rigs.head_check").check_head
    found = check(made, made.identities[0], space.low.astype(np.float64))
    return {name: found[name] for name in _CHECKED}


def _target(rig: Rig, target: str, folder: Path | None) -> Target:
    """Return the head and its expressions in the rig's frame."""
    making, heads = (import_module(f"emogen_core.rigs.{name}") for name in ("transferred", "target_head"))
    weights = read_weights(folder, rig) if folder else {}
    own = target in rig.neutrals
    if not own and not Path(target).is_file():
        raise InvalidInputError(f"target: {expected(f'one of {list(rig.identities)} or an OBJ file', target)}")
    rest = None if own else heads.read_mesh(Path(target))
    meshes = _vertices(rig, {one: heads.read_mesh(folder / f"{one}.obj", rest) for one in weights} if folder else {})
    shown = meshes, np.array([*weights.values()]).reshape(-1, len(rig.core_shapes))
    if rest is None:
        worn: Target = making.Target(rig.neutral(target).astype(np.float64), *shown)
        return worn
    found: Target = making.posed(rig, rest.vertices, *shown)
    return found


def _vertices(rig: Rig, meshes: Mapping[str, ObjMesh]) -> Mesh:
    """Return the (E, V, 3) vertices of expressions."""
    shape = rig.neutral(rig.identities[0]).shape
    for name, mesh in meshes.items():
        if mesh.vertices.shape != shape:
            count = len(mesh.vertices)
            raise InvalidInputError(f"{name}.obj: {expected(f'{shape[0]} vertices', count)}; it has to be the mesh")
    return np.array([mesh.vertices for mesh in meshes.values()]).reshape(-1, *shape)


def read_weights(folder: Path, rig: Rig) -> dict[str, Mesh]:
    """Return expression -> (C,) weights of a rig's core shapes, of the expressions that a folder has an OBJ of.

    Raises:
        InvalidInputError: no table, one of another rig, a weight that is none, an OBJ that is not in it, or no OBJ.
    """
    path = folder / WEIGHTS
    try:
        rows = [*csv.reader(path.read_text("utf-8-sig").splitlines())]
    except (OSError, ValueError, csv.Error) as error:
        raise InvalidInputError(
            f"expressions: {expected(f'{WEIGHTS} of emogen rig pack', f'{path} ({error})')}"
        ) from None
    names = _columns(rows[0] if rows else [], rig)
    table = {row[0]: _weights(path, row, names, rig) for row in rows[1:] if row}
    made = sorted(one.stem for one in folder.glob("*.obj"))
    unknown = [name for name in made if name not in table]
    if unknown or not made:
        wanted = f"OBJ files named after the expressions of {WEIGHTS} ({', '.join([*table][:3])}, ...)"
        raise InvalidInputError(f"expressions: {expected(wanted, [f'{name}.obj' for name in unknown])}")
    return {name: table[name] for name in made}


def _columns(header: list[str], rig: Rig) -> list[str]:
    names = header[1:]
    unknown = [name for name in names if name not in rig.core_shapes]
    if header[:1] != ["expression"] or unknown or len(set(names)) != len(names):
        wanted = f"columns expression and core shapes of {rig.name}, each once"
        raise InvalidInputError(f"{WEIGHTS}: {expected(wanted, unknown or header[:4])}")
    return names


def _weights(path: Path, row: list[str], names: list[str], rig: Rig) -> Mesh:
    weights = np.zeros(len(rig.core_shapes))
    try:
        values = np.array(row[1:], np.float64)
        weights[[rig.core_shapes.index(name) for name in names]] = values
    except (ValueError, IndexError):
        wanted = expected(f"{len(names)} weights of {row[0]}", row[1:5])
        raise InvalidInputError(f"{path.name}: {wanted}") from None
    return weights
