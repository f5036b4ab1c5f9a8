"""The 56 feature points on a head that is not the bundled one: where the bundled head's come to lie on it.

The bundled head is laid over the other, as an import does it, and each of its points goes to the vertex of skin that is
nearest in place, faces the same way and is on the same side of the mouth. Of pupils the overlay knows nothing: theirs
are the vertices that are next to where the cornea bulges.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.landmarks.points import FeaturePoint, bundled_points
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.imported.gaze import find_eyeball
from emogen_core.rigs.imported.lying import bundled_on, front_of, skin_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

_PUPILS = {"3.5": "eye_left", "3.6": "eye_right"}
_FEWEST = 8  # vertices of an eyeball


def placed_points(rig: Rig) -> tuple[FeaturePoint, ...]:
    """Return the 56 points on a rig of another mesh than the bundled one; takes seconds.

    Raises:
        InvalidInputError: too little of a face is found on it, or it has no eyeballs.
    """
    template, findings = load_bundled_rig(), Findings()
    known = bundled_points(template)
    front = front_of(rig)
    lying = bundled_on(template, template.identities[0], front, findings)
    if lying is None:
        raise InvalidInputError(f"feature points: {findings.missing[0]} Expected a head with eyes and a jaw that opens")
    skin = skin_of(front)
    tree = cKDTree(skin.features()[skin.used])
    near = skin.used[tree.query(lying.features()[[point.vertex for point in known]])[1]]
    pupils = dict(_pupils(rig))
    return tuple(
        FeaturePoint(point.name, point.meaning, pupils.get(point.name, int(vertex)))
        for point, vertex in zip(known, near, strict=True)
    )


def _pupils(rig: Rig) -> Iterable[tuple[str, int]]:
    neutral = rig.neutral(rig.identities[0])
    for name, part in _PUPILS.items():
        rows: NDArray[np.intp] = np.unique(rig.triangles[slice(*rig.parts.get(part, (0, 0)))]).astype(np.intp)
        if len(rows) < _FEWEST:
            raise InvalidInputError(f"feature points: {expected('a rig with both eyeballs', f'none for {name}')}")
        eye = find_eyeball(neutral, rows)
        yield name, int(rows[((neutral[rows] - eye.centre - eye.radius * eye.axis) ** 2).sum(1).argmin()])
