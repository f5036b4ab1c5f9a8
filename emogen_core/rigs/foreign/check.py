"""What a head model must be before anything is made of it; each refusal names the part or the shape."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.foreign.names import meaning
from emogen_core.rigs.foreign.parts import roles_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings, HeadModel

MIN_VERTICES = 100
MAX_VERTICES = 200_000
MAX_SHAPES = 1000
LONGEST_NAME = 64

# Half of a head's vertices, back and all, never move farther than this share of its size: they are of another order.
_STAYS = 0.1
# Parts of which the front is drawn, or taken for what lips meet, even where they are open.
_FACING = ("skin", "eyes", "teeth")


def check_model(model: HeadModel, findings: Findings) -> None:
    """Refuse a model that cannot become a rig, whatever its unit and axes.

    Raises:
        InvalidInputError: too small or too large; no expressions, or names that are none, or none that is known; a
            movement twice; numbers that are not finite; movements of nothing, longer than the head, or of most of it;
            an edge with more than two triangles, neighbours that face opposite ways, or a part inside out.
    """
    _check_size(model)
    _check_names(model)
    _check_finite(model)
    _check_reach(model)
    for part in model.parts:
        _check_surface(model, part)
    _check_outward(model)
    still = [name for name, offsets in model.expressions.items() if not offsets.any()]
    if len(still) == len(model.expressions):
        wanted = "expressions that move the neutral's vertices"
        raise InvalidInputError(f"{model.name}: expected {wanted}, got none that does; export shapes, not the neutral")
    if still:
        findings.missing.append(f"{len(still)} expressions move nothing: {counted(still)}.")


def _check_size(model: HeadModel) -> None:
    if not len(model.triangles):
        raise InvalidInputError(f"{model.name}: expected triangles, got none")
    if len(model.vertices) < MIN_VERTICES:
        wanted = f"a head of at least {MIN_VERTICES} vertices"
        raise InvalidInputError(f"{model.name}: {expected(wanted, len(model.vertices))}; is it the right file?")
    counts = (len(model.vertices), len(model.expressions) + len(model.identity_modes))
    if counts[0] > MAX_VERTICES or counts[1] > MAX_SHAPES:
        wanted = f"at most {MAX_VERTICES} vertices and {MAX_SHAPES} shapes"
        raise InvalidInputError(f"{model.name}: {expected(wanted, counts)}; leave out clothes and hair")


def _check_names(model: HeadModel) -> None:
    names = tuple(model.expressions)
    if not names:
        raise InvalidInputError(f"{model.name}: expected expressions (morph targets or OBJ files), got none")
    wrong = [name for name in names if not _is_name(name)]
    if wrong:
        raise InvalidInputError(f"names: {expected(f'1 to {LONGEST_NAME} letters', wrong[0])}; name every expression")
    if not any(meaning(name).known for name in names):
        wanted = "names of ARKit or ICT-FaceKit, as jawOpen and eyeBlink_L"
        got = counted(names)
        raise InvalidInputError(f"names: expected {wanted}, got {got}; rename the expressions that are such")
    _check_once(names)


def _is_name(name: object) -> bool:
    return isinstance(name, str) and bool(name.strip()) and len(name) <= LONGEST_NAME and name.isprintable()


def _check_once(names: Sequence[str]) -> None:
    first: dict[str, str] = {}
    for name in names:
        other = first.setdefault(meaning(name).standard, name)
        if other != name and meaning(name).known:
            raise InvalidInputError(f"names: expected every movement once, got {other} and {name}; leave out one")


def _check_finite(model: HeadModel) -> None:
    for name, values in (("neutral", model.vertices), *model.expressions.items(), *model.identity_modes.items()):
        wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
        if len(wrong):
            got = f"{values[wrong[0]].tolist()} at vertex {wrong[0]}, and {len(wrong) - 1} more such"
            raise InvalidInputError(f"{name}: expected finite coordinates, got {got}; export it again")


def _check_reach(model: HeadModel) -> None:
    """Refuse movements that are longer than the head is large, or of most of it: another unit, or another order."""
    large = float(np.ptp(model.vertices.astype(np.float64), axis=0).max())
    for name, offsets in (*model.expressions.items(), *model.identity_modes.items()):
        longest = float(np.abs(offsets).max())
        if longest > large:
            wanted = f"movements shorter than the head's {large:.4g}"
            raise InvalidInputError(
                f"{name}: expected {wanted}, got {longest:.4g}; is it in the neutral's unit and place?"
            )
        usual = float(np.median(np.linalg.norm(offsets, axis=1)))
        if usual > _STAYS * large:
            wanted = f"most vertices within {_STAYS * large:.4g} of where the neutral has them"
            raise InvalidInputError(
                f"{name}: expected {wanted}, got {usual:.4g} away; is it in the neutral's unit, place and order?"
            )


def _check_surface(model: HeadModel, part: str) -> None:
    """Refuse a part that is no orientable surface: then no side of it is the outside."""
    triangles = model.triangles[slice(*model.parts[part])]
    twice = int((triangles == np.roll(triangles, 1, axis=1)).any(axis=1).sum())
    if twice:
        raise InvalidInputError(
            f"part {part}: expected triangles of three vertices, got {twice} with one twice; mend it"
        )
    directed = _edges(triangles)
    shared, counts = np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)
    if (counts > 2).any():
        first = shared[counts > 2][0].tolist()
        got = f"{int((counts > 2).sum())} edges with more, as between vertices {first[0]} and {first[1]}"
        raise InvalidInputError(
            f"part {part}: expected edges of one or two triangles, got {got}; mend or remove the part"
        )
    same, times = np.unique(directed, axis=0, return_counts=True)
    if (times > 1).any():
        first = same[times > 1][0].tolist()
        got = f"{int((times > 1).sum())} edges where they differ, as between vertices {first[0]} and {first[1]}"
        wanted = "neighbours that face the same way"
        raise InvalidInputError(f"part {part}: expected {wanted}, got {got}; recalculate its normals outside")


def _check_outward(model: HeadModel) -> None:
    """Refuse skin, eyes, teeth and closed parts that are inside out; of other open parts nobody can tell."""
    facing = {part for role in _FACING for part in roles_of(model)[role]}
    for part in model.parts:
        triangles = model.triangles[slice(*model.parts[part])]
        if (part in facing or _is_closed(triangles)) and _volume(model.vertices, triangles) < 0:
            raise InvalidInputError(f"part {part}: expected its front outside, got it inside out; flip its normals")


def _edges(triangles: NDArray[np.int32]) -> NDArray[np.int32]:
    return triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)


def _is_closed(triangles: NDArray[np.int32]) -> bool:
    _, counts = np.unique(np.sort(_edges(triangles), axis=1), axis=0, return_counts=True)
    return bool((counts == 2).all())


def _volume(vertices: NDArray[np.float32], triangles: NDArray[np.int32]) -> float:
    """Return the signed volume under triangles, from the middle of their box: positive if they face out."""
    if not len(triangles):
        return 0.0
    used = vertices[triangles].astype(np.float64)
    corners = used - (used.min(axis=(0, 1)) + used.max(axis=(0, 1))) / 2
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6
