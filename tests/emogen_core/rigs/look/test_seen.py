"""What no portrait shows is left out."""

import numpy as np

from emogen_core.rendering.plain import plain_look
from emogen_core.rigs.look.seen import seen_layers
from tests.emogen_core.rendering.ball import ball_rig


def test_the_far_side_of_a_ball_goes_and_the_near_side_stays():
    rig = ball_rig()
    layer = plain_look(rig).layers["skin"]
    layers, left = seen_layers(rig, {"skin": layer})
    kept = layers["skin"]
    assert np.array_equal(kept.source, layer.source[left["skin"]])
    assert np.array_equal(kept.uv, layer.uv[left["skin"]])
    assert set(np.unique(kept.triangles)) == set(range(len(kept.source)))

    def middles(mesh):
        outward = rig.neutral("ball")[mesh.source[mesh.triangles]].mean(1) - (0, -10, -80)
        return outward / np.linalg.norm(outward, axis=1, keepdims=True)

    assert middles(kept)[:, 2].min() > -0.55
    near = (middles(layer)[:, 2] > 0).sum()
    assert near <= len(kept.triangles) < len(layer.triangles)
