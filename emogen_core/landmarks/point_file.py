"""Feature points from a CSV file: motions (``name,dx,dy,dz``) or positions (``frame,name,x,y,z``).

Positions need a frame called ``neutral``. It is laid over the rig's own points by the similarity (rotation, shift and
scale) with the least squared error, and the motions are turned and scaled along: another head, and another camera,
speak of the same face.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from trimesh.registration import procrustes

from emogen_core.errors import InvalidInputError, expected
from emogen_core.landmarks.motions import FEWEST, Motions, check_finite, check_scale, make_motions
from emogen_core.landmarks.points import point_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.landmarks.rows import Row

    Floats = NDArray[np.float64]
    Named = dict[str, Floats]

UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0}
NEUTRAL = "neutral"
ONLY = "1"
"""Name of the frame of a file that names none."""
_MOTIONS, _POSITIONS = ("dx", "dy", "dz"), ("x", "y", "z")
_OFF = 25.0
"""A neutral point further than this from the rig's, millimetres, after the best fit, is not where its name says."""
_SCALES = (0.5, 2.0)
"""Heads differ in size by less than this."""
_FAR = 1e6
"""Millimetres from the camera: beyond this nothing is computed."""


@dataclass(frozen=True, eq=False)
class PointFrame:
    """The motions of one frame of a file."""

    name: str
    motions: Motions


def are_points(header: Sequence[str]) -> bool:
    """Return whether a file with these columns is one of feature points."""
    return "name" in {column.lower() for column in header}


def read_points(header: Sequence[str], rows: Sequence[Row], unit: str, points: Floats) -> list[PointFrame]:
    """Return the frames of a file of feature points.

    Args:
        header: names of the columns.
        rows: the file's rows.
        unit: of the file's numbers, one of `UNITS`.
        points: (P, 3) feature points of the driven head at rest, millimetres.

    Raises:
        InvalidInputError: other columns or another unit, no neutral frame beside positions, what `make_motions` and
            `check_scale` refuse, or neutral points that do not lie on a face.
    """
    if unit not in UNITS:
        raise InvalidInputError(f"unit: {expected(f'one of {list(UNITS)}', unit)}")
    known = {column.lower() for column in header}
    if known >= set(_MOTIONS):
        frames = _frames(rows, _MOTIONS, UNITS[unit])
        found = [PointFrame(name, _told(name, list(given), _stacked(given))) for name, given in frames.items()]
    elif known >= {*_POSITIONS, "frame"}:
        found = _moved(_frames(rows, _POSITIONS, UNITS[unit]), points)
    else:
        raise InvalidInputError(f"line 1: {expected('columns name,dx,dy,dz or frame,name,x,y,z', ','.join(header))}")
    check_scale([frame.motions for frame in found])
    return found


def _frames(rows: Sequence[Row], columns: tuple[str, ...], scale: float) -> dict[str, Named]:
    """Return frame -> point -> (3,) millimetres."""
    frames: dict[str, Named] = {}
    for row in rows:
        frame = frames.setdefault(row.fields.get("frame", "") or ONLY, {})
        name = row.fields.get("name", "")
        if name in frame:
            raise InvalidInputError(f"line {row.line}: {expected('every point once in a frame', name)}")
        frame[name] = scale * np.array([row.number(column) for column in columns])
    return frames


def _moved(frames: dict[str, Named], points: Floats) -> list[PointFrame]:
    neutral = frames.pop(NEUTRAL, None)
    if neutral is None or not frames:
        raise InvalidInputError(
            f"frame: {expected(f'a frame {NEUTRAL} and others', [*frames, *[NEUTRAL] * bool(neutral)])}"
        )
    turn = _turned_onto(neutral, points)
    found = []
    for frame, given in frames.items():
        missing = [name for name in given if name not in neutral]
        if missing:
            raise InvalidInputError(
                f"frame {NEUTRAL}: {expected(f'all points of frame {frame}', f'none for {missing}')}"
            )
        away = _stacked(given) - np.stack([neutral[name] for name in given])
        found.append(PointFrame(frame, _told(frame, list(given), away @ turn.T)))
    return found


def _turned_onto(neutral: Named, points: Floats) -> Floats:
    """Return the (3, 3) rotation and scale that lay neutral points over those of the rig."""
    names, given = list(neutral), _stacked(neutral)
    wanted = points[point_rows(names)]
    check_finite(names, given)
    if len(names) < FEWEST:
        raise InvalidInputError(f"frame {NEUTRAL}: {expected(f'at least {FEWEST} points', len(names))}")
    if np.abs(given).max() > _FAR:
        raise InvalidInputError(
            f"frame {NEUTRAL}: {expected(f'places within {_FAR:g} mm', float(np.abs(given).max()))}"
        )
    size, rest = (float(np.linalg.norm(p - p.mean(0), axis=1).mean()) for p in (given, wanted))
    if not _SCALES[0] <= size / rest <= _SCALES[1]:
        raise InvalidInputError(
            f"frame {NEUTRAL}: {expected(f'points {rest:.3g} mm about their middle', f'{size:.3g} mm')}: another unit"
            " than millimetres (--unit m, --unit cm)?"
        )
    matrix, laid, _ = procrustes(given, wanted, reflection=False)
    away = np.linalg.norm(laid - wanted, axis=1)
    off = [f"{name} ({far:.0f} mm)" for name, far in zip(names, away, strict=True) if far > _OFF]
    if off:
        raise InvalidInputError(
            f"frame {NEUTRAL}: {expected(f'points within {_OFF:g} mm of their place on the face', off)}: off the face,"
            " or left and right exchanged (docs/landmarks.md has a picture)"
        )
    turn: Floats = np.asarray(matrix, np.float64)[:3, :3]
    return turn


def _told(frame: str, names: list[str], vectors: Floats) -> Motions:
    """Return checked motions; a complaint names the frame."""
    try:
        return make_motions(names, vectors)
    except InvalidInputError as error:
        raise InvalidInputError(f"frame {frame}: {error}") from None


def _stacked(named: Named) -> Floats:
    return np.stack(list(named.values()))
