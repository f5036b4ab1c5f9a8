"""A folder of OBJ files of one vertex order: a neutral, expressions, identity modes; ICT-FaceKit is one.

ICT-FaceKit (Li et al. 2020, Learning Formation of Physically-Based Face Attributes, CVPR,
doi:10.1109/CVPR42600.2020.00347) keeps its files in a folder ``FaceXModel``, beside ``vertex_indices.json``.
"""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.files import files_of, read_limited
from emogen_core.rigs.foreign.model import HeadModel, counted
from emogen_core.rigs.foreign.obj import parse_obj, triangulated

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings
    from emogen_core.rigs.foreign.obj import ObjMesh

ICT_FOLDER = "FaceXModel"
ICT_INDEX = "vertex_indices.json"
NEUTRAL_WORDS = ("neutral", "generic", "base", "rest", "default", "bind")

_IDENTITY = re.compile(r"identity_?\d+", re.IGNORECASE)
# Differences of this fraction of the largest coordinate are the rounding of six digits, and no movement.
_ROUNDING = 5e-6


def read_obj_folder(folder: Path, findings: Findings, neutral: str = "") -> HeadModel:
    """Return the head model of a folder of OBJs, in the files' units and axes.

    Args:
        folder: with one ``.obj`` file a shape, named as the shape; or with a folder ``FaceXModel`` of such.
        findings: gets what was found, guessed and missing.
        neutral: name of the neutral's file, with or without ``.obj``; by default the one that is called so.

    Raises:
        InvalidInputError: no neutral or several, names that occur twice, a file that is none, or one whose vertices or
            faces are not the neutral's.
    """
    inside = folder / ICT_FOLDER
    folder = inside if inside.is_dir() else folder
    files = _by_name(files_of(folder, ".obj"))
    if not files:
        raise InvalidInputError(f"{folder.name}: expected OBJ files, one a shape, got none; is it the right folder?")
    rest = files.pop(_neutral(tuple(files), neutral, findings))
    mesh = parse_obj(read_limited(rest), rest.name)
    shapes = {name: _offsets(path, mesh) for name, path in files.items()}
    modes = {name: shapes.pop(name) for name in tuple(shapes) if _IDENTITY.fullmatch(name)}
    findings.found.append(
        f"{len(mesh.vertices)} vertices, {len(mesh.polygons.sizes)} faces, {len(shapes)} expressions, "
        f"{len(modes)} identity modes"
    )
    _say_expected(folder / ICT_INDEX, shapes, findings)
    triangles, texture, parts = triangulated(mesh.polygons)
    name = folder.parent.name if folder.name == ICT_FOLDER else folder.name
    vertices = mesh.vertices.astype(np.float32)
    return HeadModel(name, vertices, triangles, parts, shapes, modes, _uv(mesh.uv, texture))


def _by_name(files: list[Path]) -> dict[str, Path]:
    named = {path.stem: path for path in files}
    folded = {name.lower() for name in named}
    if len(folded) < len(files):
        twice = sorted(path.name for path in files if sum(path.stem.lower() == o.stem.lower() for o in files) > 1)
        raise InvalidInputError(f"shapes: {expected('every name once, whatever its case', twice)}; rename one")
    return named


def _neutral(names: tuple[str, ...], asked: str, findings: Findings) -> str:
    if asked:
        name = asked.removesuffix(".obj")
        if name not in names:
            raise InvalidInputError(f"neutral: {expected(f'one of {sorted(names)}', asked)}")
        return name
    likely = [n for n in names if any(word in n.lower() for word in NEUTRAL_WORDS)]
    best = [n for n in likely if "neutral" in n.lower()] or likely
    if len(best) != 1:
        wanted = f"one OBJ file called {', '.join(NEUTRAL_WORDS)} or the like"
        got = counted(sorted(best)) if best else f"none among {counted(sorted(names))}"
        raise InvalidInputError(
            f"neutral: expected {wanted}, got {got}; rename it, or say which one with --neutral NAME"
        )
    findings.guessed.append(f"The neutral is {best[0]}.obj, by its name.")
    return best[0]


def _offsets(path: Path, neutral: ObjMesh) -> NDArray[np.float32]:
    mesh = parse_obj(read_limited(path), path.name, like=neutral)
    offsets = mesh.vertices - neutral.vertices
    offsets[np.abs(offsets) < _ROUNDING * np.abs(neutral.vertices).max()] = 0
    return offsets.astype(np.float32)


def _say_expected(index: Path, shapes: dict[str, NDArray[np.float32]], findings: Findings) -> None:
    """Hold the expressions against the list that ICT-FaceKit has of them, where there is one."""
    if not index.is_file():
        return
    try:
        listed = json.loads(read_limited(index)).get("expressions", [])
    except (ValueError, AttributeError, RecursionError) as error:
        raise InvalidInputError(f"{index.name}: expected a JSON object, got {error}") from error
    absent = [name for name in listed if name not in shapes] if isinstance(listed, list) else []
    if absent:
        findings.missing.append(
            f"{len(absent)} of the {len(listed)} expressions that {index.name} lists: {counted(absent)}."
        )


def _uv(uv: NDArray[np.float64], texture: NDArray[np.int64]) -> NDArray[np.float32]:
    if not len(uv) or (texture < 0).all():
        return np.zeros((0, 3, 2), np.float32)
    return np.where(texture[..., np.newaxis] >= 0, uv[texture], 0).astype(np.float32)
