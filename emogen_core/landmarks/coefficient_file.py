"""Files of blendshape coefficients: the CSV of Live Link Face, and results of MediaPipe's Face Landmarker as JSON.

A phone writes one row a frame, with `Timecode`, `BlendShapeCount`, the coefficients, and angles of head and eyes. Rows
of frames in which it saw no face have no values. MediaPipe's JavaScript names the coefficients ``faceBlendshapes``,
each face with ``categories`` of ``categoryName`` and ``score``; Python writes ``face_blendshapes`` and
``category_name``. Both are read, as one result or as a list of results.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from emogen_core.errors import InvalidInputError, expected
from emogen_core.landmarks.arkit import TABLE, arkit_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.landmarks.rows import Row

_TIME, _COUNT = "timecode", "blendshapecount"
_ANGLES = {f"{what}{angle}" for what in ("head", "lefteye", "righteye") for angle in ("yaw", "pitch", "roll")}
_NEUTRAL = "_neutral"
"""MediaPipe's name for what no coefficient says."""


@dataclass(frozen=True, slots=True)
class Coefficients:
    """One frame: its name, and ARKit name -> coefficient."""

    name: str
    values: dict[str, float]


@dataclass(frozen=True, slots=True)
class Recording:
    """A file: its frames, columns that are no coefficients, and coefficients that it lacks."""

    frames: tuple[Coefficients, ...]
    unknown: tuple[str, ...]
    missing: tuple[str, ...]


def read_recording(header: Sequence[str], rows: Sequence[Row]) -> Recording:
    """Return the frames of a CSV file as phones write them; frames without a face are left out.

    Raises:
        InvalidInputError: no column is a coefficient, no frame has a face, or a value is no number.
    """
    columns = {column.lower(): name for column in header if (name := arkit_name(column))}
    if not columns:
        wanted = "columns of feature points (name,dx,dy,dz) or ARKit names, as jawOpen"
        raise InvalidInputError(f"line 1: {expected(wanted, ','.join(header))}")
    frames = []
    for number, row in enumerate(rows, 1):
        if all(not row.fields.get(column) for column in columns):
            continue
        values = {name: row.number(column) for column, name in columns.items()}
        frames.append(Coefficients(row.fields.get(_TIME) or str(number), values))
    if not frames:
        raise InvalidInputError(f"file: {expected('a frame with a face', f'{len(rows)} without values')}")
    others = [name for name in header if name.lower() not in {*columns, *_ANGLES, _TIME, _COUNT}]
    return _recording(frames, others)


def read_mediapipe(text: str) -> Recording:
    """Return the frames of a JSON file with results of MediaPipe's Face Landmarker.

    Raises:
        InvalidInputError: not JSON, no blendshapes in it, or more than one face in a result.
    """
    results = _results(text)
    told = [(number, dict(_scores(number, result))) for number, result in enumerate(results, 1)]
    seen = [(number, scores) for number, scores in told if scores]
    frames = [Coefficients(str(number), _known(scores)) for number, scores in seen]
    others = [name for _, scores in seen for name in scores if name != _NEUTRAL and not arkit_name(name)]
    if not frames:
        raise InvalidInputError(f"file: {expected('a result with a face', f'{len(results)} without')}")
    if not any(frame.values for frame in frames):
        raise InvalidInputError(f"file: {expected('blendshapes with ARKit names', sorted(set(others)))}")
    return _recording(frames, others)


def _known(scores: dict[str, float]) -> dict[str, float]:
    return {known: value for name, value in scores.items() if (known := arkit_name(name))}


def _results(text: str) -> list[Any]:
    try:
        plain = json.loads(text)
    except (json.JSONDecodeError, RecursionError) as error:
        raise InvalidInputError(f"file: {expected('JSON', str(error))}") from None
    return plain if isinstance(plain, list) else [plain]


def _scores(number: int, result: Any) -> list[tuple[str, float]]:
    """Return names and scores of the face in a result; nothing if no face was seen."""
    where = f"result {number}"
    found = result if isinstance(result, dict) else {}
    given = found.get("faceBlendshapes", found.get("face_blendshapes"))
    if not isinstance(given, list):
        wanted = "faceBlendshapes of a Face Landmarker with outputFaceBlendshapes"
        raise InvalidInputError(f"{where}: {expected(wanted, 'none')}")
    if len(given) > 1:
        raise InvalidInputError(f"{where}: {expected('one face', len(given))}")
    face: Any = given[0] if given else []
    if isinstance(face, dict):
        face = face.get("categories")
    try:
        return [(str(one.get("categoryName") or one["category_name"]), float(one["score"])) for one in face]
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise InvalidInputError(
            f"{where}: {expected('categories with categoryName and score', type(error).__name__)}"
        ) from None


def _recording(frames: list[Coefficients], others: Sequence[str]) -> Recording:
    known = {name for frame in frames for name in frame.values}
    return Recording(tuple(frames), tuple(dict.fromkeys(others)), tuple(name for name in TABLE if name not in known))
