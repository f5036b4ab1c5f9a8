"""Feature points on a head that the bundled one is laid over: near where they are known to be."""

from dataclasses import replace

import numpy as np
import pytest

from emogen_core.errors import InvalidInputError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.landmarks.points import NAMES, bundled_points, is_bundled_mesh
from emogen_core.rigs.imported.points import placed_points
from emogen_core.rigs.landmark_head import driven_head, feature_points
from tests.rig_factory import small_rig

RIG = load_bundled_rig()
KNOWN = {point.name: point.vertex for point in bundled_points(RIG)}


def shuffled(rig, who):
    """One head of the bundled rig with its vertices in another order, and where each of them went."""
    order = np.random.default_rng(7).permutation(len(rig.mirror))
    place = np.argsort(order)
    other = replace(
        rig,
        neutrals={who: rig.neutrals[who][order]},
        offsets=rig.offsets[:, order],
        triangles=place[rig.triangles].astype(np.int32),
        mirror=np.zeros(0, np.int32),
        adjustments={},
        hash="",
    )
    return other, place


@pytest.mark.parametrize("who", ["asian-male-old", "african-female-young"])
def test_points_come_near_to_where_they_are(who):
    rig, place = shuffled(RIG, who)
    assert not is_bundled_mesh(rig)
    found = feature_points(rig)
    assert tuple(point.name for point in found) == NAMES
    neutral = rig.neutral(who)
    away = {p.name: np.linalg.norm(neutral[p.vertex] - neutral[place[KNOWN[p.name]]]) for p in found}
    # Along a smooth surface places slide, cheeks and hairline most.
    assert np.median([*away.values()]) < 2, away
    assert max(away.values()) < 12, away
    assert max(away["3.5"], away["3.6"]) < 1
    # What belongs to the lower lip goes with the jaw, and the upper lip stays.
    moved = driven_head(rig, who, found).offsets_at_points[rig.shape_names.index("jawOpen"), :, 1]
    drop = dict(zip(NAMES, -moved, strict=True))
    assert min(drop[name] for name in ("2.3", "2.8", "2.9", "8.2")) > 15
    assert max(drop[name] for name in ("2.2", "2.6", "2.7", "8.1")) < 5


def test_too_little_of_a_face_is_refused():
    with pytest.raises(InvalidInputError, match=r"feature points: .*a head with eyes and a jaw"):
        placed_points(small_rig())


def test_a_head_without_one_eyeball_is_refused():
    rig, _ = shuffled(RIG, "male")
    parts = {name: rows for name, rows in rig.parts.items() if name != "eye_right"}
    with pytest.raises(InvalidInputError, match=r"feature points: .*(eyeballs|places)"):
        placed_points(replace(rig, parts=parts))
