"""Where a foreign head looks, and how large it is: its axes by what its expressions move, its unit by its height."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.mirror import centre_of
from emogen_core.rigs.foreign.names import meaning
from emogen_core.rigs.foreign.parts import eyeballs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import Findings, HeadModel
    from emogen_core.rigs.foreign.names import Meaning

    Floats = NDArray[np.float64]

UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4}
"""Millimetres in each unit that can be said."""

INFERRED = (180.0, 450.0)
"""Heights, millimetres, at which a unit is inferred, from a face to a head with shoulders; units do not overlap."""

SIZES = (100.0, 600.0)
"""Heights, millimetres, that are believed when the unit is said."""

_NEAR = 1.0  # millimetres: a model that is so near the right origin keeps its own
_EYES_APART = (45.0, 80.0)
_UPPER, _LOWER = ("brow", "eyeBlink", "eyeWide", "eyeSquint"), ("jawOpen", "mouth")
_AXES = ("x", "y", "z")


def placed(model: HeadModel, findings: Findings, unit: str = "") -> HeadModel:
    """Return a model in millimetres, x to its left, y up, z out of the face, the origin between its eyes.

    Args:
        model: in the file's unit and axes.
        findings: gets what was concluded.
        unit: one of `UNITS`; by default inferred from the height.

    Raises:
        InvalidInputError: an unknown unit, a size that is no head's, or shapes of the left that move the right.
    """
    turn = _axes(model, findings)
    upright = _moved(model, turn)
    scale = _scale(float(np.ptp(upright.vertices[:, 1])), unit, findings)
    sized = upright if scale == 1 else _moved(upright, np.eye(3) * scale)
    origin = _between_eyes(sized, findings)
    if np.linalg.norm(origin) < _NEAR:
        findings.found.append("The origin lies between the eyes.")
        return sized
    findings.found.append(f"The origin was moved between the eyes, by {np.round(-origin, 1).tolist()} mm.")
    return replace(sized, vertices=(sized.vertices - origin).astype(np.float32))


def _moved(model: HeadModel, matrix: Floats) -> HeadModel:
    if np.array_equal(matrix, np.eye(3)):
        return model

    return replace(
        model,
        vertices=_mapped(model.vertices, matrix),
        expressions={name: _mapped(offsets, matrix) for name, offsets in model.expressions.items()},
        identity_modes={name: _mapped(offsets, matrix) for name, offsets in model.identity_modes.items()},
    )


def _mapped(values: NDArray[np.float32], matrix: Floats) -> NDArray[np.float32]:
    return (values.astype(np.float64) @ matrix.T).astype(np.float32)


def _axes(model: HeadModel, findings: Findings) -> Floats:
    """Return the (3, 3) rotation, a quarter turn or several, that puts a model upright and facing z."""
    left, up = _leftward(model), _upward(model)
    if left is None or up is None:
        findings.guessed.append("Axes were taken as x to the left, y up, z forward: too few shapes are named to tell.")
        return np.eye(3)
    side = _snapped(left)
    top = _snapped(np.where(side != 0, 0, up))
    front = np.cross(side, top)
    if _forward(model) @ front < 0:
        wanted = "shapes of the left (_L, Left) to move the head's own left side"
        raise InvalidInputError(f"{model.name}: expected {wanted}, got its right; swap the names, or mirror the head")
    turn = np.stack([side, top, front])
    told = f"left is {_axis(side)}, up is {_axis(top)}, forward is {_axis(front)}"
    findings.found.append(
        f"Axes by what the expressions move: {told}." + ("" if (turn == np.eye(3)).all() else " Turned.")
    )
    return turn


def _leftward(model: HeadModel) -> Floats | None:
    """Return the way from what the right shapes move to what the left ones move."""
    named = {(one.stem, one.side): offsets for one, offsets in _meant(model)}
    ways = [
        centre_of(model.vertices, offsets) - centre_of(model.vertices, named[stem, "R"])
        for (stem, side), offsets in named.items()
        if side == "L" and (stem, "R") in named
    ]
    way = np.nansum([*ways, np.zeros(3)], axis=0)
    return way if way.any() else None


def _upward(model: HeadModel) -> Floats | None:
    centres = [
        [
            centre_of(model.vertices, offsets)
            for one, offsets in _meant(model)
            if one.stem.startswith(stems) and offsets.any()
        ]
        for stems in (_UPPER, _LOWER)
    ]
    if not all(centres):
        return None
    upper, lower = (np.mean(one, axis=0) for one in centres)
    return np.asarray(upper - lower)


def _forward(model: HeadModel) -> Floats:
    """Return the way from the middle of the head to what its expressions move."""
    centres = [centre_of(model.vertices, offsets) for offsets in model.expressions.values() if offsets.any()]
    low, high = model.vertices.min(axis=0), model.vertices.max(axis=0)
    return np.asarray(np.mean(centres, axis=0) - (low.astype(np.float64) + high) / 2)


def _meant(model: HeadModel) -> list[tuple[Meaning, NDArray[np.float32]]]:
    return [(meaning(name), offsets) for name, offsets in model.expressions.items()]


def _snapped(way: Floats) -> Floats:
    axis = np.zeros(3)
    strongest = int(np.abs(way).argmax())
    axis[strongest] = np.sign(way[strongest])
    return axis


def _axis(way: Floats) -> str:
    strongest = int(np.abs(way).argmax())
    return ("-" if way[strongest] < 0 else "") + _AXES[strongest]


def _scale(height: float, unit: str, findings: Findings) -> float:
    if unit:
        return _said(height, unit, findings)
    for name, scale in UNITS.items():
        if INFERRED[0] <= height * scale <= INFERRED[1]:
            findings.guessed.append(f"The unit is {name}: the head is {height:.4g} high, {height * scale:.0f} mm.")
            return scale
    wanted = f"a head of {INFERRED[0]:.0f} to {INFERRED[1]:.0f} mm in one of {', '.join(UNITS)}"
    raise InvalidInputError(f"size: expected {wanted}, got a height of {height:.4g}; say the unit with --unit")


def _said(height: float, unit: str, findings: Findings) -> float:
    if unit not in UNITS:
        raise InvalidInputError(f"unit: {expected(f'one of {sorted(UNITS)}', unit)}")
    scaled = height * UNITS[unit]
    if not SIZES[0] <= scaled <= SIZES[1]:
        wanted = f"a head of {SIZES[0]:.0f} to {SIZES[1]:.0f} mm"
        raise InvalidInputError(f"size: expected {wanted}, got {height:.4g} {unit}; this is no head, or not its unit")
    findings.found.append(f"The head is {scaled:.0f} mm high ({unit}, as said).")
    return UNITS[unit]


def _between_eyes(model: HeadModel, findings: Findings) -> Floats:
    balls = eyeballs(model)
    if balls is not None:
        apart = float(np.linalg.norm(balls[0] - balls[1]))
        findings.found.append(f"The eyes are {apart:.1f} mm apart.")
        if not _EYES_APART[0] <= apart <= _EYES_APART[1]:
            findings.guessed.append(
                "Eyes of people are about 62 mm apart: the unit may be another, or the head no adult's."
            )
        return (balls[0] + balls[1]) / 2
    lids = [centre_of(model.vertices, o) for one, o in _meant(model) if one.stem in ("eyeBlink", "eyeWide") and o.any()]
    if not lids:
        findings.guessed.append("The origin was left where it was: neither eyes nor lids are named.")
        return np.zeros(3)
    findings.guessed.append("The eyes are taken to be where the lids move.")
    return np.asarray(np.mean(lids, axis=0))
