"""The 56 feature points of MPEG-4 (ISO/IEC 14496-2, facial definition parameters) on the bundled mesh.

Zhu & Lee (2006) use 56 of the standard's 84 points and do not list them: none of tongue, teeth, ears and hair, and not
all of those that lie close together at the eyes. Left out here are 4 points of the tongue, 4 of the teeth, 10 of the
ears, 5 of the hair, the 4 outer edges of the lids, and the centre about which the head turns (7.1), which no expression
moves. The border between hair and forehead (11.1) stays. Left and right are the head's own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig


@dataclass(frozen=True, slots=True)
class FeaturePoint:
    """One point: its name in the standard, what it is, and its vertex on a mesh."""

    name: str
    meaning: str
    vertex: int


# Name, meaning and vertex of the points in the middle.
_MIDDLE = (
    ("2.1", "bottom of the chin", 732),
    ("2.2", "middle of the inner upper lip contour", 474),
    ("2.3", "middle of the inner lower lip contour", 493),
    ("2.10", "chin boss", 4900),
    ("8.1", "middle of the outer upper lip contour", 4748),
    ("8.2", "middle of the outer lower lip contour", 492),
    ("9.3", "nose tip", 4642),
    ("9.12", "middle lower edge of the nose bone", 1462),
    ("9.15", "bottom middle edge of the nose", 343),
    ("11.1", "middle border between hair and forehead", 5431),
)
# Names of the left and of the right point, meaning with {} for the side and with {} for the other one, left vertex.
_PAIRS = (
    ("2.4", "2.5", "{0} corner of the inner lip contour", 2660),
    ("2.6", "2.7", "middle of the {0} half of the inner upper lip contour", 6690),
    ("2.8", "2.9", "middle of the {0} half of the inner lower lip contour", 2625),
    ("2.11", "2.12", "chin {0} corner", 3611),
    ("2.13", "2.14", "{0} corner of the jaw bone", 7619),
    ("3.1", "3.2", "middle of the {0} upper lid's edge", 2173),
    ("3.3", "3.4", "middle of the {0} lower lid's edge", 2216),
    ("3.5", "3.6", "middle of the {0} pupil", 12926),
    ("3.7", "3.12", "{0} corner of the {0} eye", 2190),
    ("3.11", "3.8", "{1} corner of the {0} eye", 4201),
    ("4.1", "4.2", "{1} corner of the {0} eyebrow", 6442),
    ("4.3", "4.4", "uppermost point of the {0} eyebrow", 2384),
    ("4.5", "4.6", "{0} corner of the {0} eyebrow", 2419),
    ("5.1", "5.2", "middle of the {0} cheek", 7670),
    ("5.3", "5.4", "{0} cheek bone", 8462),
    ("8.3", "8.4", "{0} corner of the outer lip contour", 2517),
    ("8.5", "8.6", "middle of the {0} half of the outer upper lip contour", 3775),
    ("8.7", "8.8", "middle of the {0} half of the outer lower lip contour", 6612),
    ("8.10", "8.9", "{0} high point of Cupid's bow", 2598),
    ("9.1", "9.2", "{0} nostril border", 6566),
    ("9.5", "9.4", "bottom {0} edge of the nose", 2442),
    ("9.7", "9.6", "{0} upper edge of the nose bone", 2286),
    ("9.13", "9.14", "{0} lower edge of the nose bone", 2377),
)
PAIRS = tuple((left, right) for left, right, _, _ in _PAIRS)
"""Names of mirror images: the left point, the right one."""


def is_bundled_mesh(rig: Rig) -> bool:
    """Return whether a rig is of the mesh on which the points are known by number."""
    return np.array_equal(rig.triangles, load_bundled_rig().triangles)


def bundled_points(rig: Rig) -> tuple[FeaturePoint, ...]:
    """Return the 56 points in the order of the standard, with their vertices on the bundled mesh.

    Raises:
        InvalidInputError: the rig has another mesh (`emogen_core.rigs.landmark_head` finds them there).
    """
    if not is_bundled_mesh(rig):
        got = f"{len(rig.triangles)} other triangles"
        raise InvalidInputError(f"feature points: {expected('the bundled mesh', got)}")
    points = [FeaturePoint(*row) for row in _MIDDLE]
    for left, right, meaning, vertex in _PAIRS:
        points.append(FeaturePoint(left, meaning.format("left", "right"), vertex))
        points.append(FeaturePoint(right, meaning.format("right", "left"), int(rig.mirror[vertex])))
    return tuple(sorted(points, key=lambda point: _order(point.name)))


def point_rows(names: Sequence[str], known: Sequence[str] = ()) -> NDArray[np.intp]:
    """Return where named points stand among the 56 (or among ``known``).

    Raises:
        InvalidInputError: names that are not among them, or one given twice.
    """
    order = {name: row for row, name in enumerate(known or NAMES)}
    unknown = [name for name in names if name not in order]
    if unknown:
        raise InvalidInputError(f"points: {expected('MPEG-4 names, as 8.3 (emogen landmarks points)', unknown)}")
    twice = sorted({name for name in names if list(names).count(name) > 1}, key=_order)
    if twice:
        raise InvalidInputError(f"points: {expected('every point once', twice)}")
    return np.array([order[name] for name in names], np.intp)


def _order(name: str) -> tuple[int, ...]:
    return tuple(int(part) for part in name.split("."))


NAMES = tuple(sorted([*(name for name, _, _ in _MIDDLE), *(name for pair in PAIRS for name in pair)], key=_order))
"""Names of the 56 points, in the order of the standard."""
