"""Templates that contradict themselves are refused with the reason."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.transfer.packing.made_up import face_bumps, made_up_face
from emogen_core.transfer.packing.template import check_template

FACE = made_up_face(face_bumps()[:4], 7)


def bad(array, value, at=(1, 2)):
    changed = array.copy()
    changed[at] = value
    return changed


def test_a_sound_template_passes():
    check_template(FACE)
    check_template(replace(FACE, target=FACE.neutral * 2))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"names": (), "offsets": FACE.offsets[:0]}, "shapes: expected one or more, got 0"),
        ({"offsets": FACE.offsets[:2]}, r"offsets: expected shape \(4, 49, 3\), got \(2, 49, 3\)"),
        ({"offsets": FACE.offsets[:, :40]}, r"offsets: expected shape \(4, 49, 3\), got \(4, 40, 3\)"),
        ({"target": FACE.neutral[:40]}, r"target: expected shape \(49, 3\), got \(40, 3\); vertices"),
        ({"neutral": bad(FACE.neutral, np.nan)}, r"neutral: expected finite millimetres, got 'nan at \[1, 2\]'"),
        ({"target": bad(FACE.neutral, np.inf)}, r"target: expected finite millimetres, got 'inf at \[1, 2\]'"),
        ({"offsets": bad(FACE.offsets, np.nan, (3, 1, 0))}, r"offsets: expected finite .*, got 'nan at \[3, 1, 0\]'"),
        ({"offsets": bad(FACE.offsets, 0, 2)}, r"shapes: expected offsets other than 0, got \['browInnerUp_L'\]"),
        ({"triangles": FACE.triangles + 40}, "triangles: expected .* indices within 49 vertices"),
        ({"triangles": FACE.triangles[:, :2]}, "triangles: expected"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(change, said):
    with pytest.raises(InvalidInputError, match=f"^{said}"):
        check_template(replace(FACE, **change))
